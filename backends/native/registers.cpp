#include "backends/native/registers.hpp"

#include "celltrace/error.hpp"

#include <cstring>
#include <utility>

namespace celltrace::native {

namespace {

constexpr ea_t kQuadword = 16;
constexpr ea_t kLastWord = 0xC;
constexpr std::uint32_t kRegisters = 3;

} // namespace

RegisterMap::RegisterMap(std::vector<Channels*> spes)
    : spes_(std::move(spes)), pages_(std::make_unique<Page[]>(spes_.size())),
      begin_(reinterpret_cast<std::uintptr_t>(pages_.get())), bytes_(spes_.size() * sizeof(Page)) {
}

ea_t RegisterMap::address(unsigned spe, Register which) const {
  return begin_ + spe * sizeof(Page) + static_cast<std::uint32_t>(which) * kQuadword + kLastWord;
}

RegisterMap::Register RegisterMap::write(ea_t ea, const void* ls, std::uint32_t size) const {
  std::uint32_t value;
  if (size != sizeof value) throw SpeError("DMA write to problem state that is not one word");
  std::memcpy(&value, ls, sizeof value);
  const ea_t offset = ea - begin_;
  const ea_t quadword = offset % sizeof(Page) / kQuadword;
  if (offset % kQuadword != kLastWord || quadword >= kRegisters)
    throw SpeError("DMA write to an address in problem state where no register lies");
  Channels& channels = *spes_[offset / sizeof(Page)];
  const auto which = static_cast<Register>(quadword);
  switch (which) {
  case Register::signal_1:
    channels.write_signal(Signal::one, value);
    break;
  case Register::signal_2:
    channels.write_signal(Signal::two, value);
    break;
  case Register::in_mailbox:
    channels.put_in_mailbox(value);
    break;
  }
  return which;
}

} // namespace celltrace::native

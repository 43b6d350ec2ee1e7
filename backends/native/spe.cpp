#include "backends/native/spe.hpp"

#include "celltrace/error.hpp"

#include <new>
#include <string>

namespace celltrace::native {

namespace {

constexpr std::align_val_t kArenaAlignment{kLineBytes};

} // namespace

Spe::Spe(unsigned spe, const SignalMode (&modes)[2], Doorbell& ppe) : id(spe), channels(modes, ppe) {
  arena.begin = static_cast<std::uint8_t*>(::operator new(kArenaBytes, kArenaAlignment));
  arena.end = arena.begin + kArenaBytes;
  arena.next = arena.begin;
}

Spe::~Spe() {
  ::operator delete(arena.begin, kArenaAlignment);
}

void Spe::begin() {
  arena.next = arena.begin;
  mfc->reset();
  channels.begin();
}

void Spe::end() {
  tracked_arena();
  mfc->reset();
  channels.end();
}

void Spe::halt(HaltCode code) const {
  throw SpeError("halted: " + std::string(to_text(code)) + " (code " +
                 std::to_string(static_cast<std::uint32_t>(code)) + ")");
}

} // namespace celltrace::native

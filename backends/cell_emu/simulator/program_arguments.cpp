#include "backends/cell_emu/simulator/program_arguments.hpp"

#include "backends/cell_emu/simulator/big_endian.hpp"
#include "celltrace/error.hpp"

#include <cstring>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint32_t kMaxTransfer = 16384;
constexpr std::size_t kQuadword = 16;

std::size_t rounded(std::size_t bytes, std::size_t to) {
  return (bytes + to - 1) / to * to;
}

/// Returns the word at an address, or 0 outside of the program.
std::uint32_t word_of(const SpuElf& elf, std::uint32_t lsa) {
  for (const ElfSegment& segment : elf.segments())
    if (lsa >= segment.lsa && lsa - segment.lsa + 4 <= segment.content.size())
      return load_big_endian<std::uint32_t>(segment.content.data() + (lsa - segment.lsa));
  return 0;
}

} // namespace

StartRegisters StartRegisters::of(std::uint64_t spe_id, std::uint64_t argp, std::uint64_t local_store) {
  StartRegisters registers{};
  registers.spe_id.set<std::uint64_t>(0, spe_id);
  registers.argp.set<std::uint64_t>(0, argp);
  registers.local_store.set<std::uint64_t>(0, local_store);
  return registers;
}

bool fetches_argv(const SpuElf& elf) {
  // No symbol tells crt2 from crt1. crt2 is recognised by an instruction near its beginning that passes
  // register 4 to the MFC.
  constexpr std::uint32_t kWriteLsaFromArgp = 0x21A00804; // wrch $ch16,$4
  constexpr std::uint32_t kFirstWords = 8;
  for (std::uint32_t i = 0; i < kFirstWords; ++i)
    if (word_of(elf, elf.entry() + 4 * i) == kWriteLsaFromArgp) return true;
  return false;
}

ProgramArguments::ProgramArguments(const std::vector<std::string>& arguments)
    : count_(static_cast<std::uint32_t>(arguments.size())) {
  // In the PPE's form each string begins at a quadword, so that the program can fetch it by DMA.
  const std::size_t ppe_pointers = rounded((arguments.size() + 1) * sizeof(std::uint64_t), kQuadword);
  const std::size_t spu_pointers = (arguments.size() + 1) * sizeof(std::uint32_t);
  std::size_t ppe_bytes = ppe_pointers, spu_bytes = spu_pointers;
  for (const std::string& argument : arguments) {
    ppe_bytes += rounded(argument.size() + 1, kQuadword);
    spu_bytes += argument.size() + 1;
  }
  spu_bytes = rounded(spu_bytes, kQuadword);
  if (spu_bytes > kMaxTransfer)
    throw InputError("the arguments of the program take " + std::to_string(spu_bytes) + " bytes, more than " +
                     std::to_string(kMaxTransfer));
  local_bytes_ = static_cast<std::uint32_t>(spu_bytes);
  ppe_argv_.resize(rounded(ppe_bytes, kLineBytes) / kLineBytes);
  spu_argv_.resize(rounded(spu_bytes, kLineBytes) / kLineBytes);

  std::uint8_t* const ppe = ppe_argv_.front().bytes;
  std::uint8_t* const spu = spu_argv_.front().bytes;
  std::size_t ppe_at = ppe_pointers, spu_at = spu_pointers;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::size_t bytes = arguments[i].size() + 1;
    store_big_endian<std::uint64_t>(ppe + i * sizeof(std::uint64_t), ppe_argv() + ppe_at);
    store_big_endian<std::uint32_t>(spu + i * sizeof(std::uint32_t),
                                    kLocalStoreBytes - local_bytes_ + static_cast<std::uint32_t>(spu_at));
    std::memcpy(ppe + ppe_at, arguments[i].c_str(), bytes);
    std::memcpy(spu + spu_at, arguments[i].c_str(), bytes);
    ppe_at += rounded(bytes, kQuadword);
    spu_at += bytes;
  }
}

StartRegisters ProgramArguments::for_fetching(std::uint64_t local_store) const {
  const std::uint64_t ea = reinterpret_cast<std::uintptr_t>(spu_argv_.data());
  StartRegisters registers = StartRegisters::of(0, 0, local_store);
  registers.spe_id.set<std::uint32_t>(0, count_);
  registers.argp.set<std::uint32_t>(0, kLocalStoreBytes - local_bytes_);
  registers.argp.set<std::uint32_t>(1, static_cast<std::uint32_t>(ea >> 32));
  registers.argp.set<std::uint32_t>(2, static_cast<std::uint32_t>(ea));
  registers.argp.set<std::uint32_t>(3, local_bytes_);
  return registers;
}

} // namespace celltrace::cell_emu

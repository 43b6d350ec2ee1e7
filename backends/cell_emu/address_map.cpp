#include "backends/cell_emu/address_map.hpp"

namespace celltrace::cell_emu {
namespace {

// Offsets in an SPE's problem state (Linux asm/spu.h, struct spu_problem).
constexpr ea_t kInMailbox = 0x0400C;
constexpr ea_t kSignal1 = 0x1400C;
constexpr ea_t kSignal2 = 0x1C00C;

ea_t address_of(const void* block) {
  return reinterpret_cast<std::uintptr_t>(block);
}

} // namespace

AddressMap::Block AddressMap::allocate(std::size_t bytes, std::size_t alignment) {
  const auto align = std::align_val_t{alignment};
  return Block(new (align) std::uint8_t[bytes], Free{align});
}

AddressMap::AddressMap(unsigned spes)
    : spes_(spes), local_stores_(spes),
      problem_states_(allocate(spes * std::size_t{kProblemStateBytes}, kProblemStateBytes)),
      local_store_base_(address_of(local_stores_.begin())),
      problem_state_base_(address_of(problem_states_.get())) {
}

SpeAddresses AddressMap::addresses(unsigned spe) const {
  const ea_t registers = problem_state_base_ + spe * kProblemStateBytes;
  return {address_of(local_store(spe)), registers + kSignal1, registers + kSignal2, registers + kInMailbox};
}

AddressMap::Place AddressMap::locate_local_store(ea_t offset, std::uint32_t size) const {
  // There is a gap in front of the first local store, and behind each local store.
  if (offset < kLocalStoreBytes) return {EaKind::unmapped, 0};
  const ea_t in_stride = (offset - kLocalStoreBytes) % LocalStoreBlock::kStride;
  if (in_stride + size > kLocalStoreBytes) return {EaKind::unmapped, 0};
  return {EaKind::local_store, static_cast<unsigned>((offset - kLocalStoreBytes) / LocalStoreBlock::kStride)};
}

AddressMap::Place AddressMap::locate_register(ea_t offset) const {
  const auto spe = static_cast<unsigned>(offset / kProblemStateBytes);
  switch (offset % kProblemStateBytes) {
  case kInMailbox:
    return {EaKind::in_mailbox, spe};
  case kSignal1:
    return {EaKind::signal_1, spe};
  case kSignal2:
    return {EaKind::signal_2, spe};
  default:
    return {EaKind::no_register, spe};
  }
}

} // namespace celltrace::cell_emu

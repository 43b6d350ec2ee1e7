// The main storage domain: maps local stores and problem-state registers into the host's memory.
//
// Main memory is the host's; an effective address is a host address. Local stores lie in one block, each
// aligned to 256 KB, with gaps in between that are no storage. Problem-state addresses are in reserved
// memory, so that no object of the host can have the same address; the registers have their architected
// offsets.
#pragma once

#include "backends/cell_emu/local_store_block.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <memory>
#include <new>

namespace celltrace::cell_emu {

/// Thread safety: immutable after construction.
class AddressMap {
public:
  struct Place {
    EaKind kind;
    unsigned spe; ///< owner of the local store or the register; else 0
  };

  explicit AddressMap(unsigned spes);

  unsigned spes() const { return spes_; }
  std::uint8_t* local_store(unsigned spe) const { return local_stores_.local_store(spe); }
  const LocalStoreBlock& local_stores() const { return local_stores_; }
  SpeAddresses addresses(unsigned spe) const;

  /// Returns the kind of storage at [ea, ea + size), and its SPE.
  Place locate(ea_t ea, std::uint32_t size) const {
    const ea_t in_local_stores = ea - local_store_base_;
    if (in_local_stores < local_stores_.bytes()) return locate_local_store(in_local_stores, size);
    const ea_t in_problem_state = ea - problem_state_base_;
    if (in_problem_state < spes_ * kProblemStateBytes) return locate_register(in_problem_state);
    return {is_host_memory(ea, size) ? EaKind::main_memory : EaKind::unmapped, 0};
  }

private:
  static constexpr ea_t kProblemStateBytes = 0x20000;
  /// First address that counts as mapped. No system maps its lowest pages: an address below is a null
  /// pointer, or an offset used as an address.
  static constexpr ea_t kFirstMapped = 0x10000;

  struct Free {
    std::align_val_t alignment;
    void operator()(std::uint8_t* block) const { ::operator delete[](block, alignment); }
  };
  using Block = std::unique_ptr<std::uint8_t[], Free>;
  static Block allocate(std::size_t bytes, std::size_t alignment);

  Place locate_local_store(ea_t offset, std::uint32_t size) const;
  Place locate_register(ea_t offset) const;
  bool is_host_memory(ea_t ea, std::uint32_t size) const {
    return ea >= kFirstMapped && ea + size >= ea && local_store_base_ - ea >= size &&
           problem_state_base_ - ea >= size;
  }

  unsigned spes_;
  LocalStoreBlock local_stores_;
  Block problem_states_;
  ea_t local_store_base_;
  ea_t problem_state_base_;
};

} // namespace celltrace::cell_emu

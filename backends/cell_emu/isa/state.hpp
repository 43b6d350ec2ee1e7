// State and Environment: the registers and local store of one SPU, on which instructions work, and the
// interface to everything else.
#pragma once

#include "celltrace/spe/quadword.hpp"

#include <cstdint>

namespace celltrace::isa {

constexpr std::uint32_t kLocalStoreLimit = 0x3FFFF;

/// Everything that an SPU accesses outside its registers and its local store.
class Environment {
public:
  virtual ~Environment() = default;

  virtual std::uint32_t read_channel(unsigned channel) = 0;
  virtual void write_channel(unsigned channel, std::uint32_t value) = 0;
  virtual std::uint32_t channel_count(unsigned channel) = 0;

  /// Executes stop and stopd. Execution continues at State::next, which the call may change.
  virtual void stop(std::uint32_t code) = 0;
  /// Executes a halt instruction (such as heq) whose condition holds.
  virtual void halt() = 0;
  virtual void invalid_instruction(std::uint32_t word) = 0;

  /// Returns true if the event status has a count: the condition of bisled.
  virtual bool has_event() = 0;
  /// Enables or disables interrupts, for branches with an E or D bit.
  virtual void enable_interrupts(bool enabled) = 0;
  virtual std::uint32_t srr0() = 0;

  /// Called before a load or store of a quadword with the bit kWatchLoads or kWatchStores in its watch byte.
  virtual void watched_load(std::uint32_t lsa) = 0;
  virtual void watched_store(std::uint32_t lsa, const Quadword& value) = 0;
};

/// The state of one SPU. Thread safety: none.
struct State {
  Quadword gpr[128] = {};
  Quadword fpscr = {};
  std::uint32_t pc = 0;                ///< address of the present instruction: a multiple of 4 below 256 KB
  std::uint32_t next = 4;              ///< address of the next instruction; branches change it
  std::uint8_t* local_store = nullptr; ///< 256 KB
  const std::uint8_t* watch = nullptr; ///< one byte for each quadword of local store: 16,384
  Environment* environment = nullptr;

  static constexpr std::uint8_t kWatchLoads = 1, kWatchStores = 2;

  /// Returns the quadword at an address, whose low four bits and bits beyond 256 KB are ignored.
  Quadword load(std::uint32_t address) const {
    const std::uint32_t lsa = address & (kLocalStoreLimit & ~15u);
    if ((watch[lsa >> 4] & kWatchLoads) != 0) [[unlikely]]
      environment->watched_load(lsa);
    return Quadword::load(local_store + lsa);
  }
  void store(std::uint32_t address, const Quadword& value) {
    const std::uint32_t lsa = address & (kLocalStoreLimit & ~15u);
    if ((watch[lsa >> 4] & kWatchStores) != 0) [[unlikely]]
      environment->watched_store(lsa, value);
    value.store(local_store + lsa);
  }
};

} // namespace celltrace::isa

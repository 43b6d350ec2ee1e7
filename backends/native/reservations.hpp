// Lock-line reservations of the SPEs of one machine.
#pragma once

#include "backends/native/channels.hpp"
#include "celltrace/spe/types.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace celltrace::native {

/// Implements getllar, putllc and putlluc for threads. Every line maps to one of a few locks. An SPE has at
/// most one reservation, which any other write of the line by an SPE of the machine takes away (event 0x400).
///
/// Deviations from the architecture: while no SPE has a reservation, a plain put is one memmove. If such a
/// put runs at the same time as a getllar of the same line, the reservation may survive the put; puts that
/// are ordered after the getllar by a signal, a mailbox or another lock line take the reservation. Stores by
/// the PPE never take reservations.
///
/// Thread safety: all members may be called from any thread.
class Reservations {
public:
  /// Makes reservations; `spes[i]` are the channels of SPE i, which outlive this object.
  explicit Reservations(std::vector<Channels*> spes);

  // In get_and_reserve(), put_conditional() and put_unconditional() the low seven bits of `ea` are ignored,
  // as by the hardware.

  void get_and_reserve(unsigned spe, void* ls, ea_t ea);
  /// Writes the line if the SPE still has its reservation; returns whether it did.
  bool put_conditional(unsigned spe, const void* ls, ea_t ea);
  void put_unconditional(unsigned spe, const void* ls, ea_t ea);
  /// Writes `size` bytes at any address, for plain puts.
  void put(unsigned spe, const void* ls, ea_t ea, std::size_t size);
  /// Gives up the SPE's reservation, if any.
  void release(unsigned spe) noexcept;

private:
  static constexpr std::size_t kLocks = 64;
  static constexpr ea_t kNone = 0;

  struct alignas(kLineBytes) Lock {
    std::mutex mutex;
  };

  std::mutex& lock_of(ea_t line) { return locks_[line / kLineBytes % kLocks].mutex; }
  bool take(unsigned spe, ea_t line) noexcept;
  void take_from_others(unsigned spe, ea_t line);

  std::vector<Channels*> spes_;
  std::array<Lock, kLocks> locks_;
  /// By SPE: the reserved line, or kNone; set under the lock of the line.
  std::vector<std::atomic<ea_t>> reserved_;
  std::atomic<unsigned> held_{0}; ///< number of SPEs that hold a reservation
};

} // namespace celltrace::native

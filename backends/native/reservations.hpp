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

/// Implements getllar, putllc and putlluc for threads: every line maps to one of a few locks, and every SPE
/// has at most one reservation, which any other write of that line by an SPE of the machine takes away (event
/// 0x400).
///
/// Deviation from the architecture: a plain put is one memmove as long as no SPE holds a reservation, so a
/// put that runs at the same time as a getllar of its line (rather than being ordered after it by a signal, a
/// mailbox or another lock line) may go unnoticed by it. Stores by the PPE are not noticed either.
///
/// Thread safety: all members may be called from any thread.
class Reservations {
public:
  /// Makes reservations; `spes[i]` are the channels of SPE i, which outlive this object.
  explicit Reservations(std::vector<Channels*> spes);

  // For all members below `ea` names a 128-byte line; its low seven bits are ignored, as by the hardware.

  void get_and_reserve(unsigned spe, void* ls, ea_t ea);
  /// Writes if the reservation still holds; returns whether it did.
  bool put_conditional(unsigned spe, const void* ls, ea_t ea);
  void put_unconditional(unsigned spe, const void* ls, ea_t ea);
  /// Writes bytes of any number and place.
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
  std::vector<std::atomic<ea_t>> reserved_; ///< per SPE: its line, or kNone; set under the lock of the line
  std::atomic<unsigned> held_{0};           ///< number of SPEs that hold a reservation
};

} // namespace celltrace::native

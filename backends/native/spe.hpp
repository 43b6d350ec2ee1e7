// One SPE of the native machine: the state that its Spu object operates on, whatever the SIMD.
#pragma once

#include "backends/native/channels.hpp"
#include "backends/native/counters.hpp"
#include "backends/native/mfc.hpp"
#include "celltrace/spe/spu.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace::native {

/// The exception that unwinds a kernel that ended by a stop with one of the exit codes.
struct Exited {
  std::uint32_t code;
};

/// Bytes of an SPE's arena, which is all of its local store. Far more than a Cell's; code and stack, which
/// a Cell keeps in local store, do not lie in it.
constexpr std::uint32_t kArenaBytes = 1024 * 1024;

struct Spe {
  Spe(unsigned id, const SignalMode (&modes)[2], Doorbell& ppe);
  Spe(const Spe&) = delete;
  Spe& operator=(const Spe&) = delete;
  ~Spe();

  /// Empties the arena and resets the MFC and the SPU's own channels.
  void begin();
  /// Ends the kernel: resets the MFC, and tells the PPE the exit code.
  void end(std::uint32_t exit_code);

  /// Returns the arena, for the SPE's thread. Every change of its fill is preceded by a call, which updates
  /// the peak.
  ArenaState& tracked_arena() {
    counters.local_store_peak.raise_to(static_cast<std::uint64_t>(arena.next - arena.begin));
    return arena;
  }
  /// Stops with a 14-bit code: ends the kernel, or waits for the PPE.
  void stop(std::uint32_t code);
  /// Ends the kernel with an SpeError.
  [[noreturn]] void halt(HaltCode code) const;

  const unsigned id;
  Counters counters;
  Channels channels;
  std::unique_ptr<Mfc> mfc;                       ///< set once the machine's registers are mapped
  const std::vector<SpeAddresses>* all = nullptr; ///< addresses of all SPEs of the machine
  ArenaState arena{};
};

} // namespace celltrace::native

// One SPE of the native machine: the state that its Spu object works on, independent of the SIMD level.
#pragma once

#include "backends/native/channels.hpp"
#include "backends/native/counters.hpp"
#include "backends/native/mfc.hpp"
#include "celltrace/spe/spu.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace celltrace::native {

/// The exception that ends a kernel that stopped with one of the exit codes.
struct Exited {
  std::uint32_t code;
};

/// Bytes of an SPE's arena, its only local store: far more than on a Cell, although code and stack lie
/// elsewhere.
constexpr std::uint32_t kArenaBytes = 1024 * 1024;

struct Spe {
  Spe(unsigned id, const SignalMode (&modes)[2], Doorbell& ppe);
  Spe(const Spe&) = delete;
  Spe& operator=(const Spe&) = delete;
  ~Spe();

  /// Empties the arena and resets the MFC and the SPU's own channels.
  void begin();
  /// Tells the PPE that the kernel has ended.
  void end(std::uint32_t exit_code);

  /// Returns the arena, for the SPE's thread, and updates the peak of its use: each change of
  /// ArenaState::next is preceded by a call.
  ArenaState& tracked_arena() {
    counters.local_store_peak.raise_to(static_cast<std::uint64_t>(arena.next - arena.begin));
    return arena;
  }
  /// Stops with a 14-bit code. Ends the kernel if this is an exit code, else waits until the PPE resumes the
  /// kernel.
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

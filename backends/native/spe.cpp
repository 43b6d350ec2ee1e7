#include "backends/native/spe.hpp"

#include "celltrace/error.hpp"

#include <new>
#include <string>

namespace celltrace::native {

namespace {

constexpr std::align_val_t kArenaAlignment{kLineBytes};

// First and number of the stop codes that end a program, as in libspe2.
constexpr std::uint32_t kExitStop = 0x2000;
constexpr std::uint32_t kExitCodes = 0x100;

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

void Spe::end(std::uint32_t exit_code) {
  tracked_arena();
  mfc->reset();
  channels.end(exit_code);
}

void Spe::stop(std::uint32_t code) {
  if (code - kExitStop < kExitCodes) throw Exited{code - kExitStop};
  channels.stop_and_signal(code);
}

void Spe::halt(HaltCode code) const {
  throw SpeError("halted: " + std::string(to_text(code)) + " (code " +
                 std::to_string(static_cast<std::uint32_t>(code)) + ")");
}

} // namespace celltrace::native

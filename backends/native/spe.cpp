#include "backends/native/spe.hpp"

#include "celltrace/error.hpp"

#include <new>
#include <string>

namespace celltrace::native {

namespace {

constexpr std::align_val_t kArenaAlignment{kLineBytes};

const char* reason(HaltCode code) {
  switch (code) {
  case HaltCode::local_store_exhausted:
    return "local store is exhausted";
  case HaltCode::bad_argument:
    return "bad argument";
  case HaltCode::internal_error:
    return "internal error";
  }
  return "unknown halt code";
}

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
  throw SpeError("halted: " + std::string(reason(code)) + " (code " +
                 std::to_string(static_cast<std::uint32_t>(code)) + ")");
}

} // namespace celltrace::native

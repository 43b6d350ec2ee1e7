// System calls of Linux on PowerPC that newlib for the SPU makes: read_ea() and related calls, and getpid.
#include "backends/cell_emu/simulator/ppe/ppe_state.hpp"

#include <unistd.h>

namespace celltrace::cell_emu {

namespace {

/// The arguments of a system call: doublewords behind the call's number.
class LinuxArguments {
public:
  LinuxArguments(const LocalStoreView& local_store, std::uint32_t block)
      : local_store_(local_store), block_(block) {}

  std::uint64_t number() const { return local_store_.load<std::uint64_t>(block_); }
  std::uint64_t operator[](unsigned argument) const {
    return local_store_.load<std::uint64_t>(block_ + 8 + 8 * argument);
  }

private:
  LocalStoreView local_store_;
  std::uint32_t block_;
};

enum class Direction { in, out };

OpenFile& file(PpeState& state, std::uint64_t descriptor) {
  return *state.files.at(static_cast<std::int32_t>(descriptor));
}

std::uint64_t transfer(OpenFile& file, std::span<std::uint8_t> memory, Direction direction) {
  if (direction == Direction::in) return file.read(memory);
  file.write({reinterpret_cast<const char*>(memory.data()), memory.size()});
  return memory.size();
}

std::uint64_t transfer_one(PpeState& state, const LinuxArguments& arguments, Direction direction) {
  return transfer(file(state, arguments[0]), state.effective_memory(arguments[1], arguments[2]), direction);
}

std::uint64_t transfer_at(PpeState& state, const LinuxArguments& arguments, Direction direction) {
  const int host = file(state, arguments[0]).host_descriptor();
  const auto offset = static_cast<off_t>(arguments[3]);
  if (host < 0) throw CallFailed{SpuErrno::illegal_seek};
  const auto memory = state.effective_memory(arguments[1], arguments[2]);
  const ssize_t count = direction == Direction::in ? ::pread(host, memory.data(), memory.size(), offset)
                                                   : ::pwrite(host, memory.data(), memory.size(), offset);
  if (count < 0) fail_with_host_errno();
  return static_cast<std::uint64_t>(count);
}

/// Reads or writes the parts of a list in main memory; each part has a doubleword of address and a doubleword
/// of length.
std::uint64_t transfer_list(PpeState& state, const LinuxArguments& arguments, Direction direction) {
  constexpr std::uint64_t kMostParts = 1024;
  OpenFile& target = file(state, arguments[0]);
  if (arguments[2] > kMostParts) throw CallFailed{SpuErrno::invalid};
  const auto list = state.effective_memory(arguments[1], arguments[2] * 16);
  std::uint64_t total = 0;
  for (std::size_t at = 0; at < list.size(); at += 16) {
    const auto ea = load_big_endian<std::uint64_t>(list.data() + at),
               bytes = load_big_endian<std::uint64_t>(list.data() + at + 8);
    const std::uint64_t done = transfer(target, state.effective_memory(ea, bytes), direction);
    total += done;
    if (done < bytes) break;
  }
  return total;
}

std::uint64_t answer(PpeState& state, const LinuxArguments& arguments) {
  switch (arguments.number()) {
  case 3:
    return transfer_one(state, arguments, Direction::in);
  case 4:
    return transfer_one(state, arguments, Direction::out);
  case 145:
    return transfer_list(state, arguments, Direction::in);
  case 146:
    return transfer_list(state, arguments, Direction::out);
  case 179:
    return transfer_at(state, arguments, Direction::in);
  case 180:
    return transfer_at(state, arguments, Direction::out);
  case 20: // getpid
  case 207:
    return 1; // gettid: all SPEs are one process, which has the same number in every run
  default:
    throw CallFailed{SpuErrno::not_implemented};
  }
}

} // namespace

void answer_linux_call(PpeState& state, const LocalStoreView& local_store, std::uint32_t block) {
  constexpr std::uint32_t kBlockBytes = 7 * 8;
  try {
    local_store.range(block, kBlockBytes);
  } catch (const CallFailed&) {
    return; // the block is not in local store, so the result cannot be stored
  }
  std::uint64_t result = 0;
  try {
    result = answer(state, LinuxArguments(local_store, block));
  } catch (const CallFailed& failure) {
    result = ~static_cast<std::uint64_t>(failure.error) + 1;
  }
  local_store.store(block, result);
}

} // namespace celltrace::cell_emu

// Calls that allocate and map main memory: malloc_ea(), mmap_ea() and related calls.
#include "backends/cell_emu/simulator/ppe/ppe_state.hpp"

#include <array>
#include <bit>
#include <cstring>

#include <unistd.h>

namespace celltrace::cell_emu {

namespace {

using Arguments = CallArguments;

std::uint64_t allocate(PpeState& state, std::uint64_t bytes, std::uint64_t alignment = EaHeap::kAlignment) {
  const std::uint64_t ea = state.ea_heap.allocate(bytes, alignment);
  if (ea == 0) throw CallFailed{SpuErrno::no_memory};
  return ea;
}

std::uint64_t allocate_zeros(PpeState& state, std::uint64_t bytes,
                             std::uint64_t alignment = EaHeap::kAlignment) {
  const std::uint64_t ea = allocate(state, bytes, alignment);
  std::memset(state.ea_heap.at(ea, bytes), 0, static_cast<std::size_t>(bytes));
  return ea;
}

std::uint64_t reallocate(PpeState& state, std::uint64_t ea, std::uint64_t bytes,
                         std::uint64_t alignment = EaHeap::kAlignment) {
  const std::optional<std::uint64_t> had = state.ea_heap.bytes_at(ea);
  if (!had) throw CallFailed{SpuErrno::invalid};
  const std::uint64_t moved = allocate(state, bytes, alignment);
  const auto copied = static_cast<std::size_t>(std::min(*had, bytes));
  std::memcpy(state.ea_heap.at(moved, bytes), state.ea_heap.at(ea, *had), copied);
  state.ea_heap.release(ea);
  return moved;
}

CallResult answer_calloc(PpeState& state, const Arguments& arguments) {
  const std::uint64_t count = arguments.doubleword(0), bytes = arguments.doubleword(1);
  if (bytes != 0 && count > ~std::uint64_t{0} / bytes) throw CallFailed{SpuErrno::no_memory};
  return CallResult::wide(allocate_zeros(state, count * bytes));
}

CallResult answer_free(PpeState& state, const Arguments& arguments) {
  state.ea_heap.release(arguments.doubleword(0));
  return CallResult::number(0);
}

CallResult answer_malloc(PpeState& state, const Arguments& arguments) {
  return CallResult::wide(allocate(state, arguments.doubleword(0)));
}

CallResult answer_realloc(PpeState& state, const Arguments& arguments) {
  const std::uint64_t ea = arguments.doubleword(0), bytes = arguments.doubleword(1);
  if (ea == 0) return CallResult::wide(allocate(state, bytes));
  if (bytes == 0) {
    state.ea_heap.release(ea);
    return CallResult::wide(0);
  }
  return CallResult::wide(reallocate(state, ea, bytes));
}

/// Answers posix_memalign_ea(), which returns the error instead of setting errno. Stores the pointer with 32
/// bits, as the library is compiled, unless the address needs more.
CallResult answer_aligned(PpeState& state, const Arguments& arguments) {
  const auto failure = [](SpuErrno error) { return CallResult::number(static_cast<std::int64_t>(error)); };
  const std::uint64_t alignment = arguments.doubleword(1), bytes = arguments.doubleword(2);
  if (!std::has_single_bit(alignment) || alignment < 4) return failure(SpuErrno::invalid);
  const std::uint64_t ea = state.ea_heap.allocate(bytes, alignment);
  if (ea == 0) return failure(SpuErrno::no_memory);
  if (ea >> 32 == 0)
    arguments.local_store().store(arguments.word(0), static_cast<std::uint32_t>(ea));
  else
    arguments.local_store().store(arguments.word(0), ea);
  return CallResult::number(0);
}

// --- mmap
// -------------------------------------------------------------------------------------------------------

constexpr std::uint32_t kProtectionWrite = 2, kShared = 1, kFixed = 0x10, kAnonymous = 0x20, kMayMove = 1;
constexpr std::uint64_t kPageBytes = 4096;

/// Reads a part of a file; bytes behind the file's end are zero.
void read_file(int descriptor, std::span<std::uint8_t> to, std::int64_t offset) {
  while (!to.empty()) {
    const ssize_t count = ::pread(descriptor, to.data(), to.size(), offset);
    if (count < 0) fail_with_host_errno();
    if (count == 0) break;
    to = to.subspan(static_cast<std::size_t>(count));
    offset += count;
  }
}

constexpr std::array kMemoryCalls = {
    PpeCall{},
    PpeCall{answer_calloc, PpeCall::OnFailure::zero},
    PpeCall{answer_free, PpeCall::OnFailure::zero},
    PpeCall{answer_malloc, PpeCall::OnFailure::zero},
    PpeCall{answer_realloc, PpeCall::OnFailure::zero},
    PpeCall{answer_aligned},
};

} // namespace

std::span<const PpeCall> memory_calls() {
  return kMemoryCalls;
}

CallResult map_memory(PpeState& state, const Arguments& arguments) {
  const std::uint64_t bytes = arguments.word(1);
  const std::uint32_t protection = arguments.word(2), flags = arguments.word(3);
  const std::int64_t offset = arguments.number(5);
  if (bytes == 0 || (flags & kFixed) != 0 || offset < 0 || offset % kPageBytes != 0)
    throw CallFailed{SpuErrno::invalid};
  if ((flags & kAnonymous) != 0) return CallResult::wide(allocate_zeros(state, bytes, kPageBytes));

  const int descriptor = state.files.at(arguments.number(4))->host_descriptor();
  // Shared writable mappings are refused: the program gets a copy, so that its writes would not reach the
  // file.
  const bool written = (flags & kShared) != 0 && (protection & kProtectionWrite) != 0;
  if (descriptor < 0 || written) throw CallFailed{SpuErrno::no_device};
  const std::uint64_t ea = allocate_zeros(state, bytes, kPageBytes);
  try {
    read_file(descriptor, {state.ea_heap.at(ea, bytes), static_cast<std::size_t>(bytes)}, offset);
  } catch (const CallFailed&) {
    state.ea_heap.release(ea);
    throw;
  }
  return CallResult::wide(ea);
}

CallResult remap_memory(PpeState& state, const Arguments& arguments) {
  const std::uint64_t ea = arguments.doubleword(0), bytes = arguments.word(2);
  if (bytes == 0) throw CallFailed{SpuErrno::invalid};
  if ((arguments.word(3) & kMayMove) == 0) throw CallFailed{SpuErrno::no_memory};
  return CallResult::wide(reallocate(state, ea, bytes, kPageBytes));
}

CallResult synchronize_memory(PpeState& state, const Arguments& arguments) {
  if (state.ea_heap.at(arguments.doubleword(0), arguments.word(1)) == nullptr)
    throw CallFailed{SpuErrno::no_memory};
  return CallResult::number(0);
}

/// Unmaps memory, which must be a whole block.
CallResult unmap_memory(PpeState& state, const Arguments& arguments) {
  if (!state.ea_heap.release(arguments.doubleword(0))) throw CallFailed{SpuErrno::invalid};
  return CallResult::number(0);
}

} // namespace celltrace::cell_emu

// Programs that touch local store which a get in flight targets, for the tools that find that: each case
// prints the line that does it, for the test that runs them and reads the tool's report. `clean` has nothing
// to report.
#include "celltrace/emulator.hpp"

#include <cstdio>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

namespace celltrace {
namespace {

using Spu = EmulatedSpu;

/// Says which line it is, and does what that line is for.
#define AT_THIS_LINE(...) std::printf("line %d\n", __LINE__), std::fflush(stdout), (void)(__VA_ARGS__)

struct alignas(128) Data {
  std::int32_t from[256];
  std::int32_t to[256] = {};
  Data() { std::iota(from, from + 256, 1); }
};

Data data;
std::int32_t sink;

void run(const MachineConfig& config, void (*program)(Spu&)) {
  const EmulatedRun run = emulate(config, program);
  std::printf("%s\n%s\n", run.ok() ? "ok" : "not ok", run.report().c_str());
}

std::int32_t* get(Spu& spu, std::uint32_t tag, std::uint32_t bytes = 128) {
  auto* buffer = spu.allocate<std::int32_t>(32);
  spu.get(buffer, to_ea(data.from), bytes, tag);
  return buffer;
}

void read(Spu& spu) {
  const std::int32_t* buffer = get(spu, 0);
  AT_THIS_LINE(sink = buffer[3]);
  spu.wait_all(1);
}

void write(Spu& spu) {
  std::int32_t* buffer = get(spu, 0);
  AT_THIS_LINE(buffer[31] += 1);
  spu.wait_all(1);
}

void of_another_tag(Spu& spu) {
  const std::int32_t* first = get(spu, 1);
  const std::int32_t* second = get(spu, 2);
  spu.wait_all(1u << 1);
  sink = first[0];
  AT_THIS_LINE(sink = second[0]);
  spu.wait_all(1u << 2);
}

void behind_a_fence(Spu& spu) {
  const std::int32_t* first = get(spu, 1);
  auto* second = spu.allocate<std::int32_t>(32);
  spu.getf(second, to_ea(data.from), 128, 1);
  spu.compute({.fixed = 100000}); // time enough for both
  (void)spu.completed(1u << 2);
  AT_THIS_LINE(sink = first[0]);
  spu.wait_all(1u << 1);
}

/// The pattern of double buffering: results go, and the next data come into the same buffer.
void behind_its_put(Spu& spu) {
  std::int32_t* buffer = get(spu, 1);
  spu.wait_all(1u << 1);
  buffer[0] += 1;
  spu.put(buffer, to_ea(data.to), 128, 1);
  spu.getf(buffer, to_ea(data.from), 128, 1);
  spu.compute({.fixed = 100000});
  (void)spu.completed(1u << 2);
  AT_THIS_LINE(sink = buffer[5]);
  spu.wait_all(1u << 1);
}

/// The SPU may not look, though the MFC may go on with it.
void ahead_of_its_put(Spu& spu) {
  const std::int32_t* buffer = get(spu, 1);
  spu.putf(buffer, to_ea(data.to), 128, 1);
  spu.compute({.fixed = 100000});
  (void)spu.completed(1u << 2);
  AT_THIS_LINE(sink = buffer[5]);
  spu.wait_all(1u << 1);
}

void of_a_list(Spu& spu) {
  auto* buffer = spu.allocate<std::int32_t>(64);
  auto* list = spu.allocate<ListElement>(2);
  list[0] = ListElement::make(128, to_ea(data.from));
  list[1] = ListElement::make(128, to_ea(data.from + 32));
  spu.getl(buffer, to_ea(data.from), list, 2, 3);
  AT_THIS_LINE(sink = buffer[40]);
  spu.wait_all(1u << 3);
}

void of_8_bytes(Spu& spu) {
  const std::int32_t* buffer = get(spu, 0, 8);
  sink = buffer[2];
  AT_THIS_LINE(sink = buffer[1]);
  spu.wait_all(1);
}

void of_4_bytes(Spu& spu) {
  const std::int32_t* buffer = get(spu, 0, 4);
  sink = buffer[1];
  AT_THIS_LINE(sink = buffer[0]);
  spu.wait_all(1);
}

/// Exceptions on an SPE's stack, and one that ends the program with a get in flight.
void throws(Spu& spu) {
  try {
    throw std::runtime_error("caught");
  } catch (const std::runtime_error& error) {
    sink = error.what()[0];
  }
  get(spu, 5);
  throw std::runtime_error("not caught");
}

/// Every transfer is waited for, in several ways, and all that is allowed meanwhile is done.
void correct(Spu& spu) {
  const ea_t own_target = to_ea(data.to + 64 * spu.id());
  std::int32_t* first = get(spu, 1);
  const std::int32_t* second = get(spu, 2);
  spu.wait_any(1u << 1);
  sink = first[31];
  spu.put(first, own_target, 128, 1);
  sink = first[0]; // as the source of a put it may be read
  spu.mfc_barrier(4);
  spu.wait_all(1u << 4);
  sink = second[1]; // the barrier was behind this one
  spu.getf(first, to_ea(data.from), 128, 1);
  spu.putf(first, own_target, 128, 1);
  while (spu.completed(1u << 1) == 0) {
  }
  sink = first[2];
  spu.wait_all(1u << 2);
  const std::int32_t* small = get(spu, 6, 4);
  spu.wait_all(1u << 6);
  sink = small[0];
  struct Padded {
    char tag = 1;
    alignas(16) float value = 2;
  };
  auto* padded = spu.allocate<Padded>(4);
  for (int i = 0; i < 4; ++i)
    padded[i] = Padded(); // with bytes that nobody has set
  spu.put(padded, own_target, sizeof(Padded) * 4, 7);
  spu.wait_all(1u << 7);
}

MachineConfig with_transfers(TransferTime when) {
  MachineConfig config = lockstep(1);
  config.emulation.transfers = when;
  return config;
}

void clean() {
  for (const auto when : {TransferTime::at_issue, TransferTime::at_wait, TransferTime::random}) {
    run(with_transfers(when), correct);
    run(with_transfers(when), throws); // and the next machine may use the memory
  }
  run(exploring_with_faults(3, 7), correct);
  run(free_running(2), correct);
}

const std::map<std::string, void (*)()> kCases = {
    {"read", [] { run(lockstep(1), read); }},
    {"write", [] { run(lockstep(1), write); }},
    {"read of data that came at once", [] { run(with_transfers(TransferTime::at_issue), read); }},
    {"read of data that came in between", [] { run(exploring(1, 4), read); }},
    {"read on a thread of its own", [] { run(free_running(1), read); }},
    {"of another tag", [] { run(lockstep(2), of_another_tag); }},
    {"behind a fence", [] { run(lockstep(1), behind_a_fence); }},
    {"behind its put", [] { run(lockstep(1), behind_its_put); }},
    {"ahead of its put", [] { run(lockstep(1), ahead_of_its_put); }},
    {"of a list", [] { run(lockstep(1), of_a_list); }},
    {"of 8 bytes", [] { run(lockstep(1), of_8_bytes); }},
    {"of 4 bytes", [] { run(lockstep(1), of_4_bytes); }},
    {"clean", clean},
};

} // namespace
} // namespace celltrace

int main(int arguments, char** values) {
  const auto found = celltrace::kCases.find(arguments == 2 ? values[1] : "");
  if (found == celltrace::kCases.end()) return 2;
  found->second();
}

// Three programs for one SPE, each of which adds 1 to a block of main memory, and each wrong. What does the
// emulator say of them, and what does it not say?
//
//   missing_wait never|late|early
#include <celltrace/emulator.hpp>

#include <cstdio>
#include <string>

using celltrace::EmulatedSpu;

namespace {

alignas(128) float data[32] = {1, 2, 3};

float* begin(EmulatedSpu& spu) {
  float* buffer = spu.allocate<float>(32);
  spu.get(buffer, celltrace::to_ea(data), sizeof data, 0);
  return buffer;
}

void never_waits(EmulatedSpu& spu) {
  float* buffer = begin(spu);
  buffer[0] += 1; // who says that the data are there?
}

void waits_too_late(EmulatedSpu& spu) {
  float* buffer = begin(spu);
  buffer[0] += 1;
  spu.wait_all(1 << 0);
  spu.put(buffer, celltrace::to_ea(data), sizeof data, 0);
  spu.wait_all(1 << 0);
}

void reads_too_early(EmulatedSpu& spu) {
  const float* buffer = begin(spu);
  float* results = spu.allocate<float>(32);
  for (int i = 0; i < 32; ++i)
    results[i] = buffer[i] + 1;
  spu.wait_all(1 << 0);
  spu.put(results, celltrace::to_ea(data), sizeof data, 0);
  spu.wait_all(1 << 0);
}

} // namespace

int main(int arguments, char** values) {
  const std::string which = arguments == 2 ? values[1] : "";
  if (which != "never" && which != "late" && which != "early") {
    std::puts("missing_wait never|late|early");
    return 2;
  }
  const auto program = which == "never" ? never_waits : which == "late" ? waits_too_late : reads_too_early;
  const celltrace::EmulatedRun run = celltrace::emulate(celltrace::lockstep(1), program);
  std::printf("%s\n%s", run.ok() ? "no rule was broken" : "a rule was broken:", run.report().c_str());
  return run.ok() ? 0 : 1;
}

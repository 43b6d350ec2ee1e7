// Runs normals.c, a program for the SPU with its intrinsics, on the emulated Cell; and, given the same
// program as the SPU's compiler made it, in the simulator, where it has to give the same bits:
//
//   spe_intrinsics [normals.elf]
#include "normals.h"

#include <celltrace/simulator.hpp>
#include <celltrace/spe/byte_order.hpp>
#include <celltrace/spe/spu_mfcio.hpp>

#include <bit>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// The main() of normals.c.
int normals_main(unsigned long long speid, unsigned long long argp, unsigned long long envp);

namespace {

constexpr unsigned kBlocks = 4, kVectors = kBlocks * NORMALS_BLOCK;

/// Words in the order of the machine's SPUs.
struct Vectors {
  alignas(128) std::uint32_t x[kVectors];
  alignas(128) std::uint32_t y[kVectors];
  alignas(128) std::uint32_t z[kVectors];
};

struct Outcome {
  std::vector<std::uint32_t> words;
  std::uint32_t zeros = 0;
};

template <class Integer> Integer in_order(Integer value, std::endian order) {
  celltrace::reorder(value, order);
  return value;
}

/// Vectors of many lengths, every hundredth of none.
Vectors make_vectors(std::endian order) {
  Vectors vectors{};
  std::uint32_t state = 1;
  const auto component = [&](unsigned i) {
    state = state * 1664525 + 1013904223;
    const float value = static_cast<float>(static_cast<std::int32_t>(state)) * 0x1p-20f;
    return in_order(std::bit_cast<std::uint32_t>(i % 100 == 0 ? 0.0f : value), order);
  };
  for (unsigned i = 0; i < kVectors; ++i) {
    vectors.x[i] = component(i);
    vectors.y[i] = component(i);
    vectors.z[i] = component(i);
  }
  return vectors;
}

/// `run` runs the program with its control block at an address, and the PPE's part.
template <class Run> Outcome outcome_of(std::endian order, Run run) {
  using namespace celltrace;
  auto vectors = std::make_unique<Vectors>(make_vectors(order));
  normals_control control{};
  control.x = in_order<std::uint64_t>(to_ea(vectors->x), order);
  control.y = in_order<std::uint64_t>(to_ea(vectors->y), order);
  control.z = in_order<std::uint64_t>(to_ea(vectors->z), order);
  control.blocks = in_order<std::uint32_t>(kBlocks, order);
  Outcome outcome;
  const auto ppe = [&](Machine& machine) {
    std::optional<std::uint32_t> zeros;
    while (!(zeros = machine.read_out_mailbox(0)))
      machine.wait_for_mail(std::chrono::milliseconds(100));
    outcome.zeros = *zeros;
  };
  // The program may touch these objects, but not leave them.
  const std::vector<MemoryObject> objects = {memory_object(vectors->x, "x"), memory_object(vectors->y, "y"),
                                             memory_object(vectors->z, "z"),
                                             memory_object(control, "control")};
  const EmulatedRun ran = run(objects, to_ea(&control), ppe);
  if (!ran.ok()) throw std::runtime_error(ran.report());
  for (const auto* component : {vectors->x, vectors->y, vectors->z})
    for (unsigned i = 0; i < kVectors; ++i)
      outcome.words.push_back(in_order(component[i], order));
  return outcome;
}

Outcome on_the_emulated_cell() {
  using namespace celltrace;
  return outcome_of(std::endian::native, [](const auto& objects, ea_t control, const auto& ppe) {
    MachineConfig config = lockstep(1);
    config.emulation.objects = objects;
    return emulate(config, spe_main(normals_main), control, ppe);
  });
}

Outcome in_the_simulator(const char* path) {
  using namespace celltrace;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(std::string("cannot read ") + path);
  const std::vector<std::uint8_t> elf{std::istreambuf_iterator<char>(file), {}};
  return outcome_of(std::endian::big, [&](const auto& objects, ea_t control, const auto& ppe) -> EmulatedRun {
    MachineConfig config = simulated(1);
    config.emulation.objects = objects;
    return simulate(config, elf, control, ppe);
  });
}

} // namespace

int main(int argc, char** argv) {
  try {
    const Outcome emulated = on_the_emulated_cell();
    const auto component = [&](unsigned i) { return std::bit_cast<float>(emulated.words[i]); };
    std::printf("%u vectors, %u of length 0; number 1: %.7f %.7f %.7f\n", kVectors, emulated.zeros,
                component(1), component(kVectors + 1), component(2 * kVectors + 1));
    if (argc < 2) return 0;
    const Outcome simulated = in_the_simulator(argv[1]);
    const bool same = simulated.zeros == emulated.zeros && simulated.words == emulated.words;
    std::printf("%s\n",
                same ? "the SPU's machine code gives the same bits" : "the SPU's machine code differs");
    return same ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "spe_intrinsics: %s\n", error.what());
    return 1;
  }
}

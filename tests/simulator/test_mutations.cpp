// Programs damaged at random: the loader refuses each with a reason or keeps its promises, and the SPU ends
// each in some way that a report has words for. The sanitizers watch.
#include "backends/cell_emu/simulator/code_places.hpp"
#include "celltrace/error.hpp"
#include "celltrace/simulator.hpp"
#include "simulator/elf_image.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace celltrace;
using namespace celltrace::test;
using cell_emu::CodePlaces;
using cell_emu::SpuElf;

namespace {

/// Bytes near the start, in the tables and anywhere are changed, swapped for extreme values, or cut off.
Bytes damaged(Bytes image, std::mt19937& random) {
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const std::size_t sections = cell_emu::load_big_endian<std::uint32_t>(image.data() + 32);
  for (std::size_t n = 1 + below(4); n > 0 && !image.empty(); --n) {
    std::size_t at = below(image.size());
    if (below(3) == 0) at = below(std::min<std::size_t>(image.size(), 160));
    if (below(3) == 0 && sections < image.size()) at = sections + below(image.size() - sections);
    switch (below(4)) {
    case 0:
      image[at] = static_cast<std::uint8_t>(random());
      break;
    case 1:
      image[at] ^= static_cast<std::uint8_t>(1u << below(8));
      break;
    case 2: {
      static constexpr std::uint32_t kExtremes[] = {0,          1,       0x7FFFFFFF, 0x80000000,
                                                    0xFFFFFFFF, 0x3FFFF, 0x40000};
      if (at / 4 * 4 + 4 <= image.size()) put<std::uint32_t>(image, at / 4 * 4, kExtremes[below(7)]);
      break;
    }
    default:
      if (below(8) == 0) image.resize(at);
      break;
    }
  }
  return image;
}

/// Returns whether the image was accepted.
bool survive(const Bytes& image) {
  try {
    const SpuElf elf(image);
    Bytes local_store(256 * 1024);
    elf.load(local_store.data());
    CHECK(elf.program_end() <= local_store.size());
    CHECK(elf.entry() % 4 == 0);
    CHECK(elf.entry() < local_store.size());
    const CodePlaces places(elf);
    for (std::uint32_t lsa = 0; lsa < 0x1000; lsa += 64)
      if (const auto place = places.at(lsa); place.function != nullptr) CHECK(place.function[0] != 0);
    return true;
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).starts_with("SPU program: "));
    return false;
  }
}

void survive_mutations(const Bytes& image) {
  std::mt19937 random(20051213);
  REQUIRE(survive(image));
  int accepted = 0;
  constexpr int kMutations = 3000;
  for (int i = 0; i < kMutations; ++i)
    accepted += survive(damaged(image, random)) ? 1 : 0;
  CHECK(accepted > kMutations / 20);
  CHECK(accepted < kMutations);
}

} // namespace

TEST_CASE("a hand-made program survives damage") {
  ElfImage elf = small_program();
  elf.add_section(".data", 1, {1, 2, 3});
  survive_mutations(elf.build());
}

#ifdef CELLTRACE_SIMULATOR_PROGRAMS
TEST_CASE("a compiled program survives damage") {
  survive_mutations(read_file(CELLTRACE_SIMULATOR_PROGRAMS "/lines.elf"));
}

namespace {

/// Instructions and data are changed, and the program is run. Effective addresses are pointers of this
/// process: the program must have no DMA of its own, so that a few damaged bytes cannot make up a whole
/// command.
void run_mutations(const Bytes& image, int count) {
  std::mt19937 random(20060317);
  const SpuElf elf(image);
  MachineConfig config = simulated(1);
  config.emulation.cycle_limit = 300000;
  int ended = 0, broken = 0;
  for (int i = 0; i < count; ++i) {
    Bytes mutation = image;
    for (std::size_t n = 1 + random() % 4; n > 0; --n) {
      const auto content = elf.segments()[random() % 8 == 0 ? elf.segments().size() - 1 : 0].content;
      const auto start = static_cast<std::size_t>(content.data() - elf.image().data());
      mutation[start + random() % content.size()] = static_cast<std::uint8_t>(random());
    }
    const SimulatedRun run = simulate(config, mutation);
    CHECK(run.errors.size() == 1);
    ended += run.errors[0].empty() ? 1 : 0;
    broken += run.diagnostics.empty() ? 0 : 1;
    for (const Diagnostic& diagnostic : run.diagnostics)
      CHECK_FALSE(diagnostic.text.empty());
  }
  // Not all of the code is executed.
  CHECK(ended > count / 20);
  CHECK(broken > count / 20);
}

} // namespace

TEST_CASE("a compiled program that is damaged ends in some way") {
  run_mutations(read_file(CELLTRACE_SIMULATOR_PROGRAMS "/lines.elf"), 1000);
}
#endif

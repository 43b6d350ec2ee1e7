// Grades process_blocks(): points for each thing that it has to be.
#include "task.hpp"

#include <cstdio>
#include <string>
#include <vector>

using namespace celltrace;

void work_on(EmulatedSpu& spu, float* block) {
  for (std::uint32_t i = 0; i < kBlockFloats; ++i)
    block[i] = 2 * block[i] + 1;
  // More than that takes, so that it is worth hiding transfers behind it.
  spu.compute({.floating = kBlockFloats, .memory = kBlockFloats / 2, .waits = 800});
}

namespace {

constexpr unsigned kSpes = 2;
constexpr std::uint32_t kBlocks = 12; // of each SPE
/// Cycles of one buffer, which student.cpp begins with, and of which an answer may take so much at most.
constexpr double kMostOfSingleBuffered = 0.7;

struct Result {
  EmulatedRun run;
  bool right = true;
};

/// The program as it stands at first, to compare with.
void with_one_buffer(EmulatedSpu& spu, ea_t argument) {
  Task* task = spu.allocate<Task>();
  spu.get(task, argument, sizeof *task, 0);
  spu.wait_all(1);
  float* buffer = spu.allocate<float>(kBlockFloats);
  for (std::uint32_t i = 0; i < task->count; ++i) {
    const ea_t block = task->blocks + i * sizeof(float) * kBlockFloats;
    spu.get(buffer, block, sizeof(float) * kBlockFloats, 0);
    spu.wait_all(1);
    work_on(spu, buffer);
    spu.put(buffer, block, sizeof(float) * kBlockFloats, 0);
    spu.wait_all(1);
  }
}

/// `count`: 0 and 1 are where programs with two buffers go wrong.
Result execute(const MachineConfig& config, void (*program)(EmulatedSpu&, ea_t), std::uint32_t count) {
  struct alignas(128) Block {
    float numbers[kBlockFloats];
  };
  std::vector<Block> blocks(kSpes * kBlocks);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::uint32_t k = 0; k < kBlockFloats; ++k)
      blocks[i].numbers[k] = static_cast<float>(i + k);
  Task tasks[kSpes];
  for (unsigned spe = 0; spe < kSpes; ++spe)
    tasks[spe] = {to_ea(&blocks[spe * kBlocks]), count};

  Result result;
  result.run = emulate(config, [&](EmulatedSpu& spu) { program(spu, to_ea(&tasks[spu.id()])); });
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::uint32_t k = 0; k < kBlockFloats; ++k) {
      const auto before = static_cast<float>(i + k);
      result.right &= blocks[i].numbers[k] == (i % kBlocks < count ? 2 * before + 1 : before);
    }
  return result;
}

class Grade {
public:
  void add(int points, const std::string& what, bool reached, const std::string& why_not = {}) {
    std::printf("%d of %d  %s\n", reached ? points : 0, points, what.c_str());
    if (!reached && !why_not.empty()) std::printf("%s\n", why_not.c_str());
    points_ += reached ? points : 0;
    of_ += points;
  }
  int finish() const {
    std::printf("%d of %d points\n", points_, of_);
    return points_ == of_ ? 0 : 1;
  }

private:
  int points_ = 0, of_ = 0;
};

} // namespace

int main() {
  Grade grade;
  const Result result = execute(lockstep(kSpes), process_blocks, kBlocks);
  grade.add(2, "each block is worked on once", result.right);
  grade.add(2, "no rule is broken", result.run.ok(), result.run.report());

  bool few = true;
  for (const std::uint32_t count : {0u, 1u, 2u, 3u}) {
    const Result part = execute(lockstep(kSpes), process_blocks, count);
    few &= part.right && part.run.ok();
  }
  grade.add(1, "0, 1, 2 and 3 blocks are no exception", few);

  std::string failed;
  for (unsigned seed = 0; seed < 100 && failed.empty(); ++seed) {
    const Result order = execute(exploring_with_faults(kSpes, seed), process_blocks, kBlocks);
    if (!order.right || !order.run.ok()) failed = "seed " + std::to_string(seed) + "\n" + order.run.report();
  }
  grade.add(2, "nor is any of 100 orders of events", failed.empty(), failed);

  const std::uint64_t local_store = result.run.spes[0].local_store_peak;
  grade.add(1, "at most 32 KB of local store", local_store <= 32 * 1024,
            std::to_string(local_store) + " bytes");

  const Result single = execute(lockstep(kSpes), with_one_buffer, kBlocks);
  const double part = static_cast<double>(result.run.cycles) / static_cast<double>(single.run.cycles);
  char text[64];
  std::snprintf(text, sizeof text, "it takes %.0f %% of the cycles of one buffer", 100 * part);
  grade.add(2, std::string(text) + ", 70 % at most", part <= kMostOfSingleBuffered);
  return grade.finish();
}

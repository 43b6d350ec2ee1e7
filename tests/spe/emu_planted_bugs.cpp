// Ten small kernels, each with a mistake that programs for the Cell really make. The emulator finds every one
// of them on every run, whoever runs first and whenever data move, and has nothing to say about the same
// kernel without its mistake.
#include "celltrace/emulator.hpp"
#include "spe/emu_peek.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

constexpr std::uint32_t kWords = 1024;

/// What a kernel works on, and whether it is to make its mistake.
struct Scene {
  explicit Scene(bool is_mistaken) : mistaken(is_mistaken) {
    for (std::uint32_t i = 0; i < kWords; ++i)
      from[i] = i;
  }

  alignas(128) std::uint32_t from[kWords];
  alignas(128) std::uint32_t to[kWords] = {};
  const bool mistaken;
  std::uint32_t result = 0;
  CallSite culprit; ///< where the diagnosis has to point to

  /// The operation on the next line is what has to be named.
  void next_line(CallSite site = CallSite::here()) { culprit = {site.file, site.line + 1}; }
};

/// Uses a block as soon as it has been asked for.
void missing_wait(Spu& spu, Scene& scene) {
  auto* block = spu.allocate<std::uint32_t>(kWords);
  scene.next_line();
  spu.get(block, to_ea(scene.from), sizeof scene.from, 0);
  if (!scene.mistaken) spu.wait_all(1u << 0);
  scene.result = peek(block + 1);
}

/// Two blocks under two tags; waits for a third that nothing was issued under.
void wrong_tag(Spu& spu, Scene& scene) {
  auto* block = spu.allocate<std::uint32_t>(64);
  spu.get(block, to_ea(scene.from), 128, 1);
  spu.get(block + 32, to_ea(scene.from + 32), 128, 2);
  spu.wait_all(1u << 1);
  scene.result = block[1];
  if (scene.mistaken) scene.next_line();
  spu.wait_all(scene.mistaken ? 1u << 3 : 1u << 2);
  block[0] = scene.result += peek(block + 32);
  spu.put(block, to_ea(scene.to), 16, 4);
  spu.wait_all(1u << 4);
}

/// Doubles blocks in place in two buffers, and fills a buffer again while its results still leave.
void overlap(Spu& spu, Scene& scene) {
  constexpr std::uint32_t kBlock = 32, kBlocks = kWords / kBlock;
  auto* buffers = spu.allocate<std::uint32_t>(2 * kBlock);
  const auto buffer = [&](std::uint32_t block) { return buffers + block % 2 * kBlock; };
  const auto fetch = [&](std::uint32_t block) {
    const ea_t ea = to_ea(scene.from + block * kBlock);
    if (scene.mistaken) {
      scene.next_line();
      spu.get(buffer(block), ea, kBlock * 4, block % 2);
    } else {
      spu.getf(buffer(block), ea, kBlock * 4, block % 2);
    }
  };
  fetch(0);
  for (std::uint32_t block = 0; block < kBlocks; ++block) {
    if (block + 1 < kBlocks) fetch(block + 1);
    spu.wait_all(1u << block % 2);
    for (std::uint32_t i = 0; i < kBlock; ++i)
      buffer(block)[i] *= 2;
    spu.put(buffer(block), to_ea(scene.to + block * kBlock), kBlock * 4, block % 2);
  }
  spu.wait_all(3);
}

/// Fetches a counter from the middle of a record to the beginning of a buffer.
void not_congruent(Spu& spu, Scene& scene) {
  auto* buffer = spu.allocate<std::uint32_t>(4);
  std::uint32_t* const counter = scene.mistaken ? buffer : buffer + 3;
  scene.next_line();
  spu.get(counter, to_ea(scene.from + 7), 4, 0);
  spu.wait_all(1u << 0);
  scene.result = *counter;
}

/// Signals its neighbour with a word that does not lie where the register wants it.
void misplaced_signal(Spu& spu, Scene& scene) {
  if (spu.id() == 1) {
    scene.result = spu.read_signal_1();
    return;
  }
  auto* word = spu.allocate<std::uint32_t>(4) + (scene.mistaken ? 0 : 3);
  *word = 0x100;
  scene.next_line();
  spu.put(word, spu.addresses(1).signal_1, 4, 0);
  spu.wait_all(1u << 0);
}

/// Posts six jobs to a worker that takes them later, in a mailbox that holds four.
void mailbox_overrun(Spu& spu, Scene& scene) {
  constexpr std::uint32_t kJobs = 6;
  if (spu.id() == 0) {
    for (std::uint32_t job = 1; job <= kJobs; ++job) {
      if (!scene.mistaken && job > kInboundMailboxEntries) spu.read_in_mailbox(); // one has been taken
      if (job == kInboundMailboxEntries + 1) scene.next_line();
      spu.send_mailbox(1, job);
      if (job == kInboundMailboxEntries) spu.send_signal(1, Signal::one, 1);
    }
    for (std::uint32_t taken = 0; !scene.mistaken && taken < kInboundMailboxEntries; ++taken)
      spu.read_in_mailbox();
    if (scene.mistaken) spu.send_signal(1, Signal::two, 1);
    return;
  }
  spu.read_signal_1();
  if (scene.mistaken) spu.read_signal_2();
  for (std::uint32_t job = 0; job < (scene.mistaken ? kInboundMailboxEntries : kJobs); ++job) {
    scene.result = scene.result * 10 + spu.read_in_mailbox();
    if (!scene.mistaken) spu.send_mailbox(0, 1);
  }
}

/// Reports two rows in a register that holds one word.
void lost_signal(Spu& spu, Scene& scene) {
  if (spu.id() == 1) {
    for (std::uint32_t row = 1; row <= 2; ++row) {
      if (row == 2) scene.next_line();
      spu.send_signal(0, Signal::one, row);
      if (!scene.mistaken) spu.read_in_mailbox(); // until it has been read
    }
    if (scene.mistaken) spu.send_mailbox(0, 1);
    return;
  }
  if (scene.mistaken) spu.read_in_mailbox();
  for (std::uint32_t row = 1; row <= (scene.mistaken ? 1u : 2u); ++row) {
    scene.result = scene.result * 10 + spu.read_signal_1();
    if (!scene.mistaken) spu.send_mailbox(1, 1);
  }
}

/// Counts under a reservation, and writes a statistic that shares the counter's line in between.
void reservation_lost(Spu& spu, Scene& scene) {
  auto* line = spu.allocate<std::uint32_t>(32);
  auto* statistic = spu.allocate<std::uint32_t>(4);
  const ea_t counter = to_ea(scene.to + 32 * spu.id());
  const auto write_statistic = [&] {
    statistic[0] = 7;
    spu.put(statistic, counter + 64, 16, 0);
    spu.wait_all(1u << 0);
  };
  if (!scene.mistaken) write_statistic();
  bool counted = false;
  for (int tries = 0; !counted && tries < 3; ++tries) {
    spu.getllar(line, counter);
    if (scene.mistaken) write_statistic();
    ++line[0];
    scene.next_line();
    counted = spu.putllc(line, counter);
  }
  scene.result += counted ? 1 : 0;
}

/// Takes the count of the event status for news, though the event behind it was acknowledged.
void phantom_event(Spu& spu, Scene& scene) {
  if (spu.id() == 1) {
    spu.send_signal(0, Signal::one, 0x10);
    return;
  }
  spu.write_event_mask(event::signal_1);
  scene.result = spu.read_signal_1();
  spu.acknowledge_events(event::signal_1);
  while (spu.event_count() != 0) {
    const std::uint32_t events = spu.read_event_status();
    if (!scene.mistaken && (events & event::signal_1) == 0) continue;
    spu.acknowledge_events(events);
    scene.next_line();
    scene.result += spu.read_signal_1();
  }
}

/// Fetches twice what its buffer, the last of the arena, has room for.
void local_store_overflow(Spu& spu, Scene& scene) {
  constexpr std::uint32_t kBytes = 4096;
  spu.allocate<std::uint8_t>(spu.available() - kBytes, 16);
  auto* buffer = spu.allocate<std::uint32_t>(kBytes / 4);
  scene.next_line();
  spu.get(buffer, to_ea(scene.from), scene.mistaken ? 2 * kBytes : kBytes, 0);
  spu.wait_all(1u << 0);
  scene.result = buffer[3];
}

struct Planted {
  const char* mistake;
  Rule rule;
  unsigned spes;
  void (*kernel)(Spu&, Scene&);
  std::uint32_t wrong, right; ///< results
};

const Planted kPlanted[] = {
    {"missing wait", Rule::in_flight_at_exit, 1, missing_wait, kPoisonWord, 1},
    {"wrong tag", Rule::wait_without_command, 1, wrong_tag, 1 + kPoisonWord, 33},
    {"overlap", Rule::local_store_race, 1, overlap, 0, 0},
    {"4-byte get that is not congruent modulo 16", Rule::same_low_bits, 1, not_congruent, 0, 7},
    {"signal with the wrong low bits", Rule::register_word, 2, misplaced_signal, 0, 0x100},
    {"mailbox overrun", Rule::mailbox_overwritten, 2, mailbox_overrun, 1236, 123456},
    {"lost signal", Rule::signal_overwritten, 2, lost_signal, 2, 12},
    {"reservation lost", Rule::reservation_lost_to_own_put, 1, reservation_lost, 0, 1},
    {"phantom event", Rule::phantom_event, 2, phantom_event, 0x10, 0x10},
    {"local-store overflow", Rule::program_overwritten, 1, local_store_overflow, 0, 3},
};

void check(const Planted& planted, const MachineConfig& config, bool mistaken) {
  Scene scene(mistaken);
  const EmulatedRun run = emulate(config, [&](Spu& spu) { planted.kernel(spu, scene); });
  INFO(run.report());
  if (!mistaken) {
    REQUIRE(run.ok());
    CHECK(scene.result == planted.right);
    return;
  }
  const Diagnostic* const found = run.find(planted.rule);
  REQUIRE(found != nullptr);
  CHECK(std::string(found->site.file) == scene.culprit.file);
  CHECK(found->site.line == scene.culprit.line);
  // At most what follows from it: that the wrong wait left its command in flight.
  for (const Diagnostic& each : run.diagnostics)
    if (each.rule != planted.rule) CHECK(each.rule == Rule::in_flight_at_exit);
  // Only data that come before they are asked for can hide a mistake from its program.
  if (config.emulation.transfers == TransferTime::at_wait || scene.result != planted.right)
    CHECK(scene.result == planted.wrong);
}

void check_on_all_schedules(const Planted& planted, bool mistaken) {
  for (const TransferTime when : {TransferTime::at_issue, TransferTime::at_wait, TransferTime::random}) {
    CAPTURE(when);
    for (MachineConfig config : {lockstep(planted.spes), free_running(planted.spes)}) {
      CAPTURE(config.emulation.schedule);
      config.emulation.transfers = when;
      check(planted, config, mistaken);
    }
  }
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    {
      INFO("exploring");
      check(planted, exploring(planted.spes, seed), mistaken);
    }
    INFO("exploring with faults");
    check(planted, exploring_with_faults(planted.spes, seed), mistaken);
  }
}

TEST_CASE("a planted bug is found on every run") {
  for (const Planted& planted : kPlanted)
    DYNAMIC_SECTION(planted.mistake) {
      check_on_all_schedules(planted, true);
    }
}

TEST_CASE("the same kernel without the bug is clean on every run") {
  for (const Planted& planted : kPlanted)
    DYNAMIC_SECTION(planted.mistake) {
      check_on_all_schedules(planted, false);
    }
}

} // namespace
} // namespace celltrace::test

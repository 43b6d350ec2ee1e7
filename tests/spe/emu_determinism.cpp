// A run in lockstep is the same every time: cycles, statistics, diagnostics and trace depend on the
// configuration and its seed alone, and another seed is another interleaving.
#include "celltrace/emulator.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <set>
#include <sstream>

namespace celltrace::test {
namespace {

using Spu = EmulatedSpu;

constexpr unsigned kSpes = 4, kRounds = 6;

struct alignas(128) Memory {
  std::uint32_t from[kSpes][1024] = {};
  std::uint32_t to[kSpes][1024] = {};
  /// Word 0: entries; then the SPEs in the order in which they got here.
  std::uint32_t order[32] = {};
};

/// Uses all that an SPE can do to others, and breaks a rule that does not stop it.
void work(Spu& spu, Memory& memory) {
  auto* block = spu.allocate<std::uint32_t>(1024);
  auto* line = spu.allocate<std::uint32_t>(32);
  auto* list = spu.allocate<ListElement>(4);
  const std::uint32_t next = (spu.id() + 1) % spu.count();
  const ea_t mine = to_ea(memory.from[spu.id()]);
  std::uint32_t signalled = 0;
  spu.get(block, mine, 0, 1);
  for (std::uint32_t round = 0; round < kRounds; ++round) {
    spu.note("round", round);
    spu.get(block, mine, sizeof memory.from[0], 1);
    spu.wait_all(1u << 1);
    spu.compute(
        {.fixed = 100 * (spu.id() + 1), .floating = 50, .memory = 200, .shuffle = 100, .branches = 20});
    for (std::uint32_t i = 0; i < 1024; ++i)
      block[i] += i * round;
    spu.put(block, to_ea(memory.to[spu.id()]), sizeof memory.to[0], 2);
    for (std::uint32_t i = 0; i < 4; ++i)
      list[i] = ListElement::make(128, mine + 256 * i);
    spu.send_mailbox(next, round);
    spu.write_out_mailbox(spu.id() * 100 + round);
    spu.wait_all(1u << 2);
    spu.getl(block, mine, list, 4, 3);
    spu.send_signal(next, Signal::two, 1u << round);
    spu.wait_all(1u << 3);
    if (round < 4) {
      do {
        spu.getllar(line, to_ea(memory.order));
        line[1 + line[0]++] = spu.id();
      } while (!spu.putllc(line, to_ea(memory.order)));
    }
    spu.read_in_mailbox();
    while ((signalled >> round & 1) == 0) // its neighbour may be ahead
      signalled |= spu.read_signal_2();
    spu.write_event_mask(event::decrementer);
    spu.write_decrementer(10);
    spu.read_event_status();
    spu.acknowledge_events(event::decrementer);
  }
}

void collect_mail(Machine& machine) {
  for (unsigned words = 0; words < kSpes * kRounds;) {
    machine.wait_for_mail(std::chrono::seconds(60));
    for (unsigned spe = 0; spe < kSpes; ++spe)
      if (machine.read_out_mailbox(spe)) ++words;
  }
}

std::string text_of(const SpeStatistics& of) {
  std::ostringstream text;
  for (const std::uint64_t n :
       {of.dma_commands, of.dma_list_elements, of.dma_bytes_read, of.dma_bytes_written, of.signals_sent,
        of.mailbox_words_sent, of.local_store_peak})
    text << n << ' ';
  for (const auto& [name, count] : kSpuCycleCounts)
    text << of.cycles.*count << ' ';
  return text.str();
}

/// Without addresses of main memory.
std::string text_of(const Diagnostic& of) {
  std::ostringstream text;
  text << name_of(of.rule) << ' ' << static_cast<int>(of.action) << ' ' << of.spe << ' ' << of.command << ' '
       << of.opcode << ' ' << of.tag << ' ' << of.lsa << ' ' << of.size << ' ' << of.site.line << ' '
       << of.other_spe << ' ' << of.other_command << ' ' << of.other_site.line << ' ' << of.cycle;
  return text.str();
}

struct Record {
  std::uint64_t cycles;
  std::string statistics, diagnostics, trace, order;
  bool operator==(const Record&) const = default;
};

Record record(MachineConfig config) {
  // At another address each time.
  static std::vector<std::unique_ptr<Memory>> elsewhere;
  elsewhere.push_back(std::make_unique<Memory>());
  Memory& memory = *elsewhere.back();
  std::ostringstream trace;
  config.emulation.trace = &trace;
  config.signal_mode[1] = SignalMode::logical_or;
  const EmulatedRun run = emulate(
      config, [&](Spu& spu) { work(spu, memory); }, 0, collect_mail);
  INFO(run.report());
  for (const std::string& error : run.errors)
    REQUIRE(error.empty());
  REQUIRE(run.count(Rule::zero_size) == kSpes);
  REQUIRE(run.diagnostics.size() == kSpes);
  Record record{run.cycles, {}, {}, trace.str(), {}};
  for (const SpeStatistics& each : run.spes)
    record.statistics += text_of(each) + "\n";
  for (const Diagnostic& each : run.diagnostics)
    record.diagnostics += text_of(each) + "\n";
  for (std::uint32_t i = 0; i < memory.order[0]; ++i)
    record.order += std::to_string(memory.order[1 + i]);
  REQUIRE(record.order.size() == kSpes * 4);
  return record;
}

void check_twice(const MachineConfig& config) {
  const Record once = record(config);
  const Record again = record(config);
  CHECK(once.cycles == again.cycles);
  CHECK(once.statistics == again.statistics);
  CHECK(once.diagnostics == again.diagnostics);
  CHECK(once.order == again.order);
  CHECK((once.trace == again.trace)); // it is long
  CHECK(once.trace.size() > 1000);
}

TEST_CASE("a run by virtual time is the same twice") {
  for (const TransferTime when : {TransferTime::at_issue, TransferTime::at_wait, TransferTime::random}) {
    CAPTURE(when);
    MachineConfig config = lockstep(kSpes);
    config.emulation.transfers = when;
    check_twice(config);
  }
}

TEST_CASE("a run by virtual time with faults is the same twice") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    CAPTURE(seed);
    MachineConfig config = lockstep(kSpes);
    config.emulation.seed = seed;
    config.emulation.faults = Faults::mixed();
    check_twice(config);
  }
}

TEST_CASE("an exploring run is the same twice with the same seed") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    CAPTURE(seed);
    check_twice(exploring(kSpes, seed));
    check_twice(exploring_with_faults(kSpes, seed));
  }
}

TEST_CASE("different seeds are different interleavings") {
  std::set<std::string> orders, slowed;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    orders.insert(record(exploring(kSpes, seed)).order);
    MachineConfig config = lockstep(kSpes);
    config.emulation.seed = seed;
    config.emulation.faults = Faults::mixed();
    slowed.insert(record(config).order);
  }
  CHECK(orders.size() >= 15);
  CHECK(slowed.size() >= 10);
}

} // namespace
} // namespace celltrace::test

// Programs that break a rule end with an error that names the SPE, the command, the rule and the place.
#include "backends/cell_emu/machine.hpp"
#include "celltrace/emulator.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace celltrace::test {
namespace {

using Catch::Contains;
using Spu = EmulatedSpu;

/// The error of a program that gets 16 KB of main memory as its argument.
template <class Program> std::string violation(Program program) {
  alignas(128) static std::uint32_t memory[4096];
  MachineConfig config = lockstep(1);
  config.code_bytes = 0x18000;
  config.emulation.red_zones = false; // allocations lie where they do on the SPU
  const EmulatedRun run = emulate(config, program, to_ea(memory));
  // What ends a program is a diagnostic, too.
  REQUIRE(!run.diagnostics.empty());
  CHECK(run.diagnostics.back().text == run.errors[0]);
  return run.errors[0];
}

TEST_CASE("a bad size is reported with SPE, addresses, tag, rule and place") {
  const std::string line = std::to_string(__LINE__ + 1);
  const auto get_20 = [](Spu& spu, ea_t ea) { spu.get(spu.allocate<std::uint8_t>(32), ea, 20, 5); };
  CHECK_THAT(violation(get_20),
             Catch::StartsWith("SPE 0: get 20 bytes, LS 0x18080 <- EA 0x") &&
                 Catch::EndsWith(", tag 5: size must be 1, 2, 4, 8 or a multiple of 16 up to 16384 "
                                 "[transfer-size, command 1, at emu_violations.cpp:" +
                                 line + "]"));
}

TEST_CASE("an error is told once, and then the SPE has ended") {
  alignas(128) static std::uint32_t memory[8];
  const std::unique_ptr<Machine> machine = cell_emu::make_machine(lockstep(1));
  SpeProgram program("breaks a rule");
  program.add<EmulatedSpu>(
      [](EmulatedSpu& spu, ea_t ea) { spu.get(spu.allocate<std::uint8_t>(32), ea, 20, 5); });
  machine->start(0, program, to_ea(memory));
  CHECK_THROWS_AS(machine->wait(0), SpeError);
  const SpeStop stop = machine->wait(0);
  CHECK(stop.reason == SpeStop::Reason::exit);
  CHECK(stop.code == 0);
  CHECK_FALSE(machine->running(0));
}

TEST_CASE("bad operands are reported when the command is issued") {
  CHECK_THAT(violation([](Spu& spu, ea_t ea) { spu.get(spu.allocate<std::uint8_t>(32), ea, 16, 32); }),
             Contains("tag must be 0..31"));
  CHECK_THAT(violation([](Spu& spu, ea_t ea) { spu.get(spu.allocate<std::uint8_t>(32), ea + 4, 4, 1); }),
             Contains("low 4 bits"));
  CHECK_THAT(violation([](Spu& spu, ea_t ea) {
               alignas(128) std::uint8_t on_stack[16] = {};
               spu.get(on_stack, ea, 16, 1);
             }),
             Contains("LS outside") && Contains("this SPE's local store"));
  CHECK_THAT(violation([](Spu& spu) { spu.get(spu.allocate<std::uint8_t>(32), 0, 16, 1); }),
             Contains("EA must be mapped"));
  CHECK_THAT(violation([](Spu& spu) {
               const ea_t end = spu.addresses(0).local_store + kLocalStoreBytes;
               spu.put(spu.allocate<std::uint8_t>(32), end - 16, 32, 1);
             }),
             Contains("stay in the storage"));
  CHECK_THAT(violation([](Spu& spu, ea_t ea) { spu.getllar(spu.allocate<std::uint8_t>(128), ea + 64); }),
             Contains("getllar") && Contains("128-byte aligned"));
}

TEST_CASE("registers take one word from the last word of a quadword") {
  CHECK_THAT(
      violation([](Spu& spu) { spu.put(spu.allocate<std::uint32_t>(4), spu.addresses(0).in_mailbox, 4, 1); }),
      Contains("LS & 15 = 0xC"));
  CHECK_THAT(violation([](Spu& spu) {
               spu.put(spu.allocate<std::uint32_t>(4) + 3, spu.addresses(0).in_mailbox + 16, 4, 1);
             }),
             Contains("must be a problem-state register"));
  CHECK_THAT(violation([](Spu& spu, ea_t ea) {
               spu.mfc_command<MfcOpcode::sndsig>(spu.allocate<std::uint32_t>(4) + 3, ea + 12, 4, 1);
             }),
             Contains("sndsig must go to a signal"));
}

TEST_CASE("a bad list element is reported with its number") {
  CHECK_THAT(violation([](Spu& spu, ea_t ea) {
               auto* buffer = spu.allocate<std::uint8_t>(256);
               auto* list = spu.allocate<ListElement>(3);
               list[0] = ListElement::make(16, ea);
               list[1] = ListElement::make(16, ea);
               list[2] = ListElement::make(24, ea);
               spu.getl(buffer, ea, list, 3, 9);
               spu.wait_all(1u << 9);
             }),
             Contains("SPE 0: element 2 of getl of 24 bytes of list at LS 0x18180") &&
                 Contains("get 24 bytes, LS 0x180a0 <- EA 0x") && Contains("size must be"));
  CHECK_THAT(violation([](Spu& spu, ea_t ea) {
               auto* buffer = spu.allocate<std::uint8_t>(256);
               spu.getl(buffer, ea, reinterpret_cast<ListElement*>(buffer + 4), 1, 9);
             }),
             Contains("8-byte aligned"));
}

TEST_CASE("reading an MFC status that can never come is an error") {
  CHECK_THAT(violation([](Spu& spu) { spu.read_channel<Channel::rd_tag_stat>(); }),
             Contains("MFC_RdTagStat would stall for ever: no tag status update"));
  CHECK_THAT(violation([](Spu& spu) { spu.wait_any(0); }), Contains("no tag group is enabled"));
  CHECK_THAT(violation([](Spu& spu) { spu.read_list_stall_status(); }),
             Contains("MFC_RdListStallStat would stall for ever"));
  CHECK_THAT(violation([](Spu& spu) { spu.read_channel<Channel::rd_atomic_stat>(); }),
             Contains("MFC_RdAtomicStat would stall for ever"));
  CHECK_THAT(violation([](Spu& spu) { spu.write_channel<Channel::wr_tag_update>(3); }),
             Contains("MFC_WrTagUpdate 3"));
  CHECK_THAT(violation([](Spu& spu) { spu.acknowledge_list_stall(32); }), Contains("MFC_WrListStallAck 32"));
}

TEST_CASE("an error of a queued command is reported at the end of the kernel at the latest") {
  CHECK_THAT(violation([](Spu& spu, ea_t ea) {
               auto* list = spu.allocate<ListElement>(1);
               *list = ListElement::make(17, ea);
               spu.getl(spu.allocate<std::uint8_t>(32), ea, list, 1, 2);
             }),
             Contains("element 0"));
}

TEST_CASE("a kernel's own exception ends it like any error") {
  CHECK_THAT(violation([](Spu&) { throw std::runtime_error("out of luck"); }),
             Catch::StartsWith("SPE 0: ") && Contains("out of luck") && Contains("[kernel-exception"));
  CHECK_THAT(violation([](Spu&) { throw 5; }),
             Contains("unknown exception") && Contains("[kernel-exception"));
}

TEST_CASE("an address of an SPE that does not exist is an error") {
  const EmulatedRun run = emulate(lockstep(1), [](Spu& spu) { spu.send_signal(1, Signal::one, 0); });
  CHECK_THAT(run.errors[0], Contains("SPE 0: there is no SPE 1"));
}

TEST_CASE("a configuration that does not fit is refused") {
  MachineConfig config;
  config.code_bytes = kLocalStoreBytes - 1024;
  config.stack_bytes = 4096;
  CHECK_THROWS_WITH(cell_emu::make_machine(config), Contains("leave no arena"));
  config = {};
  config.signal_mode[1] = static_cast<SignalMode>(7);
  CHECK_THROWS_AS(cell_emu::make_machine(config), InputError);
  config = {};
  config.spes = 257;
  CHECK_THROWS_AS(cell_emu::make_machine(config), InputError);
  config = {};
  CHECK(cell_emu::make_machine(config)->spe_count() == 8);
}

TEST_CASE("numbers, enumerators and rules of a configuration that do not exist are refused") {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::pair<const char*, std::function<void(EmulationConfig&)>> kWrong[] = {
      {"schedule", [](auto& c) { c.schedule = static_cast<Schedule>(2); }},
      {"transfers", [](auto& c) { c.transfers = static_cast<TransferTime>(3); }},
      {"actions", [](auto& c) { c.actions[static_cast<Rule>(kRules)] = Action::warn; }},
      {"actions", [](auto& c) { c.actions[Rule::zero_size] = static_cast<Action>(3); }},
      {"faults.slowest_spe", [](auto& c) { c.faults.slowest_spe = 0.5; }},
      {"faults.slowest_spe", [](auto& c) { c.faults.slowest_spe = kNaN; }},
      {"faults.slowest_spe", [](auto& c) { c.faults.slowest_spe = kInfinity; }},
      {"faults.pause_probability", [](auto& c) { c.faults.pause_probability = 2; }},
      {"faults.pause_probability", [](auto& c) { c.faults.pause_probability = -0.1; }},
      {"faults.pause_probability", [](auto& c) { c.faults.pause_probability = kNaN; }},
      {"timing.clock_hz", [](auto& c) { c.timing.clock_hz = 0; }},
      {"timing.clock_hz", [](auto& c) { c.timing.clock_hz = kNaN; }},
      {"timing.clock_hz", [](auto& c) { c.timing.clock_hz = kInfinity; }},
      {"timing.cycles_per_tick", [](auto& c) { c.timing.cycles_per_tick = 0; }},
      {"timing.spes", [](auto& c) { c.timing.spes = 0; }},
      {"timing.spes", [](auto& c) { c.timing.spes = 257; }},
      {"timing.exposed_latency", [](auto& c) { c.timing.exposed_latency = 1.5; }},
      {"timing.hints", [](auto& c) { c.timing.hints = -1; }},
      {"timing.late_hint", [](auto& c) { c.timing.late_hint = 17; }},
      {"timing.no_ops", [](auto& c) { c.timing.no_ops = kNaN; }},
      {"timing.late_fetch", [](auto& c) { c.timing.late_fetch = kInfinity; }},
      {"timing.paired_issue", [](auto& c) { c.timing.paired_issue = kNaN; }},
      {"seconds_limit", [](auto& c) { c.seconds_limit = -1; }},
      {"seconds_limit", [](auto& c) { c.seconds_limit = kNaN; }},
  };
  for (const auto& [member, spoil] : kWrong) {
    CAPTURE(member);
    MachineConfig config;
    spoil(config.emulation);
    CHECK_THROWS_AS(cell_emu::make_machine(config), InputError);
    CHECK_THROWS_WITH(cell_emu::make_machine(config), Contains(std::string("EmulationConfig::") + member));
  }
  MachineConfig config;
  config.emulation.faults.pause_probability = 1;
  config.emulation.timing.exposed_latency = 0;
  config.emulation.timing.paired_issue = 1;
  config.emulation.seconds_limit = 1e9;
  config.emulation.cycle_limit = ~std::uint64_t{0};
  CHECK(cell_emu::make_machine(config)->spe_count() == 8);
}

} // namespace
} // namespace celltrace::test

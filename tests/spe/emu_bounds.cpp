// Bounds: what a program allocated of its local store, and the host's objects in main memory.
#include "celltrace/emulator.hpp"
#include "celltrace/spe/local_store.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace celltrace::test {
namespace {

using Catch::Contains;
using Spu = EmulatedSpu;

struct alignas(128) Memory {
  std::array<std::uint32_t, 1024> words{};
};

template <class Program> EmulatedRun run_on_memory(const MachineConfig& config, Program program) {
  Memory memory;
  return emulate(config, program, to_ea(memory.words.data()));
}

/// Of either schedule, with data that move at once, late and at random.
std::vector<MachineConfig> machines(unsigned spes) {
  std::vector<MachineConfig> all{lockstep(spes), exploring(spes, 3), free_running(spes)};
  all.push_back(lockstep(spes));
  all.back().emulation.transfers = TransferTime::at_issue;
  return all;
}

void wait(Spu& spu, unsigned tag) {
  spu.wait_all(1u << tag);
}

// --- allocations and commands ---

struct Case {
  const char* what;
  void (*program)(Spu&, ea_t);
};

const Case kBroken[] = {
    {"a get longer than its allocation",
     [](Spu& spu, ea_t ea) { spu.get(spu.allocate<float>(32), ea, 144, 5); }},
    {"one that begins behind it",
     [](Spu& spu, ea_t ea) { spu.get(spu.allocate<float>(32) + 32, ea, 16, 5); }},
    {"one across two allocations",
     [](Spu& spu, ea_t ea) {
       float* first = spu.allocate<float>(32);
       spu.allocate<float>(32);
       spu.get(first, ea, 512, 5);
     }},
    {"a put that sends more than there is",
     [](Spu& spu, ea_t ea) { spu.put(spu.allocate<float>(32), ea, 256, 5); }},
    {"a lock line that is larger than its allocation",
     [](Spu& spu, ea_t ea) { spu.getllar(spu.allocate<std::uint32_t>(4), ea); }},
    {"an element of a list",
     [](Spu& spu, ea_t ea) {
       float* buffer = spu.allocate<float>(32);
       auto* list = spu.allocate<ListElement>(2);
       list[0] = ListElement::make(64, ea);
       list[1] = ListElement::make(128, ea);
       spu.getl(buffer, ea, list, 2, 5);
     }},
    {"a list longer than its allocation",
     [](Spu& spu, ea_t ea) {
       float* buffer = spu.allocate<float>(32);
       spu.getl(buffer, ea, spu.allocate<ListElement>(2), 3, 5);
     }},
};

TEST_CASE("a command that leaves an allocation breaks a rule") {
  for (const Case& each : kBroken) {
    for (const MachineConfig& config : machines(1)) {
      const EmulatedRun run = run_on_memory(config, each.program);
      INFO(each.what << "\n" << run.report());
      CHECK_FALSE(run.ok());
      CHECK(run.count(Rule::allocation_bounds) == 1);
      const Diagnostic* const told = run.find(Rule::allocation_bounds);
      REQUIRE(told != nullptr);
      CHECK(told->site.line != 0);
      CHECK(told->command == 1);
      CHECK_THAT(told->text, Contains("[allocation-bounds, command 1, at emu_bounds.cpp:"));
    }
  }
}

TEST_CASE("the diagnostic of bounds names command, addresses, tag and allocation") {
  MachineConfig config = lockstep(1);
  config.code_bytes = 0x18000;
  const std::string line = std::to_string(__LINE__ + 1);
  const auto program = [](Spu& spu, ea_t ea) { spu.get(spu.allocate<float>(32), ea, 144, 5); };
  const EmulatedRun run = run_on_memory(config, program);
  CHECK_THAT(run.report(), Catch::StartsWith("SPE 0: get 144 bytes, LS 0x18080 <- EA 0x") &&
                               Contains(", tag 5: a transfer or list that touches an allocation of local "
                                        "store must lie within it; the last "
                                        "one before it is 128 bytes at LS 0x18080, made at emu_bounds.cpp:" +
                                        line));
}

struct Pair {
  std::array<float, 32> first, second;
};
LocalStore<Pair> pair;

TEST_CASE("commands within allocations break none") {
  for (const MachineConfig& config : machines(1)) {
    const EmulatedRun run = run_on_memory(config, [](Spu& spu, ea_t ea) {
      float* buffer = spu.allocate<float>(64);
      spu.get(buffer, ea, 256, 1);
      spu.get(pair->first.data(), ea, 128, 1);
      spu.get(pair->second.data(), ea, 128, 1);
      wait(spu, 1);
      spu.put(buffer + 32, ea, 128, 1);
      wait(spu, 1);
      std::uint8_t* const mark = spu.mark();
      spu.allocate<float>(64);
      spu.release(mark);
      float* again = spu.allocate<float>(32);
      spu.get(again, ea, 128, 1);
      wait(spu, 1);
      spu.send_mailbox(0, 1);
      spu.read_in_mailbox();
    });
    INFO(run.report());
    CHECK(run.ok());
  }
}

TEST_CASE("a transfer that leaves what another SPE has allocated breaks a rule") {
  for (const MachineConfig& config : machines(2)) {
    for (const bool inside : {true, false}) {
      const EmulatedRun run = emulate(
          config,
          [&](Spu& spu) {
            auto* target = spu.allocate<std::uint32_t>(32);
            auto* source = spu.allocate<std::uint32_t>(64);
            if (spu.id() == 1) {
              spu.write_out_mailbox(spu.local_address(target));
              spu.read_signal_1();
              return;
            }
            const ea_t ea = spu.addresses(1).local_store + spu.read_in_mailbox();
            spu.put(source, inside ? ea : ea + 64, 128, 3);
            wait(spu, 3);
            spu.send_signal(1, Signal::one, 1);
          },
          0,
          [](Machine& machine) {
            std::optional<std::uint32_t> lsa;
            while (!(lsa = machine.read_out_mailbox(1)))
              machine.wait_for_mail(std::chrono::milliseconds(20));
            machine.write_in_mailbox(0, *lsa);
          });
      INFO(run.report());
      CHECK(run.ok() == inside);
      CHECK(run.count(Rule::allocation_bounds) == (inside ? 0u : 1u));
      if (!inside)
        CHECK_THAT(run.report(), Contains("the last one before it of SPE 1 is 128 bytes at LS 0x"));
    }
  }
}

// --- allocations and stores ---

const Case kStores[] = {
    {"right behind the last allocation",
     [](Spu& spu, ea_t) {
       volatile float* buffer = spu.allocate<float>(32);
       buffer[32] = 1;
     }},
    {"between two",
     [](Spu& spu, ea_t) {
       volatile float* buffer = spu.allocate<float>(32);
       spu.allocate<float>(32);
       buffer[35] = 1;
     }},
    {"behind a static object",
     [](Spu&, ea_t) {
       volatile float* second = pair->second.data();
       second[32] = 1;
     }},
    {"one byte behind bytes",
     [](Spu& spu, ea_t) {
       volatile std::uint8_t* buffer = spu.allocate<std::uint8_t>(13);
       buffer[13] = 1;
     }},
    {"and before the memory is given back",
     [](Spu& spu, ea_t) {
       std::uint8_t* const mark = spu.mark();
       volatile float* buffer = spu.allocate<float>(32);
       buffer[32] = 1;
       spu.release(mark);
       spu.allocate<float>(64);
     }},
    {"and before a command",
     [](Spu& spu, ea_t ea) {
       float* const buffer = spu.allocate<float>(32);
       static_cast<volatile float*>(buffer)[32] = 1;
       spu.get(buffer, ea, 128, 1);
       wait(spu, 1);
     }},
};

TEST_CASE("a store past an allocation breaks a rule") {
  for (const Case& each : kStores) {
    for (const MachineConfig& config : machines(1)) {
      const EmulatedRun run = run_on_memory(config, each.program);
      INFO(each.what << "\n" << run.report());
      CHECK_FALSE(run.ok());
      CHECK(run.count(Rule::allocation_overrun) == 1);
      CHECK_THAT(run.report(), Contains("a store went past an allocation of ") && Contains("bytes at LS 0x"));
    }
  }
}

TEST_CASE("without red zones only commands are held to allocations") {
  MachineConfig config = lockstep(1);
  config.emulation.red_zones = false;
  CHECK(run_on_memory(config, kStores[0].program).ok());
  CHECK(run_on_memory(config, kBroken[0].program).count(Rule::allocation_bounds) == 1);
  config.emulation.actions[Rule::allocation_bounds] = Action::ignore;
  const EmulatedRun run = run_on_memory(config, [](Spu& spu, ea_t ea) {
    spu.get(spu.allocate<float>(32), ea, 256, 5);
    wait(spu, 5);
  });
  INFO(run.report());
  CHECK(run.ok());
}

// --- objects in main memory ---

TEST_CASE("a transfer past the end of a registered object breaks a rule") {
  alignas(128) static std::uint32_t memory[256];
  struct Transfer {
    std::uint32_t offset, size;
    bool put, ok;
  };
  // The object is the bytes 256 to 512.
  const Transfer transfers[] = {
      {256, 256, false, true},  {256, 128, true, true},  {384, 144, false, false}, {384, 256, true, false},
      {128, 144, false, false}, {0, 1024, false, false}, {128, 128, false, true},  {512, 256, true, true},
  };
  for (const Transfer& each : transfers) {
    for (MachineConfig config : machines(1)) {
      config.emulation.objects = {{to_ea(memory) + 256, 256, "points"}};
      const EmulatedRun run = emulate(
          config,
          [&](Spu& spu, ea_t ea) {
            auto* buffer = spu.allocate<std::uint32_t>(256);
            if (each.put)
              spu.put(buffer, ea + each.offset, each.size, 4);
            else
              spu.get(buffer, ea + each.offset, each.size, 4);
            wait(spu, 4);
          },
          to_ea(memory));
      INFO(each.offset << " " << each.size << "\n" << run.report());
      CHECK(run.ok() == each.ok);
      CHECK(run.count(Rule::object_bounds) == (each.ok ? 0u : 1u));
      if (!each.ok)
        CHECK_THAT(run.report(), Contains("SPE 0: ") &&
                                     Contains(", tag 4: a transfer that touches a registered object "
                                              "in main memory must lie within it, 'points': 256 "
                                              "bytes at EA 0x") &&
                                     Contains("[object-bounds, command 1, at emu_bounds.cpp:"));
    }
  }
}

TEST_CASE("objects are registered and forgotten while the machine runs") {
  alignas(128) static std::array<std::uint32_t, 64> array;
  const std::vector<std::uint32_t> vector(100);
  CHECK(memory_object(array).bytes == 256);
  CHECK(memory_object(vector, "v").bytes == 400);
  CHECK(memory_object(vector, "v").ea == to_ea(vector.data()));
  std::uint64_t word = 0;
  CHECK(memory_object(word).bytes == 8);
  // Each word of the mailbox is a get of so many bytes.
  const EmulatedRun run = emulate(
      lockstep(1),
      [](Spu& spu, ea_t ea) {
        auto* buffer = spu.allocate<std::uint32_t>(64);
        for (;;) {
          const std::uint32_t bytes = spu.read_in_mailbox();
          if (bytes == 0) return;
          spu.get(buffer, ea, bytes, 1);
          wait(spu, 1);
          spu.write_out_mailbox(bytes);
        }
      },
      to_ea(array.data()),
      [](Machine& machine) {
        const auto get = [&](std::uint32_t bytes) {
          machine.write_in_mailbox(0, bytes);
          while (!machine.read_out_mailbox(0))
            machine.wait_for_mail(std::chrono::milliseconds(20));
        };
        get(256);
        machine.register_object({to_ea(array.data()), 128, "half"});
        CHECK_THROWS_WITH(machine.register_object({to_ea(array.data()) + 64, 4, ""}),
                          Contains("an object in main memory overlaps with the object 'half'"));
        CHECK_THROWS_WITH(machine.register_object({to_ea(array.data()), 0, "none"}), Contains("'none'"));
        CHECK_THROWS_AS(machine.forget_object(to_ea(array.data()) + 64), InputError);
        get(128);
        machine.forget_object(to_ea(array.data()));
        get(256);
        machine.write_in_mailbox(0, 0);
      });
  INFO(run.report());
  CHECK(run.ok());
}

} // namespace
} // namespace celltrace::test

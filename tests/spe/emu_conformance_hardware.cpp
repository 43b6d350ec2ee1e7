// Conformance: what programs that were recorded on a Cell do, and a model easily misses. The programs are
// those of hardware_rows.hpp, which run on host code and as machine code.
//
// Covers of the facts: the room in the queue as a sign of completion, the tag status event of every kind of
// request, the order of putqlluc, SRR0, the event of a stopped list, the channels of the performance
// monitor, and when the decrementer is an event.
#include "spe/emu_conformance.hpp"

#include <algorithm>
#include <sys/mman.h>
#include <unistd.h>

namespace celltrace::test {
namespace {

void be_lenient(MachineConfig& config) {
  config.emulation.actions = lenient_actions();
}

/// Pages of the host that a program may or may not use.
struct Pages {
  ea_t read_only; ///< behind a page that can be written
  ea_t none;      ///< behind a page that can be read
};

const Pages& pages() {
  static const Pages made = [] {
    const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    auto* const block = static_cast<std::uint8_t*>(
        mmap(nullptr, 3 * size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    mprotect(block + size, size, PROT_READ);
    mprotect(block + 2 * size, size, PROT_NONE);
    return Pages{to_ea(block + size), to_ea(block + 2 * size)};
  }();
  return made;
}

const Rows kHardware = {
    broken(Rule::drained_queue, "an empty queue says that a get is complete, but not by a tag",
           HardwareRow::drained_get, {"get 128 bytes", "MFC_Cmd's count"}),
    broken(Rule::drained_queue, "or a put, whose source is free again", HardwareRow::drained_put,
           {"put 128 bytes"})
        .after([](Stage& stage, std::endian order) { stage.is(load_word(order, stage.to), 7); }),
    broken(Rule::drained_queue, "so that a buffer can be used again, and reported once",
           HardwareRow::drained_buffer_again, {"get 128 bytes"})
        .after([](Stage& stage, std::endian order) {
          for (std::uint32_t i = 0; i < 96; ++i)
            stage.is(load_word(order, stage.to + i), i + 1);
        }),
    kept(Rule::drained_queue, "a lenient machine takes it for a wait", HardwareRow::drained_get)
        .configured(be_lenient),
    kept(Rule::drained_queue, "also where buffers are used again", HardwareRow::drained_buffer_again)
        .configured(be_lenient),
    kept(Rule::drained_queue, "who looks at the room, but waits for the tag",
         HardwareRow::drained_and_waited),
    broken(Rule::drained_queue,
           "what is read before that wait relies on the room, as only machine code shows",
           HardwareRow::drained_get_read_and_waited, {"get 128 bytes"})
        .of_machine_code(),
    kept(Rule::drained_queue, "which a lenient machine does not mind",
         HardwareRow::drained_get_read_and_waited)
        .configured(be_lenient),
    broken(Rule::drained_queue, "so does what is written before it",
           HardwareRow::drained_put_changed_and_waited, {"put 128 bytes"})
        .after([](Stage& stage, std::endian order) {
          stage.is(load_word(order, stage.to), 7);
          stage.is(load_word(order, stage.to + 32), 8);
        }),
    kept(Rule::drained_queue, "nor that", HardwareRow::drained_put_changed_and_waited).configured(be_lenient),
    broken(Rule::in_flight_at_exit, "room that is not all of the queue says nothing",
           HardwareRow::room_is_not_all, {"get 128 bytes"}),

    fact("an answer to an immediate request is an event, too", HardwareRow::immediate_is_event),
    fact("the tag status event is the rise of the status's count", HardwareRow::event_of_status_rises_once),

    fact("a putqlluc comes behind a put of its tag to the same line", HardwareRow::putqlluc_behind_put)
        .seeds(100),
    fact("and behind a get from there", HardwareRow::putqlluc_behind_get).seeds(100),
    kept(Rule::local_store_race, "and takes what a get before it brought", HardwareRow::putqlluc_from_get)
        .seeds(20),
    broken(Rule::local_store_race, "it does not wait for other tags", HardwareRow::putqlluc_of_other_tag,
           {"putqlluc 128 bytes"}),

    fact("SRR0 holds an address of an instruction: 18 bits, of which the low two are 0",
         HardwareRow::srr0_bits),
    fact("a list that stops while the stall status is unread raises no further event",
         HardwareRow::stall_event_once),
    fact("the channels 69 to 71 take what is written", HardwareRow::measurement_channels),
    fact("a decrementer that expired under the old mask leaves a phantom event",
         HardwareRow::decrementer_phantom),
    fact("the decrementer is an event also when the written value has the top bit that the last one had not",
         HardwareRow::decrementer_written_negative),

    broken(Rule::register_word, "word 1 of a quadword is none for a register",
           HardwareRow::signal_from_given_word, {"sndsig 4 bytes"})
        .given([](Stage&) {
          return Given{0, 1};
        }),
    broken(Rule::register_word, "nor is word 2", HardwareRow::signal_from_given_word, {"sndsig 4 bytes"})
        .given([](Stage&) {
          return Given{0, 2};
        }),
    kept(Rule::register_word, "word 3 is", HardwareRow::signal_from_given_word).given([](Stage&) {
      return Given{0, 3};
    }),
    fact("what comes behind a barriered command waits for that command itself",
         HardwareRow::put_behind_barrier)
        .seeds(20),
    fact("also for one that stops", HardwareRow::get_behind_list_barrier),
    broken(Rule::list_length, "a number of elements whose bytes 32 bits do not hold is too large, too",
           HardwareRow::list_count_wraps, {"getl of 4294967288 bytes of list"}),

    broken(Rule::mapped_address, "what the host cannot read is not mapped", HardwareRow::get_of_given_address,
           {"get 128 bytes"})
        .given([](Stage&) {
          return Given{pages().none, 0};
        }),
    broken(Rule::mapped_address, "nor what it has no memory for", HardwareRow::get_of_given_address,
           {"get 128 bytes"})
        .given([](Stage&) {
          return Given{ea_t{1} << 56, 0};
        }),
    broken(Rule::mapped_address, "nor what it cannot write", HardwareRow::put_to_given_address,
           {"put 128 bytes"})
        .given([](Stage&) {
          return Given{pages().read_only, 0};
        }),
    kept(Rule::mapped_address, "that can still be read", HardwareRow::get_of_given_address).given([](Stage&) {
      return Given{pages().read_only, 0};
    }),
    kept(Rule::mapped_address, "also as a line", HardwareRow::line_of_given_address).given([](Stage&) {
      return Given{pages().read_only, 0};
    }),
    broken(Rule::mapped_address, "unless there is none", HardwareRow::line_of_given_address,
           {"getllar 128 bytes"})
        .given([](Stage&) {
          return Given{pages().none, 0};
        }),
    broken(Rule::mapped_address, "every element of a list has to be writable",
           HardwareRow::list_to_given_address, {"element 1 of putl"})
        .given([](Stage&) {
          return Given{pages().read_only - 128, 0};
        }),
    broken(Rule::mapped_address, "and every byte of a transfer", HardwareRow::get_of_given_address,
           {"get 128 bytes"})
        .given([](Stage&) {
          return Given{pages().none - 64, 0};
        }),

    kept(Rule::time_limit, "a program that ends in time", HardwareRow::drained_and_waited)
        .configured([](MachineConfig& config) {
          config.emulation.cycle_limit = 10000000;
          config.emulation.seconds_limit = 100;
        }),
    broken(Rule::time_limit, "one that polls for ever ends after so many cycles", HardwareRow::poll_for_ever,
           {"after 100000 cycles"})
        .configured([](MachineConfig& config) { config.emulation.cycle_limit = 100000; }),
    broken(Rule::time_limit, "or after so many seconds of the host", HardwareRow::poll_for_ever,
           {"after 0.010000 seconds"})
        .configured([](MachineConfig& config) { config.emulation.seconds_limit = 0.01; }),
    broken(Rule::time_limit, "who waits for it ends, too", HardwareRow::wait_of_two)
        .spes(2)
        .configured([](MachineConfig& config) { config.emulation.cycle_limit = 100000; }),
    broken(Rule::time_limit, "so does the PPE, when it looks for mail", HardwareRow::poll_for_ever)
        .ppe([](Machine& machine, Stage&) {
          while (!machine.read_out_mailbox(0))
            machine.wait_for_mail(std::chrono::milliseconds(1));
        })
        .configured([](MachineConfig& config) { config.emulation.cycle_limit = 100000; }),
    broken(Rule::time_limit, "or polls for it without a pause", HardwareRow::poll_for_ever)
        .ppe([](Machine& machine, Stage&) {
          while (!machine.read_out_mailbox(0)) {
          }
        })
        .configured([](MachineConfig& config) { config.emulation.cycle_limit = 100000; }),
};

std::uint32_t* local_store_of(Spu& spu, unsigned spe) {
  return reinterpret_cast<std::uint32_t*>(static_cast<std::uintptr_t>(spu.addresses(spe).local_store));
}
constexpr std::uint32_t kLocalStoreWords = kLocalStoreBytes / sizeof(std::uint32_t);

/// SPE 0 tells SPE 1 where a line of its local store is, and looks at it when SPE 1 has changed it by `act`.
std::function<void(Spu&, Stage&)> line_changed_by(std::function<void(Spu&, std::uint32_t lsa)> act) {
  return [act](Spu& spu, Stage& stage) {
    if (spu.id() == 1) {
      act(spu, spu.read_signal_1());
      spu.send_signal(0, Signal::one, 1);
      spu.read_signal_1();
      return;
    }
    auto* line = line_of(spu);
    spu.send_signal(1, Signal::one, lsa_of(spu, line));
    spu.read_signal_1();
    stage.is(line[2], 7);
    spu.send_signal(1, Signal::one, 1);
  };
}

// What machine code cannot do: its addresses wrap at 256 KB, and name its own local store only.
const Rows kPointers = {
    kept(Rule::local_store_overrun, "the arena can be written up to its end",
         [](Spu& spu, Stage& stage) {
           auto* all = spu.allocate<std::uint32_t>(spu.available() / 4, 16);
           std::fill(reinterpret_cast<std::uint32_t*>(all), reinterpret_cast<std::uint32_t*>(spu.arena().end),
                     1u);
           spu.get(all, to_ea(stage.from), 128, 0);
           spu.wait_all(1);
         }),
    broken(Rule::local_store_overrun, "a store past local store is found by the next command",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             poke(local_store_of(spu, 0) + kLocalStoreWords + 2, 1);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 128, 0);
             spu.wait_all(1);
           },
           {"near LS 0x40008"}),
    broken(Rule::local_store_overrun, "so is one in front of it",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             poke(local_store_of(spu, 0) - 1, 1);
             stage.next_line();
             spu.put(line, to_ea(stage.to), 128, 0);
             spu.wait_all(1);
           },
           {"8 bytes in front of LS 0"}),
    broken(Rule::local_store_overrun, "one by a few kilobytes is found at the end",
           [](Spu& spu, Stage&) { poke(local_store_of(spu, 0) + kLocalStoreWords + 1023, 1); },
           {"near LS 0x40ff8"}),
    kept(Rule::foreign_store, "other SPEs reach local store by DMA",
         line_changed_by([](Spu& spu, std::uint32_t lsa) {
           auto* word = spu.allocate<std::uint32_t>(4);
           word[2] = 7;
           spu.put(word + 2, spu.addresses(0).local_store + lsa + 8, 8, 1);
           spu.wait_all(1u << 1);
         }))
        .spes(2),
    kept(Rule::foreign_store, "and the PPE where it is mapped",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           if (spu.id() == 1) return;
           spu.write_out_mailbox(lsa_of(spu, line));
           spu.read_in_mailbox();
           stage.is(line[2], 7);
         })
        .spes(2)
        .ppe([](Machine& machine, Stage&) {
          std::optional<std::uint32_t> lsa;
          while (!(lsa = machine.read_out_mailbox(0)))
            machine.wait_for_mail(std::chrono::seconds(60));
          poke(reinterpret_cast<std::uint32_t*>(
                   static_cast<std::uintptr_t>(machine.addresses(0).local_store + *lsa)) +
                   2,
               7);
          machine.write_in_mailbox(0, 1);
        }),
    broken(
        Rule::foreign_store, "a store through a pointer is none that a Cell has",
        line_changed_by([](Spu& spu, std::uint32_t lsa) { poke(local_store_of(spu, 0) + lsa / 4 + 2, 7); }),
        {"local store of SPE 0, LS address 106632"})
        .spes(2)
        .by(1)
        .lockstep_only(),
};

constexpr CodeModule kOne = {"one", 1, 0, 4096};
constexpr CodeModule kOther = {"other", 2, 0, 8192};
constexpr CodeModule kElsewhere = {"elsewhere", 3, 1, 1024};

// Of host code: what the machine code of cell_sim calls is fetched by the program itself.
const Rows kModules = {
    kept(Rule::absent_module,
         "a module is there when it has been entered, until another one of its region is",
         [](Spu& spu, Stage& stage) {
           const auto before = spu.cycles();
           spu.enter_module(kOne);
           stage.is(spu.cycles() - before > 500, true);
           spu.enter_module(kElsewhere);
           spu.run_in_module(kOne);
           const auto after = spu.cycles();
           spu.enter_module(kOne);
           stage.is(spu.cycles(), after);
         }),
    broken(Rule::absent_module, "then it is not",
           [](Spu& spu, Stage& stage) {
             spu.enter_module(kOne);
             spu.enter_module(kOther);
             stage.next_line();
             spu.run_in_module(kOne);
           },
           {"code of module 'one'"}),
};

TEST_CASE("conformance: code modules") {
  run_rows(kModules);
}

TEST_CASE("conformance: pointers") {
  run_rows(kPointers);
}

TEST_CASE("conformance: hardware") {
  run_rows(kHardware);
}

} // namespace
} // namespace celltrace::test

// Conformance: channels and run control.
//
// Covers of the facts: "Channels" (numbers, directions, counts after a reset, what blocks), stop codes,
// halts, and the budget of the local store.
#include "spe/emu_conformance.hpp"

#include <stdexcept>

namespace celltrace::test {
namespace {

std::uint32_t read(Spu& spu, unsigned channel, CallSite site = CallSite::here()) {
  spu.at(site);
  return spu.read_channel(channel);
}
void write(Spu& spu, unsigned channel, std::uint32_t value, CallSite site = CallSite::here()) {
  spu.at(site);
  spu.write_channel(channel, value);
}

Row no_channel_to_read(const char* fact, unsigned channel) {
  return broken(Rule::invalid_channel, fact,
                [channel](Spu& spu, Stage& stage) {
                  stage.next_line();
                  read(spu, channel);
                },
                {"read of channel " + std::to_string(channel)});
}
Row no_channel_to_write(const char* fact, unsigned channel) {
  return broken(Rule::invalid_channel, fact,
                [channel](Spu& spu, Stage& stage) {
                  stage.next_line();
                  write(spu, channel, 0);
                },
                {"write of channel " + std::to_string(channel)});
}

const Rows kChannels = {
    fact("counts after a reset",
         [](Spu& spu, Stage& stage) {
           const std::uint32_t expected[32] = {0, 1, 1, 0, 0, 0,  0, 1, 1, 1, 0, 1, 1, 1, 1, 1,
                                               1, 1, 1, 1, 1, 16, 1, 1, 0, 0, 1, 0, 1, 0, 1, 0};
           for (unsigned channel = 0; channel < 32; ++channel)
             stage.is(spu.channel_count(channel), expected[channel]);
           for (unsigned channel = 32; channel < 128; ++channel)
             stage.is(spu.channel_count(channel), channel >= 69 && channel <= 71 ? 1 : 0);
         }),
    kept(Rule::invalid_channel, "a channel that does not exist has the count 0",
         [](Spu& spu, Stage& stage) {
           for (const unsigned channel : {5u, 6u, 10u, 31u, 64u, 127u})
             stage.is(spu.channel_count(channel), 0);
         }),
    kept(Rule::invalid_channel, "channels go by their numbers",
         [](Spu& spu, Stage& stage) {
           write(spu, 1, event::signal_1);
           stage.is(read(spu, 11), event::signal_1);
           write(spu, 22, 0x55);
           stage.is(read(spu, 12), 0x55);
           write(spu, 23, 0);
           stage.is(read(spu, 24), 0x55);
           write(spu, 69, 1);
           write(spu, 14, 0x1230);
           stage.is(read(spu, 15), 0x1230);
           write(spu, 7, 1000);
           stage.is(read(spu, 8) <= 1000, true);
           stage.is(read(spu, 13), 0);
         }),
    no_channel_to_read("there is no channel 5", 5),
    no_channel_to_write("neither to write", 6),
    no_channel_to_read("nor a channel 31", 31),
    no_channel_to_read("nor a channel 128", 128),
    no_channel_to_read("what measures cannot be read", 70),
    no_channel_to_read("the outbound mailbox cannot be read", 28),
    no_channel_to_read("nor the command", 21),
    no_channel_to_write("the inbound mailbox cannot be written", 29),
    no_channel_to_write("nor the event status", 0),
    fact("a count is read without a stall",
         [](Spu& spu, Stage& stage) {
           for (int i = 0; i < 3; ++i)
             for (const unsigned channel : {0u, 3u, 4u, 24u, 25u, 27u, 29u})
               stage.is(spu.channel_count(channel), 0);
         }),
    fact("a full outbound mailbox has the count 0",
         [](Spu& spu, Stage& stage) {
           spu.write_out_mailbox(1);
           stage.is(spu.channel_count(28), 0);
           stage.is(spu.channel_count(30), 1);
           spu.write_out_interrupt_mailbox(1);
           stage.is(spu.channel_count(30), 0);
         }),
};

const Rows kRunControl = {
    fact("a program that stopped with a signal goes on when it is resumed",
         [](Spu& spu, Stage& stage) {
           stage.shared[0] = 1;
           spu.stop_and_signal<0x1234>();
           stage.shared[0] = 2;
           spu.stop_and_signal<0x2100>(); // a callback of libspe2, which the PPE would serve
           stage.shared[0] = 3;
         })
        .ppe([](Machine& machine, Stage& stage) {
          for (const std::uint32_t code : {0x1234u, 0x2100u}) {
            const SpeStop stop = machine.wait(0);
            stage.is(stop.reason == SpeStop::Reason::stop_and_signal, true);
            stage.is(stop.code, code);
            stage.is(stage.shared[0], code == 0x1234 ? 1 : 2);
            machine.resume(0);
          }
          stage.is(machine.wait(0).reason == SpeStop::Reason::exit, true);
          stage.is(stage.shared[0], 3);
        }),
    kept(Rule::halted, "an exit with a code is no halt",
         [](Spu& spu, Stage& stage) {
           spu.stop_and_signal<0x2007>();
           stage.is(1, 0); // not reached
         })
        .ppe([](Machine& machine, Stage& stage) { stage.is(machine.wait(0).code, 7); }),
    broken(Rule::halted, "a halt ends the program with an error",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.halt(HaltCode::bad_argument);
           },
           {"halted: bad argument"}),
    broken(Rule::halted, "so does an alignment that is none",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.allocate<std::uint32_t>(4, 0);
           },
           {"halted: bad argument"}),
    kept(Rule::kernel_exception, "an exception that the kernel catches is its own affair",
         [](Spu&, Stage& stage) {
           try {
             throw std::runtime_error("caught");
           } catch (const std::exception&) {
             stage.shared[0] = 1;
           }
         }),
    broken(Rule::kernel_exception, "one that it does not catch ends it with an error",
           [](Spu&, Stage&) { throw std::runtime_error("out of luck"); }, {"out of luck"}),
    broken(Rule::kernel_exception, "whatever is thrown", [](Spu&, Stage&) { throw 5; },
           {"unknown exception"}),

    kept(Rule::local_store_exhausted, "the arena can be used up to its last byte",
         [](Spu& spu, Stage& stage) {
           auto* all = spu.allocate<std::uint8_t>(spu.available(), 16);
           stage.is(spu.available(), 0);
           all[0] = 1;
           stage.is(lsa_of(spu, spu.arena().end), kLocalStoreBytes - 24 * 1024);
         }),
    broken(Rule::local_store_exhausted, "but not beyond",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.allocate<std::uint8_t>(spu.available() + 1, 16);
           },
           {"local store exhausted", "of 131072 bytes of the arena are free"}),
    broken(Rule::local_store_exhausted, "a count that overflows is too large, too",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.allocate<std::uint64_t>(0x20000000);
           }),
    fact("code and stack take their part of the 256 KB",
         [](Spu& spu, Stage& stage) {
           stage.is(lsa_of(spu, spu.arena().begin), 200 * 1024);
           stage.is(lsa_of(spu, spu.arena().end), 240 * 1024);
         })
        .configured([](MachineConfig& config) {
          config.code_bytes = 200 * 1024;
          config.stack_bytes = 16 * 1024;
        }),
};

TEST_CASE("conformance: channels") {
  run_rows(kChannels);
}

TEST_CASE("conformance: run control") {
  run_rows(kRunControl);
}

} // namespace
} // namespace celltrace::test

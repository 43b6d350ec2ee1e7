// Conformance: lock-line commands and reservations.
//
// Covers of the facts: "Atomics" with the hardware tests of reservations (which writes lose one, and which of
// them raise event 0x400), and the status of channel 27.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

std::uint32_t lost_events(Spu& spu) {
  return spu.event_count() != 0 ? spu.read_event_status() : 0;
}

/// SPE 0 reserves stage.to; what `act` does to it then.
Row own_act(Row row, std::uint32_t events, bool written,
            std::function<void(Spu&, Stage&, std::uint32_t*)> act) {
  row.program = [=](Spu& spu, Stage& stage) {
    auto* line = line_of(spu);
    spu.write_event_mask(event::reservation_lost);
    spu.getllar(line, to_ea(stage.to));
    act(spu, stage, line);
    stage.is(lost_events(spu), events);
    stage.next_line();
    stage.is(spu.putllc(line, to_ea(stage.to)), written);
  };
  return row;
}

/// SPE 0 reserves a line, SPE 1 does `act`, which loses the reservation with an event.
Row act_of_another(const char* what, std::function<void(Spu&, ea_t, std::uint32_t*)> act) {
  return kept(Rule::conditional_without_reservation, what,
              [act](Spu& spu, Stage& stage) {
                const ea_t reserved = to_ea(stage.to);
                auto* line = line_of(spu);
                if (spu.id() == 1) {
                  spu.read_signal_1();
                  act(spu, reserved, line);
                  spu.wait_all(1);
                  return;
                }
                spu.write_event_mask(event::reservation_lost);
                spu.getllar(line, reserved);
                spu.send_signal(1, Signal::one, 1);
                stage.is(spu.read_event_status(), event::reservation_lost);
                stage.is(spu.putllc(line, reserved), false);
              })
      .spes(2);
}

const Rows kAtomics = {
    fact("the status of a lock-line command says what it did",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           stage.is(spu.getllar(line, to_ea(stage.from)), atomic_status::getllar_done);
           stage.is(line[31], 32);
           stage.is(spu.putlluc(line, to_ea(stage.to)), atomic_status::putlluc_done);
           stage.is(stage.to[31], 32);
           stage.is(spu.channel_count<Channel::rd_atomic_stat>(), 0);
         }),
    fact("a putllc under its reservation writes, status 0",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.getllar(line, to_ea(stage.to));
           line[0] = 7;
           spu.mfc_command<MfcOpcode::putllc>(line, to_ea(stage.to), 128, 0);
           stage.is(spu.read_channel<Channel::rd_atomic_stat>(), 0);
           stage.is(stage.to[0], 7);
         }),
    fact("the count of channel 27 becomes 1 in time",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.mfc_command<MfcOpcode::getllar>(line, to_ea(stage.to), 128, 0);
           while (spu.channel_count<Channel::rd_atomic_stat>() == 0) {
           }
           stage.is(spu.read_channel<Channel::rd_atomic_stat>(), atomic_status::getllar_done);
         }),
    fact("lock-line commands wait neither for the queue nor for a tag",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(32 * 17);
           for (std::uint32_t i = 0; i < 16; ++i)
             spu.get(lines + 32 * i, to_ea(stage.from), 128, 0);
           spu.getllar(lines + 32 * 16, to_ea(stage.from));
           stage.is(lines[32 * 16], 1);
           spu.wait_all(1);
         }),
    fact("putqlluc is queued under a tag",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line[3] = 3;
           spu.putqlluc(line, to_ea(stage.to), 5);
           stage.is(spu.wait_all(1u << 5), 1u << 5);
           stage.is(stage.to[3], 3);
           stage.is(spu.channel_count<Channel::rd_atomic_stat>(), 0);
         }),
    fact("counting under reservations loses nothing",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           for (int i = 0; i < 20; ++i) {
             do {
               spu.getllar(line, to_ea(stage.to));
               ++line[0];
             } while (!spu.putllc(line, to_ea(stage.to)));
           }
           spu.send_signal(0, Signal::one, 1u << spu.id());
           if (spu.id() != 0) return;
           for (std::uint32_t here = 0; here != 0xF;)
             here |= spu.read_signal_1();
           spu.getllar(line, to_ea(stage.to));
           stage.is(line[0], 4 * 20);
         })
        .spes(4)
        .configured([](MachineConfig& config) { config.signal_mode[0] = SignalMode::logical_or; }),

    own_act(kept(Rule::reservation_lost_to_own_put, "a reservation holds while nothing happens", {}), 0, true,
            [](Spu&, Stage&, std::uint32_t*) {}),
    own_act(kept(Rule::reservation_lost_to_own_put, "an own put next to the line leaves it", {}), 0, true,
            [](Spu& spu, Stage& stage, std::uint32_t* line) {
              spu.put(line, to_ea(stage.to + 32), 128, 0);
              spu.wait_all(1);
            }),
    own_act(kept(Rule::reservation_lost_to_own_put, "an own get of the line leaves it", {}), 0, true,
            [](Spu& spu, Stage& stage, std::uint32_t*) {
              spu.get(line_of(spu), to_ea(stage.to), 128, 0);
              spu.wait_all(1);
            }),
    own_act(broken(Rule::reservation_lost_to_own_put, "an own put of the line loses it, with the event", {},
                   {"putllc 128 bytes"}),
            event::reservation_lost, false,
            [](Spu& spu, Stage& stage, std::uint32_t* line) {
              spu.put(line + 28, to_ea(stage.to + 28), 16, 0);
              spu.wait_all(1);
            }),
    own_act(broken(Rule::reservation_lost_to_own_put, "an own putlluc of the line loses it without", {}), 0,
            false, [](Spu& spu, Stage& stage, std::uint32_t* line) { spu.putlluc(line, to_ea(stage.to)); }),
    own_act(broken(Rule::conditional_without_reservation,
                   "a getllar of another line replaces it, without the event", {}, {"putllc 128 bytes"}),
            0, false,
            [](Spu& spu, Stage& stage, std::uint32_t* line) { spu.getllar(line, to_ea(stage.from)); }),
    broken(Rule::conditional_without_reservation, "a putllc of another line loses it without the event",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             spu.write_event_mask(event::reservation_lost);
             spu.getllar(line, to_ea(stage.to));
             stage.next_line();
             stage.is(spu.putllc(line, to_ea(stage.from)), false);
             stage.is(lost_events(spu), 0);
             stage.is(spu.putllc(line, to_ea(stage.to)), false);
           }),
    broken(Rule::conditional_without_reservation, "a reservation is good for one putllc",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             spu.getllar(line, to_ea(stage.to));
             stage.is(spu.putllc(line, to_ea(stage.to)), true);
             stage.next_line();
             stage.is(spu.putllc(line, to_ea(stage.to)), false);
           }),
    broken(Rule::conditional_without_reservation, "a putllc without a getllar",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             stage.is(spu.putllc(line, to_ea(stage.to)), false);
           }),
    act_of_another("another SPE's put loses a reservation, with the event",
                   [](Spu& spu, ea_t line, std::uint32_t* from) { spu.put(from, line, 16, 0); }),
    act_of_another("so does its putlluc",
                   [](Spu& spu, ea_t line, std::uint32_t* from) { spu.putlluc(from, line); }),
    act_of_another("its putqlluc",
                   [](Spu& spu, ea_t line, std::uint32_t* from) { spu.putqlluc(from, line, 0); }),
    act_of_another("its putllc",
                   [](Spu& spu, ea_t line, std::uint32_t* from) {
                     do
                       spu.getllar(from, line);
                     while (!spu.putllc(from, line));
                   }),
    act_of_another("and the zeroing of the line",
                   [](Spu& spu, ea_t line, std::uint32_t*) { spell(spu, 0x89, 0, line, 128, 0); }),

    kept(Rule::atomic_status_unread, "a lock-line command whose status is read",
         [](Spu& spu, Stage& stage) { spu.putlluc(line_of(spu), to_ea(stage.to)); }),
    broken(Rule::atomic_status_unread, "one whose status is not",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spell(spu, 0xB0, lsa_of(spu, line), to_ea(stage.to), 128, 0);
           },
           {"putlluc 128 bytes"}),
    broken(Rule::stalls_for_ever, "without a lock-line command there is no status",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.at(CallSite::here());
             spu.read_channel<Channel::rd_atomic_stat>();
           },
           {"MFC_RdAtomicStat would stall for ever"}),
};

TEST_CASE("conformance: atomics") {
  run_rows(kAtomics);
}

} // namespace
} // namespace celltrace::test

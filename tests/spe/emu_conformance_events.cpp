// Conformance: the event facility and the decrementer.
//
// Covers of the facts: "Event facility" - every event, pending bits and the count, phantom events with the
// hardware test of acknowledging, interrupts and bisled, and how the decrementer starts, fires and stops.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

void signal_self(Spu& spu, Signal which = Signal::one) {
  spu.send_signal(spu.id(), which, 1);
}
/// Lets virtual time pass.
void idle(Spu& spu, std::uint64_t cycles) {
  const std::uint64_t end = spu.cycles() + cycles;
  while (spu.cycles() < end)
    spu.in_mailbox_count();
}

const Rows kEvents = {
    fact("an event whose bit the mask has raises the count",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_1);
           stage.is(spu.event_count(), 0);
           signal_self(spu);
           stage.is(spu.event_count(), 1);
           stage.is(spu.read_event_status(), event::signal_1);
           stage.is(spu.event_count(), 0);
           spu.read_signal_1();
         }),
    fact("others are pending until the mask names them",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_2);
           signal_self(spu);
           stage.is(spu.event_count(), 0);
           spu.write_event_mask(event::signal_1);
           stage.is(spu.event_count(), 1);
           stage.is(spu.read_event_mask(), event::signal_1);
           stage.is(spu.read_event_status(), event::signal_1);
           spu.read_signal_1();
         }),
    fact("the status clears no pending bit, an acknowledge the bits it names",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_1 | event::signal_2);
           signal_self(spu);
           signal_self(spu, Signal::two);
           stage.is(spu.read_event_status(), event::signal_1 | event::signal_2);
           stage.is(spu.event_count(), 0);
           spu.acknowledge_events(event::signal_1);
           // What is left pending raises the count again.
           stage.is(spu.event_count(), 1);
           stage.is(spu.read_event_status(), event::signal_2);
           spu.acknowledge_events(event::signal_2);
           stage.is(spu.event_count(), 0);
           spu.read_signal_1();
           spu.read_signal_2();
         }),
    fact("an event that is pending already raises the count again",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_1);
           signal_self(spu);
           stage.is(spu.read_event_status(), event::signal_1);
           spu.read_signal_1();
           signal_self(spu);
           stage.is(spu.event_count(), 1);
           spu.read_signal_1();
         }),
    fact("the count is no counter",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_1 | event::signal_2);
           signal_self(spu);
           signal_self(spu, Signal::two);
           stage.is(spu.event_count(), 1);
           spu.read_event_status();
           stage.is(spu.event_count(), 0);
           spu.read_signal_1();
           spu.read_signal_2();
         }),
    fact("an acknowledge never lowers the count: a phantom event, status 0",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_1);
           signal_self(spu);
           spu.acknowledge_events(event::signal_1);
           stage.is(spu.event_count(), 1);
           stage.is(spu.read_event_status(), 0);
           stage.is(spu.event_count(), 0);
           spu.read_signal_1();
         }),
    kept(Rule::phantom_event, "a program that looks at the status tolerates a phantom",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::signal_1);
           signal_self(spu);
           spu.write_event_mask(0);
           const std::uint32_t events = spu.read_event_status();
           stage.is(events, 0);
           if ((events & event::signal_1) != 0) spu.read_signal_2();
           spu.read_signal_1();
         }),
    broken(Rule::phantom_event, "one that takes the count for news waits for ever",
           [](Spu& spu, Stage& stage) {
             spu.write_event_mask(event::signal_1);
             signal_self(spu);
             spu.read_signal_1();
             spu.acknowledge_events(event::signal_1);
             stage.is(spu.event_count(), 1);
             spu.read_event_status();
             stage.next_line();
             spu.read_signal_1();
           },
           {"SPE 0 waits at channel 3 (SPU_RdSigNotify1)", "after a phantom event"}),
    broken(Rule::phantom_event, "so does one that goes on to its mailbox",
           [](Spu& spu, Stage& stage) {
             spu.write_event_mask(event::in_mailbox);
             spu.send_mailbox(spu.id(), 1);
             spu.read_in_mailbox();
             spu.write_event_mask(0);
             spu.read_event_status();
             stage.next_line();
             spu.read_in_mailbox();
           }),
    broken(Rule::deadlock, "a wait for events that nothing raises is a deadlock",
           [](Spu& spu, Stage& stage) {
             spu.write_event_mask(event::signal_1);
             stage.next_line();
             spu.read_event_status();
           },
           {"channel 0 (SPU_RdEventStat)"}),

    fact("mail and signals are events when the count of their channel rises",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::in_mailbox);
           spu.send_mailbox(spu.id(), 1);
           stage.is(spu.read_event_status(), event::in_mailbox);
           spu.acknowledge_events(event::in_mailbox);
           spu.read_in_mailbox();
           spu.send_mailbox(spu.id(), 2);
           stage.is(spu.read_event_status(), event::in_mailbox);
           spu.read_in_mailbox();
         }),
    fact("the PPE's reads of the outbound mailboxes are events",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::out_mailbox);
           spu.write_out_mailbox(1);
           stage.is(spu.read_event_status(), event::out_mailbox);
           spu.write_event_mask(event::out_intr_mailbox);
           spu.write_out_interrupt_mailbox(2);
           stage.is(spu.read_event_status(), event::out_intr_mailbox);
         })
        .ppe([](Machine& machine, Stage&) {
          while (!machine.read_out_mailbox(0))
            machine.wait_for_mail(std::chrono::seconds(60));
          while (!machine.read_out_interrupt_mailbox(0))
            machine.wait_for_mail(std::chrono::seconds(60));
        }),
    fact("room in a full queue is an event",
         [](Spu& spu, Stage& stage) {
           // A stopped list and 15 commands behind it: the queue is full until the list is acknowledged.
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(2);
           list[0] = ListElement::make(16, to_ea(stage.from), true);
           list[1] = ListElement::make(16, to_ea(stage.from));
           spu.write_event_mask(event::command_queue);
           spu.getl(line, to_ea(stage.from), list, 2, 3);
           for (std::uint32_t i = 0; i < 15; ++i)
             spu.getb(line, to_ea(stage.from), 128, 3);
           stage.is(spu.channel_count<Channel::mfc_cmd>(), 0);
           spu.read_list_stall_status();
           stage.is(spu.event_count(), 0);
           spu.acknowledge_list_stall(3);
           stage.is(spu.read_event_status(), event::command_queue);
           spu.wait_all(1u << 3);
         }),
    fact("a multi-source synchronisation is an event",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::multi_source_sync);
           spu.write_channel<Channel::wr_ms_sync_req>(1);
           stage.is(spu.read_event_status(), event::multi_source_sync);
         }),

    fact("the decrementer is an event when it passes 0, once",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::decrementer);
           spu.write_decrementer(100);
           stage.is(spu.read_event_status(), event::decrementer);
           stage.is(spu.read_decrementer() > 0x80000000u, true);
           spu.acknowledge_events(event::decrementer);
           idle(spu, 100 * 40);
           stage.is(spu.event_count(), 0);
         }),
    fact("masked off and acknowledged it stands still, until it is written again",
         [](Spu& spu, Stage& stage) {
           spu.write_decrementer(1000000);
           spu.write_event_mask(0);
           spu.acknowledge_events(event::decrementer);
           const std::uint32_t value = spu.read_decrementer();
           idle(spu, 10000);
           stage.is(spu.read_decrementer(), value);
           spu.write_decrementer(1000000);
           idle(spu, 10000);
           stage.is(spu.read_decrementer() <= 1000000 - 10000 / 40, true);
         }),
    fact("the decrementer counts virtual time, 40 cycles a tick",
         [](Spu& spu, Stage& stage) {
           spu.write_decrementer(0x7FFFFFFF);
           const std::uint64_t begin = spu.cycles();
           idle(spu, 50000);
           const std::uint32_t ticks = 0x7FFFFFFF - spu.read_decrementer();
           const std::uint64_t cycles = spu.cycles() - begin;
           stage.is(cycles / 40 - ticks <= 1, true);
         }),

    fact("bisled branches when the event status has a count",
         [](Spu& spu, Stage& stage) {
           unsigned taken = 0;
           const auto handler = [&](Spu&) { ++taken; };
           spu.write_event_mask(event::signal_1);
           spu.branch_if_event(handler);
           stage.is(taken, 0u);
           signal_self(spu);
           spu.branch_if_event(handler);
           stage.is(taken, 1u);
           spu.read_signal_1();
         }),
    fact("an interrupt comes while the count is 1, again and again until the status is read",
         [](Spu& spu, Stage& stage) {
           unsigned entered = 0;
           spu.write_event_mask(event::signal_1);
           stage.is(spu.read_channel<Channel::rd_mach_stat>() & 1, 0);
           spu.enable_interrupts([&](Spu& inside) {
             stage.is(inside.read_channel<Channel::rd_mach_stat>() & 1, 0);
             if (++entered < 3) return;
             stage.is(inside.read_event_status(), event::signal_1);
             inside.acknowledge_events(event::signal_1);
             inside.read_signal_1();
           });
           stage.is(spu.read_channel<Channel::rd_mach_stat>() & 1, 1);
           signal_self(spu);
           idle(spu, 100);
           stage.is(entered, 3u);
           spu.disable_interrupts();
           signal_self(spu);
           idle(spu, 100);
           stage.is(entered, 3u);
           spu.read_signal_1();
         }),
};

TEST_CASE("conformance: events") {
  run_rows(kEvents);
}

} // namespace
} // namespace celltrace::test

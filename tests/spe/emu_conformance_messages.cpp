// Conformance: mailboxes and signals.
//
// Covers of the facts: "Mailboxes" and "Signal notification", as SPEs and the PPE use them, and the deadlocks
// that they lead to.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

/// The PPE's wait for a word from an SPE.
std::uint32_t mail_of(Machine& machine, unsigned spe) {
  for (;;) {
    if (const auto word = machine.read_out_mailbox(spe)) return *word;
    machine.wait_for_mail(std::chrono::seconds(60));
  }
}

const Rows kMailboxes = {
    kept(Rule::mailbox_overwritten, "the inbound mailbox holds four words, first in, first out",
         [](Spu& spu, Stage& stage) {
           for (std::uint32_t word = 1; word <= 4; ++word) {
             spu.send_mailbox(spu.id(), word);
             stage.is(spu.in_mailbox_count(), word);
           }
           for (std::uint32_t word = 1; word <= 4; ++word)
             stage.is(spu.read_in_mailbox(), word);
           stage.is(spu.in_mailbox_count(), 0);
         }),
    broken(Rule::mailbox_overwritten, "a fifth replaces the fourth",
           [](Spu& spu, Stage& stage) {
             for (std::uint32_t word = 1; word <= 4; ++word)
               spu.send_mailbox(spu.id(), word);
             stage.next_line();
             spu.send_mailbox(spu.id(), 5);
             stage.is(spu.in_mailbox_count(), 4);
             for (const std::uint32_t word : {1u, 2u, 3u, 5u})
               stage.is(spu.read_in_mailbox(), word);
           },
           {"put 4 bytes", "mailbox of SPE 0", "tag 31"}),
    kept(Rule::mailbox_overwritten, "the PPE waits for room",
         [](Spu& spu, Stage& stage) {
           spu.read_signal_1();
           for (std::uint32_t word = 1; word <= 6; ++word)
             stage.is(spu.read_in_mailbox(), word);
         })
        .ppe([](Machine& machine, Stage& stage) {
          for (std::uint32_t word = 1; word <= 4; ++word)
            machine.write_in_mailbox(0, word);
          stage.is(machine.in_mailbox_space(0), 0);
          machine.write_signal(0, Signal::one, 1);
          machine.write_in_mailbox(0, 5);
          machine.write_in_mailbox(0, 6);
        }),
    kept(Rule::mailbox_unread, "a program that reads its mail",
         [](Spu& spu, Stage& stage) {
           spu.send_mailbox(spu.id(), 3);
           stage.is(spu.read_in_mailbox(), 3);
         }),
    broken(Rule::mailbox_unread, "one that leaves a word behind",
           [](Spu& spu, Stage&) { spu.send_mailbox(spu.id(), 3); }),
    fact("the outbound mailbox holds one word; the SPE waits until the PPE has read it",
         [](Spu& spu, Stage& stage) {
           stage.is(spu.out_mailbox_count(), 1);
           spu.write_out_mailbox(1);
           stage.is(spu.out_mailbox_count(), 0);
           spu.write_out_interrupt_mailbox(9); // now the PPE may read
           spu.write_out_mailbox(2);
           spu.write_out_mailbox(3);
         })
        .ppe([](Machine& machine, Stage& stage) {
          while (!machine.read_out_interrupt_mailbox(0))
            machine.wait_for_mail(std::chrono::seconds(60));
          for (std::uint32_t word = 1; word <= 3; ++word)
            stage.is(mail_of(machine, 0), word);
          stage.is(machine.read_out_mailbox(0).has_value(), false); // never blocks
        }),
    fact("the outbound interrupt mailbox is another",
         [](Spu& spu, Stage& stage) {
           spu.write_out_interrupt_mailbox(1);
           spu.write_out_mailbox(2);
           stage.is(spu.read_in_mailbox(), 7);
           stage.is(spu.out_interrupt_mailbox_count(), 1);
         })
        .ppe([](Machine& machine, Stage& stage) {
          stage.is(mail_of(machine, 0), 2);
          stage.is(machine.read_out_interrupt_mailbox(0).value_or(0), 1);
          machine.write_in_mailbox(0, 7);
        }),
    kept(Rule::deadlock, "a wait for mail that comes is none",
         [](Spu& spu, Stage& stage) { stage.is(spu.read_in_mailbox(), 5); })
        .ppe([](Machine& machine, Stage&) { machine.write_in_mailbox(0, 5); }),
    broken(Rule::deadlock, "a wait for mail that nobody sends is a deadlock",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.read_in_mailbox();
           },
           {"SPE 0 waits at channel 29 (SPU_RdInMbox) at emu_conformance_messages.cpp:",
            "the PPE waits for SPE 0 to stop"}),
    broken(Rule::deadlock, "so is mail that the PPE does not fetch",
           [](Spu& spu, Stage& stage) {
             spu.write_out_mailbox(1);
             stage.next_line();
             spu.write_out_mailbox(2);
           },
           {"channel 28 (SPU_WrOutMbox)"}),
};

const Rows kSignals = {
    kept(Rule::signal_overwritten, "a signal that is read before the next",
         [](Spu& spu, Stage& stage) {
           for (std::uint32_t word = 1; word <= 3; ++word) {
             spu.send_signal(spu.id(), Signal::one, word);
             stage.is(spu.signal_1_count(), 1);
             stage.is(spu.read_signal_1(), word);
             stage.is(spu.signal_1_count(), 0);
           }
         }),
    broken(Rule::signal_overwritten, "in overwrite mode a second signal takes the first away",
           [](Spu& spu, Stage& stage) {
             spu.send_signal(spu.id(), Signal::two, 1);
             stage.next_line();
             spu.send_signal(spu.id(), Signal::two, 2);
             stage.is(spu.signal_2_count(), 1);
             stage.is(spu.read_signal_2(), 2);
           },
           {"sndsig 4 bytes", "signal of SPE 0"}),
    kept(Rule::signal_overwritten, "in or mode it joins it",
         [](Spu& spu, Stage& stage) {
           spu.send_signal(spu.id(), Signal::two, 1);
           spu.send_signal(spu.id(), Signal::two, 2);
           stage.is(spu.signal_2_count(), 1);
           stage.is(spu.read_signal_2(), 3);
           spu.send_signal(spu.id(), Signal::two, 4);
           stage.is(spu.read_signal_2(), 4);
         })
        .configured([](MachineConfig& config) { config.signal_mode[1] = SignalMode::logical_or; }),
    kept(Rule::signal_overwritten, "the two registers are two",
         [](Spu& spu, Stage& stage) {
           spu.send_signal(spu.id(), Signal::one, 1);
           spu.send_signal(spu.id(), Signal::two, 2);
           stage.is(spu.read_signal_2() * 16 + spu.read_signal_1(), 0x21);
         }),
    broken(Rule::signal_overwritten, "the PPE loses one as well",
           [](Spu& spu, Stage& stage) {
             spu.read_in_mailbox();
             stage.is(spu.read_signal_1(), 2);
           },
           {"signal 1 of SPE 0"})
        .by(Diagnostic::kPpe)
        .ppe([](Machine& machine, Stage&) {
          machine.write_signal(0, Signal::one, 1);
          machine.write_signal(0, Signal::one, 2);
          machine.write_in_mailbox(0, 1);
        }),
    kept(Rule::signal_unread, "a program that reads its signals",
         [](Spu& spu, Stage& stage) {
           spu.send_signal(spu.id(), Signal::one, 0);
           stage.is(spu.signal_1_count(), 1); // a signal of 0 is one
           stage.is(spu.read_signal_1(), 0);
         }),
    broken(Rule::signal_unread, "one that leaves a signal behind",
           [](Spu& spu, Stage&) { spu.send_signal(spu.id(), Signal::two, 3); }, {"signal 2"}),
    broken(Rule::deadlock, "two SPEs that wait for each other's signals are named both",
           [](Spu& spu, Stage& stage) {
             if (spu.id() == 0) {
               stage.next_line();
               spu.read_signal_1();
             }
             spu.read_signal_2();
           },
           {"SPE 0 waits at channel 3 (SPU_RdSigNotify1)", "SPE 1 waits at channel 4 (SPU_RdSigNotify2)",
            "the PPE waits for SPE 0 to stop"})
        .spes(2),
};

TEST_CASE("conformance: mailboxes") {
  run_rows(kMailboxes);
}

TEST_CASE("conformance: signals") {
  run_rows(kSignals);
}

} // namespace
} // namespace celltrace::test

// Conformance: the order of commands, and transfers in flight.
//
// Covers of the facts: "Ordering" (fences, barriers, queue barriers, the queue), and of the checks, races of
// transfers in flight, poison, changed sources, and ends of programs with commands in flight.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

constexpr std::uint32_t kMfceieio = 0xC8, kMfcsync = 0xCC;

/// A get, and another to the same line that is issued by `second`, with what stands between them.
template <class Second> std::function<void(Spu&, Stage&)> two_gets(Second second) {
  return [second](Spu& spu, Stage& stage) {
    auto* line = line_of(spu);
    spu.get(line, to_ea(stage.from), 128, 1);
    second(spu, stage, line);
    spu.wait_all(~0u);
    stage.is(line[0], 33);
  };
}

/// From line to line through local store: works only if the put comes behind the get.
template <class Put> std::function<void(Spu&, Stage&)> copy(Put put) {
  return [put](Spu& spu, Stage& stage) {
    auto* line = line_of(spu);
    spu.get(line, to_ea(stage.from), 128, 1);
    put(spu, stage, line);
    spu.wait_all(~0u);
    stage.is(stage.to[31], 32);
  };
}

const Rows kOrdering = {
    broken(Rule::local_store_race, "two gets of a tag come in any order",
           two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
             stage.next_line();
             spu.get(line, to_ea(stage.from + 32), 128, 1);
           }),
           {"get 128 bytes, LS 0x1a080 <- EA 0x", "meets command 1 of SPE 0 (get 128 bytes, LS 0x1a080"}),
    kept(Rule::local_store_race, "a fenced get comes behind the earlier ones of its tag",
         two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spu.getf(line, to_ea(stage.from + 32), 128, 1);
         })),
    kept(Rule::local_store_race, "so does a barriered one",
         two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spu.getb(line, to_ea(stage.from + 32), 128, 1);
         })),
    broken(Rule::local_store_race, "a fence orders nothing of another tag",
           two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
             stage.next_line();
             spu.getf(line, to_ea(stage.from + 32), 128, 2);
           })),
    broken(Rule::local_store_race, "nor does a tag's barrier",
           two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
             stage.next_line();
             spu.getb(line, to_ea(stage.from + 32), 128, 2);
           })),
    kept(Rule::local_store_race, "a barrier holds back what comes behind it, too",
         two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spu.putb(line_of(spu), to_ea(stage.to), 128, 1);
           spu.get(line, to_ea(stage.from + 32), 128, 1);
         })),
    broken(Rule::local_store_race, "a fence does not",
           two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
             spu.putf(line_of(spu), to_ea(stage.to), 128, 1);
             stage.next_line();
             spu.get(line, to_ea(stage.from + 32), 128, 1);
           })),
    kept(Rule::local_store_race, "mfc_barrier orders all tags",
         two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spu.mfc_barrier(9);
           spu.get(line, to_ea(stage.from + 32), 128, 2);
         })),
    kept(Rule::local_store_race, "so does mfceieio on the hardware",
         two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spell(spu, kMfceieio, 0, 0, 0, 9);
           spu.get(line, to_ea(stage.from + 32), 128, 2);
         })),
    kept(Rule::local_store_race, "and mfcsync", two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spell(spu, kMfcsync, 0, 0, 0, 9);
           spu.get(line, to_ea(stage.from + 32), 128, 2);
         })),
    kept(Rule::local_store_race, "a wait for the tag orders it",
         two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spu.wait_all(1u << 1);
           spu.get(line, to_ea(stage.from + 32), 128, 2);
         })),
    broken(Rule::local_store_race, "a wait for another tag does not",
           two_gets([](Spu& spu, Stage& stage, std::uint32_t* line) {
             spu.get(line_of(spu), to_ea(stage.from), 128, 2);
             spu.wait_all(1u << 2);
             stage.next_line();
             spu.get(line, to_ea(stage.from + 32), 128, 2);
           })),
    broken(Rule::local_store_race, "one shared byte is an overlap",
           [](Spu& spu, Stage& stage) {
             auto* buffer = spu.allocate<std::uint8_t>(64);
             spu.get(buffer, to_ea(stage.from), 32, 1);
             stage.next_line();
             spu.get(buffer + 31, to_ea(stage.from) + 31, 1, 2);
           },
           {"get 1 bytes", "tag 2 meets command 1"}),
    kept(Rule::local_store_race, "neighbours do not overlap",
         [](Spu& spu, Stage& stage) {
           auto* buffer = spu.allocate<std::uint8_t>(64);
           spu.get(buffer, to_ea(stage.from), 32, 1);
           spu.get(buffer + 32 + kLowByte, to_ea(stage.from + 8) + kLowByte, 1, 2);
           spu.wait_all(6);
           stage.is(buffer[32 + kLowByte], 9);
         }),
    kept(Rule::local_store_race, "puts may share their source",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line[0] = 8;
           spu.put(line, to_ea(stage.to), 128, 1);
           spu.put(line, to_ea(stage.to + 32), 128, 2);
           spu.wait_all(6);
           stage.is(stage.to[0] + stage.to[32], 16);
         }),
    broken(Rule::local_store_race, "a buffer must not be filled again while its results leave",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             spu.put(line, to_ea(stage.to), 128, 1);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 128, 1);
           },
           {"meets command 1 of SPE 0 (put 128 bytes"}),
    broken(Rule::local_store_race, "nor a get's target leave before it has come",
           copy([](Spu& spu, Stage& stage, std::uint32_t* line) {
             stage.next_line();
             spu.put(line, to_ea(stage.to), 128, 1);
           })),
    kept(Rule::local_store_race, "a fenced put takes what the get before it brought",
         copy([](Spu& spu, Stage& stage, std::uint32_t* line) { spu.putf(line, to_ea(stage.to), 128, 1); })),
    kept(Rule::local_store_race, "across tags a queue barrier makes it so",
         copy([](Spu& spu, Stage& stage, std::uint32_t* line) {
           spu.mfc_barrier(0);
           spu.put(line, to_ea(stage.to), 128, 2);
         })),
    broken(Rule::local_store_race, "a lock line must not come where a get is to come",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             spu.get(line, to_ea(stage.from), 128, 1);
             stage.next_line();
             spu.getllar(line, to_ea(stage.to));
           },
           {"getllar 128 bytes"}),
    broken(Rule::main_storage_race, "another SPE's put must not meet a get there",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             if (spu.id() == 0) {
               spu.get(line, to_ea(stage.from), 128, 1);
               spu.write_out_mailbox(lsa_of(spu, line));
               spu.read_in_mailbox();
               return;
             }
             const ea_t theirs = spu.addresses(0).local_store + spu.read_in_mailbox();
             stage.next_line();
             spu.put(line, theirs, 128, 4);
           },
           {"put 128 bytes", "meets command 1 of SPE 0 (get 128 bytes"})
        .spes(2)
        .by(1)
        .ppe([](Machine& machine, Stage&) {
          std::optional<std::uint32_t> lsa;
          while (!(lsa = machine.read_out_mailbox(0)))
            machine.wait_for_mail(std::chrono::seconds(60));
          machine.write_in_mailbox(1, *lsa);
        }),

    broken(Rule::main_storage_race, "two puts to one place come in any order",
           [](Spu& spu, Stage& stage) {
             auto* lines = spu.allocate<std::uint32_t>(64);
             spu.put(lines, to_ea(stage.to), 128, 1);
             stage.next_line();
             spu.put(lines + 32, to_ea(stage.to), 128, 1);
           },
           {"put 128 bytes, LS 0x1a100 -> EA 0x", "meets command 1 of SPE 0"}),
    kept(Rule::main_storage_race, "a fence puts them in order",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(64);
           lines[0] = 1;
           lines[32] = 2;
           spu.put(lines, to_ea(stage.to), 128, 1);
           spu.putf(lines + 32, to_ea(stage.to), 128, 1);
           spu.wait_all(1u << 1);
           stage.is(stage.to[0], 2);
         }),
    kept(Rule::main_storage_race, "two halves of a line are two places",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line[0] = line[16] = 4;
           spu.put(line, to_ea(stage.to), 64, 1);
           spu.put(line + 16, to_ea(stage.to + 16), 64, 1);
           spu.wait_all(1u << 1);
           stage.is(stage.to[0] + stage.to[16], 8);
         }),
    broken(Rule::main_storage_race, "a get does not wait for the put before it",
           [](Spu& spu, Stage& stage) {
             auto* lines = spu.allocate<std::uint32_t>(64);
             spu.put(lines, to_ea(stage.to), 128, 1);
             stage.next_line();
             spu.get(lines + 32, to_ea(stage.to), 128, 1);
           }),
    kept(Rule::main_storage_race, "a fenced get does",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(64);
           lines[5] = 77;
           spu.put(lines, to_ea(stage.to), 128, 1);
           spu.getf(lines + 32, to_ea(stage.to), 128, 1);
           spu.wait_all(1u << 1);
           stage.is(lines[32 + 5], 77);
         }),
    kept(Rule::main_storage_race, "gets may share their source",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(64);
           spu.get(lines, to_ea(stage.from), 128, 1);
           spu.get(lines + 32, to_ea(stage.from), 128, 1);
           spu.wait_all(1u << 1);
           stage.is(lines[0] + lines[32], 2);
         })
        .spes(2),
    broken(Rule::main_storage_race, "a signal behind a put says nothing about it",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             if (spu.id() == 0) {
               spu.put(line, to_ea(stage.to), 128, 1);
               spu.send_signal(1, Signal::one, 1);
               spu.read_signal_1();
               return;
             }
             spu.read_signal_1();
             stage.next_line();
             spu.get(line, to_ea(stage.to), 128, 4);
           },
           {"get 128 bytes", "meets command 1 of SPE 0 (put 128 bytes"})
        .spes(2)
        .by(1),
    kept(Rule::main_storage_race, "a signal behind a wait does",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           if (spu.id() == 0) {
             line[0] = 9;
             spu.put(line, to_ea(stage.to), 128, 1);
             spu.wait_all(1u << 1);
             spu.send_signal(1, Signal::one, 1);
             return;
           }
           spu.read_signal_1();
           spu.get(line, to_ea(stage.to), 128, 4);
           spu.wait_all(1u << 4);
           stage.is(line[0], 9);
         })
        .spes(2),
    kept(Rule::main_storage_race, "so does one that is fenced behind the put",
         [](Spu& spu, Stage& stage) {
           auto* line = spu.allocate<std::uint32_t>(64);
           if (spu.id() == 0) {
             line[0] = 9;
             line[35] = 1;
             spu.put(line, to_ea(stage.to), 128, 1);
             spu.mfc_command<MfcOpcode::sndsigf>(line + 35, spu.addresses(1).signal_1, 4, 1);
             spu.read_signal_1();
             spu.wait_all(1u << 1);
             return;
           }
           spu.read_signal_1();
           spu.get(line, to_ea(stage.to), 128, 4);
           spu.wait_all(1u << 4);
           stage.is(line[0], 9);
           spu.send_signal(0, Signal::one, 1);
         })
        .spes(2),
    broken(Rule::main_storage_race, "a fence says nothing of commands behind it",
           [](Spu& spu, Stage& stage) {
             auto* lines = spu.allocate<std::uint32_t>(96);
             if (spu.id() == 0) {
               spu.put(lines, to_ea(stage.to), 128, 1);
               spu.putf(lines + 32, to_ea(stage.to + 32), 128, 1);
               spu.put(lines + 64, to_ea(stage.to + 64), 128, 1);
               while (spu.cycles() < 100000)
                 spu.event_count();
               spu.send_signal(1, Signal::one, 1);
               spu.read_signal_1();
               return;
             }
             spu.read_signal_1();
             stage.next_line();
             spu.get(lines, to_ea(stage.to + 64), 128, 4);
           },
           {"meets command 3 of SPE 0 (put 128 bytes"})
        .spes(2)
        .by(1),
    fact("the 17th command waits for room in the queue",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(32 * 40);
           stage.is(spu.channel_count<Channel::mfc_cmd>(), 16);
           for (std::uint32_t i = 0; i < 40; ++i) {
             spu.get(lines + 32 * i, to_ea(stage.from), 128, i % 31);
             stage.is(spu.channel_count<Channel::mfc_cmd>() <= 16, true);
           }
           spu.wait_all(~0u);
           stage.is(lines[32 * 39], 1);
           stage.is(spu.channel_count<Channel::mfc_cmd>(), 16);
         }),
};

const Rows kInFlight = {
    kept(Rule::get_target_touched, "a target may be written before its get and after the wait",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line[0] = 5;
           spu.get(line, to_ea(stage.from), 128, 1);
           spu.wait_all(1u << 1);
           stage.is(line[0], 1);
           line[0] = 6;
           spu.wait_all(1u << 1);
         }),
    broken(Rule::get_target_touched, "not in between",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 128, 1);
             poke(line + 31, 6);
             spu.wait_all(1u << 1);
           },
           {"get 128 bytes"}),
    kept(Rule::put_source_changed, "a source may be read while it leaves",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line[0] = 5;
           spu.put(line, to_ea(stage.to), 128, 1);
           stage.is(line[0], 5);
           spu.wait_all(1u << 1);
           line[0] = 6;
           stage.is(stage.to[0], 5);
         }),
    broken(Rule::put_source_changed, "but not written",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.put(line, to_ea(stage.to), 128, 1);
             line[31] = 6;
             spu.wait_all(1u << 1);
           },
           {"put 128 bytes"}),
    broken(Rule::put_source_changed, "nor written and restored between two looks of a poll",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.put(line, to_ea(stage.to), 128, 1);
             line[31] = 6;
             while (spu.completed(1u << 1) == 0) {
             }
           }),
    broken(Rule::put_source_changed, "the source of a putqlluc is one, too",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.putqlluc(line, to_ea(stage.to), 1);
             line[31] = 6;
             spu.wait_all(1u << 1);
           },
           {"putqlluc 128 bytes"}),
    fact("where data are to come lies poison, a word that is no number",
         [](Spu& spu, Stage& stage) {
           auto* line = spu.allocate<std::uint32_t>(64);
           spu.get(line, to_ea(stage.from), 128, 1);
           stage.is(peek(line), kPoisonWord);
           stage.is(peek(line + 31), kPoisonWord);
           stage.is(line[32], 0);
           spu.wait_all(1u << 1);
           stage.is(line[31], 32);
         })
        .not_at_issue(),
    fact("a poll that finds the tag complete is as good as a wait",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.get(line, to_ea(stage.from), 128, 1);
           while (spu.completed(1u << 1) == 0) {
           }
           stage.is(line[0], 1);
         }),

    kept(Rule::in_flight_at_exit, "a program that waits for what it began",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.put(line, to_ea(stage.to), 128, 1);
           spu.putqlluc(line, to_ea(stage.to + 32), 2);
           spu.wait_all(6);
         }),
    broken(Rule::in_flight_at_exit, "one that does not wait for a put",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.put(line, to_ea(stage.to), 128, 1);
           },
           {"put 128 bytes", "without a wait"}),
    broken(Rule::in_flight_at_exit, "nor for a signal",
           [](Spu& spu, Stage& stage) {
             auto* word = spu.allocate<std::uint32_t>(4) + 3;
             stage.next_line();
             spell(spu, 0xA0, lsa_of(spu, word), spu.addresses(0).signal_1, 4, 1);
             spu.read_signal_1();
           },
           {"sndsig 4 bytes"}),
    broken(Rule::in_flight_at_exit, "nor for a putqlluc",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.putqlluc(line, to_ea(stage.to), 1);
           },
           {"putqlluc 128 bytes"}),
    broken(Rule::in_flight_at_exit, "one that exits by a stop code",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 128, 1);
             spu.stop_and_signal<0x2000>();
           }),
    broken(Rule::in_flight_at_exit, "one that waits for one of two tags",
           [](Spu& spu, Stage& stage) {
             auto* lines = spu.allocate<std::uint32_t>(64);
             spu.get(lines, to_ea(stage.from), 128, 1);
             stage.next_line();
             spu.get(lines + 32, to_ea(stage.from), 128, 2);
             spu.wait_all(1u << 1);
           }),
};

TEST_CASE("conformance: ordering") {
  run_rows(kOrdering);
}

TEST_CASE("conformance: in flight") {
  run_rows(kInFlight);
}

} // namespace
} // namespace celltrace::test

// Conformance: MFC commands and their operands.
//
// Covers of the facts: opcodes, command word, "Size and alignment check", problem-state registers (sndsig, LS
// to LS), alignment of lock lines, and the parameters of channels 16 to 20.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

/// A get of `size` bytes between the same offsets of a line in local store and one in memory.
void get_at(Spu& spu, Stage& stage, std::uint32_t offset, std::uint32_t size) {
  auto* buffer = spu.allocate<std::uint8_t>(256);
  stage.next_line();
  spu.get(buffer + offset, to_ea(stage.from) + offset, size, 3);
  spu.wait_all(1u << 3);
  for (std::uint32_t i = 0; i < 256; ++i) {
    const bool moved = i >= offset && i < offset + size;
    stage.is(buffer[i], moved ? reinterpret_cast<const std::uint8_t*>(stage.from)[i] : 0);
  }
}

Row bad_size(const char* fact, std::uint32_t size) {
  return broken(Rule::transfer_size, fact,
                [size](Spu& spu, Stage& stage) {
                  auto* buffer = spu.allocate<std::uint8_t>(32 * 1024);
                  stage.next_line();
                  spu.get(buffer, to_ea(stage.from), size, 5);
                },
                {"get " + std::to_string(size) + " bytes, LS 0x1a080 <- EA 0x", ", tag 5: size must be"});
}

Row bad_address(const char* fact, ea_t (*address)(Spu&)) {
  return broken(Rule::mapped_address, fact,
                [address](Spu& spu, Stage& stage) {
                  auto* line = line_of(spu);
                  const ea_t ea = address(spu);
                  stage.next_line();
                  spu.put(line, ea, 128, 1);
                },
                {"put 128 bytes"});
}

alignas(128) const std::uint32_t kObject[64] = {};

/// The first line of it.
void register_object(MachineConfig& config) {
  config.emulation.objects = {{to_ea(kObject), 128, "object"}};
}

const Rows kTransfers = {
    kept(Rule::transfer_size, "1, 2, 4 and 8 bytes are transfers, at any multiple of their size",
         [](Spu& spu, Stage& stage) {
           for (const std::uint32_t size : {1u, 2u, 4u, 8u})
             for (std::uint32_t offset = 0; offset < 32; offset += size)
               get_at(spu, stage, offset, size);
         }),
    kept(Rule::transfer_size, "multiples of 16 up to 16 KB are transfers",
         [](Spu& spu, Stage& stage) {
           auto* buffer = spu.allocate<std::uint32_t>(4096);
           for (std::uint32_t size = 16; size <= kMaxDmaBytes; size = size < 128 ? size + 16 : 2 * size) {
             spu.get(buffer, to_ea(stage.from), size, 0);
             spu.wait_all(1);
             stage.is(buffer[size / 4 - 1], size / 4);
             spu.put(buffer, to_ea(stage.to), size, 0);
             spu.wait_all(1);
             stage.is(stage.to[size / 4 - 1], size / 4);
           }
         }),
    bad_size("3 bytes are no transfer", 3),
    bad_size("12 bytes are no transfer", 12),
    bad_size("17 bytes are none, which the check of Linux lets pass", 17),
    bad_size("20 bytes are none", 20),
    bad_size("16 KB and 16 bytes are too many", 16400),

    kept(Rule::zero_size, "a transfer of 1 byte is one",
         [](Spu& spu, Stage& stage) { get_at(spu, stage, 0, 1); }),
    broken(Rule::zero_size, "a transfer of 0 bytes does nothing",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 0, 2);
             stage.is(spu.wait_all(1u << 2), 1u << 2);
             stage.is(line[0], 0);
           },
           {"get 0 bytes", "tag 2"}),

    kept(Rule::same_low_bits, "4 bytes at 4 go to a place at 20",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.get(line + 5, to_ea(stage.from + 1), 4, 0);
           spu.wait_all(1);
           stage.is(line[5], 2);
         }),
    broken(Rule::same_low_bits, "4 bytes at 4 do not go to a place at 0",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.get(line, to_ea(stage.from + 1), 4, 0);
           },
           {"get 4 bytes", "low 4 bits"}),
    broken(Rule::same_low_bits, "a quadword at 8 does not go to one at 0",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.put(line, to_ea(stage.to + 2), 16, 0);
           }),

    kept(Rule::natural_alignment, "8 bytes at 8", [](Spu& spu, Stage& stage) { get_at(spu, stage, 8, 8); }),
    broken(Rule::natural_alignment, "8 bytes at 4", [](Spu& spu, Stage& stage) { get_at(spu, stage, 4, 8); }),
    broken(Rule::natural_alignment, "4 bytes at 2", [](Spu& spu, Stage& stage) { get_at(spu, stage, 2, 4); }),
    broken(Rule::natural_alignment, "2 bytes at 1", [](Spu& spu, Stage& stage) { get_at(spu, stage, 1, 2); }),
    kept(Rule::quadword_alignment, "32 bytes at 16",
         [](Spu& spu, Stage& stage) { get_at(spu, stage, 16, 32); }),
    broken(Rule::quadword_alignment, "16 bytes at 8",
           [](Spu& spu, Stage& stage) { get_at(spu, stage, 8, 16); }),
    broken(Rule::quadword_alignment, "16 bytes at 4",
           [](Spu& spu, Stage& stage) { get_at(spu, stage, 4, 16); }),

    kept(Rule::tag_range, "tags 0 to 31 exist",
         [](Spu& spu, Stage& stage) {
           auto* words = spu.allocate<std::uint32_t>(32 * 4);
           for (std::uint32_t tag = 0; tag < 32; ++tag)
             spu.get(words + 4 * tag, to_ea(stage.from), 16, tag);
           stage.is(spu.wait_all(~0u), ~0u);
           stage.is(words[4 * 31], 1);
         }),
    broken(Rule::tag_range, "tag 32 does not, though the hardware has bits for it",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 128, 32);
           },
           {"tag 32: tag must be 0..31"}),

    kept(Rule::in_local_store, "the arena's first and last quadword are local store",
         [](Spu& spu, Stage& stage) {
           ArenaState& arena = spu.arena();
           auto* first = spu.allocate<std::uint32_t>(4, 16);
           auto* last = reinterpret_cast<std::uint32_t*>(arena.end - 16);
           spu.get(first, to_ea(stage.from), 16, 0);
           spu.get(last, to_ea(stage.from), 16, 0);
           spu.wait_all(1);
           stage.is(first[0] + last[3], 5);
         }),
    broken(Rule::in_local_store, "a variable on the host's stack is not",
           [](Spu& spu, Stage& stage) {
             alignas(128) std::uint32_t variable[32] = {};
             stage.next_line();
             spu.get(variable, to_ea(stage.from), 128, 0);
           },
           {"LS outside"}),
    broken(Rule::in_local_store, "nor is the address 256 KB, which the hardware wraps",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spell(spu, 0x40, 0x40000, to_ea(stage.from), 128, 0);
           },
           {"LS 0x40000"}),
    kept(Rule::local_store_end, "a put may start at the last quadword of local store",
         [](Spu& spu, Stage& stage) {
           spell(spu, 0x20, 0x3FFF0, to_ea(stage.to), 16, 0);
           spu.wait_all(1);
           stage.is(stage.to[0], kUnwrittenWord); // of the stack, which nobody has written
         }),
    broken(Rule::local_store_end, "but not cross the end",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spell(spu, 0x20, 0x3FFF0, to_ea(stage.to), 32, 0);
           },
           {"put 32 bytes, LS 0x3fff0"}),

    kept(Rule::mapped_address, "the last line of another local store is mapped",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.get(line, spu.addresses(1 - spu.id()).local_store + kLocalStoreBytes - 128, 128, 0);
           stage.is(spu.wait_all(1), 1);
         })
        .spes(2),
    bad_address("a null pointer is not mapped", [](Spu&) { return ea_t{0}; }),
    bad_address("nor is a transfer that leaves the local store it starts in",
                [](Spu& spu) { return spu.addresses(0).local_store + kLocalStoreBytes - 64; }),
    bad_address("nor one that runs from memory into a local store",
                [](Spu& spu) { return spu.addresses(0).local_store - 64; }),
    bad_address("nor the end of all addresses", [](Spu&) { return ~ea_t{0} - 63; }),

    kept(Rule::known_command, "the high half of a command word is not its opcode",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spell(spu, 0x12340040, lsa_of(spu, line), to_ea(stage.from), 128, 0);
           spu.wait_all(1);
           stage.is(line[31], 32);
         }),
    kept(Rule::known_command, "a put with the result bit is a put",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line[5] = 5;
           for (const std::uint32_t opcode : {0x30u, 0x31u, 0x32u})
             spell(spu, opcode, lsa_of(spu, line), to_ea(stage.to + (opcode & 3) * 32), 128, 0);
           spu.wait_all(1);
           stage.is(stage.to[5] + stage.to[32 + 5] + stage.to[64 + 5], 15);
         }),
    kept(Rule::known_command, "cache hints change nothing, sdcrz zeroes lines",
         [](Spu& spu, Stage& stage) {
           for (const std::uint32_t opcode : {0x80u, 0x81u, 0x8Du, 0x8Fu}) {
             spell(spu, opcode, 0, to_ea(stage.from), 256, 0);
             spu.wait_all(1);
             stage.is(stage.from[5], 6);
           }
           spell(spu, 0x89, 0, to_ea(stage.from), 256, 0);
           spu.wait_all(1);
           stage.is(stage.from[0] + stage.from[63], 0);
           stage.is(stage.from[64], 65);
         }),
    broken(Rule::known_command, "0x99 is no opcode",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spell(spu, 0x99, 0x20000, to_ea(stage.from), 128, 3);
           },
           {"command 0x99"}),
    broken(Rule::known_command, "get and start (0x48) is a command of the PPE only",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spell(spu, 0x48, 0x20000, to_ea(stage.from), 128, 3);
           },
           {"command 0x48"}),

    kept(Rule::parameters_kept, "a command of which all parameters are written",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           for (int i = 0; i < 2; ++i) {
             spell(spu, 0x40, lsa_of(spu, line), to_ea(stage.from), 128, 0);
             spu.wait_all(1);
           }
           stage.is(line[0], 1);
         }),
    broken(Rule::parameters_kept,
           "the hardware keeps the parameters of the last command, the manual does not",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             spell(spu, 0x40, lsa_of(spu, line), to_ea(stage.from), 128, 7);
             spu.wait_all(1u << 7);
             stage.next_line();
             spu.at(CallSite::here());
             spu.write_channel<Channel::mfc_cmd>(0x40);
             stage.is(spu.wait_all(1u << 7), 1u << 7);
             stage.is(line[31], 32);
           },
           {"get 128 bytes"}),

    kept(Rule::program_overwritten, "a get into the arena leaves code and stack alone",
         [](Spu& spu, Stage& stage) { get_at(spu, stage, 0, 128); }),
    broken(Rule::program_overwritten, "a get to LS 0 hits the code",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spell(spu, 0x40, 0, to_ea(stage.from), 128, 0);
           },
           {"get 128 bytes, LS 0x0 <-"}),
    broken(Rule::program_overwritten, "a get that ends behind the arena hits the stack",
           [](Spu& spu, Stage& stage) {
             const std::uint32_t end = lsa_of(spu, spu.arena().end);
             stage.next_line();
             spell(spu, 0x40, end - 64, to_ea(stage.from), 128, 0);
           },
           {"get 128 bytes"}),
    broken(Rule::program_overwritten, "a stray store is found when the program has ended",
           [](Spu& spu, Stage&) { poke(reinterpret_cast<std::uint32_t*>(spu.arena().begin - 16), 1); },
           {"near LS address 106480"}),
    broken(Rule::program_overwritten, "so is what another SPE puts there",
           [](Spu& spu, Stage&) {
             if (spu.id() == 0) {
               spu.send_signal(1, Signal::one, 1);
               spu.read_signal_1();
               return;
             }
             spu.read_signal_1();
             auto* line = line_of(spu);
             spu.put(line, spu.addresses(0).local_store + 0x400, 128, 0);
             spu.wait_all(1);
             spu.send_signal(0, Signal::one, 1);
           },
           {"near LS address 1024"})
        .spes(2),

    kept(Rule::allocation_bounds, "a get may fill all of an allocation",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.get(line, to_ea(stage.from), 128, 0);
           spu.wait_all(1);
           stage.is(line[31], 32);
         }),
    broken(Rule::allocation_bounds, "and not go on behind it",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.get(line, to_ea(stage.from), 256, 7);
           },
           {"get 256 bytes, LS 0x1a080 <- EA 0x", ", tag 7: ", "128 bytes at LS 0x1a080"}),
    kept(Rule::allocation_overrun, "a program may store into all of an allocation",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           line_of(spu);
           poke(line + 31, 5);
           stage.is(line[31], 5);
         }),
    broken(Rule::allocation_overrun, "and not behind it",
           [](Spu& spu, Stage&) {
             auto* line = line_of(spu);
             line_of(spu);
             poke(line + 32, 5);
           },
           {"near LS 0x1a100: a store went past an allocation of 128 bytes at LS 0x1a080"}),
    fact("red zones take nothing from the arena",
         [](Spu& spu, Stage& stage) {
           const std::uint32_t lines = spu.available() / 128 - 1;
           for (std::uint32_t line = 0; line < lines; ++line)
             line_of(spu);
           stage.is(spu.available() < 256, true);
         }),
    kept(Rule::object_bounds, "a get may read all of a registered object",
         [](Spu& spu, Stage&) { spu.get(line_of(spu), to_ea(kObject), 128, 0), spu.wait_all(1); })
        .configured(register_object),
    broken(Rule::object_bounds, "and not go on behind it",
           [](Spu& spu, Stage& stage) {
             auto* lines = spu.allocate<std::uint32_t>(64);
             stage.next_line();
             spu.get(lines, to_ea(kObject), 256, 7);
           },
           {"get 256 bytes", ", tag 7: ", "'object': 128 bytes at EA 0x"})
        .configured(register_object),
};

/// What a mailbox word or a signal looks like on the SPE that sends it.
struct Registers {
  std::uint32_t* quadword;
  SpeAddresses mine;
};
Registers registers_of(Spu& spu) {
  Registers registers{spu.allocate<std::uint32_t>(4, 16), spu.addresses(spu.id())};
  registers.quadword[3] = 0x77;
  return registers;
}

const Rows kRegisters = {
    kept(Rule::register_exists, "an SPE may put a word into an inbound mailbox",
         [](Spu& spu, Stage& stage) {
           const auto [quadword, mine] = registers_of(spu);
           spu.put(quadword + 3, mine.in_mailbox, 4, 0);
           spu.wait_all(1);
           stage.is(spu.read_in_mailbox(), 0x77);
         }),
    broken(Rule::register_exists, "there is nothing 16 bytes behind it",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spu.put(quadword + 3, mine.in_mailbox + 16, 4, 0);
           }),
    kept(Rule::register_size, "a signal takes 4 bytes",
         [](Spu& spu, Stage& stage) {
           const auto [quadword, mine] = registers_of(spu);
           spu.put(quadword + 3, mine.signal_2, 4, 0);
           spu.wait_all(1);
           stage.is(spu.read_signal_2(), 0x77);
         }),
    broken(Rule::register_size, "it takes no quadword",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spu.put(quadword, mine.signal_2, 16, 0);
           },
           {"put 16 bytes"}),
    kept(Rule::register_word, "its word lies in the last one of a quadword",
         [](Spu& spu, Stage& stage) {
           const auto [quadword, mine] = registers_of(spu);
           stage.is(mine.signal_1 & 15, 0xC);
           stage.is(mine.signal_2 & 15, 0xC);
           stage.is(mine.in_mailbox & 15, 0xC);
           spu.put(quadword + 3, mine.signal_1, 4, 0);
           spu.wait_all(1);
           stage.is(spu.read_signal_1(), 0x77);
         }),
    broken(Rule::register_word, "not in the first",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spu.put(quadword, mine.in_mailbox, 4, 0);
           },
           {"LS & 15 = 0xC"}),
    kept(Rule::register_readable, "a signal can be read by DMA, which does not clear it",
         [](Spu& spu, Stage& stage) {
           const auto [quadword, mine] = registers_of(spu);
           spu.send_signal(spu.id(), Signal::one, 0x55);
           spu.get(quadword + 3, mine.signal_1, 4, 0);
           spu.wait_all(1);
           stage.is(quadword[3], 0x55);
           stage.is(spu.signal_1_count(), 1);
           stage.is(spu.read_signal_1(), 0x55);
         }),
    broken(Rule::register_readable, "the inbound mailbox cannot",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spu.get(quadword + 3, mine.in_mailbox, 4, 0);
           }),
    kept(Rule::signal_size, "sndsig, with fence or barrier or without, sends 4 bytes",
         [](Spu& spu, Stage& stage) {
           const auto [quadword, mine] = registers_of(spu);
           for (const std::uint32_t opcode : {0xA0u, 0xA1u, 0xA2u}) {
             quadword[3] = opcode;
             spell(spu, opcode, lsa_of(spu, quadword + 3), mine.signal_1, 4, 0);
             spu.wait_all(1);
             stage.is(spu.read_signal_1(), opcode);
           }
         }),
    broken(Rule::signal_size, "it sends no 8",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spell(spu, 0xA0, lsa_of(spu, quadword + 2), mine.signal_1, 8, 0);
           },
           {"sndsig 8 bytes"}),
    kept(Rule::signal_target, "sndsig goes to either signal",
         [](Spu& spu, Stage& stage) {
           spu.send_signal(spu.id(), Signal::one, 1);
           spu.send_signal(spu.id(), Signal::two, 2);
           stage.is(spu.read_signal_1() + spu.read_signal_2(), 3);
         }),
    broken(Rule::signal_target, "it does not go to a mailbox",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spell(spu, 0xA0, lsa_of(spu, quadword + 3), mine.in_mailbox, 4, 0);
           }),
    broken(Rule::signal_target, "nor to memory",
           [](Spu& spu, Stage& stage) {
             const auto [quadword, mine] = registers_of(spu);
             stage.next_line();
             spell(spu, 0xA0, lsa_of(spu, quadword + 3), to_ea(stage.to + 3), 4, 0);
           }),
    fact("local store to local store is DMA like any other",
         [](Spu& spu, Stage& stage) {
           auto* line = spu.allocate<std::uint32_t>(64);
           if (spu.id() == 1) {
             spu.write_out_mailbox(lsa_of(spu, line));
             spu.read_signal_1();
             stage.is(line[31], 32);
             return;
           }
           for (std::uint32_t i = 0; i < 32; ++i)
             line[32 + i] = i + 1;
           const std::uint32_t lsa = spu.read_in_mailbox();
           spu.put(line + 32, spu.addresses(1).local_store + lsa, 128, 0);
           spu.get(line, spu.addresses(1).local_store, 128, 0); // its code
           spu.wait_all(1);
           stage.is(line[0], kUnwrittenWord);
           spu.send_signal(1, Signal::one, 1);
         })
        .spes(2)
        .ppe([](Machine& machine, Stage&) {
          std::optional<std::uint32_t> lsa;
          while (!(lsa = machine.read_out_mailbox(1)))
            machine.wait_for_mail(std::chrono::seconds(60));
          machine.write_in_mailbox(0, *lsa);
        }),

    kept(Rule::line_alignment, "a lock line is 128-byte aligned on both sides",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.getllar(line, to_ea(stage.from + 32));
           stage.is(line[0], 33);
         }),
    broken(Rule::line_alignment, "a lock line at 64 is an error, though the hardware drops the low 7 bits",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spu.getllar(line, to_ea(stage.from + 16));
           },
           {"getllar 128 bytes"}),
    broken(Rule::line_alignment, "so is one to local store at 16",
           [](Spu& spu, Stage& stage) {
             auto* line = spu.allocate<std::uint32_t>(64);
             stage.next_line();
             spu.putlluc(line + 4, to_ea(stage.to));
           },
           {"putlluc 128 bytes"}),
    fact("on demand the low 7 bits of a lock line's addresses are dropped",
         [](Spu& spu, Stage& stage) {
           auto* line = spu.allocate<std::uint32_t>(64);
           spu.getllar(line + 4, to_ea(stage.from + 33));
           stage.is(line[0], 33);
           stage.is(line[32], 0);
           line[0] = 0x99;
           stage.is(spu.putllc(line, to_ea(stage.from + 40)), true);
           stage.is(stage.from[32], 0x99);
         })
        .configured(
            [](MachineConfig& config) { config.emulation.actions[Rule::line_alignment] = Action::ignore; }),
    broken(Rule::line_alignment, "sdcrz zeroes whole lines only",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spell(spu, 0x89, 0, to_ea(stage.from + 16), 128, 0);
           }),
    kept(Rule::line_in_memory, "a lock line may lie in a local store",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(64);
           lines[5] = 55;
           const ea_t first = spu.addresses(spu.id()).local_store + lsa_of(spu, lines);
           spu.getllar(lines + 32, first);
           stage.is(lines[32 + 5], 55);
         }),
    broken(Rule::line_in_memory, "it does not lie in problem state",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             const ea_t registers = spu.addresses(0).signal_1 & ~ea_t{127};
             stage.next_line();
             spu.getllar(line, registers);
           }),
    fact("a command that is not stopped for its operands is not carried out",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           spu.get(line, to_ea(stage.from), 20, 1);
           spu.get(line, to_ea(stage.from), 128, 33);
           spu.get(&stage, to_ea(stage.from), 128, 1);
           spu.get(line, 0, 128, 1);
           stage.is(spu.wait_all(1u << 1), 1u << 1);
           stage.is(line[0], 0);
         })
        .configured([](MachineConfig& config) {
          for (const Rule rule :
               {Rule::transfer_size, Rule::tag_range, Rule::in_local_store, Rule::mapped_address})
            config.emulation.actions[rule] = Action::ignore;
        }),
};

TEST_CASE("conformance: transfers") {
  run_rows(kTransfers);
}

TEST_CASE("conformance: registers and lock lines as targets") {
  run_rows(kRegisters);
}

} // namespace
} // namespace celltrace::test

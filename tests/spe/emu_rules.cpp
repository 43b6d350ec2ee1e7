// The rules of the MFC as pure functions: every rule kept and broken.
#include "backends/cell_emu/mfc_rules.hpp"

#include <catch2/catch.hpp>

namespace celltrace::cell_emu {
namespace {

constexpr ea_t kMemory = 0x7F0000000000;

struct Case {
  const char* what;
  MfcCommand command; // opcode, tag, lsa, size, ea
  EaKind target;
  Rule rule;
};

constexpr MfcOpcode kGet = MfcOpcode::get;
constexpr MfcOpcode kPut = MfcOpcode::put;
constexpr MfcOpcode kSignal = MfcOpcode::sndsig;

const Case kTransfers[] = {
    {"one line", {kGet, 0, 0x18000, 128, kMemory}, EaKind::main_memory, Rule::none},
    {"nothing", {kGet, 0, 0x18001, 0, kMemory}, EaKind::main_memory, Rule::none},
    {"1 byte", {kPut, 0, 0x18003, 1, kMemory + 3}, EaKind::main_memory, Rule::none},
    {"2 bytes", {kPut, 0, 0x18002, 2, kMemory + 2}, EaKind::main_memory, Rule::none},
    {"4 bytes", {kPut, 0, 0x18004, 4, kMemory + 4}, EaKind::main_memory, Rule::none},
    {"8 bytes", {kPut, 0, 0x18008, 8, kMemory + 8}, EaKind::main_memory, Rule::none},
    {"16 KB", {kGet, 0, 0x3C000, 16384, kMemory}, EaKind::main_memory, Rule::none},
    {"3 bytes", {kGet, 0, 0x18000, 3, kMemory}, EaKind::main_memory, Rule::transfer_size},
    {"17 bytes", {kGet, 0, 0x18000, 17, kMemory}, EaKind::main_memory, Rule::transfer_size},
    {"20 bytes", {kGet, 0, 0x18000, 20, kMemory}, EaKind::main_memory, Rule::transfer_size},
    {"16 KB and 16", {kGet, 0, 0x18000, 16400, kMemory}, EaKind::main_memory, Rule::transfer_size},
    {"other low bits", {kGet, 0, 0x18000, 4, kMemory + 4}, EaKind::main_memory, Rule::same_low_bits},
    {"quadword, other low bits",
     {kGet, 0, 0x18000, 16, kMemory + 8},
     EaKind::main_memory,
     Rule::same_low_bits},
    {"2 bytes at 1", {kGet, 0, 0x18001, 2, kMemory + 1}, EaKind::main_memory, Rule::natural_alignment},
    {"4 bytes at 2", {kGet, 0, 0x18002, 4, kMemory + 2}, EaKind::main_memory, Rule::natural_alignment},
    {"8 bytes at 4", {kGet, 0, 0x18004, 8, kMemory + 4}, EaKind::main_memory, Rule::natural_alignment},
    {"16 bytes at 8", {kGet, 0, 0x18008, 16, kMemory + 8}, EaKind::main_memory, Rule::quadword_alignment},
    {"stack pointer", {kGet, 0, kOutsideLocalStore, 16, kMemory}, EaKind::main_memory, Rule::in_local_store},
    {"LS past the end", {kGet, 0, 0x40000, 16, kMemory}, EaKind::main_memory, Rule::in_local_store},
    {"last quadword", {kGet, 0, 0x3FFF0, 16, kMemory}, EaKind::main_memory, Rule::none},
    {"over the end", {kGet, 0, 0x3FFF0, 32, kMemory}, EaKind::main_memory, Rule::local_store_end},
    {"other local store", {kPut, 0, 0x18000, 128, kMemory}, EaKind::local_store, Rule::none},
    {"null", {kGet, 0, 0x18000, 128, 0}, EaKind::unmapped, Rule::mapped_address},

    {"mailbox", {kPut, 0, 0x1800C, 4, kMemory + 12}, EaKind::in_mailbox, Rule::none},
    {"mailbox read", {kGet, 0, 0x1800C, 4, kMemory + 12}, EaKind::in_mailbox, Rule::register_readable},
    {"mailbox, first word", {kPut, 0, 0x18000, 4, kMemory + 12}, EaKind::in_mailbox, Rule::register_word},
    {"mailbox, second word", {kPut, 0, 0x18004, 4, kMemory + 12}, EaKind::in_mailbox, Rule::register_word},
    {"mailbox, third word", {kPut, 0, 0x18008, 4, kMemory + 12}, EaKind::in_mailbox, Rule::register_word},
    {"mailbox, quadword", {kPut, 0, 0x18000, 16, kMemory + 12}, EaKind::in_mailbox, Rule::register_size},
    {"mailbox, byte", {kPut, 0, 0x1800C, 1, kMemory + 12}, EaKind::in_mailbox, Rule::register_size},
    {"signal by put", {kPut, 0, 0x1800C, 4, kMemory + 12}, EaKind::signal_2, Rule::none},
    {"signal by get", {kGet, 0, 0x1800C, 4, kMemory + 12}, EaKind::signal_1, Rule::none},
    {"no register", {kPut, 0, 0x18000, 4, kMemory}, EaKind::no_register, Rule::register_exists},

    {"signal", {kSignal, 31, 0x1800C, 4, kMemory + 12}, EaKind::signal_1, Rule::none},
    {"signal, first word", {kSignal, 31, 0x18000, 4, kMemory + 12}, EaKind::signal_1, Rule::register_word},
    {"signal, second word", {kSignal, 31, 0x18004, 4, kMemory + 12}, EaKind::signal_1, Rule::register_word},
    {"signal, third word", {kSignal, 31, 0x18008, 4, kMemory + 12}, EaKind::signal_2, Rule::register_word},
    {"signal, 8 bytes", {kSignal, 31, 0x18008, 8, kMemory + 12}, EaKind::signal_1, Rule::signal_size},
    {"signal to mailbox", {kSignal, 31, 0x1800C, 4, kMemory + 12}, EaKind::in_mailbox, Rule::signal_target},
    {"signal to memory", {kSignal, 31, 0x1800C, 4, kMemory + 12}, EaKind::main_memory, Rule::signal_target},
};

TEST_CASE("the rules of transfers") {
  for (const Case& c : kTransfers) {
    CAPTURE(c.what, describe(c.command));
    CHECK(std::string(text_of(broken_transfer_rule(c.command, c.target))) == text_of(c.rule));
  }
}

TEST_CASE("fenced and barriered forms obey the same rules") {
  for (Case c : kTransfers) {
    CAPTURE(c.what);
    for (const std::uint32_t suffix : {1u, 2u}) {
      c.command.opcode =
          static_cast<MfcOpcode>((static_cast<std::uint32_t>(c.command.opcode) & ~3u) | suffix);
      CHECK(broken_transfer_rule(c.command, c.target) == c.rule);
    }
  }
}

constexpr MfcOpcode kGetl = MfcOpcode::getl;
constexpr MfcOpcode kPutlb = MfcOpcode::putlb;

const Case kLists[] = {
    {"two elements", {kGetl, 0, 0x18000, 16, kMemory + 0x1000}, EaKind::main_memory, Rule::none},
    {"no element", {kGetl, 0, 0x18000, 0, kMemory + 0x1000}, EaKind::main_memory, Rule::none},
    {"2048 elements", {kPutlb, 0, 0x18000, 16384, kMemory + 0x1000}, EaKind::main_memory, Rule::none},
    {"2049 elements", {kPutlb, 0, 0x18000, 16392, kMemory + 0x1000}, EaKind::main_memory, Rule::list_length},
    {"half an element", {kGetl, 0, 0x18000, 12, kMemory + 0x1000}, EaKind::main_memory, Rule::list_length},
    {"list at 4", {kGetl, 0, 0x18000, 16, kMemory + 0x1004}, EaKind::main_memory, Rule::list_alignment},
    {"list outside",
     {kGetl, 0, 0x18000, 16, kMemory + 0x40000},
     EaKind::main_memory,
     Rule::list_in_local_store},
    {"list on the stack",
     {kGetl, 0, 0x18000, 16, 0x7F00FFFFFFFF},
     EaKind::main_memory,
     Rule::list_in_local_store},
    {"list over the end", {kGetl, 0, 0x18000, 16, kMemory + 0x3FFF8}, EaKind::main_memory, Rule::list_end},
    {"list up to the end", {kGetl, 0, 0x18000, 8, kMemory + 0x3FFF8}, EaKind::main_memory, Rule::none},
    {"data outside", {kGetl, 0, 0x40000, 16, kMemory + 0x1000}, EaKind::main_memory, Rule::in_local_store},
};

TEST_CASE("the rules of lists") {
  for (const Case& c : kLists) {
    CAPTURE(c.what);
    CHECK(std::string(text_of(broken_list_rule(c.command))) == text_of(c.rule));
  }
}

TEST_CASE("the rules of list elements") {
  const MfcCommand list{kPutlb, 7, 0x18000, 16, 0x7F0000001000};
  const auto rule = [&](std::uint32_t size, std::uint32_t ea_low, std::uint32_t quadword = 0x18000) {
    return broken_element_rule(element_command(list, ListElement::make(size, ea_low), quadword),
                               EaKind::main_memory);
  };
  CHECK(rule(16, 0x20) == Rule::none);
  CHECK(rule(0, 0x21) == Rule::none);
  CHECK(rule(4, 0x2C) == Rule::none);
  CHECK(rule(16384, 0x20) == Rule::none);
  CHECK(rule(16400, 0x20) == Rule::transfer_size);
  CHECK(rule(20, 0x20) == Rule::transfer_size);
  CHECK(rule(16, 0x28) == Rule::quadword_alignment);
  CHECK(rule(4, 0x22) == Rule::natural_alignment);
  CHECK(rule(32, 0x20, 0x3FFF0) == Rule::local_store_end);
  CHECK(rule(16, 0x20, 0x40000) == Rule::in_local_store);
  CHECK(rule(16, 0xFFFFFFF0) == Rule::none);
  CHECK(rule(32, 0xFFFFFFF0) == Rule::element_region);

  // Of the first word the notify bit and the reserved bits do not count.
  const MfcCommand part = element_command(list, {0xFFFF8010, 0x2C}, 0x18000);
  CHECK(part.opcode == MfcOpcode::put);
  CHECK(part.size == 16);
  CHECK(part.lsa == 0x1800C);
  CHECK(part.ea == 0x7F000000002C);
  CHECK(part.tag == 7);
}

const Case kLockLines[] = {
    {"getllar", {MfcOpcode::getllar, 0, 0x18080, 128, kMemory}, EaKind::main_memory, Rule::none},
    {"putllc", {MfcOpcode::putllc, 0, 0x18080, 128, kMemory}, EaKind::local_store, Rule::none},
    {"LS alignment",
     {MfcOpcode::putlluc, 0, 0x18040, 128, kMemory},
     EaKind::main_memory,
     Rule::line_alignment},
    {"EA alignment",
     {MfcOpcode::putqlluc, 0, 0x18080, 128, kMemory + 16},
     EaKind::main_memory,
     Rule::line_alignment},
    {"outside",
     {MfcOpcode::getllar, 0, kOutsideLocalStore, 128, kMemory},
     EaKind::main_memory,
     Rule::in_local_store},
    {"null", {MfcOpcode::getllar, 0, 0x18080, 128, 0}, EaKind::unmapped, Rule::mapped_address},
    {"registers", {MfcOpcode::getllar, 0, 0x18080, 128, kMemory}, EaKind::no_register, Rule::line_in_memory},
};

TEST_CASE("the rules of lock-line commands") {
  for (const Case& c : kLockLines) {
    CAPTURE(c.what);
    CHECK(std::string(text_of(broken_lock_line_rule(c.command, c.target))) == text_of(c.rule));
  }
}

TEST_CASE("the rules of all commands") {
  const auto rule = [](std::uint32_t opcode, std::uint32_t tag) {
    return broken_common_rule({static_cast<MfcOpcode>(opcode), tag, 0x18000, 16, kMemory});
  };
  CHECK(rule(0x40, 0) == Rule::none);
  CHECK(rule(0x40, 31) == Rule::none);
  CHECK(rule(0x40, 32) == Rule::tag_range);
  CHECK(rule(0xC0, 32) == Rule::tag_range);
  CHECK(rule(0xA2, 31) == Rule::none);
  for (const std::uint32_t opcode : {0x00u, 0x23u, 0x43u, 0x47u, 0x48u, 0xA4u, 0xC1u, 0xD1u, 0xFFu})
    CHECK(rule(opcode, 0) == Rule::known_command);
}

TEST_CASE("a command is described by its operands") {
  CHECK(describe({kGet, 5, 0x18010, 20, 0x7F0010}) == "get 20 bytes, LS 0x18010 <- EA 0x7f0010, tag 5");
  CHECK(describe({kPut, 5, kOutsideLocalStore, 20, 0x10}) == "put 20 bytes, LS outside -> EA 0x10, tag 5");
  CHECK(describe({MfcOpcode::getllar, 0, 0x80, 128, 0x100}) ==
        "getllar 128 bytes, LS 0x80 <- EA 0x100, tag 0");
  CHECK(describe({MfcOpcode::mfcsync, 3, 0, 0, 0}) == "mfcsync, tag 3");
  CHECK(describe({MfcOpcode::putlf, 3, 0x20, 24, 0x7F00001000}) ==
        "putlf of 24 bytes of list at LS 0x1000, LS 0x20 -> EA 0x7f........, tag 3");
  CHECK(describe({static_cast<MfcOpcode>(0x99), 3, 0, 0, 0}) == "command 0x99");
}

} // namespace
} // namespace celltrace::cell_emu

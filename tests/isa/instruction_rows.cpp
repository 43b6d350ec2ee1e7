#include "isa/instruction_rows.hpp"

#include "isa/machines.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>

namespace celltrace::test {

namespace {

constexpr unsigned kRt = 3, kRa = 4, kRb = 5, kRc = 6;

const isa::OpcodeInfo& opcode_of(std::string_view mnemonic) {
  const auto all = isa::opcodes();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& info) { return mnemonic == info.mnemonic; });
  INFO(mnemonic);
  REQUIRE(found != all.end());
  return *found;
}

std::uint32_t encode(const Row& row) {
  const isa::OpcodeInfo& info = opcode_of(row.op);
  const auto immediate = static_cast<std::uint32_t>(row.immediate);
  const bool has_ra = (info.operands & isa::operand::reads_ra) != 0;
  const bool has_rb = (info.operands & isa::operand::reads_rb) != 0;
  const bool has_rt = (info.operands & (isa::operand::reads_rt | isa::operand::writes_rt)) != 0;
  const std::uint32_t rt = has_rt ? kRt : 0, ra = (has_ra ? kRa : row.channel) << 7;
  const std::uint32_t rb = (has_rb ? kRb : row.feature) << 14;
  const std::uint32_t code = info.code;
  switch (info.format) {
  case isa::Format::rr:
    return code << 21 | rb | ra | rt | (immediate & 0x3FFF);
  case isa::Format::rrr:
    return code << 28 | kRt << 21 | kRb << 14 | kRa << 7 | kRc;
  case isa::Format::ri7:
    return code << 21 | (immediate & 0x7F) << 14 | ra | rt;
  case isa::Format::ri8:
    return code << 22 | (immediate & 0xFF) << 14 | ra | rt;
  case isa::Format::ri10:
    return code << 24 | (immediate & 0x3FF) << 14 | ra | rt;
  case isa::Format::ri16:
    return code << 23 | (immediate & 0xFFFF) << 7 | rt;
  case isa::Format::ri18:
    return code << 25 | (immediate & 0x3FFFF) << 7 | rt;
  }
  return 0;
}

void set_up(Machine& machine, const Row& row) {
  for (unsigned i = 0; i < 128; ++i)
    machine.set_gpr(i, Register::of_preferred(0xABC00000 + i));
  machine.set_gpr(kRt, register_of(row.rt));
  machine.set_gpr(kRa, register_of(row.ra));
  machine.set_gpr(kRb, register_of(row.rb));
  machine.set_gpr(kRc, register_of(row.rc));
  machine.set_fpscr(register_of(row.fpscr));
  machine.answers() = row.answers;
  std::fill_n(machine.local_store(), kLocalStoreSize, std::uint8_t{0x5A});
  const Register held = register_of(row.holds);
  std::copy(held.bytes.begin(), held.bytes.end(), machine.local_store() + row.at);
}

bool other_bytes_are_untouched(std::uint8_t* local_store, std::uint32_t at) {
  const auto untouched = [](std::uint8_t byte) { return byte == 0x5A; };
  return std::all_of(local_store, local_store + at, untouched) &&
         std::all_of(local_store + at + 16, local_store + kLocalStoreSize, untouched);
}

void check_row(Machine& machine, const Row& row, std::uint32_t word) {
  set_up(machine, row);
  const auto before = [&](unsigned number) { return text_of(machine.gpr(number)); };
  INFO(machine.name() << ": " << isa::disassemble(word, row.pc) << "\n  rt " << before(kRt) << "\n  ra "
                      << before(kRa) << "\n  rb " << before(kRb) << "\n  rc " << before(kRc));
  machine.execute(row.pc, word);

  CHECK(text_of(machine.gpr(kRt)) == text_of(register_of(row.gives != nullptr ? row.gives : row.rt)));
  for (unsigned i = 0; i < 128; ++i)
    if (i < kRt || i > kRc) CHECK(machine.gpr(i) == Register::of_preferred(0xABC00000 + i));
  CHECK(machine.gpr(kRa) == register_of(row.ra));
  CHECK(machine.gpr(kRb) == register_of(row.rb));
  CHECK(machine.gpr(kRc) == register_of(row.rc));
  const Register fpscr = register_of(row.fpscr_after != nullptr ? row.fpscr_after : row.fpscr);
  CHECK(text_of(machine.fpscr()) == text_of(fpscr));

  Register quadword;
  std::copy_n(machine.local_store() + row.at, 16, quadword.bytes.begin());
  CHECK(text_of(quadword) == text_of(register_of(row.stores != nullptr ? row.stores : row.holds)));
  CHECK(other_bytes_are_untouched(machine.local_store(), row.at));
  CHECK(machine.next() == row.next);
  CHECK(machine.effects() == row.effects);
}

} // namespace

Register register_of(std::string_view text) {
  std::string digits;
  std::copy_if(text.begin(), text.end(), std::back_inserter(digits),
               [](unsigned char c) { return std::isxdigit(c) != 0; });
  INFO(text);
  REQUIRE((digits.size() >= 2 && 32 % digits.size() == 0));
  Register result;
  for (std::size_t i = 0; i < 16; ++i)
    result.bytes[i] =
        static_cast<std::uint8_t>(std::stoul(digits.substr(2 * i % digits.size(), 2), nullptr, 16));
  return result;
}

std::string text_of(const Register& value) {
  char text[36];
  std::snprintf(text, sizeof text, "%08x %08x %08x %08x", value.word(0), value.word(1), value.word(2),
                value.word(3));
  return text;
}

void check(std::span<const Row> rows) {
  // Neither is small enough for the stack of every host.
  const auto interpreter = std::make_unique<InterpreterMachine>();
  const auto reference = std::make_unique<ReferenceMachine>();
  for (const Row& row : rows) {
    const std::uint32_t word = encode(row);
    check_row(*interpreter, row, word);
    check_row(*reference, row, word);
  }
}

} // namespace celltrace::test

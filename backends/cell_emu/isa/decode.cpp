// The table of opcodes, and the decoding of instructions.
#include "backends/cell_emu/isa/execute.hpp"

#include <array>

namespace celltrace::isa {
namespace {

/// Values of the last column of opcodes.def.
namespace operand_set {
using namespace operand;
constexpr std::uint8_t none = 0, a = reads_ra, ab = reads_ra | reads_rb, r = reads_rt,
                       ra = reads_rt | reads_ra, rab = reads_rt | reads_ra | reads_rb, w = writes_rt,
                       wr = writes_rt | reads_rt, wa = writes_rt | reads_ra,
                       wab = writes_rt | reads_ra | reads_rb, wabr = wab | reads_rt, wabc = wab | reads_rc;
} // namespace operand_set

constexpr OpcodeInfo kOpcodes[] = {
#define SPU_OPCODE(name, mnemonic, format, code, unit, syntax, operands)                                     \
  {mnemonic,   Opcode::name,   Format::format,        code,                                                  \
   Unit::unit, Syntax::syntax, operand_set::operands, execute::name},
#include "celltrace/spe/opcodes.def"
#undef SPU_OPCODE
};

constexpr unsigned opcode_bits(Format format) {
  switch (format) {
  case Format::rr:
  case Format::ri7:
    return 11;
  case Format::ri8:
    return 10;
  case Format::ri16:
    return 9;
  case Format::ri10:
    return 8;
  case Format::ri18:
    return 7;
  case Format::rrr:
    return 4;
  }
  return 0;
}

// Number of high bits by which find_opcode() looks up opcodes: no opcode has more bits.
constexpr unsigned kPrimaryBits = 11;
constexpr std::uint8_t kNone = 0xFF;
static_assert(std::size(kOpcodes) < kNone);

constexpr std::array<std::uint8_t, 1 << kPrimaryBits> make_lookup() {
  std::array<std::uint8_t, 1 << kPrimaryBits> lookup{};
  lookup.fill(kNone);
  for (std::size_t i = 0; i < std::size(kOpcodes); ++i) {
    const unsigned free_bits = kPrimaryBits - opcode_bits(kOpcodes[i].format);
    const unsigned first = static_cast<unsigned>(kOpcodes[i].code) << free_bits;
    for (unsigned primary = first; primary < first + (1u << free_bits); ++primary)
      lookup[primary] = static_cast<std::uint8_t>(i);
  }
  return lookup;
}
constexpr auto kLookup = make_lookup();

constexpr std::uint32_t field(std::uint32_t word, unsigned low, unsigned bits) {
  return word >> low & ((1u << bits) - 1);
}
constexpr std::int32_t signed_field(std::uint32_t word, unsigned low, unsigned bits) {
  const std::uint32_t sign = 1u << (bits - 1);
  return static_cast<std::int32_t>((field(word, low, bits) ^ sign) - sign);
}
constexpr std::uint8_t register_at(std::uint32_t word, unsigned low) {
  return static_cast<std::uint8_t>(field(word, low, 7));
}

/// Returns the offset of a hint's branch, which is in two pieces: its low seven bits are at the place of rt,
/// its upper two bits at `high_piece`.
std::int32_t hinted_offset(std::uint32_t word, unsigned high_piece) {
  return signed_field(field(word, high_piece, 2) << 7 | field(word, 0, 7), 0, 9) * 4;
}
constexpr unsigned kHintRegisterPiece = 14, kHintImmediatePiece = 23;

std::int32_t immediate_of(std::uint32_t word, Syntax syntax) {
  switch (syntax) {
  case Syntax::rt_ra_i7:
  case Syntax::rt_i7_ra:
    return signed_field(word, 14, 7);
  case Syntax::rt_ra_i10:
    return signed_field(word, 14, 10);
  case Syntax::rt_displacement:
    return signed_field(word, 14, 10) * 16;
  case Syntax::rt_ra_scale_173:
    return 173 - static_cast<std::int32_t>(field(word, 14, 8));
  case Syntax::rt_ra_scale_155:
    return 155 - static_cast<std::int32_t>(field(word, 14, 8));
  case Syntax::rt_i16:
    return signed_field(word, 7, 16);
  case Syntax::rt_u16:
    return static_cast<std::int32_t>(field(word, 7, 16));
  case Syntax::rt_u18:
    return static_cast<std::int32_t>(field(word, 7, 18));
  case Syntax::relative:
  case Syntax::rt_relative:
  case Syntax::hint_relative:
    return signed_field(word, 7, 16) * 4;
  case Syntax::absolute:
  case Syntax::rt_absolute:
  case Syntax::hint_absolute:
    return static_cast<std::int32_t>(field(word, 7, 16) * 4);
  case Syntax::hint_register:
    return hinted_offset(word, kHintRegisterPiece);
  case Syntax::stop:
    return static_cast<std::int32_t>(field(word, 0, 14));
  default:
    return 0;
  }
}

void take_registers(Instruction& i, Format format) {
  const std::uint32_t word = i.word;
  i.rt = register_at(word, 0);
  switch (format) {
  case Format::rrr:
    i.rt = register_at(word, 21);
    i.rc = register_at(word, 0);
    [[fallthrough]];
  case Format::rr:
    i.rb = register_at(word, 14);
    [[fallthrough]];
  case Format::ri7:
  case Format::ri8:
  case Format::ri10:
    i.ra = register_at(word, 7);
    break;
  case Format::ri16:
  case Format::ri18:
    break;
  }
}

void take_operands(Instruction& i, std::uint8_t operands) {
  unsigned count = 0;
  if ((operands & operand::reads_ra) != 0) i.source[count++] = i.ra;
  if ((operands & operand::reads_rb) != 0) i.source[count++] = i.rb;
  if ((operands & operand::reads_rc) != 0) i.source[count++] = i.rc;
  if ((operands & operand::reads_rt) != 0) i.source[count++] = i.rt;
  if ((operands & operand::writes_rt) != 0) i.target = i.rt;
}

} // namespace

std::span<const OpcodeInfo> opcodes() {
  return kOpcodes;
}

const OpcodeInfo* find_opcode(std::uint32_t word) {
  const std::uint8_t index = kLookup[word >> (32 - kPrimaryBits)];
  return index == kNone ? nullptr : &kOpcodes[index];
}

Instruction decode(std::uint32_t word) {
  Instruction i{};
  i.execute = execute::invalid;
  i.word = word;
  i.source[0] = i.source[1] = i.source[2] = i.target = kNoRegister;
  i.opcode = Opcode::stop;
  i.unit = Unit::br;
  const OpcodeInfo* info = find_opcode(word);
  if (info == nullptr) return i;
  i.execute = info->execute;
  i.immediate = immediate_of(word, info->syntax);
  i.opcode = info->opcode;
  i.unit = info->unit;
  take_registers(i, info->format);
  take_operands(i, info->operands);
  return i;
}

std::uint32_t hinted_branch(const Instruction& hint, std::uint32_t pc) {
  const unsigned piece = hint.opcode == Opcode::hbr ? kHintRegisterPiece : kHintImmediatePiece;
  return (pc + static_cast<std::uint32_t>(hinted_offset(hint.word, piece))) & kLocalStoreLimit;
}

} // namespace celltrace::isa

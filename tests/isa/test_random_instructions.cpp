// Random instructions on random operands, on the interpreter and on the reference.
#include "isa/fields.hpp"
#include "isa/instruction_rows.hpp"
#include "isa/machines.hpp"

#include "backends/cell_emu/seeded_random.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Random = cell_emu::SeededRandom;

std::uint64_t setting(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 0) : otherwise;
}

/// What random bits hardly ever are.
class Operands {
public:
  explicit Operands(Random& random) : random_(random) {}

  Register next() {
    switch (random_.below(8)) {
    case 0:
      return last_ = words([&] { return random_.next(); });
    case 1:
      return last_ = words([&] { return integer(); });
    case 2:
      return last_ = words([&] { return random_.once_in(2) ? edge(kSingleEdges, 31) : single(); });
    case 3:
      return last_ = doublewords([&] { return random_.once_in(2) ? edge(kDoubleEdges, 63) : special(); });
    case 4:
      return last_ = words([&] { return single(); });
    case 5:
      return last_ = doublewords([&] { return double_precision(); });
    case 6:
      return last_ = bytes();
    default:
      return last_ = neighbour(last_);
    }
  }

private:
  static constexpr std::uint64_t kSingleEdges[] = {
      0x00000000, 0x00000001, 0x007FFFFF, 0x00800000, 0x00800001, 0x01000000, 0x3F000000, 0x3F7FFFFF,
      0x3F800000, 0x3F800001, 0x3FFFFFFF, 0x40000000, 0x4EFFFFFF, 0x4F000000, 0x4F7FFFFF, 0x4F800000,
      0x5F800000, 0x7F000000, 0x7F7FFFFF, 0x7F800000, 0x7F800001, 0x7FC00000, 0x7FFFFFFE, 0x7FFFFFFF};
  static constexpr std::uint64_t kDoubleEdges[] = {
      0x0000000000000000, 0x0000000000000001, 0x000FFFFFFFFFFFFF, 0x0010000000000000, 0x0010000000000001,
      0x0020000000000000, 0x1FF0000000000000, 0x36A0000000000000, 0x380FFFFFF0000000, 0x3810000000000000,
      0x3CA0000000000000, 0x3FEFFFFFFFFFFFFF, 0x3FF0000000000000, 0x3FF0000000000001, 0x3FF0000010000000,
      0x3FFFFFFFFFFFFFFF, 0x47EFFFFFEFFFFFFF, 0x47EFFFFFF0000000, 0x47F0000000000000, 0x5FE0000000000000,
      0x7FE0000000000000, 0x7FEFFFFFFFFFFFFF, 0x7FF0000000000000, 0x7FF0000000000001, 0x7FF8000000000000};

  template <class F> Register words(F f) {
    return for_parts(4, [&](unsigned) { return f(); });
  }
  template <class F> Register doublewords(F f) {
    return for_parts(8, [&](unsigned) { return f(); });
  }
  template <std::size_t Size> std::uint64_t edge(const std::uint64_t (&edges)[Size], unsigned sign) {
    return edges[random_.below(Size)] | random_.below(2) << sign;
  }
  /// Runs of ones and zeros: what carries, and what rounding decides by.
  std::uint64_t fraction(unsigned bits) {
    std::uint64_t value = random_.next() >> (64 - bits);
    const std::uint64_t lower = (std::uint64_t{1} << random_.below(bits + 1)) - 1;
    switch (random_.below(5)) {
    case 0:
      return 0;
    case 1:
      return value;
    case 2:
      return value & ~lower;
    case 3:
      return value | lower;
    default:
      return (std::uint64_t{1} << random_.below(bits)) & ((std::uint64_t{1} << bits) - 1);
    }
  }
  /// An exponent near that of one, near where products leave the range, near both ends.
  std::uint64_t exponent(unsigned bits) {
    const std::uint64_t highest = (1u << bits) - 1, bias = highest / 2;
    const std::uint64_t from[] = {bias - 4, bias - 4,   bias - 30, bias / 2 - 4, bias + bias / 2 - 4,
                                  0,        highest - 7};
    return from[random_.below(std::size(from))] + random_.below(8);
  }
  std::uint64_t single() { return random_.below(2) << 31 | exponent(8) << 23 | fraction(23); }
  std::uint64_t double_precision() { return random_.below(2) << 63 | exponent(11) << 52 | fraction(52); }
  /// What the rules of IEEE for infinities, NaN and zeros tell apart.
  std::uint64_t special() {
    constexpr std::uint64_t kSpecial[] = {0, 0x3FF0000000000000, 0x7FF0000000000000, 0x7FF8000000000001};
    return edge(kSpecial, 63);
  }
  std::uint64_t integer() {
    switch (random_.below(4)) {
    case 0:
      return random_.below(64) - 32;
    case 1: // an address
      return random_.below(kLocalStoreSize);
    case 2:
      return (std::uint64_t{1} << random_.below(32)) - random_.below(2);
    default:
      return random_.next() >> (32 + random_.below(32));
    }
  }
  Register bytes() {
    constexpr std::uint8_t kEdges[] = {0x00, 0x01, 0x7F, 0x80, 0xFF, 0xC0, 0xE0, 0x1F};
    return for_parts(1, [&](unsigned) { return kEdges[random_.below(std::size(kEdges))]; });
  }
  /// The same, or its parts a little apart from it, or of the other sign.
  Register neighbour(Register value) {
    const unsigned size = random_.once_in(2) ? 4 : 8;
    if (random_.once_in(4)) return value;
    return for_parts(size, [&](unsigned i) {
      const std::uint64_t part = value.part(size, i);
      switch (random_.below(4)) {
      case 0:
        return part;
      case 1:
        return part + random_.below(5) - 2;
      case 2:
        return part ^ std::uint64_t{1} << (8 * size - 1);
      default:
        return part ^ std::uint64_t{1} << random_.below(8 * size);
      }
    });
  }

  Random& random_;
  Register last_;
};

unsigned opcode_bits(isa::Format format) {
  switch (format) {
  case isa::Format::rrr:
    return 4;
  case isa::Format::ri18:
    return 7;
  case isa::Format::ri10:
    return 8;
  case isa::Format::ri16:
    return 9;
  case isa::Format::ri8:
    return 10;
  case isa::Format::rr:
  case isa::Format::ri7:
    return 11;
  }
  return 11;
}

/// Of a valid opcode, and without what the ISA leaves undefined.
std::uint32_t random_word(Random& random) {
  const auto all = isa::opcodes();
  const isa::OpcodeInfo& info = all[random.below(all.size())];
  const unsigned below = 32 - opcode_bits(info.format);
  std::uint32_t word = static_cast<std::uint32_t>(info.code) << below |
                       (static_cast<std::uint32_t>(random.next()) & ((1u << below) - 1));
  const auto set_field = [&](unsigned place, std::uint32_t mask, std::uint64_t value) {
    word = (word & ~(mask << place)) | static_cast<std::uint32_t>(value) << place;
  };
  if (info.format == isa::Format::ri8) { // scales of 0 to 127
    const bool from_integer = (info.code & 2) != 0;
    set_field(14, 0xFF, (from_integer ? 28 : 46) + random.below(128));
  }
  // Few registers, so that they are often the same.
  if (info.unit != isa::Unit::spr && random.once_in(4)) set_field(7, 0x7F, rt_of(word));
  const bool has_rb = (info.operands & isa::operand::reads_rb) != 0;
  if (has_rb && random.once_in(4)) set_field(14, 0x7F, ra_of(word));
  // Interrupts disabled and enabled at once are reserved.
  if (!has_rb && info.unit == isa::Unit::br && (word >> 18 & 3) == 3) set_field(18, 3, random.below(3));
  return word;
}

class Comparison {
public:
  explicit Comparison(std::uint64_t seed)
      : random_(seed, 0), operands_(random_), interpreter_(std::make_unique<InterpreterMachine>()),
        reference_(std::make_unique<ReferenceMachine>()) {
    for (unsigned i = 0; i < 128; ++i)
      set_gpr(i, operands_.next());
    for (std::size_t i = 0; i < kLocalStoreSize; ++i)
      reference_->local_store()[i] = static_cast<std::uint8_t>(random_.next());
    std::memcpy(interpreter_->local_store(), reference_->local_store(), kLocalStoreSize);
  }

  /// Empty: both did the same.
  std::string step() {
    const std::uint32_t word = random_word(random_);
    const std::uint32_t pc = static_cast<std::uint32_t>(random_.below(kLocalStoreSize)) & ~3u;
    set_operands(word);
    std::copy(std::begin(reference_->reference.gpr), std::end(reference_->reference.gpr),
              std::begin(before_));
    fpscr_before_ = reference_->fpscr();
    interpreter_->execute(pc, word);
    reference_->execute(pc, word);
    std::string difference = differences();
    if (!difference.empty()) {
      difference = description(pc, word) + difference;
      align();
    }
    return difference;
  }

  bool local_stores_agree() {
    return std::memcmp(interpreter_->local_store(), reference_->local_store(), kLocalStoreSize) == 0;
  }

private:
  void set_gpr(unsigned number, const Register& value) {
    interpreter_->set_gpr(number, value);
    reference_->set_gpr(number, value);
  }

  /// Anew, but sometimes what instructions before have left.
  void set_operands(std::uint32_t word) {
    for (const unsigned number : {rt_of(word), ra_of(word), rb_of(word)})
      if (!random_.once_in(4)) set_gpr(number, operands_.next());
    Answers answers;
    answers.channel_value = static_cast<std::uint32_t>(random_.next());
    answers.channel_count = static_cast<std::uint32_t>(random_.below(17));
    answers.srr0 = static_cast<std::uint32_t>(random_.next());
    answers.event = random_.once_in(2);
    interpreter_->answers() = reference_->answers() = answers;
    if (!random_.once_in(8)) return;
    const Register fpscr = for_parts(4, [&](unsigned i) { return random_.next() & kDefinedFpscr[i]; });
    interpreter_->set_fpscr(fpscr);
    reference_->set_fpscr(fpscr);
  }

  std::string differences() const {
    const Reference& expected = reference_->reference;
    std::ostringstream text;
    text << std::hex;
    for (unsigned i = 0; i < 128; ++i)
      if (!(interpreter_->state.gpr[i] == isa::Quadword::load(expected.gpr[i].bytes.data())))
        text << "  $" << std::dec << i << std::hex << " is " << text_of(interpreter_->gpr(i))
             << "\n  reference " << text_of(expected.gpr[i]) << '\n';
    if (interpreter_->next() != expected.next)
      text << "  next is " << interpreter_->next() << ", reference " << expected.next << '\n';
    if (interpreter_->effects() != expected.effects) text << "  effects differ\n";
    if (!(interpreter_->fpscr() == expected.fpscr))
      text << "  fpscr is " << text_of(interpreter_->fpscr()) << "\n  reference " << text_of(expected.fpscr)
           << '\n';
    if (expected.stored && std::memcmp(interpreter_->local_store() + *expected.stored,
                                       expected.local_store.data() + *expected.stored, 16) != 0)
      text << "  local store differs at " << *expected.stored << '\n';
    return text.str();
  }

  std::string description(std::uint32_t pc, std::uint32_t word) const {
    std::ostringstream text;
    text << std::hex << word << " at " << pc << ": " << isa::disassemble(word, pc) << std::dec << '\n';
    std::set<unsigned> numbers{rt_of(word), ra_of(word), rb_of(word)};
    for (const unsigned number : numbers)
      text << "  $" << number << " was " << text_of(before_[number]) << '\n';
    text << "  fpscr was " << text_of(fpscr_before_) << '\n';
    return text.str();
  }

  /// A mismatch should not show again.
  void align() {
    std::memcpy(interpreter_->local_store(), reference_->local_store(), kLocalStoreSize);
    interpreter_->set_fpscr(reference_->fpscr());
    for (unsigned i = 0; i < 128; ++i)
      interpreter_->state.gpr[i] = isa::Quadword::load(reference_->reference.gpr[i].bytes.data());
  }

  Random random_;
  Operands operands_;
  std::unique_ptr<InterpreterMachine> interpreter_;
  std::unique_ptr<ReferenceMachine> reference_;
  Register before_[128];
  Register fpscr_before_;
};

} // namespace

TEST_CASE("random instructions agree") {
  const std::uint64_t count = setting("CELLTRACE_RANDOM_INSTRUCTIONS", 200000);
  const std::uint64_t seed = setting("CELLTRACE_RANDOM_SEED", 1);
  constexpr int kEnough = 20;
  Comparison comparison(seed);
  std::string mismatches;
  int found = 0;
  for (std::uint64_t i = 0; i < count && found < kEnough; ++i) {
    std::string mismatch = comparison.step();
    if (i % 0x4000 == 0 && !comparison.local_stores_agree())
      mismatch += "  another place of local store differs\n";
    if (mismatch.empty()) continue;
    mismatches += "instruction " + std::to_string(i) + ": " + mismatch;
    ++found;
  }
  INFO("seed " << seed << '\n' << mismatches);
  CHECK(found == 0);
  CHECK(comparison.local_stores_agree());
}

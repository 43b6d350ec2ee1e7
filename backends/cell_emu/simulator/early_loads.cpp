#include "backends/cell_emu/simulator/early_loads.hpp"

namespace celltrace::cell_emu {
namespace {

using isa::Instruction;
using isa::Opcode;
using isa::Quadword;
using isa::Unit;

constexpr std::uint64_t kAll = ~std::uint64_t{0};

Quadword all_bytes() {
  Quadword q;
  q.set(0, kAll);
  q.set(1, kAll);
  return q;
}

/// Returns all ones for each part in which a bit is set.
template <class Part> Quadword widened(const Quadword& bits) {
  Quadword q;
  for (unsigned i = 0; i < 16 / sizeof(Part); ++i)
    q.set(i, static_cast<Part>(bits.get<Part>(i) != 0 ? static_cast<Part>(-1) : 0));
  return q;
}

template <class Combine> Quadword combined(Combine combine) {
  Quadword q;
  for (unsigned half = 0; half < 2; ++half)
    q.set(half, static_cast<std::uint64_t>(combine(half)));
  return q;
}

bool is_store(Opcode opcode) {
  return opcode == Opcode::stqd || opcode == Opcode::stqx || opcode == Opcode::stqa || opcode == Opcode::stqr;
}

bool moves_bytes(Opcode opcode) {
  switch (opcode) {
  case Opcode::shlqbi:
  case Opcode::shlqby:
  case Opcode::shlqbybi:
  case Opcode::shlqbii:
  case Opcode::shlqbyi:
  case Opcode::rotqbi:
  case Opcode::rotqby:
  case Opcode::rotqbybi:
  case Opcode::rotqbii:
  case Opcode::rotqbyi:
  case Opcode::rotqmbi:
  case Opcode::rotqmby:
  case Opcode::rotqmbybi:
  case Opcode::rotqmbii:
  case Opcode::rotqmbyi:
    return true;
  default:
    return false;
  }
}

} // namespace

void EarlyLoads::set(std::uint8_t target, const Quadword& early, const Load& load) {
  if (registers_ == nullptr) registers_ = std::make_unique<std::array<Register, 128>>();
  Register& into = (*registers_)[target];
  live_ += !into.live;
  into = {early, true, load};
}

void EarlyLoads::clear(std::uint8_t target) {
  Register& into = (*registers_)[target];
  live_ -= into.live;
  into.live = false;
  into.early = Quadword::zero();
}

void EarlyLoads::loaded(std::uint8_t target, const Load& load) {
  set(target, all_bytes(), load);
}

const EarlyLoads::Load* EarlyLoads::use(const isa::State& state, const Instruction& instruction) {
  const Register* from = nullptr;
  for (const std::uint8_t source : instruction.source) {
    if (source == isa::kNoRegister) continue;
    const Register& read = (*registers_)[source];
    if (!read.live) continue;
    // An instruction without a result uses the preferred slots of its operands; a store also uses all bytes
    // that it stores.
    const bool acts = instruction.target == isa::kNoRegister || instruction.unit == Unit::ls ||
                      instruction.unit == Unit::br || instruction.unit == Unit::spr;
    const bool stored = is_store(instruction.opcode) && source == instruction.rt;
    if (acts && instruction.unit != Unit::hbr && (stored || read.early.word(0) != 0)) return &read.load;
    from = &read;
  }
  if (instruction.target == isa::kNoRegister) return nullptr;
  const Quadword early = from == nullptr || instruction.unit == Unit::ls || instruction.unit == Unit::br
                             ? Quadword::zero()
                             : passed_on(state, instruction);
  if (early == Quadword::zero())
    clear(instruction.target);
  else
    set(instruction.target, early, Load(from->load));
  return nullptr;
}

Quadword EarlyLoads::passed_on(const isa::State& state, const Instruction& instruction) const {
  const std::uint8_t ra = instruction.ra, rb = instruction.rb, rc = instruction.rc;
  const auto early_in = [&](std::uint8_t number, unsigned half) { return early(number).doubleword(half); };
  const auto value_in = [&](std::uint8_t number, unsigned half) {
    return state.gpr[number].doubleword(half);
  };
  if (instruction.opcode == Opcode::shufb || moves_bytes(instruction.opcode))
    return moved(state, instruction);
  if (instruction.opcode == Opcode::selb)
    return widened<std::uint8_t>(combined([&](unsigned half) {
      const std::uint64_t mask = value_in(rc, half);
      return (early_in(ra, half) & ~mask) | (early_in(rb, half) & mask) | early_in(rc, half);
    }));
  // A bit of one operand matters only where the other operand has a 1 or is early.
  if (instruction.opcode == Opcode::and_)
    return widened<std::uint8_t>(combined([&](unsigned half) {
      return (early_in(ra, half) & value_in(rb, half)) | (early_in(rb, half) & value_in(ra, half)) |
             (early_in(ra, half) & early_in(rb, half));
    }));
  const Quadword sum = combined([&](unsigned half) {
    std::uint64_t bits = 0;
    for (const std::uint8_t source : instruction.source)
      if (source != isa::kNoRegister) bits |= early_in(source, half);
    return bits;
  });
  if (instruction.unit == Unit::shuf)
    return all_bytes(); // results of gathers and masks depend on the whole register
  const bool doublewords = instruction.unit == Unit::fpd || instruction.opcode == Opcode::xswd;
  return doublewords ? widened<std::uint64_t>(sum) : widened<std::uint32_t>(sum);
}

/// Returns the early bytes of the result of an instruction that moves bytes. Executes the instruction on
/// registers whose bytes say whether they are early.
Quadword EarlyLoads::moved(const isa::State& state, const Instruction& instruction) const {
  const bool shuffle = instruction.opcode == Opcode::shufb;
  const std::uint8_t control = shuffle ? instruction.rc : instruction.source[1];
  if (control != isa::kNoRegister && !(early(control) == Quadword::zero())) return all_bytes();
  // Separate registers, because the program's instruction may use one register both as data and as control.
  enum : std::uint8_t { a, b, controls, result_at };
  isa::State bytes;
  Instruction moving = instruction;
  moving.ra = a;
  moving.rb = shuffle ? b : controls;
  moving.rc = controls;
  moving.rt = result_at;
  bytes.gpr[a] = early(instruction.ra);
  if (shuffle) bytes.gpr[b] = early(instruction.rb);
  if (control != isa::kNoRegister) bytes.gpr[controls] = state.gpr[control];
  moving.execute(bytes, moving);
  Quadword result = widened<std::uint8_t>(bytes.gpr[result_at]);
  if (shuffle)
    for (unsigned i = 0; i < 16; ++i)
      if (state.gpr[control].byte(i) >= 0x80) result.set<std::uint8_t>(i, 0); // a constant byte
  return result;
}

} // namespace celltrace::cell_emu

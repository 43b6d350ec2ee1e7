#include "isa/reference.hpp"

#include "isa/fields.hpp"
#include "isa/reference_single.hpp"

namespace celltrace::test {

namespace {

constexpr std::uint32_t kLimit = kLocalStoreSize - 1;

/// Compares of parts of `size` bytes give all ones or all zeros.
template <class F> Register compare(unsigned size, F f) {
  return for_parts(size, [&](unsigned i) { return f(i) ? ~std::uint64_t{0} : 0; });
}

} // namespace

void Reference::execute(std::uint32_t word) {
  effects.clear();
  loaded.reset();
  stored.reset();
  next = (pc + 4) & kLimit;
  if (execute_rrr(word) || execute_ri18(word) || execute_ri10(word) || execute_ri16(word) ||
      execute_ri8(word) || execute_11_bits(word))
    return;
  effects.push_back({Effect::invalid, word});
}

Register Reference::load(std::uint32_t address) {
  loaded = address & kLimit & ~15u;
  Register value;
  for (unsigned i = 0; i < 16; ++i)
    value.bytes[i] = local_store[*loaded + i];
  return value;
}

void Reference::store(std::uint32_t address, const Register& value) {
  stored = address & kLimit & ~15u;
  for (unsigned i = 0; i < 16; ++i)
    local_store[*stored + i] = value.bytes[i];
}

void Reference::branch(std::uint32_t address) {
  next = address & kLimit & ~3u;
}

void Reference::branch_indirect(std::uint32_t word, std::uint32_t address) {
  const bool disable = (word >> 19 & 1) != 0, enable = (word >> 18 & 1) != 0;
  if (disable != enable) effects.push_back({Effect::interrupts, 0, enable});
  branch(address);
}

Register Reference::link() const {
  return Register::of_preferred((pc + 4) & kLimit);
}

void Reference::halt_if(bool condition) {
  if (condition) effects.push_back({Effect::halt});
}

bool Reference::execute_rrr(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)], c = gpr[rc_of(word)];
  Register& t = gpr[word >> 21 & 0x7F];
  const auto fused = [&](bool negate_product, bool negate_c) {
    return compute_singles([&](unsigned i, std::uint32_t& exceptions) {
      return single_multiply_add(a.word(i), b.word(i), c.word(i), negate_product, negate_c, exceptions);
    });
  };
  switch (word >> 28) {
  case 0x8: // selb
    t = for_parts(1, [&](unsigned i) { return (c.bytes[i] & b.bytes[i]) | (~c.bytes[i] & a.bytes[i]); });
    return true;
  case 0xB: // shufb
    t = for_parts(1, [&](unsigned i) -> unsigned {
      const unsigned select = c.bytes[i];
      if (select >> 6 == 0b10) return 0x00;
      if (select >> 5 == 0b110) return 0xFF;
      if (select >> 5 == 0b111) return 0x80;
      const unsigned from = select & 31;
      return from < 16 ? a.bytes[from] : b.bytes[from - 16];
    });
    return true;
  case 0xC: // mpya
    t = for_parts(
        4, [&](unsigned i) { return with_sign(a.word(i), 16) * with_sign(b.word(i), 16) + c.word(i); });
    return true;
  case 0xD: // fnms
    t = fused(true, false);
    return true;
  case 0xE: // fma
    t = fused(false, false);
    return true;
  case 0xF: // fms
    t = fused(false, true);
    return true;
  default:
    return false;
  }
}

bool Reference::execute_ri18(std::uint32_t word) {
  switch (word >> 25) {
  case 0x08: // hbra
  case 0x09: // hbrr
    return true;
  case 0x21: // ila
    gpr[rt_of(word)] = for_parts(4, [&](unsigned) { return word >> 7 & 0x3FFFF; });
    return true;
  default:
    return false;
  }
}

bool Reference::execute_ri10(std::uint32_t word) {
  const Register a = gpr[ra_of(word)];
  Register& t = gpr[rt_of(word)];
  const std::int64_t immediate = with_sign(word >> 14, 10);
  const auto displaced = a.preferred() + static_cast<std::uint32_t>(immediate * 16);
  // Of each size of parts: the operand and the immediate, with sign and without.
  const auto part = [&](unsigned size, unsigned i) { return with_sign(a.part(size, i), 8 * size); };
  const auto extended = [&](unsigned size) {
    return with_sign(static_cast<std::uint64_t>(immediate), 8 * size);
  };
  const auto logical = [&](unsigned size) {
    return static_cast<std::uint64_t>(immediate) & ((std::uint64_t{1} << 8 * size) - 1);
  };
  const auto combine = [&](unsigned size, auto f) {
    t = for_parts(size, [&](unsigned i) { return f(part(size, i), extended(size)); });
    return true;
  };
  const auto is_greater = [&](unsigned size) {
    t = compare(size, [&](unsigned i) { return part(size, i) > extended(size); });
    return true;
  };
  const auto is_above = [&](unsigned size) {
    t = compare(size, [&](unsigned i) { return a.part(size, i) > logical(size); });
    return true;
  };
  const auto is_equal = [&](unsigned size) {
    t = compare(size, [&](unsigned i) { return part(size, i) == extended(size); });
    return true;
  };
  using Number = std::int64_t;
  const auto disjunction = [](Number x, Number y) { return x | y; };
  const auto conjunction = [](Number x, Number y) { return x & y; };
  const auto exclusive = [](Number x, Number y) { return x ^ y; };
  const auto sum = [](Number x, Number y) { return x + y; };
  const auto from = [](Number x, Number y) { return y - x; };
  switch (word >> 24) {
  case 0x04: // ori
    return combine(4, disjunction);
  case 0x05: // orhi
    return combine(2, disjunction);
  case 0x06: // orbi
    return combine(1, disjunction);
  case 0x0C: // sfi
    return combine(4, from);
  case 0x0D: // sfhi
    return combine(2, from);
  case 0x14: // andi
    return combine(4, conjunction);
  case 0x15: // andhi
    return combine(2, conjunction);
  case 0x16: // andbi
    return combine(1, conjunction);
  case 0x1C: // ai
    return combine(4, sum);
  case 0x1D: // ahi
    return combine(2, sum);
  case 0x24: // stqd
    store(displaced, t);
    return true;
  case 0x34: // lqd
    t = load(displaced);
    return true;
  case 0x44: // xori
    return combine(4, exclusive);
  case 0x45: // xorhi
    return combine(2, exclusive);
  case 0x46: // xorbi
    return combine(1, exclusive);
  case 0x4C: // cgti
    return is_greater(4);
  case 0x4D: // cgthi
    return is_greater(2);
  case 0x4E: // cgtbi
    return is_greater(1);
  case 0x4F: // hgti
    halt_if(part(4, 0) > immediate);
    return true;
  case 0x5C: // clgti
    return is_above(4);
  case 0x5D: // clgthi
    return is_above(2);
  case 0x5E: // clgtbi
    return is_above(1);
  case 0x5F: // hlgti
    halt_if(a.part(4, 0) > logical(4));
    return true;
  case 0x74: // mpyi
    t = for_parts(4, [&](unsigned i) { return with_sign(a.word(i), 16) * immediate; });
    return true;
  case 0x75: // mpyui
    t = for_parts(4, [&](unsigned i) { return (a.word(i) & 0xFFFF) * logical(2); });
    return true;
  case 0x7C: // ceqi
    return is_equal(4);
  case 0x7D: // ceqhi
    return is_equal(2);
  case 0x7E: // ceqbi
    return is_equal(1);
  case 0x7F: // heqi
    halt_if(part(4, 0) == immediate);
    return true;
  default:
    return false;
  }
}

bool Reference::execute_ri16(std::uint32_t word) {
  Register& t = gpr[rt_of(word)];
  const std::uint32_t immediate = word >> 7 & 0xFFFF;
  const auto offset = static_cast<std::uint32_t>(with_sign(immediate, 16) * 4);
  const std::uint32_t preferred_half = t.preferred() & 0xFFFF;
  switch (word >> 23) {
  case 0x40: // brz
    if (t.preferred() == 0) branch(pc + offset);
    return true;
  case 0x41: // stqa
    store(offset, t);
    return true;
  case 0x42: // brnz
    if (t.preferred() != 0) branch(pc + offset);
    return true;
  case 0x44: // brhz
    if (preferred_half == 0) branch(pc + offset);
    return true;
  case 0x46: // brhnz
    if (preferred_half != 0) branch(pc + offset);
    return true;
  case 0x47: // stqr
    store(pc + offset, t);
    return true;
  case 0x60: // bra
    branch(offset);
    return true;
  case 0x61: // lqa
    t = load(offset);
    return true;
  case 0x62: // brasl
    t = link();
    branch(offset);
    return true;
  case 0x64: // br
    branch(pc + offset);
    return true;
  case 0x65: // fsmbi
    t = for_parts(1, [&](unsigned i) { return (immediate >> (15 - i) & 1) != 0 ? 0xFF : 0; });
    return true;
  case 0x66: // brsl
    t = link();
    branch(pc + offset);
    return true;
  case 0x67: // lqr
    t = load(pc + offset);
    return true;
  case 0x81: // il
    t = for_parts(4, [&](unsigned) { return with_sign(immediate, 16); });
    return true;
  case 0x82: // ilhu
    t = for_parts(4, [&](unsigned) { return immediate << 16; });
    return true;
  case 0x83: // ilh
    t = for_parts(2, [&](unsigned) { return immediate; });
    return true;
  case 0xC1: // iohl
    t = for_parts(4, [&](unsigned i) { return t.word(i) | immediate; });
    return true;
  default:
    return false;
  }
}

bool Reference::execute_ri8(std::uint32_t word) {
  const Register a = gpr[ra_of(word)];
  Register& t = gpr[rt_of(word)];
  const int immediate = static_cast<int>(word >> 14 & 0xFF);
  switch (word >> 22) {
  case 0x1D8: // cflts
    t = for_parts(4, [&](unsigned i) { return single_to_signed(a.word(i), 173 - immediate); });
    return true;
  case 0x1D9: // cfltu
    t = for_parts(4, [&](unsigned i) { return single_to_unsigned(a.word(i), 173 - immediate); });
    return true;
  case 0x1DA: // csflt
    t = compute_singles([&](unsigned i, std::uint32_t& exceptions) {
      return single_from_integer(with_sign(a.word(i), 32), immediate - 155, exceptions);
    });
    return true;
  case 0x1DB: // cuflt
    t = compute_singles([&](unsigned i, std::uint32_t& exceptions) {
      return single_from_integer(a.word(i), immediate - 155, exceptions);
    });
    return true;
  default:
    return false;
  }
}

} // namespace celltrace::test

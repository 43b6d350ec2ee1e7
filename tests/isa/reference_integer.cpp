// Opcodes of 11 bits: whole numbers, logic, compares, halts, and shifts of parts of a register.
#include "isa/fields.hpp"
#include "isa/reference.hpp"

#include <cstdlib>

namespace celltrace::test {

namespace {

constexpr std::uint64_t kOnes = ~std::uint64_t{0};

unsigned leading_zeros(std::uint32_t value) {
  unsigned count = 0;
  while (count < 32 && (value >> (31 - count) & 1) == 0)
    ++count;
  return count;
}

unsigned ones(unsigned value) {
  return value == 0 ? 0 : (value & 1) + ones(value >> 1);
}

} // namespace

bool Reference::execute_11_bits(std::uint32_t word) {
  return execute_integer(word) || execute_shift(word) || execute_shuffle(word) || execute_float(word) ||
         execute_double(word) || execute_control(word);
}

bool Reference::execute_integer(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)], before = gpr[rt_of(word)];
  Register& t = gpr[rt_of(word)];
  const auto number = [](const Register& r, unsigned size, unsigned i) {
    return with_sign(r.part(size, i), 8 * size);
  };
  const auto sum = [&](unsigned size) {
    t = for_parts(size, [&](unsigned i) { return a.part(size, i) + b.part(size, i); });
    return true;
  };
  const auto difference = [&](unsigned size) {
    t = for_parts(size, [&](unsigned i) { return b.part(size, i) - a.part(size, i); });
    return true;
  };
  const auto bitwise = [&](auto f) {
    t = for_parts(1, [&](unsigned i) { return f(unsigned{a.bytes[i]}, unsigned{b.bytes[i]}); });
    return true;
  };
  const auto is_greater = [&](unsigned size) {
    t = for_parts(size, [&](unsigned i) { return number(a, size, i) > number(b, size, i) ? kOnes : 0; });
    return true;
  };
  const auto is_above = [&](unsigned size) {
    t = for_parts(size, [&](unsigned i) { return a.part(size, i) > b.part(size, i) ? kOnes : 0; });
    return true;
  };
  const auto is_equal = [&](unsigned size) {
    t = for_parts(size, [&](unsigned i) { return a.part(size, i) == b.part(size, i) ? kOnes : 0; });
    return true;
  };
  // The last bit of the target is what was carried in; with sf and bg, a carry is no borrow.
  const auto carried = [&](unsigned i) { return std::uint64_t{before.word(i)} & 1; };
  const auto added = [&](unsigned i, std::uint64_t carry) { return a.part(4, i) + b.part(4, i) + carry; };
  const auto subtracted = [&](unsigned i, std::uint64_t carry) {
    return (~a.part(4, i) & 0xFFFFFFFF) + b.part(4, i) + carry;
  };
  // Products of halves of words: the left, high one or the right, low one.
  const auto low = [](const Register& r, unsigned i) { return with_sign(r.word(i), 16); };
  const auto high = [](const Register& r, unsigned i) { return with_sign(r.word(i) >> 16, 16); };
  const auto low_unsigned = [](const Register& r, unsigned i) { return r.part(4, i) & 0xFFFF; };
  const auto high_unsigned = [](const Register& r, unsigned i) { return r.part(4, i) >> 16; };

  switch (word >> 21) {
  case 0x0C0: // a
    return sum(4);
  case 0x0C8: // ah
    return sum(2);
  case 0x040: // sf
    return difference(4);
  case 0x048: // sfh
    return difference(2);
  case 0x340: // addx
    t = for_parts(4, [&](unsigned i) { return added(i, carried(i)); });
    return true;
  case 0x0C2: // cg
    t = for_parts(4, [&](unsigned i) { return added(i, 0) >> 32; });
    return true;
  case 0x342: // cgx
    t = for_parts(4, [&](unsigned i) { return added(i, carried(i)) >> 32; });
    return true;
  case 0x341: // sfx
    t = for_parts(4, [&](unsigned i) { return subtracted(i, carried(i)); });
    return true;
  case 0x042: // bg
    t = for_parts(4, [&](unsigned i) { return subtracted(i, 1) >> 32; });
    return true;
  case 0x343: // bgx
    t = for_parts(4, [&](unsigned i) { return subtracted(i, carried(i)) >> 32; });
    return true;

  case 0x3C4: // mpy
    t = for_parts(4, [&](unsigned i) { return low(a, i) * low(b, i); });
    return true;
  case 0x3CC: // mpyu
    t = for_parts(4, [&](unsigned i) { return low_unsigned(a, i) * low_unsigned(b, i); });
    return true;
  case 0x3C5: // mpyh
    t = for_parts(4, [&](unsigned i) { return high_unsigned(a, i) * low_unsigned(b, i) << 16; });
    return true;
  case 0x3C7: // mpys
    t = for_parts(4, [&](unsigned i) {
      return with_sign(static_cast<std::uint64_t>(low(a, i) * low(b, i)) >> 16, 16);
    });
    return true;
  case 0x3C6: // mpyhh
    t = for_parts(4, [&](unsigned i) { return high(a, i) * high(b, i); });
    return true;
  case 0x346: // mpyhha
    t = for_parts(4, [&](unsigned i) { return high(a, i) * high(b, i) + before.word(i); });
    return true;
  case 0x3CE: // mpyhhu
    t = for_parts(4, [&](unsigned i) { return high_unsigned(a, i) * high_unsigned(b, i); });
    return true;
  case 0x34E: // mpyhhau
    t = for_parts(4, [&](unsigned i) { return high_unsigned(a, i) * high_unsigned(b, i) + before.word(i); });
    return true;

  case 0x2A5: // clz
    t = for_parts(4, [&](unsigned i) { return leading_zeros(a.word(i)); });
    return true;
  case 0x2B4: // cntb
    t = for_parts(1, [&](unsigned i) { return ones(a.bytes[i]); });
    return true;
  case 0x0D3: // avgb
    t = for_parts(1, [&](unsigned i) { return (a.bytes[i] + b.bytes[i] + 1) / 2; });
    return true;
  case 0x053: // absdb
    t = for_parts(1, [&](unsigned i) { return std::abs(b.bytes[i] - a.bytes[i]); });
    return true;
  case 0x253: // sumb: of each word, the bytes of b to the left half and those of a to the right
    t = for_parts(2, [&](unsigned i) {
      const Register& from = i % 2 == 0 ? b : a;
      const unsigned first = i / 2 * 4;
      return from.bytes[first] + from.bytes[first + 1] + from.bytes[first + 2] + from.bytes[first + 3];
    });
    return true;
  case 0x2B6: // xsbh
    t = for_parts(2, [&](unsigned i) { return with_sign(a.part(2, i), 8); });
    return true;
  case 0x2AE: // xshw
    t = for_parts(4, [&](unsigned i) { return with_sign(a.part(4, i), 16); });
    return true;
  case 0x2A6: // xswd
    t = for_parts(8, [&](unsigned i) { return with_sign(a.part(8, i), 32); });
    return true;

  case 0x0C1: // and
    return bitwise([](unsigned x, unsigned y) { return x & y; });
  case 0x2C1: // andc
    return bitwise([](unsigned x, unsigned y) { return x & ~y; });
  case 0x041: // or
    return bitwise([](unsigned x, unsigned y) { return x | y; });
  case 0x2C9: // orc
    return bitwise([](unsigned x, unsigned y) { return x | ~y; });
  case 0x241: // xor
    return bitwise([](unsigned x, unsigned y) { return x ^ y; });
  case 0x0C9: // nand
    return bitwise([](unsigned x, unsigned y) { return ~(x & y); });
  case 0x049: // nor
    return bitwise([](unsigned x, unsigned y) { return ~(x | y); });
  case 0x249: // eqv
    return bitwise([](unsigned x, unsigned y) { return ~(x ^ y); });

  case 0x240: // cgt
    return is_greater(4);
  case 0x248: // cgth
    return is_greater(2);
  case 0x250: // cgtb
    return is_greater(1);
  case 0x2C0: // clgt
    return is_above(4);
  case 0x2C8: // clgth
    return is_above(2);
  case 0x2D0: // clgtb
    return is_above(1);
  case 0x3C0: // ceq
    return is_equal(4);
  case 0x3C8: // ceqh
    return is_equal(2);
  case 0x3D0: // ceqb
    return is_equal(1);

  case 0x258: // hgt
    halt_if(number(a, 4, 0) > number(b, 4, 0));
    return true;
  case 0x2D8: // hlgt
    halt_if(a.preferred() > b.preferred());
    return true;
  case 0x3D8: // heq
    halt_if(a.preferred() == b.preferred());
    return true;
  default:
    return false;
  }
}

bool Reference::execute_shift(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)];
  Register& t = gpr[rt_of(word)];
  // Each part has a count of its own, or all have the same: opcodes 0x05_ and 0x07_.
  const unsigned immediate = word >> 14 & 0x7F;
  const bool is_immediate = (word >> 21 & 0x20) != 0;
  const auto shift = [&](unsigned size, auto f) {
    t = for_parts(size, [&](unsigned i) {
      return f(a.part(size, i), is_immediate ? immediate : static_cast<unsigned>(b.part(size, i)), 8 * size);
    });
    return true;
  };
  const auto left = [](std::uint64_t value, unsigned count, unsigned bits) {
    count %= 2 * bits;
    return count < bits ? value << count : 0;
  };
  const auto around = [](std::uint64_t value, unsigned count, unsigned bits) {
    count %= bits;
    return value << count | value >> (bits - count);
  };
  // Rotate and mask: a shift to the right by the negative of the count.
  const auto right = [](std::uint64_t value, unsigned count, unsigned bits) {
    count = (0 - count) % (2 * bits);
    return count < bits ? value >> count : 0;
  };
  const auto right_with_sign = [](std::uint64_t value, unsigned count, unsigned bits) {
    count = (0 - count) % (2 * bits);
    const bool negative = (value >> (bits - 1) & 1) != 0;
    for (; count > 0; --count)
      value = value >> 1 | static_cast<std::uint64_t>(negative) << (bits - 1);
    return value;
  };
  switch (word >> 21) {
  case 0x058: // rot
  case 0x078: // roti
    return shift(4, around);
  case 0x059: // rotm
  case 0x079: // rotmi
    return shift(4, right);
  case 0x05A: // rotma
  case 0x07A: // rotmai
    return shift(4, right_with_sign);
  case 0x05B: // shl
  case 0x07B: // shli
    return shift(4, left);
  case 0x05C: // roth
  case 0x07C: // rothi
    return shift(2, around);
  case 0x05D: // rothm
  case 0x07D: // rothmi
    return shift(2, right);
  case 0x05E: // rotmah
  case 0x07E: // rotmahi
    return shift(2, right_with_sign);
  case 0x05F: // shlh
  case 0x07F: // shlhi
    return shift(2, left);
  default:
    return false;
  }
}

} // namespace celltrace::test

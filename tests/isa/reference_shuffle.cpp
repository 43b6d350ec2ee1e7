// Opcodes of 11 bits: shifts of whole registers, masks and their gathering, controls for insertion.
#include "isa/fields.hpp"
#include "isa/reference.hpp"

namespace celltrace::test {

namespace {

// Of whole registers, by bits; what leaves on one side is lost or comes in on the other.
Register left(const Register& a, unsigned bits) {
  Register result;
  for (unsigned i = 0; i + bits < 128; ++i)
    result.set_bit(i, a.bit(i + bits));
  return result;
}

Register right(const Register& a, unsigned bits) {
  Register result;
  for (unsigned i = bits; i < 128; ++i)
    result.set_bit(i, a.bit(i - bits));
  return result;
}

Register around(const Register& a, unsigned bits) {
  Register result;
  for (unsigned i = 0; i < 128; ++i)
    result.set_bit(i, a.bit((i + bits) % 128));
  return result;
}

/// The right-most bits of the preferred slot, spread over parts of `size` bytes.
Register mask(std::uint32_t bits, unsigned size) {
  const unsigned parts = 16 / size;
  return for_parts(size, [&](unsigned i) {
    return (bits >> (parts - 1 - i) & 1) != 0 ? ~std::uint64_t{0} : std::uint64_t{0};
  });
}

/// The last bit of each part.
Register gather(const Register& a, unsigned size) {
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 16 / size; ++i)
    bits = bits << 1 | static_cast<std::uint32_t>(a.part(size, i) & 1);
  return Register::of_preferred(bits);
}

/// For shufb: all from the second register, but the preferred part of the first at the place of the address.
Register insertion(std::uint32_t address, unsigned size) {
  const unsigned place = address % 16 / size * size;
  const unsigned preferred = size < 4 ? 4 - size : 0;
  Register control;
  for (unsigned i = 0; i < 16; ++i) {
    const bool inserted = i >= place && i < place + size;
    control.bytes[i] = static_cast<std::uint8_t>(inserted ? preferred + i - place : 16 + i);
  }
  return control;
}

} // namespace

bool Reference::execute_shuffle(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)];
  Register& t = gpr[rt_of(word)];
  const unsigned immediate = word >> 14 & 0x7F;
  const unsigned count = b.preferred();
  const std::uint32_t indexed = a.preferred() + b.preferred();
  const std::uint32_t displaced = a.preferred() + static_cast<std::uint32_t>(with_sign(immediate, 7));
  switch (word >> 21) {
  case 0x1DB: // shlqbi
    t = left(a, count % 8);
    return true;
  case 0x1FB: // shlqbii
    t = left(a, immediate % 8);
    return true;
  case 0x1DF: // shlqby
    t = left(a, 8 * (count % 32));
    return true;
  case 0x1FF: // shlqbyi
    t = left(a, 8 * (immediate % 32));
    return true;
  case 0x1CF: // shlqbybi
    t = left(a, 8 * (count / 8 % 32));
    return true;
  case 0x1D8: // rotqbi
    t = around(a, count % 8);
    return true;
  case 0x1F8: // rotqbii
    t = around(a, immediate % 8);
    return true;
  case 0x1DC: // rotqby
    t = around(a, 8 * (count % 16));
    return true;
  case 0x1FC: // rotqbyi
    t = around(a, 8 * (immediate % 16));
    return true;
  case 0x1CC: // rotqbybi
    t = around(a, 8 * (count / 8 % 16));
    return true;
  case 0x1D9: // rotqmbi
    t = right(a, (0 - count) % 8);
    return true;
  case 0x1F9: // rotqmbii
    t = right(a, (0 - immediate) % 8);
    return true;
  case 0x1DD: // rotqmby
    t = right(a, 8 * ((0 - count) % 32));
    return true;
  case 0x1FD: // rotqmbyi
    t = right(a, 8 * ((0 - immediate) % 32));
    return true;
  case 0x1CD: // rotqmbybi
    t = right(a, 8 * ((0 - count / 8) % 32));
    return true;

  case 0x1B6: // fsmb
    t = mask(a.preferred(), 1);
    return true;
  case 0x1B5: // fsmh
    t = mask(a.preferred(), 2);
    return true;
  case 0x1B4: // fsm
    t = mask(a.preferred(), 4);
    return true;
  case 0x1B2: // gbb
    t = gather(a, 1);
    return true;
  case 0x1B1: // gbh
    t = gather(a, 2);
    return true;
  case 0x1B0: // gb
    t = gather(a, 4);
    return true;
  case 0x1F0: // orx
    t = Register::of_preferred(a.word(0) | a.word(1) | a.word(2) | a.word(3));
    return true;

  case 0x1D4: // cbx
    t = insertion(indexed, 1);
    return true;
  case 0x1D5: // chx
    t = insertion(indexed, 2);
    return true;
  case 0x1D6: // cwx
    t = insertion(indexed, 4);
    return true;
  case 0x1D7: // cdx
    t = insertion(indexed, 8);
    return true;
  case 0x1F4: // cbd
    t = insertion(displaced, 1);
    return true;
  case 0x1F5: // chd
    t = insertion(displaced, 2);
    return true;
  case 0x1F6: // cwd
    t = insertion(displaced, 4);
    return true;
  case 0x1F7: // cdd
    t = insertion(displaced, 8);
    return true;
  default:
    return false;
  }
}

} // namespace celltrace::test

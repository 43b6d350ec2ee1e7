// The specific intrinsics (si_*) of the C/C++ Language Extensions for Cell: each executes one instruction of
// the SPU, on registers (qword). Arguments are in the order of the instruction's operands; a register that an
// instruction reads and writes (rt) comes last. Immediates are the numbers in assembly; scales of conversions
// are 0..127. Results are exactly the SPU's (spu_instructions.hpp).
//
// Addresses are offsets in local store, as si_from_ptr() and spu_ls_address() return them. si_lqd() and the
// other loads and stores move words in the host's byte order. Instructions that refer to an address in the
// code (lqr, stqr, bisled) are missing; use spu_bisled(), which takes a function.
#pragma once

#include "celltrace/spe/spu_vectors.hpp"

#include <bit>
#include <cstring>

namespace celltrace::sdk {

inline qword si(Opcode opcode, qword a, qword b, qword c, int immediate) {
  return qword(execute(opcode, a.quadword(), b.quadword(), c.quadword(), immediate));
}

} // namespace celltrace::sdk

// --- by operands ---

#define CELLTRACE_SI_A(name)                                                                                 \
  inline qword si_##name(qword ra) {                                                                         \
    return celltrace::sdk::si(celltrace::isa::Opcode::name, ra, qword{}, qword{}, 0);                        \
  }
#define CELLTRACE_SI_AB_OF(name, opcode)                                                                     \
  inline qword si_##name(qword ra, qword rb) {                                                               \
    return celltrace::sdk::si(celltrace::isa::Opcode::opcode, ra, rb, qword{}, 0);                           \
  }
#define CELLTRACE_SI_AB(name) CELLTRACE_SI_AB_OF(name, name)
#define CELLTRACE_SI_ABC(name)                                                                               \
  inline qword si_##name(qword ra, qword rb, qword rc) {                                                     \
    return celltrace::sdk::si(celltrace::isa::Opcode::name, ra, rb, rc, 0);                                  \
  }
#define CELLTRACE_SI_A_IMMEDIATE(name)                                                                       \
  inline qword si_##name(qword ra, int immediate) {                                                          \
    return celltrace::sdk::si(celltrace::isa::Opcode::name, ra, qword{}, qword{}, immediate);                \
  }
#define CELLTRACE_SI_IMMEDIATE(name)                                                                         \
  inline qword si_##name(int immediate) {                                                                    \
    return celltrace::sdk::si(celltrace::isa::Opcode::name, qword{}, qword{}, qword{}, immediate);           \
  }

// constants
CELLTRACE_SI_IMMEDIATE(ilh)
CELLTRACE_SI_IMMEDIATE(ilhu)
CELLTRACE_SI_IMMEDIATE(il)
CELLTRACE_SI_IMMEDIATE(ila)
CELLTRACE_SI_IMMEDIATE(fsmbi)
inline qword si_iohl(qword rt, int immediate) {
  return celltrace::sdk::si(celltrace::isa::Opcode::iohl, qword{}, qword{}, rt, immediate);
}

// controls of shuffles
CELLTRACE_SI_A_IMMEDIATE(cbd)
CELLTRACE_SI_A_IMMEDIATE(chd)
CELLTRACE_SI_A_IMMEDIATE(cwd)
CELLTRACE_SI_A_IMMEDIATE(cdd)
CELLTRACE_SI_AB(cbx)
CELLTRACE_SI_AB(chx)
CELLTRACE_SI_AB(cwx)
CELLTRACE_SI_AB(cdx)

// integers
CELLTRACE_SI_AB(ah)
CELLTRACE_SI_A_IMMEDIATE(ahi)
CELLTRACE_SI_AB(a)
CELLTRACE_SI_A_IMMEDIATE(ai)
CELLTRACE_SI_ABC(addx)
CELLTRACE_SI_AB(cg)
CELLTRACE_SI_ABC(cgx)
CELLTRACE_SI_AB(sfh)
CELLTRACE_SI_A_IMMEDIATE(sfhi)
CELLTRACE_SI_AB(sf)
CELLTRACE_SI_A_IMMEDIATE(sfi)
CELLTRACE_SI_ABC(sfx)
CELLTRACE_SI_AB(bg)
CELLTRACE_SI_ABC(bgx)
CELLTRACE_SI_AB(mpy)
CELLTRACE_SI_AB(mpyu)
CELLTRACE_SI_A_IMMEDIATE(mpyi)
CELLTRACE_SI_A_IMMEDIATE(mpyui)
CELLTRACE_SI_ABC(mpya)
CELLTRACE_SI_AB(mpyh)
CELLTRACE_SI_AB(mpys)
CELLTRACE_SI_AB(mpyhh)
CELLTRACE_SI_AB(mpyhhu)
CELLTRACE_SI_ABC(mpyhha)
CELLTRACE_SI_ABC(mpyhhau)
CELLTRACE_SI_A(clz)
CELLTRACE_SI_A(cntb)
CELLTRACE_SI_A(fsmb)
CELLTRACE_SI_A(fsmh)
CELLTRACE_SI_A(fsm)
CELLTRACE_SI_A(gbb)
CELLTRACE_SI_A(gbh)
CELLTRACE_SI_A(gb)
CELLTRACE_SI_AB(avgb)
CELLTRACE_SI_AB(absdb)
CELLTRACE_SI_AB(sumb)
CELLTRACE_SI_A(xsbh)
CELLTRACE_SI_A(xshw)
CELLTRACE_SI_A(xswd)

// logic
CELLTRACE_SI_AB_OF(and, and_)
CELLTRACE_SI_AB(andc)
CELLTRACE_SI_A_IMMEDIATE(andbi)
CELLTRACE_SI_A_IMMEDIATE(andhi)
CELLTRACE_SI_A_IMMEDIATE(andi)
CELLTRACE_SI_AB_OF(or, or_)
CELLTRACE_SI_AB(orc)
CELLTRACE_SI_A_IMMEDIATE(orbi)
CELLTRACE_SI_A_IMMEDIATE(orhi)
CELLTRACE_SI_A_IMMEDIATE(ori)
CELLTRACE_SI_A(orx)
CELLTRACE_SI_AB_OF(xor, xor_)
CELLTRACE_SI_A_IMMEDIATE(xorbi)
CELLTRACE_SI_A_IMMEDIATE(xorhi)
CELLTRACE_SI_A_IMMEDIATE(xori)
CELLTRACE_SI_AB(nand)
CELLTRACE_SI_AB(nor)
CELLTRACE_SI_AB(eqv)
CELLTRACE_SI_ABC(selb)
CELLTRACE_SI_ABC(shufb)

// shifts and rotates
CELLTRACE_SI_AB(shlh)
CELLTRACE_SI_A_IMMEDIATE(shlhi)
CELLTRACE_SI_AB(shl)
CELLTRACE_SI_A_IMMEDIATE(shli)
CELLTRACE_SI_AB(shlqbi)
CELLTRACE_SI_A_IMMEDIATE(shlqbii)
CELLTRACE_SI_AB(shlqby)
CELLTRACE_SI_A_IMMEDIATE(shlqbyi)
CELLTRACE_SI_AB(shlqbybi)
CELLTRACE_SI_AB(roth)
CELLTRACE_SI_A_IMMEDIATE(rothi)
CELLTRACE_SI_AB(rot)
CELLTRACE_SI_A_IMMEDIATE(roti)
CELLTRACE_SI_AB(rotqby)
CELLTRACE_SI_A_IMMEDIATE(rotqbyi)
CELLTRACE_SI_AB(rotqbybi)
CELLTRACE_SI_AB(rotqbi)
CELLTRACE_SI_A_IMMEDIATE(rotqbii)
CELLTRACE_SI_AB(rothm)
CELLTRACE_SI_A_IMMEDIATE(rothmi)
CELLTRACE_SI_AB(rotm)
CELLTRACE_SI_A_IMMEDIATE(rotmi)
CELLTRACE_SI_AB(rotqmby)
CELLTRACE_SI_A_IMMEDIATE(rotqmbyi)
CELLTRACE_SI_AB(rotqmbi)
CELLTRACE_SI_A_IMMEDIATE(rotqmbii)
CELLTRACE_SI_AB(rotqmbybi)
CELLTRACE_SI_AB(rotmah)
CELLTRACE_SI_A_IMMEDIATE(rotmahi)
CELLTRACE_SI_AB(rotma)
CELLTRACE_SI_A_IMMEDIATE(rotmai)

// compares
CELLTRACE_SI_AB(ceqb)
CELLTRACE_SI_A_IMMEDIATE(ceqbi)
CELLTRACE_SI_AB(ceqh)
CELLTRACE_SI_A_IMMEDIATE(ceqhi)
CELLTRACE_SI_AB(ceq)
CELLTRACE_SI_A_IMMEDIATE(ceqi)
CELLTRACE_SI_AB(cgtb)
CELLTRACE_SI_A_IMMEDIATE(cgtbi)
CELLTRACE_SI_AB(cgth)
CELLTRACE_SI_A_IMMEDIATE(cgthi)
CELLTRACE_SI_AB(cgt)
CELLTRACE_SI_A_IMMEDIATE(cgti)
CELLTRACE_SI_AB(clgtb)
CELLTRACE_SI_A_IMMEDIATE(clgtbi)
CELLTRACE_SI_AB(clgth)
CELLTRACE_SI_A_IMMEDIATE(clgthi)
CELLTRACE_SI_AB(clgt)
CELLTRACE_SI_A_IMMEDIATE(clgti)

// single precision, and estimates
CELLTRACE_SI_AB(fa)
CELLTRACE_SI_AB(fs)
CELLTRACE_SI_AB(fm)
CELLTRACE_SI_ABC(fma)
CELLTRACE_SI_ABC(fms)
CELLTRACE_SI_ABC(fnms)
CELLTRACE_SI_A(frest)
CELLTRACE_SI_A(frsqest)
CELLTRACE_SI_AB(fi)
CELLTRACE_SI_A_IMMEDIATE(csflt)
CELLTRACE_SI_A_IMMEDIATE(cflts)
CELLTRACE_SI_A_IMMEDIATE(cuflt)
CELLTRACE_SI_A_IMMEDIATE(cfltu)
CELLTRACE_SI_AB(fceq)
CELLTRACE_SI_AB(fcmeq)
CELLTRACE_SI_AB(fcgt)
CELLTRACE_SI_AB(fcmgt)

// double precision; compares and tests are those of the enhanced SPU
CELLTRACE_SI_AB(dfa)
CELLTRACE_SI_AB(dfs)
CELLTRACE_SI_AB(dfm)
CELLTRACE_SI_ABC(dfma)
CELLTRACE_SI_ABC(dfms)
CELLTRACE_SI_ABC(dfnms)
CELLTRACE_SI_ABC(dfnma)
CELLTRACE_SI_A(frds)
CELLTRACE_SI_A(fesd)
CELLTRACE_SI_AB(dfceq)
CELLTRACE_SI_AB(dfcmeq)
CELLTRACE_SI_AB(dfcgt)
CELLTRACE_SI_AB(dfcmgt)
CELLTRACE_SI_A_IMMEDIATE(dftsv)

#undef CELLTRACE_SI_A
#undef CELLTRACE_SI_AB_OF
#undef CELLTRACE_SI_AB
#undef CELLTRACE_SI_ABC
#undef CELLTRACE_SI_A_IMMEDIATE
#undef CELLTRACE_SI_IMMEDIATE

// --- halts, which compare the preferred slots ---

inline void si_heq(qword ra, qword rb) {
  celltrace::sdk::si(celltrace::isa::Opcode::heq, ra, rb, qword{}, 0);
}
inline void si_heqi(qword ra, int immediate) {
  celltrace::sdk::si(celltrace::isa::Opcode::heqi, ra, qword{}, qword{}, immediate);
}
inline void si_hgt(qword ra, qword rb) {
  celltrace::sdk::si(celltrace::isa::Opcode::hgt, ra, rb, qword{}, 0);
}
inline void si_hgti(qword ra, int immediate) {
  celltrace::sdk::si(celltrace::isa::Opcode::hgti, ra, qword{}, qword{}, immediate);
}
inline void si_hlgt(qword ra, qword rb) {
  celltrace::sdk::si(celltrace::isa::Opcode::hlgt, ra, rb, qword{}, 0);
}
inline void si_hlgti(qword ra, int immediate) {
  celltrace::sdk::si(celltrace::isa::Opcode::hlgti, ra, qword{}, qword{}, immediate);
}

// --- scalars: in the preferred slot, zeros in the others ---

namespace celltrace::sdk {

/// Number of the element in the preferred slot: a scalar of 1 or 2 bytes ends at byte 3, a larger scalar
/// begins at byte 0.
template <class Scalar>
constexpr unsigned kPreferredElement = sizeof(Scalar) < 4 ? 4 / sizeof(Scalar) - 1 : 0;

template <class Scalar> qword to_preferred(Scalar scalar) {
  Vector<Scalar> v{};
  v[kPreferredElement<Scalar>] = scalar;
  return qword(v);
}
template <class Scalar> Scalar from_preferred(qword ra) {
  return Vector<Scalar>(ra)[kPreferredElement<Scalar>];
}

} // namespace celltrace::sdk

inline qword si_from_char(signed char scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_uchar(unsigned char scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_short(short scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_ushort(unsigned short scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_int(int scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_uint(unsigned int scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_llong(long long scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_ullong(unsigned long long scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_float(float scalar) {
  return celltrace::sdk::to_preferred(scalar);
}
inline qword si_from_double(double scalar) {
  return celltrace::sdk::to_preferred(scalar);
}

inline signed char si_to_char(qword ra) {
  return celltrace::sdk::from_preferred<signed char>(ra);
}
inline unsigned char si_to_uchar(qword ra) {
  return celltrace::sdk::from_preferred<unsigned char>(ra);
}
inline short si_to_short(qword ra) {
  return celltrace::sdk::from_preferred<short>(ra);
}
inline unsigned short si_to_ushort(qword ra) {
  return celltrace::sdk::from_preferred<unsigned short>(ra);
}
inline int si_to_int(qword ra) {
  return celltrace::sdk::from_preferred<int>(ra);
}
inline unsigned int si_to_uint(qword ra) {
  return celltrace::sdk::from_preferred<unsigned int>(ra);
}
inline long long si_to_llong(qword ra) {
  return celltrace::sdk::from_preferred<long long>(ra);
}
inline unsigned long long si_to_ullong(qword ra) {
  return celltrace::sdk::from_preferred<unsigned long long>(ra);
}
inline float si_to_float(qword ra) {
  return celltrace::sdk::from_preferred<float>(ra);
}
inline double si_to_double(qword ra) {
  return celltrace::sdk::from_preferred<double>(ra);
}

// --- loads and stores ---

namespace celltrace::sdk {

inline qword load_quadword(unsigned int lsa) {
  Vector<unsigned int> words;
  std::memcpy(&words, local_quadword(lsa), sizeof words);
  return qword(words);
}
inline void store_quadword(qword rt, unsigned int lsa) {
  const Vector<unsigned int> words(rt);
  std::memcpy(local_quadword(lsa), &words, sizeof words);
}

} // namespace celltrace::sdk

inline qword si_lqd(qword ra, int immediate) {
  return celltrace::sdk::load_quadword(si_to_uint(ra) + static_cast<unsigned int>(immediate));
}
inline qword si_lqx(qword ra, qword rb) {
  return celltrace::sdk::load_quadword(si_to_uint(ra) + si_to_uint(rb));
}
inline qword si_lqa(int immediate) {
  return celltrace::sdk::load_quadword(static_cast<unsigned int>(immediate));
}
inline void si_stqd(qword rt, qword ra, int immediate) {
  celltrace::sdk::store_quadword(rt, si_to_uint(ra) + static_cast<unsigned int>(immediate));
}
inline void si_stqx(qword rt, qword ra, qword rb) {
  celltrace::sdk::store_quadword(rt, si_to_uint(ra) + si_to_uint(rb));
}
inline void si_stqa(qword rt, int immediate) {
  celltrace::sdk::store_quadword(rt, static_cast<unsigned int>(immediate));
}

// --- special registers ---

inline qword si_fscrrd() {
  return celltrace::sdk::si(celltrace::isa::Opcode::fscrrd, qword{}, qword{}, qword{}, 0);
}
inline void si_fscrwr(qword ra) {
  celltrace::sdk::si(celltrace::isa::Opcode::fscrwr, ra, qword{}, qword{}, 0);
}
/// Returns 0: no special-purpose register is defined.
inline qword si_mfspr(int) {
  return qword{};
}
inline void si_mtspr(int, qword) {
}

// --- instructions that only take time, or only order accesses that the emulated Cell does in order anyway
// ---

inline void si_nop() {
}
inline void si_lnop() {
}
inline void si_sync() {
}
inline void si_syncc() {
}
inline void si_dsync() {
}

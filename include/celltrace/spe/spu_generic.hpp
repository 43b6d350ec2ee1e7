// The generic intrinsics (spu_*) of the C/C++ Language Extensions for Cell that compute: each is one name for
// the instructions of all element types. A scalar in place of a vector stands for all elements. Results are
// exactly the SPU's (spu_instructions.hpp).
#pragma once

#include "celltrace/spe/spu_specific.hpp"

#include <concepts>
#include <type_traits>

namespace celltrace::sdk {

/// Returns the register of an operand: of a vector, or of a scalar that is repeated in every element of type
/// T.
template <class T, class Operand> Quadword operand(const Operand& given) {
  if constexpr (AnyVector<Operand>) {
    static_assert(sizeof(ElementOf<Operand>) == sizeof(T), "operands have elements of one size");
    return VectorOf<Operand>(given).quadword();
  } else {
    static_assert(std::is_arithmetic_v<Operand> || std::is_enum_v<Operand>, "a vector or a number");
    Vector<T> all;
    for (unsigned i = 0; i < Vector<T>::kElements; ++i)
      all[i] = static_cast<T>(given);
    return all.quadword();
  }
}
template <AnyVector V> Quadword register_of(const V& v) {
  return VectorOf<V>(v).quadword();
}
/// Returns a register with a count or mask in its preferred slot.
inline Quadword preferred(unsigned int word) {
  Quadword q = Quadword::zero();
  q.set(0, word);
  return q;
}

/// Executes an instruction with one operand; `Result` is the type of the elements.
template <class Result> Vector<Result> unary(Opcode opcode, const Quadword& a, int immediate = 0) {
  return Vector<Result>(execute(opcode, a, Quadword::zero(), Quadword::zero(), immediate));
}
template <class Result> Vector<Result> binary(Opcode opcode, const Quadword& a, const Quadword& b) {
  return Vector<Result>(execute(opcode, a, b, Quadword::zero(), 0));
}
template <class Result>
Vector<Result> ternary(Opcode opcode, const Quadword& a, const Quadword& b, const Quadword& c) {
  return Vector<Result>(execute(opcode, a, b, c, 0));
}

/// Returns the instruction for elements of T.
template <OpcodeByElement by, class T> constexpr Opcode opcode_for() {
  constexpr Opcode opcode = by.of<T>();
  static_assert(opcode != Opcode::stop, "there is no such operation on elements of this type");
  return opcode;
}
template <class T> constexpr bool is_unsigned = std::is_unsigned_v<T>;

/// The element type of the masks that compares return.
template <class T>
using MaskOf = std::conditional_t<
    sizeof(T) == 1, unsigned char,
    std::conditional_t<sizeof(T) == 2, unsigned short,
                       std::conditional_t<sizeof(T) == 4, unsigned int, unsigned long long>>>;

template <class T, class... Us> constexpr bool is_one_of = (std::is_same_v<T, Us> || ...);

} // namespace celltrace::sdk

// --- constants, elements ---

template <class Scalar>
requires std::is_arithmetic_v<Scalar>
auto spu_splats(Scalar scalar) {
  typename celltrace::sdk::VectorForScalar<Scalar>::type all;
  for (unsigned i = 0; i < all.kElements; ++i)
    all[i] = static_cast<typename decltype(all)::value_type>(scalar);
  return all;
}
/// Returns an element of `v`; `element` is taken modulo the number of elements.
template <celltrace::sdk::AnyVector V> celltrace::sdk::ElementOf<V> spu_extract(const V& v, int element) {
  using Elements = celltrace::sdk::VectorOf<V>;
  return Elements(v)[static_cast<unsigned>(element) % Elements::kElements];
}
template <class Scalar, celltrace::sdk::AnyVector V>
celltrace::sdk::VectorOf<V> spu_insert(Scalar scalar, const V& v, int element) {
  celltrace::sdk::VectorOf<V> result(v);
  result[static_cast<unsigned>(element) % result.kElements] =
      static_cast<celltrace::sdk::ElementOf<V>>(scalar);
  return result;
}
/// Returns a vector with one element; the other elements, which are undefined on the SPU, are 0.
template <class Scalar>
requires std::is_arithmetic_v<Scalar>
auto spu_promote(Scalar scalar, int element) {
  return spu_insert(scalar, typename celltrace::sdk::VectorForScalar<Scalar>::type{}, element);
}

// --- conversions ---

template <celltrace::sdk::AnyVector V> vec_float4 spu_convtf(const V& a, int scale) {
  using T = celltrace::sdk::ElementOf<V>;
  static_assert(celltrace::sdk::is_one_of<T, int, unsigned int>, "converts from integers");
  using celltrace::isa::Opcode;
  return celltrace::sdk::unary<float>(celltrace::sdk::is_unsigned<T> ? Opcode::cuflt : Opcode::csflt,
                                      celltrace::sdk::register_of(a), scale);
}
inline vec_int4 spu_convts(const vec_float4& a, int scale) {
  return celltrace::sdk::unary<int>(celltrace::isa::Opcode::cflts, a.quadword(), scale);
}
inline vec_uint4 spu_convtu(const vec_float4& a, int scale) {
  return celltrace::sdk::unary<unsigned int>(celltrace::isa::Opcode::cfltu, a.quadword(), scale);
}
/// Returns wider elements: of a vec_float4, elements 0 and 2; of integers, the lower half of each wider
/// element, sign-extended.
template <celltrace::sdk::AnyVector V> auto spu_extend(const V& a) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  static_assert(is_one_of<T, float, signed char, short, int>, "extends signed integers and float");
  if constexpr (std::is_same_v<T, float>)
    return unary<double>(Opcode::fesd, register_of(a));
  else if constexpr (sizeof(T) == 1)
    return unary<short>(Opcode::xsbh, register_of(a));
  else if constexpr (sizeof(T) == 2)
    return unary<int>(Opcode::xshw, register_of(a));
  else
    return unary<long long>(Opcode::xswd, register_of(a));
}
/// Rounds to single precision, into elements 0 and 2.
inline vec_float4 spu_roundtf(const vec_double2& a) {
  return celltrace::sdk::unary<float>(celltrace::isa::Opcode::frds, a.quadword());
}

// --- arithmetic ---

template <celltrace::sdk::AnyVector V, class B> celltrace::sdk::VectorOf<V> spu_add(const V& a, const B& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kAdd{
      .halfword = Opcode::ah, .word = Opcode::a, .single = Opcode::fa, .doubleword = Opcode::dfa};
  return binary<T>(opcode_for<kAdd, T>(), register_of(a), operand<T>(b));
}
/// Returns a - b; one operand may be a scalar.
template <class A, class B>
requires celltrace::sdk::AnyVector<A> || celltrace::sdk::AnyVector<B>
auto spu_sub(const A& a, const B& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<std::conditional_t<AnyVector<A>, A, B>>;
  if constexpr (std::is_floating_point_v<T>)
    return binary<T>(sizeof(T) == 4 ? Opcode::fs : Opcode::dfs, operand<T>(a), operand<T>(b));
  else { // the instructions subtract the first operand from the second
    constexpr OpcodeByElement kSubtractFrom{.halfword = Opcode::sfh, .word = Opcode::sf};
    return binary<T>(opcode_for<kSubtractFrom, T>(), operand<T>(b), operand<T>(a));
  }
}

#define CELLTRACE_SPU_EXTENDED(name, opcode, first, second)                                                  \
  template <celltrace::sdk::AnyVector V>                                                                     \
  celltrace::sdk::VectorOf<V> name(const V& a, const std::type_identity_t<V>& b,                             \
                                   const std::type_identity_t<V>& c) {                                       \
    using namespace celltrace::sdk;                                                                          \
    static_assert(is_one_of<ElementOf<V>, int, unsigned int>, "works on words");                             \
    return ternary<ElementOf<V>>(Opcode::opcode, register_of(first), register_of(second), register_of(c));   \
  }
#define CELLTRACE_SPU_CARRY(name, opcode, first, second)                                                     \
  template <celltrace::sdk::AnyVector V>                                                                     \
  celltrace::sdk::VectorOf<V> name(const V& a, const std::type_identity_t<V>& b) {                           \
    using namespace celltrace::sdk;                                                                          \
    static_assert(is_one_of<ElementOf<V>, int, unsigned int>, "works on words");                             \
    return binary<ElementOf<V>>(Opcode::opcode, register_of(first), register_of(second));                    \
  }
CELLTRACE_SPU_EXTENDED(spu_addx, addx, a, b)
CELLTRACE_SPU_EXTENDED(spu_subx, sfx, b, a)
CELLTRACE_SPU_EXTENDED(spu_gencx, cgx, a, b)
CELLTRACE_SPU_EXTENDED(spu_genbx, bgx, b, a)
CELLTRACE_SPU_CARRY(spu_genc, cg, a, b)
CELLTRACE_SPU_CARRY(spu_genb, bg, b, a)
#undef CELLTRACE_SPU_EXTENDED
#undef CELLTRACE_SPU_CARRY

/// Returns a * b + c for floating point. For vec_short8, returns the products of the odd elements plus a
/// vec_int4.
template <celltrace::sdk::AnyVector V, celltrace::sdk::AnyVector W>
celltrace::sdk::VectorOf<W> spu_madd(const V& a, const std::type_identity_t<V>& b, const W& c) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  if constexpr (std::is_same_v<T, short>) {
    static_assert(std::is_same_v<ElementOf<W>, int>, "adds words to products of halfwords");
    return ternary<int>(Opcode::mpya, register_of(a), register_of(b), register_of(c));
  } else {
    static_assert(std::is_same_v<T, ElementOf<W>>, "operands of one type");
    constexpr OpcodeByElement kMultiplyAdd{.single = Opcode::fma, .doubleword = Opcode::dfma};
    return ternary<T>(opcode_for<kMultiplyAdd, T>(), register_of(a), register_of(b), register_of(c));
  }
}
/// Returns the products of the even elements plus `c`.
template <celltrace::sdk::AnyVector V, celltrace::sdk::AnyVector W>
celltrace::sdk::VectorOf<W> spu_mhhadd(const V& a, const std::type_identity_t<V>& b, const W& c) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  static_assert(is_one_of<T, short, unsigned short> && sizeof(ElementOf<W>) == 4,
                "adds words to products of halfwords");
  return ternary<ElementOf<W>>(is_unsigned<T> ? Opcode::mpyhhau : Opcode::mpyhha, register_of(a),
                               register_of(b), register_of(c));
}

#define CELLTRACE_SPU_FUSED(name, by_element)                                                                \
  template <celltrace::sdk::AnyVector V>                                                                     \
  celltrace::sdk::VectorOf<V> name(const V& a, const std::type_identity_t<V>& b,                             \
                                   const std::type_identity_t<V>& c) {                                       \
    using namespace celltrace::sdk;                                                                          \
    using T = ElementOf<V>;                                                                                  \
    constexpr OpcodeByElement kFused by_element;                                                             \
    return ternary<T>(opcode_for<kFused, T>(), register_of(a), register_of(b), register_of(c));              \
  }
#define CELLTRACE_ARGUMENTS(...) __VA_ARGS__
/// a * b - c.
CELLTRACE_SPU_FUSED(spu_msub, CELLTRACE_ARGUMENTS({.single = Opcode::fms, .doubleword = Opcode::dfms}))
/// c - a * b.
CELLTRACE_SPU_FUSED(spu_nmsub, CELLTRACE_ARGUMENTS({.single = Opcode::fnms, .doubleword = Opcode::dfnms}))
/// -(a * b + c).
CELLTRACE_SPU_FUSED(spu_nmadd, CELLTRACE_ARGUMENTS({.doubleword = Opcode::dfnma}))
#undef CELLTRACE_SPU_FUSED
#undef CELLTRACE_ARGUMENTS

template <celltrace::sdk::AnyVector V>
celltrace::sdk::VectorOf<V> spu_mul(const V& a, const std::type_identity_t<V>& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kMultiply{.single = Opcode::fm, .doubleword = Opcode::dfm};
  return binary<T>(opcode_for<kMultiply, T>(), register_of(a), register_of(b));
}

/// Returns the products of the even halfwords of a and the odd halfwords of b, shifted left by 16.
inline vec_int4 spu_mulh(const vec_short8& a, const vec_short8& b) {
  return celltrace::sdk::binary<int>(celltrace::isa::Opcode::mpyh, a.quadword(), b.quadword());
}
/// Returns the products of the odd halfwords, shifted right by 16.
inline vec_int4 spu_mulsr(const vec_short8& a, const vec_short8& b) {
  return celltrace::sdk::binary<int>(celltrace::isa::Opcode::mpys, a.quadword(), b.quadword());
}
/// Returns the products of the even halfwords.
template <celltrace::sdk::AnyVector V> auto spu_mule(const V& a, const std::type_identity_t<V>& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  static_assert(is_one_of<T, short, unsigned short>, "multiplies halfwords");
  using Product = std::conditional_t<is_unsigned<T>, unsigned int, int>;
  return binary<Product>(is_unsigned<T> ? Opcode::mpyhhu : Opcode::mpyhh, register_of(a), register_of(b));
}
/// Returns the products of the odd halfwords.
template <celltrace::sdk::AnyVector V, class B> auto spu_mulo(const V& a, const B& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  static_assert(is_one_of<T, short, unsigned short>, "multiplies halfwords");
  using Product = std::conditional_t<is_unsigned<T>, unsigned int, int>;
  return binary<Product>(is_unsigned<T> ? Opcode::mpyu : Opcode::mpy, register_of(a), operand<T>(b));
}

/// Return estimates of 1 / a and 1 / sqrt(|a|), good to 12 bits.
inline vec_float4 spu_re(const vec_float4& a) {
  const qword ra(a);
  return vec_float4(si_fi(ra, si_frest(ra)));
}
inline vec_float4 spu_rsqrte(const vec_float4& a) {
  const qword ra(a);
  return vec_float4(si_fi(ra, si_frsqest(ra)));
}

// --- bytes ---

inline vec_uchar16 spu_absd(const vec_uchar16& a, const vec_uchar16& b) {
  return celltrace::sdk::binary<unsigned char>(celltrace::isa::Opcode::absdb, a.quadword(), b.quadword());
}
inline vec_uchar16 spu_avg(const vec_uchar16& a, const vec_uchar16& b) {
  return celltrace::sdk::binary<unsigned char>(celltrace::isa::Opcode::avgb, a.quadword(), b.quadword());
}
/// Returns the sums of each four bytes: sums of b in the even halfwords, sums of a in the odd halfwords.
inline vec_ushort8 spu_sumb(const vec_uchar16& a, const vec_uchar16& b) {
  return celltrace::sdk::binary<unsigned short>(celltrace::isa::Opcode::sumb, a.quadword(), b.quadword());
}

// --- compares and halts ---

template <celltrace::sdk::AnyVector V, class B> auto spu_cmpeq(const V& a, const B& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kEqual{.byte = Opcode::ceqb,
                                   .halfword = Opcode::ceqh,
                                   .word = Opcode::ceq,
                                   .single = Opcode::fceq,
                                   .doubleword = Opcode::dfceq};
  return binary<MaskOf<T>>(opcode_for<kEqual, T>(), register_of(a), operand<T>(b));
}
template <celltrace::sdk::AnyVector V, class B> auto spu_cmpgt(const V& a, const B& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kSigned{.byte = Opcode::cgtb,
                                    .halfword = Opcode::cgth,
                                    .word = Opcode::cgt,
                                    .single = Opcode::fcgt,
                                    .doubleword = Opcode::dfcgt};
  constexpr OpcodeByElement kLogical{.byte = Opcode::clgtb, .halfword = Opcode::clgth, .word = Opcode::clgt};
  if constexpr (is_unsigned<T>)
    return binary<MaskOf<T>>(opcode_for<kLogical, T>(), register_of(a), operand<T>(b));
  else
    return binary<MaskOf<T>>(opcode_for<kSigned, T>(), register_of(a), operand<T>(b));
}
template <celltrace::sdk::AnyVector V> auto spu_cmpabseq(const V& a, const std::type_identity_t<V>& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kEqual{.single = Opcode::fcmeq, .doubleword = Opcode::dfcmeq};
  return binary<MaskOf<T>>(opcode_for<kEqual, T>(), register_of(a), register_of(b));
}
template <celltrace::sdk::AnyVector V> auto spu_cmpabsgt(const V& a, const std::type_identity_t<V>& b) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kGreater{.single = Opcode::fcmgt, .doubleword = Opcode::dfcmgt};
  return binary<MaskOf<T>>(opcode_for<kGreater, T>(), register_of(a), register_of(b));
}
/// Tests for special values; `tests` combines SPU_SV_NAN and the other SPU_SV constants.
inline vec_ullong2 spu_testsv(const vec_double2& a, int tests) {
  return celltrace::sdk::unary<unsigned long long>(celltrace::isa::Opcode::dftsv, a.quadword(), tests);
}
template <std::integral A, std::integral B> void spu_hcmpeq(A a, B b) {
  si_heq(si_from_uint(static_cast<unsigned int>(a)), si_from_uint(static_cast<unsigned int>(b)));
}
template <std::integral A, std::integral B> void spu_hcmpgt(A a, B b) {
  const qword ra = si_from_uint(static_cast<unsigned int>(a)),
              rb = si_from_uint(static_cast<unsigned int>(b));
  if constexpr (std::is_unsigned_v<A>)
    si_hlgt(ra, rb);
  else
    si_hgt(ra, rb);
}

// --- bits ---

/// Counts the ones in each byte.
template <celltrace::sdk::AnyVector V> vec_uchar16 spu_cntb(const V& a) {
  static_assert(sizeof(celltrace::sdk::ElementOf<V>) == 1, "counts in bytes");
  return celltrace::sdk::unary<unsigned char>(celltrace::isa::Opcode::cntb, celltrace::sdk::register_of(a));
}
template <celltrace::sdk::AnyVector V> vec_uint4 spu_cntlz(const V& a) {
  static_assert(sizeof(celltrace::sdk::ElementOf<V>) == 4, "counts in words");
  return celltrace::sdk::unary<unsigned int>(celltrace::isa::Opcode::clz, celltrace::sdk::register_of(a));
}
/// Gathers the lowest bits of all elements in element 0.
template <celltrace::sdk::AnyVector V> vec_uint4 spu_gather(const V& a) {
  using namespace celltrace::sdk;
  using T = ElementOf<V>;
  constexpr OpcodeByElement kGather{
      .byte = Opcode::gbb, .halfword = Opcode::gbh, .word = Opcode::gb, .single = Opcode::gb};
  return unary<unsigned int>(opcode_for<kGather, T>(), register_of(a));
}
template <std::integral Bits> vec_uchar16 spu_maskb(Bits bits) {
  return celltrace::sdk::unary<unsigned char>(celltrace::isa::Opcode::fsmb,
                                              celltrace::sdk::preferred(static_cast<unsigned int>(bits)));
}
template <std::integral Bits> vec_ushort8 spu_maskh(Bits bits) {
  return celltrace::sdk::unary<unsigned short>(celltrace::isa::Opcode::fsmh,
                                               celltrace::sdk::preferred(static_cast<unsigned int>(bits)));
}
template <std::integral Bits> vec_uint4 spu_maskw(Bits bits) {
  return celltrace::sdk::unary<unsigned int>(celltrace::isa::Opcode::fsm,
                                             celltrace::sdk::preferred(static_cast<unsigned int>(bits)));
}
/// Returns the bits of b where the mask has a 1, else the bits of a.
template <celltrace::sdk::AnyVector V, celltrace::sdk::AnyVector Mask>
celltrace::sdk::VectorOf<V> spu_sel(const V& a, const std::type_identity_t<V>& b, const Mask& mask) {
  using namespace celltrace::sdk;
  return ternary<ElementOf<V>>(Opcode::selb, register_of(a), register_of(b), register_of(mask));
}
template <celltrace::sdk::AnyVector V>
celltrace::sdk::VectorOf<V> spu_shuffle(const V& a, const std::type_identity_t<V>& b,
                                        const vec_uchar16& pattern) {
  using namespace celltrace::sdk;
  return ternary<ElementOf<V>>(Opcode::shufb, register_of(a), register_of(b), pattern.quadword());
}

// --- logic ---

#define CELLTRACE_SPU_LOGIC(name, opcode)                                                                    \
  template <celltrace::sdk::AnyVector V, class B> celltrace::sdk::VectorOf<V> name(const V& a, const B& b) { \
    using namespace celltrace::sdk;                                                                          \
    using T = ElementOf<V>;                                                                                  \
    return binary<T>(Opcode::opcode, register_of(a), operand<T>(b));                                         \
  }
CELLTRACE_SPU_LOGIC(spu_and, and_)
CELLTRACE_SPU_LOGIC(spu_andc, andc)
CELLTRACE_SPU_LOGIC(spu_eqv, eqv)
CELLTRACE_SPU_LOGIC(spu_nand, nand)
CELLTRACE_SPU_LOGIC(spu_nor, nor)
CELLTRACE_SPU_LOGIC(spu_or, or_)
CELLTRACE_SPU_LOGIC(spu_orc, orc)
CELLTRACE_SPU_LOGIC(spu_xor, xor_)
#undef CELLTRACE_SPU_LOGIC
/// Returns the OR of all words in element 0.
template <celltrace::sdk::AnyVector V> celltrace::sdk::VectorOf<V> spu_orx(const V& a) {
  static_assert(celltrace::sdk::is_one_of<celltrace::sdk::ElementOf<V>, int, unsigned int>, "works on words");
  return celltrace::sdk::unary<celltrace::sdk::ElementOf<V>>(celltrace::isa::Opcode::orx,
                                                             celltrace::sdk::register_of(a));
}

// --- shifts and rotates of elements ---

// Counts that are too large shift all bits out. spu_rlmask() and spu_rlmaska() shift right by the negated
// count.
#define CELLTRACE_SPU_SHIFT(name, of_halfwords, of_words, sign)                                              \
  template <celltrace::sdk::AnyVector V, class Count>                                                        \
  celltrace::sdk::VectorOf<V> name(const V& a, const Count& count) {                                         \
    using namespace celltrace::sdk;                                                                          \
    using T = ElementOf<V>;                                                                                  \
    constexpr OpcodeByElement kShift{.halfword = Opcode::of_halfwords, .word = Opcode::of_words};            \
    const Vector<T> counts(operand<T>(count));                                                               \
    return binary<T>(opcode_for<kShift, T>(), register_of(a), (sign counts).quadword());                     \
  }
#define CELLTRACE_SAME
CELLTRACE_SPU_SHIFT(spu_rl, roth, rot, CELLTRACE_SAME)
CELLTRACE_SPU_SHIFT(spu_rlmask, rothm, rotm, CELLTRACE_SAME)
CELLTRACE_SPU_SHIFT(spu_rlmaska, rotmah, rotma, CELLTRACE_SAME)
CELLTRACE_SPU_SHIFT(spu_sl, shlh, shl, CELLTRACE_SAME)
CELLTRACE_SPU_SHIFT(spu_sr, rothm, rotm, -)
CELLTRACE_SPU_SHIFT(spu_sra, rotmah, rotma, -)
#undef CELLTRACE_SPU_SHIFT
#undef CELLTRACE_SAME

// --- shifts and rotates of the quadword ---

// Shifts by bits use only the low three bits of the count; shifts by "bytes from bit shift count" use the
// bits above these.
#define CELLTRACE_SPU_QUADWORD(name, opcode, of_count)                                                       \
  template <celltrace::sdk::AnyVector V> celltrace::sdk::VectorOf<V> name(const V& a, int count) {           \
    using namespace celltrace::sdk;                                                                          \
    return binary<ElementOf<V>>(Opcode::opcode, register_of(a),                                              \
                                preferred(of_count static_cast<unsigned int>(count)));                       \
  }
#define CELLTRACE_COUNT
#define CELLTRACE_RIGHT 0u -
CELLTRACE_SPU_QUADWORD(spu_rlqw, rotqbi, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_rlqwbyte, rotqby, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_rlqwbytebc, rotqbybi, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_rlmaskqw, rotqmbi, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_rlmaskqwbyte, rotqmby, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_rlmaskqwbytebc, rotqmbybi, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_slqw, shlqbi, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_slqwbyte, shlqby, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_slqwbytebc, shlqbybi, CELLTRACE_COUNT)
CELLTRACE_SPU_QUADWORD(spu_srqw, rotqmbi, CELLTRACE_RIGHT)
CELLTRACE_SPU_QUADWORD(spu_srqwbyte, rotqmby, CELLTRACE_RIGHT)
// The instruction negates the count and rounds it down to bytes: 7 - count makes it shift by count / 8 bytes.
CELLTRACE_SPU_QUADWORD(spu_srqwbytebc, rotqmbybi, 7u -)
#undef CELLTRACE_SPU_QUADWORD
#undef CELLTRACE_COUNT
#undef CELLTRACE_RIGHT

// --- the floating-point status ---

inline vec_uint4 spu_mffpscr() {
  return vec_uint4(si_fscrrd());
}
template <celltrace::sdk::AnyVector V> void spu_mtfpscr(const V& status) {
  si_fscrwr(qword(celltrace::sdk::VectorOf<V>(status)));
}

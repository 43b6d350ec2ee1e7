// Every spu_ function against instructions on the simulated SPU.
#include "celltrace/spe/spu_intrinsics.hpp"
#include "sdk/simulated_instruction.hpp"

#include <catch2/catch.hpp>

#include <type_traits>

namespace celltrace::test {
namespace {

struct Row {
  const char* call;
  Code code;
  qword (*function)(const Operands&);
};

// --- code: rt from ra, rb and rc ---

Code ab(const char* mnemonic) {
  return Code().add(mnemonic, {.rt = kRt, .ra = kRa, .rb = kRb, .rc = kRc});
}
/// The instruction takes them the other way round.
Code ba(const char* mnemonic) {
  return Code().add(mnemonic, {.rt = kRt, .ra = kRb, .rb = kRa});
}
Code with(const char* mnemonic, std::int32_t immediate) {
  return Code().add(mnemonic, {.rt = kRt, .ra = kRa, .immediate = immediate});
}
/// With `immediate - b` for b.
Code negated(const char* subtraction, const char* mnemonic, std::int32_t immediate = 0) {
  return Code()
      .add(subtraction, {.rt = kRb, .ra = kRb, .immediate = immediate})
      .add(mnemonic, {.rt = kRt, .ra = kRa, .rb = kRb});
}
Code estimate(const char* mnemonic) {
  return Code().add(mnemonic, {.rt = kRt, .ra = kRa}).add("fi", {.rt = kRt, .ra = kRa, .rb = kRt});
}

// clang-format off
#define ROW(call, code) {#call, code, [](const Operands& o) { return of(o, [](const auto& a, const auto& b, const auto& c, int n, unsigned u) { \
  (void)a; (void)b; (void)c; (void)n; (void)u; return call; }); }},
// clang-format on

/// An operand that is a vector of any type.
struct Any {
  const qword& value;
  template <class T> operator sdk::Vector<T>() const { return sdk::Vector<T>(value); }
  vec_uchar16 uchar() const { return vec_uchar16(value); }
  vec_char16 schar() const { return vec_char16(value); }
  vec_ushort8 ushort() const { return vec_ushort8(value); }
  vec_short8 sshort() const { return vec_short8(value); }
  vec_uint4 uint() const { return vec_uint4(value); }
  vec_int4 sint() const { return vec_int4(value); }
  vec_ullong2 ullong() const { return vec_ullong2(value); }
  vec_llong2 sllong() const { return vec_llong2(value); }
  vec_float4 single() const { return vec_float4(value); }
  vec_double2 dbl() const { return vec_double2(value); }
};

/// `n`, `u`: the preferred word of b, and of a.
template <class F> qword of(const Operands& o, F f) {
  return qword(f(Any{o.a}, Any{o.b}, Any{o.c}, si_to_int(o.b), si_to_uint(o.a)));
}

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      // arithmetic
      ROW(spu_add(a.sshort(), b.sshort()), ab("ah")) ROW(spu_add(a.ushort(), b.ushort()), ab("ah")) ROW(
          spu_add(a.sint(), b.sint()), ab("a")) ROW(spu_add(a.uint(), b.uint()),
                                                    ab("a")) ROW(spu_add(a.single(), b.single()), ab("fa"))
          ROW(spu_add(a.dbl(), b.dbl()), ab("dfa")) ROW(spu_add(a.sint(), -7), with("ai", -7)) ROW(
              spu_add(a.ushort(), -7), with("ahi", -7)) ROW(spu_sub(a.sshort(), b.sshort()), ba("sfh"))
              ROW(spu_sub(a.uint(), b.uint()), ba("sf")) ROW(spu_sub(a.single(), b.single()), ab("fs"))
                  ROW(spu_sub(a.dbl(), b.dbl()), ab("dfs")) ROW(spu_sub(100, a.sint()), with("sfi", 100)) ROW(
                      spu_sub(100, a.sshort()), with("sfhi", 100)) ROW(spu_sub(a.uint(), 7u), with("ai", -7))
                      ROW(spu_addx(a.sint(), b.sint(), c.sint()), ab("addx")) ROW(
                          spu_subx(a.uint(), b.uint(), c.uint()),
                          ba("sfx")) ROW(spu_genc(a.uint(), b.uint()),
                                         ab("cg")) ROW(spu_genb(a.sint(), b.sint()), ba("bg"))
                          ROW(spu_gencx(a.uint(), b.uint(), c.uint()), ab("cgx")) ROW(
                              spu_genbx(a.sint(), b.sint(), c.sint()),
                              ba("bgx")) ROW(spu_madd(a.single(), b.single(), c.single()),
                                             ab("fma")) ROW(spu_madd(a.dbl(), b.dbl(), c.dbl()), ab("dfma"))
                              ROW(spu_madd(a.sshort(), b.sshort(), c.sint()),
                                  ab("mpya")) ROW(spu_mhhadd(a.sshort(), b.sshort(), c.sint()), ab("mpyhha"))
                                  ROW(spu_mhhadd(a.ushort(), b.ushort(), c.uint()), ab("mpyhhau")) ROW(
                                      spu_msub(a.single(), b.single(), c.single()),
                                      ab("fms")) ROW(spu_msub(a.dbl(), b.dbl(), c.dbl()), ab("dfms"))
                                      ROW(spu_nmsub(a.single(), b.single(), c.single()),
                                          ab("fnms")) ROW(spu_nmsub(a.dbl(), b.dbl(), c.dbl()), ab("dfnms"))
                                          ROW(spu_nmadd(a.dbl(), b.dbl(), c.dbl()), ab("dfnma")) ROW(
                                              spu_mul(a.single(), b.single()),
                                              ab("fm")) ROW(spu_mul(a.dbl(), b.dbl()), ab("dfm"))
                                              ROW(spu_mulh(a.sshort(), b.sshort()), ab("mpyh")) ROW(
                                                  spu_mulsr(a.sshort(), b.sshort()), ab("mpys"))
                                                  ROW(spu_mule(a.sshort(), b.sshort()), ab("mpyhh")) ROW(
                                                      spu_mule(a.ushort(), b.ushort()), ab("mpyhhu"))
                                                      ROW(spu_mulo(a.sshort(), b.sshort()), ab("mpy")) ROW(
                                                          spu_mulo(a.ushort(), b.ushort()), ab("mpyu"))
                                                          ROW(spu_mulo(a.sshort(), -100), with("mpyi", -100))
                                                              ROW(spu_mulo(a.ushort(), 100),
                                                                  with("mpyui", 100))
                                                                  ROW(spu_re(a.single()), estimate("frest"))
                                                                      ROW(spu_rsqrte(a.single()),
                                                                          estimate("frsqest"))
      // operators
      ROW(a.single() + b.single(), ab("fa")) ROW(a.single() - b.single(), ab("fs"))
          ROW(a.single() * b.single(), ab("fm")) ROW(a.dbl() - b.dbl(), ab("dfs"))
              ROW(a.sint() - b.sint(), ba("sf")) ROW(a.ushort() + b.ushort(), ab("ah"))
                  ROW(a.uchar() & b.uchar(), ab("and")) ROW(a.single() | b.single(), ab("or"))
                      ROW(a.sllong() ^ b.sllong(), ab("xor"))
                          ROW(~a.sint(), Code().add("nor", {.rt = kRt, .ra = kRa, .rb = kRa}))
                              ROW(-a.sint(), with("sfi", 0))
      // conversions
      ROW(spu_convtf(a.sint(), 0), with("csflt", 155)) ROW(spu_convtf(a.uint(), 13), with("cuflt", 142))
          ROW(spu_convts(a.single(), 0), with("cflts", 173))
              ROW(spu_convtu(a.single(), 16), with("cfltu", 157)) ROW(spu_extend(a.single()), ab("fesd"))
                  ROW(spu_extend(a.schar()), ab("xsbh")) ROW(spu_extend(a.sshort()), ab("xshw"))
                      ROW(spu_extend(a.sint()), ab("xswd")) ROW(spu_roundtf(a.dbl()), ab("frds"))
      // bytes
      ROW(spu_absd(a.uchar(), b.uchar()), ab("absdb")) ROW(spu_avg(a.uchar(), b.uchar()), ab("avgb"))
          ROW(spu_sumb(a.uchar(), b.uchar()), ab("sumb"))
      // compares
      ROW(spu_cmpeq(a.schar(), b.schar()), ab("ceqb")) ROW(spu_cmpeq(a.ushort(), b.ushort()), ab("ceqh")) ROW(
          spu_cmpeq(a.uint(), b.uint()), ab("ceq")) ROW(spu_cmpeq(a.single(), b.single()), ab("fceq"))
          ROW(spu_cmpeq(a.dbl(), b.dbl()), ab("dfceq")) ROW(spu_cmpeq(a.sint(), -1), with("ceqi", -1)) ROW(
              spu_cmpeq(a.uchar(), 0x80),
              with("ceqbi", 0x80)) ROW(spu_cmpgt(a.schar(), b.schar()),
                                       ab("cgtb")) ROW(spu_cmpgt(a.uchar(), b.uchar()), ab("clgtb"))
              ROW(spu_cmpgt(a.sshort(), b.sshort()),
                  ab("cgth")) ROW(spu_cmpgt(a.ushort(), b.ushort()), ab("clgth"))
                  ROW(spu_cmpgt(a.sint(), b.sint()), ab("cgt")) ROW(spu_cmpgt(a.uint(), b.uint()), ab("clgt"))
                      ROW(spu_cmpgt(a.single(), b.single()), ab("fcgt"))
                          ROW(spu_cmpgt(a.dbl(), b.dbl()), ab("dfcgt"))
                              ROW(spu_cmpgt(a.sint(), -3), with("cgti", -3))
                                  ROW(spu_cmpgt(a.uint(), 3), with("clgti", 3))
                                      ROW(spu_cmpabseq(a.single(), b.single()), ab("fcmeq"))
                                          ROW(spu_cmpabseq(a.dbl(), b.dbl()), ab("dfcmeq"))
                                              ROW(spu_cmpabsgt(a.single(), b.single()), ab("fcmgt"))
                                                  ROW(spu_cmpabsgt(a.dbl(), b.dbl()), ab("dfcmgt"))
                                                      ROW(spu_testsv(a.dbl(), SPU_SV_NAN | SPU_SV_POS_ZERO),
                                                          with("dftsv", 0x48))
      // bits
      ROW(spu_cntb(a.uchar()), ab("cntb")) ROW(spu_cntlz(a.sint()), ab("clz")) ROW(
          spu_cntlz(a.single()), ab("clz")) ROW(spu_gather(a.uchar()), ab("gbb"))
          ROW(spu_gather(a.sshort()), ab("gbh")) ROW(spu_gather(a.uint()), ab("gb")) ROW(
              spu_gather(a.single()), ab("gb")) ROW(spu_maskb(u), ab("fsmb")) ROW(spu_maskh(u), ab("fsmh"))
              ROW(spu_maskw(u), ab("fsm")) ROW(spu_sel(a.single(), b.single(), c.uint()), ab("selb"))
                  ROW(spu_sel(a.dbl(), b.dbl(), c.ullong()),
                      ab("selb")) ROW(spu_sel(a.uchar(), b.uchar(), c.uchar()), ab("selb"))
                      ROW(spu_shuffle(a.single(), b.single(), c.uchar()),
                          ab("shufb")) ROW(spu_shuffle(a.ushort(), b.ushort(), c.uchar()), ab("shufb"))
                          ROW(spu_shuffle(a.uchar(), b.uchar(), c.uchar()),
                              ab("shufb")) ROW(spu_and(a.sint(), b.sint()),
                                               ab("and")) ROW(spu_and(a.uint(), 255), with("andi", 255))
                              ROW(spu_and(a.uchar(), 0x0F), with("andbi", 0x0F))
                                  ROW(spu_andc(a.dbl(), b.dbl()), ab("andc"))
                                      ROW(spu_eqv(a.uchar(), b.uchar()), ab("eqv"))
                                          ROW(spu_nand(a.single(), b.single()), ab("nand"))
                                              ROW(spu_nor(a.ullong(), b.ullong()), ab("nor"))
                                                  ROW(spu_or(a.sshort(), b.sshort()), ab("or"))
                                                      ROW(spu_or(a.sint(), -2), with("ori", -2))
                                                          ROW(spu_orc(a.sint(), b.sint()), ab("orc"))
                                                              ROW(spu_xor(a.single(), b.single()), ab("xor"))
                                                                  ROW(spu_xor(a.ushort(), 0x100),
                                                                      with("xorhi", 0x100))
                                                                      ROW(spu_orx(a.uint()), ab("orx"))
      // shifts and rotates of elements
      ROW(spu_rl(a.sshort(), b.sshort()), ab("roth")) ROW(spu_rl(a.uint(), b.sint()), ab("rot"))
          ROW(spu_rl(a.sint(), 5), with("roti", 5)) ROW(spu_rlmask(a.ushort(), b.sshort()), ab("rothm"))
              ROW(spu_rlmask(a.sint(), b.sint()), ab("rotm")) ROW(spu_rlmask(a.sint(), -5), with("rotmi", -5))
                  ROW(spu_rlmaska(a.sshort(), b.sshort()), ab("rotmah"))
                      ROW(spu_rlmaska(a.uint(), b.sint()), ab("rotma"))
                          ROW(spu_rlmaska(a.sint(), -5), with("rotmai", -5))
                              ROW(spu_sl(a.ushort(), b.ushort()), ab("shlh"))
                                  ROW(spu_sl(a.sint(), b.uint()), ab("shl")) ROW(spu_sl(a.sint(), 31),
                                                                                 with("shli", 31))
                                      ROW(spu_sr(a.ushort(), b.ushort()), negated("sfhi", "rothm"))
                                          ROW(spu_sr(a.uint(), b.uint()), negated("sfi", "rotm"))
                                              ROW(spu_sra(a.sshort(), b.sshort()), negated("sfhi", "rotmah"))
                                                  ROW(spu_sra(a.sint(), b.sint()), negated("sfi", "rotma"))
                                                      ROW(spu_sra(a.sint(), 5), with("rotmai", -5))
      // of the quadword
      ROW(spu_rlqw(a.uint(), n), ab("rotqbi")) ROW(spu_rlqwbyte(a.single(), n), ab("rotqby"))
          ROW(spu_rlqwbytebc(a.uchar(), n), ab("rotqbybi")) ROW(spu_rlmaskqw(a.uint(), n), ab("rotqmbi"))
              ROW(spu_rlmaskqwbyte(a.sshort(), n), ab("rotqmby"))
                  ROW(spu_rlmaskqwbytebc(a.dbl(), n), ab("rotqmbybi"))
                      ROW(spu_slqw(a.uint(), n), ab("shlqbi")) ROW(spu_slqwbyte(a.single(), n), ab("shlqby"))
                          ROW(spu_slqwbytebc(a.uchar(), n), ab("shlqbybi"))
                              ROW(spu_srqw(a.uint(), n), negated("sfi", "rotqmbi"))
                                  ROW(spu_srqwbyte(a.single(), n), negated("sfi", "rotqmby"))
                                      ROW(spu_srqwbytebc(a.uchar(), n), negated("sfi", "rotqmbybi", 7))};
  return all;
}

TEST_CASE("every spu_ function and operator computes what the simulated SPU does") {
  std::vector<Code> codes;
  for (const Row& row : rows())
    codes.push_back(row.code);
  const std::vector<Results> all = execute_simulated(codes);
  for (std::size_t number = 0; number < codes.size(); ++number) {
    const Row& row = rows()[number];
    const Results& expected = all[number];
    unsigned differing = 0;
    for (std::size_t i = 0; i < operand_sets().size(); ++i) {
      const Operands& operands = operand_sets()[i];
      const qword result = row.function(operands);
      if (result.quadword() == expected.rt[i].quadword()) continue;
      ++differing;
      UNSCOPED_INFO(text_of(operands.a)
                    << " | " << text_of(operands.b) << " | " << text_of(operands.c) << " -> "
                    << text_of(result) << " and not " << text_of(expected.rt[i]));
    }
    INFO(row.call);
    CHECK(differing == 0);
  }
}

// --- the types ---

#define SAME_TYPE(expression, type) STATIC_REQUIRE(std::is_same_v<decltype(expression), type>)

TEST_CASE("intrinsics give the types of the language extension") {
  SAME_TYPE(spu_splats(1.0f), vec_float4);
  SAME_TYPE(spu_splats(1.0), vec_double2);
  SAME_TYPE(spu_splats(1), vec_int4);
  SAME_TYPE(spu_splats(1u), vec_uint4);
  SAME_TYPE(spu_splats(static_cast<short>(1)), vec_short8);
  SAME_TYPE(spu_splats(static_cast<unsigned char>(1)), vec_uchar16);
  SAME_TYPE(spu_splats('a'), vec_uchar16);
  SAME_TYPE(spu_splats(1ull), vec_ullong2);
  SAME_TYPE(spu_cmpgt(vec_float4{}, vec_float4{}), vec_uint4);
  SAME_TYPE(spu_cmpgt(vec_short8{}, 1), vec_ushort8);
  SAME_TYPE(spu_cmpeq(vec_double2{}, vec_double2{}), vec_ullong2);
  SAME_TYPE(spu_mulo(vec_ushort8{}, vec_ushort8{}), vec_uint4);
  SAME_TYPE(spu_extend(vec_float4{}), vec_double2);
  SAME_TYPE(spu_extract(vec_uchar16{}, 0), unsigned char);
  SAME_TYPE(spu_promote(1.0f, 0), vec_float4);
  STATIC_REQUIRE(sizeof(vec_float4) == 16);
  STATIC_REQUIRE(alignof(vec_uchar16) == 16);
  STATIC_REQUIRE(std::is_trivial_v<vec_int4>);
}

TEST_CASE("elements are numbered from the lowest address, and casts keep the register") {
  const vec_float4 v = {1, 2, 3, 4};
  CHECK(v[0] == 1);
  CHECK(spu_extract(v, 3) == 4);
  CHECK(spu_extract(v, 5) == 2);
  CHECK(reinterpret_cast<const float*>(&v)[1] == 2);
  CHECK(spu_extract(vec_uchar16(vec_uint4{0x01020304, 0, 0, 0x0D0E0F10}), 1) == 2);
  CHECK(spu_extract(vec_uchar16(vec_uint4{0x01020304, 0, 0, 0x0D0E0F10}), 15) == 0x10);
  CHECK(spu_extract(vec_ushort8(vec_float4{1, 0, 0, 0}), 0) == 0x3F80);
  CHECK(spu_extract(vec_ullong2(vec_uint4{1, 2, 3, 4}), 1) == 0x0000000300000004u);
  CHECK(spu_extract(spu_insert(9, vec_int4{1, 2, 3, 4}, 2), 2) == 9);
  CHECK(spu_extract(spu_insert(9, vec_int4{1, 2, 3, 4}, 2), 3) == 4);
  CHECK(spu_extract(spu_promote(7.0f, 2), 2) == 7);
  CHECK(spu_extract(spu_splats(static_cast<short>(-3)), 7) == -3);
  const vec_int4 short_list = {5};
  CHECK(short_list[0] == 5);
  CHECK(short_list[3] == 0);
  const vec_uint4 from_negative = {-1, 0x80000000, 0, 0};
  CHECK(from_negative[0] == 0xFFFFFFFF);
  CHECK_THROWS_AS((vec_double2{1, 2, 3}), std::length_error);
  CHECK((vec_char16{1} + vec_char16{127})[0] == -128);
  CHECK((vec_llong2{1, 2} - vec_llong2{3, 1})[0] == -2);
  CHECK((vec_int4{65537, -3} * vec_int4{65537, 5})[0] == 131073);
  CHECK((-vec_float4{0, 1, -2, 3})[2] == 2);
  CHECK(vec_uint4(-vec_float4{})[0] == 0x80000000);
}

TEST_CASE("the compilers' vectors and the SDK's stand for each other") {
  using Floats __attribute__((vector_size(16))) = float;
  using Bytes __attribute__((vector_size(16))) = unsigned char;
  const Floats native = {1, 2, 3, 4};
  const vec_float4 v = native;
  CHECK(v[2] == 3);
  const Floats sum = spu_add(native, v);
  CHECK(sum[3] == 8);
  CHECK(spu_madd(native, v, native)[1] == 6);
  CHECK(spu_extract(native, 1) == 2);
  const auto bytes = (Bytes)vec_uint4{0x01020304, 0, 0, 0};
  CHECK(bytes[0] == 1);
  CHECK(vec_uint4(bytes)[0] == 0x01020304);
}

TEST_CASE("scalars lie in the preferred slot") {
  CHECK(text_of(si_from_uchar(0xAB)) == "000000ab 00000000 00000000 00000000");
  CHECK(text_of(si_from_short(-2)) == "0000fffe 00000000 00000000 00000000");
  CHECK(text_of(si_from_float(1)) == "3f800000 00000000 00000000 00000000");
  CHECK(text_of(si_from_double(1)) == "3ff00000 00000000 00000000 00000000");
  CHECK(text_of(si_from_llong(-2)) == "ffffffff fffffffe 00000000 00000000");
  const qword q(vec_uint4{0x11223384, 0x55667788, 0, 0});
  CHECK(si_to_char(q) == static_cast<signed char>(0x84));
  CHECK(si_to_uchar(q) == 0x84);
  CHECK(si_to_short(q) == 0x3384);
  CHECK(si_to_ushort(q) == 0x3384);
  CHECK(si_to_uint(q) == 0x11223384);
  CHECK(si_to_int(q) == 0x11223384);
  CHECK(si_to_ullong(q) == 0x1122338455667788);
  CHECK(si_to_llong(q) == 0x1122338455667788);
  CHECK(si_to_float(si_from_float(2.5f)) == 2.5f);
  CHECK(si_to_double(si_from_double(-2.5)) == -2.5);
}

} // namespace
} // namespace celltrace::test

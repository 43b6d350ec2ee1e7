/* The same source for the SPU's compiler and for the host's: what the generic intrinsics, some specific ones
 * and the operators on vectors give. On the SPU it is a program that takes operands from main memory at argp
 * until one set has a 0 in its fourth quadword, and puts the results of each set behind them. */
#include "every_intrinsic.h"

#include <spu_intrinsics.h>
#include <spu_mfcio.h>

#define GIVE(...) (results[count++] = (qword)(__VA_ARGS__))
/* Of a register with a scalar only the preferred slot is defined. */
#define GIVE_SCALAR(expression) GIVE(spu_splats(expression))

int every_intrinsic(qword* results, const qword* operands) {
  int count = 0;
  const vec_uchar16 ub = (vec_uchar16)operands[0], vb = (vec_uchar16)operands[1],
                    wb = (vec_uchar16)operands[2];
  const vec_char16 sb = (vec_char16)operands[0], tb = (vec_char16)operands[1];
  const vec_ushort8 uh = (vec_ushort8)operands[0], vh = (vec_ushort8)operands[1],
                    wh = (vec_ushort8)operands[2];
  const vec_short8 sh = (vec_short8)operands[0], th = (vec_short8)operands[1];
  const vec_uint4 u = (vec_uint4)operands[0], v = (vec_uint4)operands[1], w = (vec_uint4)operands[2];
  const vec_int4 s = (vec_int4)operands[0], t = (vec_int4)operands[1], r = (vec_int4)operands[2];
  const vec_ullong2 ul = (vec_ullong2)operands[0], vl = (vec_ullong2)operands[1],
                    wl = (vec_ullong2)operands[2];
  const vec_llong2 sl = (vec_llong2)operands[0], tl = (vec_llong2)operands[1];
  const vec_float4 f = (vec_float4)operands[0], g = (vec_float4)operands[1], h = (vec_float4)operands[2];
  const vec_double2 d = (vec_double2)operands[0], e = (vec_double2)operands[1], x = (vec_double2)operands[2];
  const int n = spu_extract(t, 0);
  const unsigned int m = spu_extract(v, 1);
  vec_float4 sum = f;
  vec_int4 total = s;

  GIVE(spu_splats(spu_extract(f, 1)));
  GIVE(spu_splats(spu_extract(d, 1)));
  GIVE(spu_splats(spu_extract(ub, 3)));
  GIVE(spu_splats(spu_extract(sb, 4)));
  GIVE(spu_splats(spu_extract(uh, 5)));
  GIVE(spu_splats(spu_extract(sh, 6)));
  GIVE(spu_splats(spu_extract(u, 2)));
  GIVE(spu_splats(spu_extract(s, 3)));
  GIVE(spu_splats(spu_extract(ul, 1)));
  GIVE(spu_splats(spu_extract(sl, 0)));
  GIVE(spu_insert(1.5f, f, 2));
  GIVE(spu_insert(2.5, d, 1));
  GIVE(spu_insert((unsigned char)7, ub, n));
  GIVE(spu_insert((short)-7, sh, m));
  GIVE(spu_insert(99, s, 3));
  GIVE_SCALAR(spu_extract(spu_promote(99, 3), 3));
  GIVE_SCALAR(spu_extract(spu_promote(1.5f, 1), 1));
  GIVE_SCALAR(spu_extract(s, n));
  GIVE_SCALAR(spu_extract(ub, m));
  GIVE_SCALAR(spu_extract(sh, n));

  GIVE(spu_convtf(s, 4));
  GIVE(spu_convtf(u, 0));
  GIVE(spu_convts(f, 0));
  GIVE(spu_convtu(f, 12));
  GIVE(spu_extend(f));
  GIVE(spu_extend(sb));
  GIVE(spu_extend(sh));
  GIVE(spu_extend(s));
  GIVE(spu_roundtf(d));

  GIVE(spu_add(s, t));
  GIVE(spu_add(u, v));
  GIVE(spu_add(sh, th));
  GIVE(spu_add(uh, vh));
  GIVE(spu_add(s, 500));
  GIVE(spu_add(s, 50000));
  GIVE(spu_add(sh, -3));
  GIVE(spu_add(f, g));
  GIVE(spu_add(d, e));
  GIVE(spu_sub(s, t));
  GIVE(spu_sub(uh, vh));
  GIVE(spu_sub(17, s));
  GIVE(spu_sub(f, g));
  GIVE(spu_sub(d, e));
  GIVE(spu_addx(s, t, r));
  GIVE(spu_subx(u, v, w));
  GIVE(spu_genc(u, v));
  GIVE(spu_genb(u, v));
  GIVE(spu_gencx(u, v, w));
  GIVE(spu_genbx(u, v, w));
  GIVE(spu_madd(f, g, h));
  GIVE(spu_madd(d, e, x));
  GIVE(spu_madd(sh, th, r));
  GIVE(spu_mhhadd(sh, th, r));
  GIVE(spu_mhhadd(uh, vh, w));
  GIVE(spu_msub(f, g, h));
  GIVE(spu_msub(d, e, x));
  GIVE(spu_nmsub(f, g, h));
  GIVE(spu_nmsub(d, e, x));
  GIVE(spu_nmadd(d, e, x));
  GIVE(spu_mul(f, g));
  GIVE(spu_mul(d, e));
  GIVE(spu_mulh(sh, th));
  GIVE(spu_mulsr(sh, th));
  GIVE(spu_mule(sh, th));
  GIVE(spu_mule(uh, vh));
  GIVE(spu_mulo(sh, th));
  GIVE(spu_mulo(uh, vh));
  GIVE(spu_mulo(sh, 77));
  GIVE(spu_re(f));
  GIVE(spu_rsqrte(f));

  GIVE(spu_absd(ub, vb));
  GIVE(spu_avg(ub, vb));
  GIVE(spu_sumb(ub, vb));

  GIVE(spu_cmpeq(ub, vb));
  GIVE(spu_cmpeq(sb, tb));
  GIVE(spu_cmpeq(uh, vh));
  GIVE(spu_cmpeq(s, t));
  GIVE(spu_cmpeq(s, 5));
  GIVE(spu_cmpeq(f, g));
  GIVE(spu_cmpgt(ub, vb));
  GIVE(spu_cmpgt(sb, tb));
  GIVE(spu_cmpgt(uh, vh));
  GIVE(spu_cmpgt(sh, th));
  GIVE(spu_cmpgt(u, v));
  GIVE(spu_cmpgt(s, t));
  GIVE(spu_cmpgt(s, -5));
  GIVE(spu_cmpgt(f, g));
  GIVE(spu_cmpabseq(f, g));
  GIVE(spu_cmpabsgt(f, g));
#ifdef __SPU_EDP__
  GIVE(spu_cmpeq(d, e));
  GIVE(spu_cmpgt(d, e));
  GIVE(spu_cmpabseq(d, e));
  GIVE(spu_cmpabsgt(d, e));
  GIVE(spu_testsv(d, SPU_SV_NAN | SPU_SV_NEG_ZERO | SPU_SV_POS_DENORM));
#endif

  GIVE(spu_cntb(ub));
  GIVE(spu_cntlz(u));
  GIVE(spu_cntlz(s));
  GIVE(spu_gather(ub));
  GIVE(spu_gather(sh));
  GIVE(spu_gather(u));
  GIVE(spu_maskb(spu_extract(uh, 0)));
  GIVE(spu_maskh(spu_extract(ub, 0)));
  GIVE(spu_maskw(spu_extract(ub, 1)));
  GIVE(spu_sel(f, g, w));
  GIVE(spu_sel(d, e, wl));
  GIVE(spu_sel(uh, vh, wh));
  GIVE(spu_sel(sb, tb, wb));
  GIVE(spu_shuffle(f, g, wb));
  GIVE(spu_shuffle(uh, vh, wb));
  GIVE(spu_shuffle(ub, vb, wb));
  GIVE(spu_shuffle(d, e, wb));
  GIVE(spu_and(s, t));
  GIVE(spu_and(u, 255));
  GIVE(spu_and(f, g));
  GIVE(spu_andc(uh, vh));
  GIVE(spu_eqv(ul, vl));
  GIVE(spu_nand(sb, tb));
  GIVE(spu_nor(s, t));
  GIVE(spu_or(s, -256));
  GIVE(spu_or(d, e));
  GIVE(spu_orc(u, v));
  GIVE(spu_xor(sh, th));
  GIVE(spu_xor(s, 3));
  GIVE(spu_orx(u));
  GIVE(spu_orx(s));

  GIVE(spu_rl(sh, th));
  GIVE(spu_rl(u, t));
  GIVE(spu_rl(s, 13));
  GIVE(spu_rlmask(uh, th));
  GIVE(spu_rlmask(u, t));
  GIVE(spu_rlmask(u, -9));
  GIVE(spu_rlmaska(sh, th));
  GIVE(spu_rlmaska(s, t));
  GIVE(spu_rlmaska(s, -9));
  GIVE(spu_sl(uh, vh));
  GIVE(spu_sl(u, v));
  GIVE(spu_sl(s, 9));
  GIVE(spu_sr(uh, vh));
  GIVE(spu_sr(u, v));
  GIVE(spu_sr(u, 9));
  GIVE(spu_sra(sh, vh));
  GIVE(spu_sra(s, v));
  GIVE(spu_sra(s, 9));
  GIVE(spu_rlqw(u, n));
  GIVE(spu_rlqwbyte(f, n));
  GIVE(spu_rlqwbyte(f, 4));
  GIVE(spu_rlqwbytebc(ub, n));
  GIVE(spu_rlmaskqw(u, n));
  GIVE(spu_rlmaskqwbyte(sh, n));
  GIVE(spu_rlmaskqwbyte(sh, -3));
  GIVE(spu_rlmaskqwbytebc(u, n));
  GIVE(spu_slqw(u, m));
  GIVE(spu_slqw(u, 3));
  GIVE(spu_slqwbyte(f, m));
  GIVE(spu_slqwbyte(f, 5));
  GIVE(spu_slqwbytebc(ub, m));
  GIVE(spu_srqw(u, m));
  GIVE(spu_srqw(u, 3));
  GIVE(spu_srqwbyte(f, m));
  GIVE(spu_srqwbyte(f, 5));
  GIVE(spu_srqwbytebc(ub, m));

  GIVE(si_shufb(operands[0], operands[1], operands[2]));
  GIVE(si_selb(operands[0], operands[1], operands[2]));
  GIVE(si_fma(operands[0], operands[1], operands[2]));
  GIVE(si_mpya(operands[0], operands[1], operands[2]));
  GIVE(si_mpyhha(operands[0], operands[1], operands[2]));
  GIVE(si_sfx(operands[0], operands[1], operands[2]));
  GIVE(si_cgx(operands[0], operands[1], operands[2]));
  GIVE(si_dfnms(operands[0], operands[1], operands[2]));
  GIVE(si_iohl(operands[0], 0x1234));
  GIVE(si_il(-3));
  GIVE(si_ila(0x2FFFF));
  GIVE(si_ilh(-3));
  GIVE(si_ilhu(0x4000));
  GIVE(si_fsmbi(0xF00F));
  GIVE(si_cbd(operands[0], 3));
  GIVE(si_cwd(operands[0], 4));
  GIVE(si_cdx(operands[0], operands[1]));
  GIVE(si_sfi(operands[0], 100));
  GIVE(si_ceqbi(operands[0], 0x7F));
  GIVE(si_clgthi(operands[0], 100));
  GIVE(si_csflt(operands[0], 16));
  GIVE(si_cfltu(operands[0], 16));
  GIVE(si_rotqmbii(operands[0], -3));
  GIVE(si_rothmi(operands[0], -3));
  GIVE_SCALAR(si_to_int(si_from_int(si_to_int(operands[0]))));
  GIVE_SCALAR(si_to_uchar(si_from_uchar(si_to_uchar(operands[0]))));
  GIVE_SCALAR(si_to_short(si_from_short(si_to_short(operands[0]))));

  GIVE((vec_uchar16)(vec_uint4){0x00010203, 0x10111213, 0x80C0E0FF, 7});
  GIVE((vec_uint4)(vec_ushort8){1, 2, 3, 4, 5, 6, 7, 8});
  GIVE((vec_float4){1.0f, 2.0f, 3.0f, 4.0f});
  GIVE(f + g);
  GIVE(f - g);
  GIVE(f * g);
  GIVE(d * e);
  GIVE(s + t);
  GIVE(uh - vh);
  GIVE(s & t);
  GIVE(ub ^ vb);
  GIVE(~u);
  GIVE(-s);
  GIVE(tl + sl);
  sum += g;
  total -= t;
  GIVE(sum);
  GIVE(total);
  return count;
}

#ifdef __SPU__
static qword operands[4] __attribute__((aligned(128)));
static qword results[EVERY_INTRINSIC_RESULTS] __attribute__((aligned(128)));

static void wait(void) {
  mfc_write_tag_mask(1);
  mfc_read_tag_status_all();
}

int main(unsigned long long speid, unsigned long long argp, unsigned long long envp) {
  (void)speid;
  (void)envp;
  for (;;) {
    mfc_get(operands, argp, sizeof operands, 0, 0, 0);
    wait();
    if (si_to_uint(operands[3]) == 0) return 0;
    if (every_intrinsic(results, operands) > EVERY_INTRINSIC_RESULTS) return 1;
    mfc_put(results, argp + sizeof operands, sizeof results, 0, 0, 0);
    wait();
    argp += sizeof operands + sizeof results;
  }
}
#endif

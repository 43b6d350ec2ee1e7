#include "backends/cell_emu/isa/parts.hpp"
namespace celltrace::isa {
using u8=std::uint8_t; using u16=std::uint16_t; using u32=std::uint32_t; using u64=std::uint64_t; using s8=std::int8_t; using s16=std::int16_t; using s32=std::int32_t; using s64=std::int64_t;
#define X(name) void execute_##name([[maybe_unused]] State& s, [[maybe_unused]] const Instruction& i)
#define B(name, P, e) X(name) { binary<P>(s, i, [](P a, P b) { return e; }); }
#define U(name, P, e) X(name) { const auto m = static_cast<P>(i.immediate); (void)m; unary<P>(s, i, [m](P a) { (void)m; return e; }); }
#define ACC(name, P, e) X(name) { accumulate<P>(s, i, [](P a, P b, P t) { return e; }); }
#define T(name, P, e) X(name) { ternary<P>(s, i, [](P a, P b, P c) { return e; }); }
#define ALL(P, c) ((c) ? static_cast<P>(~P{0}) : P{0})
B(a,u32,a+b) B(ah,u16,a+b) B(sf,u32,b-a) B(sfh,u16,b-a)
U(ai,u32,a+m) U(ahi,u16,a+m) U(sfi,u32,m-a) U(sfhi,u16,m-a)
B(cg,u32,(u64{a}+b)>>32) B(bg,u32,b>=a)
ACC(addx,u32,a+b+(t&1)) ACC(sfx,u32,b+~a+(t&1)) ACC(cgx,u32,(u64{a}+b+(t&1))>>32) ACC(bgx,u32,(u64{b}+u32(~a)+(t&1))>>32)
B(mpy,u32,u32(s32{s16(a)}*s32{s16(b)})) B(mpyu,u32,(a&0xffff)*(b&0xffff)) B(mpyh,u32,((a>>16)*(b&0xffff))<<16)
B(mpys,u32,u32((s32{s16(a)}*s32{s16(b)})>>16)) B(mpyhh,u32,u32(s32{s16(a>>16)}*s32{s16(b>>16)})) B(mpyhhu,u32,(a>>16)*(b>>16))
ACC(mpyhha,u32,t+u32(s32{s16(a>>16)}*s32{s16(b>>16)})) ACC(mpyhhau,u32,t+(a>>16)*(b>>16))
T(mpya,u32,u32(s32{s16(a)}*s32{s16(b)})+c)
U(mpyi,u32,u32(s32{s16(a)}*s32{s16(m)})) U(mpyui,u32,(a&0xffff)*(m&0xffff))
U(clz,u32,u32(std::countl_zero(a))) U(cntb,u8,std::popcount(a))
U(xswd,u64,u64(s64{s32(u32(a))})) U(xshw,u32,u32(s32{s16(a)})) U(xsbh,u16,u16(s16{s8(a)}))
B(absdb,u8,a>b?a-b:b-a) B(avgb,u8,(a+b+1)>>1)
X(sumb) { auto sum=[](u32 w){return (w>>24)+(w>>16&255)+(w>>8&255)+(w&255);}; binary<u32>(s,i,[&](u32 a,u32 b){return sum(b)<<16|sum(a);}); }
B(and_,u64,a&b) B(andc,u64,a&~b) B(or_,u64,a|b) B(orc,u64,a|~b) B(xor_,u64,a^b) B(nand,u64,~(a&b)) B(nor,u64,~(a|b)) B(eqv,u64,~(a^b))
U(andi,u32,a&m) U(andhi,u16,a&m) U(andbi,u8,a&m) U(ori,u32,a|m) U(orhi,u16,a|m) U(orbi,u8,a|m) U(xori,u32,a^m) U(xorhi,u16,a^m) U(xorbi,u8,a^m)
B(ceq,u32,ALL(u32,a==b)) B(ceqh,u16,ALL(u16,a==b)) B(ceqb,u8,ALL(u8,a==b)) U(ceqi,u32,ALL(u32,a==m)) U(ceqhi,u16,ALL(u16,a==m)) U(ceqbi,u8,ALL(u8,a==m))
B(cgt,u32,ALL(u32,s32(a)>s32(b))) B(cgth,u16,ALL(u16,s16(a)>s16(b))) B(cgtb,u8,ALL(u8,s8(a)>s8(b)))
U(cgti,u32,ALL(u32,s32(a)>s32(m))) U(cgthi,u16,ALL(u16,s16(a)>s16(m))) U(cgtbi,u8,ALL(u8,s8(a)>s8(m)))
B(clgt,u32,ALL(u32,a>b)) B(clgth,u16,ALL(u16,a>b)) B(clgtb,u8,ALL(u8,a>b)) U(clgti,u32,ALL(u32,a>m)) U(clgthi,u16,ALL(u16,a>m)) U(clgtbi,u8,ALL(u8,a>m))
T(selb,u64,(c&b)|(~c&a))
X(il) { s.gpr[i.rt]=Quadword::splat(u32(i.immediate)); }
X(ilhu) { s.gpr[i.rt]=Quadword::splat(u32(i.immediate)<<16); }
X(ilh) { s.gpr[i.rt]=Quadword::splat(u32(i.immediate)*0x10001u); }
X(ila) { s.gpr[i.rt]=Quadword::splat(u32(i.immediate)); }
X(iohl) { const Quadword m=Quadword::splat(u32(i.immediate)); auto t=parts<u64>(s.gpr[i.rt]), k=parts<u64>(m); t[0]|=k[0]; t[1]|=k[1]; s.gpr[i.rt]=joined<u64>(t); }
#define HALT(name, e) X(name) { const u32 a=s.gpr[i.ra].word(0), b=s.gpr[i.rb].word(0), m=u32(i.immediate); (void)a;(void)b;(void)m; if (e) s.environment->halt(); }
HALT(heq,a==b) HALT(heqi,a==m) HALT(hgt,s32(a)>s32(b)) HALT(hgti,s32(a)>s32(m)) HALT(hlgt,a>b) HALT(hlgti,a>m)
static u32 shl(u32 a,u32 n){return n>31?0:a<<n;} static u32 shr(u32 a,u32 n){return n>31?0:a>>n;} static u32 sar(u32 a,u32 n){return u32(s32(a)>>(n>31?31:n));}
static u16 shlh(u16 a,u32 n){return n>15?0:u16(a<<n);} static u16 shrh(u16 a,u32 n){return n>15?0:u16(a>>n);} static u16 sarh(u16 a,u32 n){return u16(s16(a)>>(n>15?15:n));}
B(shl,u32,shl(a,b&63)) U(shli,u32,shl(a,m&63)) B(shlh,u16,shlh(a,b&31)) U(shlhi,u16,shlh(a,m&31))
B(rot,u32,std::rotl(a,int(b&31))) U(roti,u32,std::rotl(a,int(m&31))) B(roth,u16,std::rotl(a,int(b&15))) U(rothi,u16,std::rotl(a,int(m&15)))
B(rotm,u32,shr(a,(0u-b)&63)) U(rotmi,u32,shr(a,(0u-m)&63)) B(rothm,u16,shrh(a,(0u-b)&31)) U(rothmi,u16,shrh(a,(0u-m)&31))
B(rotma,u32,sar(a,(0u-b)&63)) U(rotmai,u32,sar(a,(0u-m)&63)) B(rotmah,u16,sarh(a,(0u-b)&31)) U(rotmahi,u16,sarh(a,(0u-m)&31))
}

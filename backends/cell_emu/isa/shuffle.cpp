#include "backends/cell_emu/isa/parts.hpp"
namespace celltrace::isa {
using u8=std::uint8_t; using u16=std::uint16_t; using u32=std::uint32_t; using u64=std::uint64_t; using u128=unsigned __int128;
#define X(name) void execute_##name([[maybe_unused]] State& s, [[maybe_unused]] const Instruction& i)
static u128 whole(const Quadword& q){ return u128{q.doubleword(0)}<<64 | q.doubleword(1); }
static Quadword quad(u128 v){ Quadword q; q.set<u64>(0,u64(v>>64)); q.set<u64>(1,u64(v)); return q; }
static u128 left(u128 v,u32 bits){ return bits>127?0:v<<bits; } static u128 right(u128 v,u32 bits){ return bits>127?0:v>>bits; }
static u128 rotl(u128 v,u32 bits){ bits&=127; return bits==0?v:v<<bits|v>>(128-bits); }
#define Q(name, e) X(name) { const u128 v=whole(s.gpr[i.ra]); const u32 n=s.gpr[i.rb].word(0), m=u32(i.immediate); (void)n;(void)m; s.gpr[i.rt]=quad(e); }
Q(shlqbi,left(v,n&7)) Q(shlqbii,left(v,m&7)) Q(shlqby,left(v,8*(n&31))) Q(shlqbyi,left(v,8*(m&31))) Q(shlqbybi,left(v,8*(n>>3&31)))
Q(rotqbi,rotl(v,n&7)) Q(rotqbii,rotl(v,m&7)) Q(rotqby,rotl(v,8*(n&15))) Q(rotqbyi,rotl(v,8*(m&15))) Q(rotqbybi,rotl(v,8*(n>>3&15)))
Q(rotqmbi,right(v,(0u-n)&7)) Q(rotqmbii,right(v,(0u-m)&7)) Q(rotqmby,right(v,8*((0u-n)&31))) Q(rotqmbyi,right(v,8*((0u-m)&31))) Q(rotqmbybi,right(v,8*((0u-(n>>3))&31)))
static Quadword control(u32 at,u32 bytes){ Quadword q; for(u32 k=0;k<16;++k) q.set<u8>(k,u8(0x10+k)); at&=16-bytes; for(u32 k=0;k<bytes;++k) q.set<u8>(at+k,u8(bytes<4?4-bytes+k:k)); return q; }
#define C(name,n) X(name##d) { s.gpr[i.rt]=control(s.gpr[i.ra].word(0)+u32(i.immediate),n); } X(name##x) { s.gpr[i.rt]=control(s.gpr[i.ra].word(0)+s.gpr[i.rb].word(0),n); }
C(cb,1) C(ch,2) C(cw,4) C(cd,8)
X(shufb) {
  u8 from[32]; const Quadword &a=s.gpr[i.ra],&b=s.gpr[i.rb],c=s.gpr[i.rc];
  a.store(from); b.store(from+16); u8 sel[16]; c.store(sel); u8 out[16];
  for(int k=0;k<16;++k){ const u8 x=sel[k]; out[k]= x<0x80?from[x&31]: x<0xc0?0: x<0xe0?0xff:0x80; }
  s.gpr[i.rt]=Quadword::load(out);
}
X(gb) { u32 r=0; for(unsigned k=0;k<4;++k) r=r<<1|(s.gpr[i.ra].word(k)&1); s.gpr[i.rt]=preferred(r); }
X(gbh) { u32 r=0; for(unsigned k=0;k<8;++k) r=r<<1|(s.gpr[i.ra].half(k)&1u); s.gpr[i.rt]=preferred(r); }
X(gbb) { u32 r=0; for(unsigned k=0;k<16;++k) r=r<<1|(s.gpr[i.ra].byte(k)&1u); s.gpr[i.rt]=preferred(r); }
X(fsm) { const u32 m=s.gpr[i.ra].word(0); Quadword q; for(unsigned k=0;k<4;++k) q.set<u32>(k,m>>(3-k)&1?~0u:0); s.gpr[i.rt]=q; }
X(fsmh) { const u32 m=s.gpr[i.ra].word(0); Quadword q; for(unsigned k=0;k<8;++k) q.set<u16>(k,m>>(7-k)&1?0xffff:0); s.gpr[i.rt]=q; }
static Quadword bytes_of(u32 m){ Quadword q; for(unsigned k=0;k<16;++k) q.set<u8>(k,m>>(15-k)&1?0xff:0); return q; }
X(fsmb) { s.gpr[i.rt]=bytes_of(s.gpr[i.ra].word(0)); }
X(fsmbi) { s.gpr[i.rt]=bytes_of(u32(i.immediate)); }
X(orx) { const auto a=parts<u32>(s.gpr[i.ra]); s.gpr[i.rt]=preferred(a[0]|a[1]|a[2]|a[3]); }
}

#include "backends/cell_emu/isa/parts.hpp"
#include <cfenv>
#include <cmath>
namespace celltrace::isa {
using u8=std::uint8_t; using u16=std::uint16_t; using u32=std::uint32_t; using u64=std::uint64_t; using s32=std::int32_t; using s64=std::int64_t;
#define X(name) void execute_##name([[maybe_unused]] State& s, [[maybe_unused]] const Instruction& i)
static inline double wide(u32 w){ const u64 e=w>>23&255; const u64 bits=u64(w>>31)<<63|(e+896)<<52|u64(w&0x7fffff)<<29; return e==0?0.0:std::bit_cast<double>(bits); }
static inline u32 narrow(double d){ const u64 b=std::bit_cast<u64>(d); const s64 e=s64(b>>52&2047)-896; const u32 sign=u32(b>>63)<<31; const u32 m=u32(b>>29)&0x7fffff;
  return e<=0?0: e>255? sign|0x7fffffff : sign|u32(e)<<23|m; }
static inline double chopped(double a,double b){ const double t=a+b; const double bb=t-a; const double err=(a-(t-bb))+(b-bb); const u64 bits=std::bit_cast<u64>(t);
  const bool away = err!=0 && (std::bit_cast<u64>(err)^bits)>>63; return std::bit_cast<double>(bits-u64(away)); }
#define F2(name,e) X(name) { binary<u32>(s,i,[](u32 x,u32 y){ const double a=wide(x),b=wide(y); return e; }); }
#define F3(name,e) X(name) { ternary<u32>(s,i,[](u32 x,u32 y,u32 z){ const double a=wide(x),b=wide(y),c=wide(z); return e; }); }
F2(fa,narrow(chopped(a,b))) F2(fs,narrow(chopped(a,-b))) F2(fm,narrow(a*b))
F3(fma,narrow(chopped(a*b,c))) F3(fms,narrow(chopped(a*b,-c))) F3(fnms,narrow(chopped(c,-(a*b))))
F2(fcgt,a>b?~0u:0u) F2(fceq,a==b?~0u:0u) F2(fcmgt,std::fabs(a)>std::fabs(b)?~0u:0u) F2(fcmeq,std::fabs(a)==std::fabs(b)?~0u:0u)
static double power(int n){ return std::bit_cast<double>(u64(1023+n)<<52); }
X(csflt){ const double k=power(i.immediate-155); unary<u32>(s,i,[k](u32 a){ return narrow(double(s32(a))*k); }); }
X(cuflt){ const double k=power(i.immediate-155); unary<u32>(s,i,[k](u32 a){ return narrow(double(a)*k); }); }
X(cflts){ const double k=power(173-i.immediate); unary<u32>(s,i,[k](u32 a){ const double d=wide(a)*k; return d>=2147483648.0?0x7fffffffu: d<=-2147483648.0?0x80000000u:u32(s32(d)); }); }
X(cfltu){ const double k=power(173-i.immediate); unary<u32>(s,i,[k](u32 a){ const double d=wide(a)*k; return d>=4294967296.0?~0u: d<=0?0u:u32(d); }); }
static constexpr u32 kF[32]={0x7FFBE0,0x7F87A6,0x70EF72,0x708B40,0x638B12,0x633AEA,0x5792C4,0x574AA0,0x4CCA7E,0x4C9262,0x430A44,0x42D62A,0x3A2E12,0x39FDFA,0x3215E4,0x31F1D2,0x2AA9BE,0x2A85AC,0x23D59A,0x23BD8E,0x1D8576,0x1D8576,0x17AD5A,0x17AD5A,0x124543,0x124543,0x0D392D,0x0D392D,0x08851A,0x08851A,0x041D07,0x041D07};
static constexpr u32 kQ[64]={0x350160,0x34E954,0x2F993D,0x2F993D,0x2AA523,0x2AA523,0x26190D,0x26190D,0x21E4F9,0x21E4F9,0x1E00E9,0x1E00E9,0x1A5CD9,0x1A5CD9,0x16F8CB,0x16F8CB,0x13CCC0,0x13CCC0,0x10CCB3,0x10CCB3,0x0E00AA,0x0E00AA,0x0B58A1,0x0B58A1,0x08D498,0x08D498,0x067491,0x067491,0x043089,0x043089,0x020C83,0x020C83,
0x7FFDF4,0x7FD1DE,0x7859C8,0x783DBA,0x71559C,0x71559C,0x6AE57C,0x6AE57C,0x64F561,0x64F561,0x5F7149,0x5F7149,0x5A4D33,0x5A4D33,0x55811F,0x55811F,0x51050F,0x51050F,0x4CC8FE,0x4CC8FE,0x48D0F0,0x48D0F0,0x4510E4,0x4510E4,0x4180D7,0x4180D7,0x3E24CC,0x3E24CC,0x3AF4C3,0x3AF4C3,0x37E8BA,0x37E8BA};
X(frest){ unary<u32>(s,i,[](u32 a){ const u32 e=a>>23&255; const u32 f=e==0?255: e>253?0:253-e; return (a&0x80000000u)|f<<23|kF[a>>18&31]; }); }
X(frsqest){ unary<u32>(s,i,[](u32 a){ const u32 e=a>>23&255; const u32 f=e==0?255:190-(e+1)/2; return f<<23|kQ[a>>18&63]; }); }
X(fi){ binary<u32>(s,i,[](u32 a,u32 b){
  // base has 13 bits, step*y 10+19 bits of fraction: 2^32 is 1
  const u64 base=(u64{1}<<32)|(u64{b>>10&0x1fff}<<19); const u64 sub=u64{b&0x3ff}*(a&0x7ffff); u64 v=base-sub; u32 e=b>>23&255;
  if(v<(u64{1}<<32)){ if(e==0) return 0u; --e; v<<=1; }
  return e==0?0u:(b&0x80000000u)|e<<23|(u32(v>>9)&0x7fffff); }); }
static double dz(u64 v){ return (v>>52&2047)==0? std::bit_cast<double>(v&0x8000000000000000u):std::bit_cast<double>(v); }
static u64 dr(double d){ const u64 v=std::bit_cast<u64>(d); if((v>>52&2047)==2047&&(v&0xfffffffffffff)) return 0x7ff8000000000000u; return (v>>52&2047)==0? v&0x8000000000000000u:v; }
template<class F> [[gnu::noinline]] static void doubles(State& s,const Instruction& i,F f){ Quadword r; static constexpr int modes[4]={FE_TONEAREST,FE_TOWARDZERO,FE_UPWARD,FE_DOWNWARD}; const int old=std::fegetround();
  for(unsigned k=0;k<2;++k){ const unsigned m=s.fpscr.word(0)>>(k==0?10:8)&3; std::fesetround(modes[m]); volatile double a=dz(s.gpr[i.ra].doubleword(k)),b=dz(s.gpr[i.rb].doubleword(k)),t=dz(s.gpr[i.rt].doubleword(k)); volatile double v=f(a,b,t); std::fesetround(old); r.set<u64>(k,dr(v)); }
  s.gpr[i.rt]=r; }
X(dfa){ doubles(s,i,[](double a,double b,double){return a+b;}); } X(dfs){ doubles(s,i,[](double a,double b,double){return a-b;}); } X(dfm){ doubles(s,i,[](double a,double b,double){return a*b;}); }
X(dfma){ doubles(s,i,[](double a,double b,double t){return std::fma(a,b,t);}); } X(dfms){ doubles(s,i,[](double a,double b,double t){return std::fma(a,b,-t);}); }
X(dfnms){ doubles(s,i,[](double a,double b,double t){return -std::fma(a,b,-t);}); } X(dfnma){ doubles(s,i,[](double a,double b,double t){return -std::fma(a,b,t);}); }
#define DC(name,e) X(name){ Quadword r; for(unsigned k=0;k<2;++k){ const double a=dz(s.gpr[i.ra].doubleword(k)),b=dz(s.gpr[i.rb].doubleword(k)); r.set<u64>(k,(e)?~u64{0}:0); } s.gpr[i.rt]=r; }
DC(dfcgt,a>b) DC(dfceq,a==b) DC(dfcmgt,std::fabs(a)>std::fabs(b)) DC(dfcmeq,std::fabs(a)==std::fabs(b))
X(dftsv){ Quadword r; for(unsigned k=0;k<2;++k){ const u64 v=s.gpr[i.ra].doubleword(k); const u32 e=u32(v>>52)&2047; const u64 m=v&0xfffffffffffff; const bool n=v>>63; u32 c=0;
  if(e==2047) c= m?0x40: n?0x10:0x20; else if(e==0) c= m? (n?1:2): (n?4:8); r.set<u64>(k,(u32(i.immediate)&c)?~u64{0}:0);} s.gpr[i.rt]=r; }
X(fesd){ Quadword r; for(unsigned k=0;k<2;++k){ const u32 w=s.gpr[i.ra].word(2*k); const u32 e=w>>23&255; double d; if(e==0) d=std::bit_cast<double>(u64(w>>31)<<63); else d=double(std::bit_cast<float>(w)); r.set<u64>(k,dr(d)); } s.gpr[i.rt]=r; }
X(frds){ Quadword r=Quadword::zero(); static constexpr int modes[4]={FE_TONEAREST,FE_TOWARDZERO,FE_UPWARD,FE_DOWNWARD}; const int old=std::fegetround(); for(unsigned k=0;k<2;++k){ std::fesetround(modes[s.fpscr.word(0)>>(k==0?10:8)&3]); volatile double d=dz(s.gpr[i.ra].doubleword(k)); volatile float f=float(d); std::fesetround(old); u32 w=std::bit_cast<u32>(float(f)); if((w>>23&255)==255&&(w&0x7fffff)) w=0x7fc00000; if((w>>23&255)==0) w&=0x80000000u; r.set<u32>(2*k,w);} s.gpr[i.rt]=r; }
}

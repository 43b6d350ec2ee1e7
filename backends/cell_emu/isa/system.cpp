#include "backends/cell_emu/isa/parts.hpp"
namespace celltrace::isa {
using u32=std::uint32_t; using s32=std::int32_t;
#define X(name) void execute_##name([[maybe_unused]] State& s, [[maybe_unused]] const Instruction& i)
X(lqd){ s.gpr[i.rt]=s.load(s.gpr[i.ra].word(0)+u32(i.immediate)); } X(stqd){ s.store(s.gpr[i.ra].word(0)+u32(i.immediate),s.gpr[i.rt]); }
X(lqx){ s.gpr[i.rt]=s.load(s.gpr[i.ra].word(0)+s.gpr[i.rb].word(0)); } X(stqx){ s.store(s.gpr[i.ra].word(0)+s.gpr[i.rb].word(0),s.gpr[i.rt]); }
X(lqa){ s.gpr[i.rt]=s.load(u32(i.immediate)); } X(stqa){ s.store(u32(i.immediate),s.gpr[i.rt]); }
X(lqr){ s.gpr[i.rt]=s.load(s.pc+u32(i.immediate)); } X(stqr){ s.store(s.pc+u32(i.immediate),s.gpr[i.rt]); }
static void go(State& s,u32 to){ s.next=to&(kLocalStoreLimit&~3u); }
static u32 link(const State& s){ return (s.pc+4)&kLocalStoreLimit; }
X(br){ go(s,s.pc+u32(i.immediate)); } X(bra){ go(s,u32(i.immediate)); }
X(brsl){ const u32 l=link(s); s.gpr[i.rt]=preferred(l); go(s,s.pc+u32(i.immediate)); } X(brasl){ s.gpr[i.rt]=preferred(link(s)); go(s,u32(i.immediate)); }
X(brz){ if(s.gpr[i.rt].word(0)==0) go(s,s.pc+u32(i.immediate)); } X(brnz){ if(s.gpr[i.rt].word(0)!=0) go(s,s.pc+u32(i.immediate)); }
X(brhz){ if(s.gpr[i.rt].half(1)==0) go(s,s.pc+u32(i.immediate)); } X(brhnz){ if(s.gpr[i.rt].half(1)!=0) go(s,s.pc+u32(i.immediate)); }
static void de(State& s,const Instruction& i){ if(i.word>>19&1) s.environment->enable_interrupts(false); else if(i.word>>18&1) s.environment->enable_interrupts(true); }
static void jump(State& s,const Instruction& i){ const u32 to=s.gpr[i.ra].word(0); go(s,to); if(i.word&0xC0000) de(s,i); }
X(bi){ jump(s,i); } X(bisl){ const u32 to=s.gpr[i.ra].word(0); s.gpr[i.rt]=preferred(link(s)); go(s,to); if(i.word&0xC0000) de(s,i); }
X(biz){ if(s.gpr[i.rt].word(0)==0) jump(s,i); } X(binz){ if(s.gpr[i.rt].word(0)!=0) jump(s,i); } X(bihz){ if(s.gpr[i.rt].half(1)==0) jump(s,i); } X(bihnz){ if(s.gpr[i.rt].half(1)!=0) jump(s,i); }
X(bisled){ const u32 to=s.gpr[i.ra].word(0); s.gpr[i.rt]=preferred(link(s)); if(s.environment->has_event()) { go(s,to); de(s,i);} }
X(iret){ go(s,s.environment->srr0()); de(s,i); }
X(stop){ s.environment->stop(i.word&0x3fff); } X(stopd){ s.environment->stop(0x3fff); }
X(hbr){} X(hbra){} X(hbrr){} X(nop){} X(lnop){} X(sync){} X(dsync){}
X(mfspr){ s.gpr[i.rt]=Quadword::zero(); } X(mtspr){}
X(rdch){ const u32 v=s.environment->read_channel(i.ra); s.gpr[i.rt]=preferred(v); } X(rchcnt){ const u32 v=s.environment->channel_count(i.ra); s.gpr[i.rt]=preferred(v); } X(wrch){ s.environment->write_channel(i.ra,s.gpr[i.rt].word(0)); }
X(fscrrd){ s.gpr[i.rt]=s.fpscr; }
X(fscrwr){ s.fpscr=s.gpr[i.ra]; const u32 masks[4]={0x00000F07,0x00003F07,0x00003F07,0x00000F07}; for(unsigned k=0;k<4;++k) s.fpscr.set<u32>(k,s.fpscr.word(k)&masks[k]); }
}

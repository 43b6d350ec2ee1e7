#include "backends/cell_emu/isa/parts.hpp"
#include <vector>
namespace celltrace::isa {
enum class Syntax : std::uint8_t { any };
enum class Opcode : std::uint8_t {
#define CELLTRACE_INSTRUCTION(name, ...) name,
#include "backends/cell_emu/isa/opcodes.def"
#undef CELLTRACE_INSTRUCTION
};
using namespace operand;
static constexpr OpcodeInfo kTable[]={
#define CELLTRACE_INSTRUCTION(name, m, f, c, u, s, o) {m, Opcode::name, Format::f, c, Unit::u, Syntax::any, o, execute_##name},
#include "backends/cell_emu/isa/opcodes.def"
#undef CELLTRACE_INSTRUCTION
};
std::span<const OpcodeInfo> opcodes(){ return kTable; }
static int bits(Format f){ switch(f){case Format::rrr:return 4; case Format::ri18:return 7; case Format::ri10:return 8; case Format::ri16:return 9; case Format::ri8:return 10; default:return 11;} }
const OpcodeInfo* find_opcode(std::uint32_t w){ static const std::vector<const OpcodeInfo*> map=[]{ std::vector<const OpcodeInfo*> m(2048); for(const auto& o:kTable){ const int b=bits(o.format); for(unsigned k=0;k<1u<<(11-b);++k) m[(unsigned(o.code)<<(11-b))+k]=&o; } return m; }(); return map[w>>21]; }
static void bad(State& s,const Instruction& i){ s.environment->invalid_instruction(i.word); }
static std::int32_t sx(std::uint32_t v,int b){ return std::int32_t(v<<(32-b))>>(32-b); }
Instruction decode(std::uint32_t w){ Instruction i{}; i.word=w; i.source[0]=i.source[1]=i.source[2]=i.target=kNoRegister; const OpcodeInfo* o=find_opcode(w); if(!o){ i.execute=bad; i.unit=Unit::br; return i; }
  i.execute=o->execute; i.opcode=o->opcode; i.unit=o->unit; i.rt=w&127; i.ra=w>>7&127; i.rb=w>>14&127; const std::string n=o->mnemonic;
  switch(o->format){ case Format::rr: break; case Format::rrr: i.rc=w&127; i.rt=w>>21&127; break; case Format::ri7: i.immediate=sx(w>>14,7); if(n=="dftsv") i.immediate=w>>14&127; break; case Format::ri8: i.immediate=w>>14&255; break;
   case Format::ri10: i.immediate=sx(w>>14,10); if(n=="lqd"||n=="stqd") i.immediate*=16; break;
   case Format::ri16: i.immediate=sx(w>>7,16); if(n=="il") ; else if(n=="ilhu"||n=="ilh"||n=="iohl"||n=="fsmbi") i.immediate&=0xffff; else i.immediate*=4; break; case Format::ri18: i.immediate=w>>7&0x3ffff; break; }
  int k=0; if(o->operands&reads_ra) i.source[k++]=i.ra; if(o->operands&reads_rb) i.source[k++]=i.rb; if(o->operands&reads_rc) i.source[k++]=i.rc; if(o->operands&reads_rt) i.source[k++]=i.rt; if(o->operands&writes_rt) i.target=i.rt; return i; }
std::string disassemble(std::uint32_t w,std::uint32_t){ const auto* o=find_opcode(w); return o?o->mnemonic:"?"; }
}

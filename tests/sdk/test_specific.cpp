// Every si_ function against the instruction on the simulated SPU.
#include "backends/cell_emu/machine.hpp"
#include "celltrace/emulator.hpp"
#include "celltrace/spe/spu_specific.hpp"
#include "sdk/simulated_instruction.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

namespace celltrace::test {
namespace {

struct Row {
  const char* mnemonic;
  qword (*function)(const Operands&, int immediate);
  bool has_immediate;
};

// clang-format off
#define ROW_A(name) {#name, [](const Operands& o, int) { return si_##name(o.a); }, false},
#define ROW_AB(name) {#name, [](const Operands& o, int) { return si_##name(o.a, o.b); }, false},
#define ROW_ABC(name) {#name, [](const Operands& o, int) { return si_##name(o.a, o.b, o.c); }, false},
#define ROW_A_IMMEDIATE(name) {#name, [](const Operands& o, int i) { return si_##name(o.a, i); }, true},
#define ROW_IMMEDIATE(name) {#name, [](const Operands&, int i) { return si_##name(i); }, true},

const Row kRows[] = {
    ROW_A(clz)
    ROW_A(cntb)
    ROW_A(fsmb)
    ROW_A(fsmh)
    ROW_A(fsm)
    ROW_A(gbb)
    ROW_A(gbh)
    ROW_A(gb)
    ROW_A(xsbh)
    ROW_A(xshw)
    ROW_A(xswd)
    ROW_A(orx)
    ROW_A(frest)
    ROW_A(frsqest)
    ROW_A(frds)
    ROW_A(fesd)
    ROW_AB(cbx)
    ROW_AB(chx)
    ROW_AB(cwx)
    ROW_AB(cdx)
    ROW_AB(ah)
    ROW_AB(a)
    ROW_AB(cg)
    ROW_AB(sfh)
    ROW_AB(sf)
    ROW_AB(bg)
    ROW_AB(mpy)
    ROW_AB(mpyu)
    ROW_AB(mpyh)
    ROW_AB(mpys)
    ROW_AB(mpyhh)
    ROW_AB(mpyhhu)
    ROW_AB(avgb)
    ROW_AB(absdb)
    ROW_AB(sumb)
    ROW_AB(and)
    ROW_AB(andc)
    ROW_AB(or)
    ROW_AB(orc)
    ROW_AB(xor)
    ROW_AB(nand)
    ROW_AB(nor)
    ROW_AB(eqv)
    ROW_AB(shlh)
    ROW_AB(shl)
    ROW_AB(shlqbi)
    ROW_AB(shlqby)
    ROW_AB(shlqbybi)
    ROW_AB(roth)
    ROW_AB(rot)
    ROW_AB(rotqby)
    ROW_AB(rotqbybi)
    ROW_AB(rotqbi)
    ROW_AB(rothm)
    ROW_AB(rotm)
    ROW_AB(rotqmby)
    ROW_AB(rotqmbi)
    ROW_AB(rotqmbybi)
    ROW_AB(rotmah)
    ROW_AB(rotma)
    ROW_AB(ceqb)
    ROW_AB(ceqh)
    ROW_AB(ceq)
    ROW_AB(cgtb)
    ROW_AB(cgth)
    ROW_AB(cgt)
    ROW_AB(clgtb)
    ROW_AB(clgth)
    ROW_AB(clgt)
    ROW_AB(fa)
    ROW_AB(fs)
    ROW_AB(fm)
    ROW_AB(fi)
    ROW_AB(fceq)
    ROW_AB(fcmeq)
    ROW_AB(fcgt)
    ROW_AB(fcmgt)
    ROW_AB(dfa)
    ROW_AB(dfs)
    ROW_AB(dfm)
    ROW_AB(dfceq)
    ROW_AB(dfcmeq)
    ROW_AB(dfcgt)
    ROW_AB(dfcmgt)
    ROW_ABC(addx)
    ROW_ABC(cgx)
    ROW_ABC(sfx)
    ROW_ABC(bgx)
    ROW_ABC(mpya)
    ROW_ABC(mpyhha)
    ROW_ABC(mpyhhau)
    ROW_ABC(selb)
    ROW_ABC(shufb)
    ROW_ABC(fma)
    ROW_ABC(fms)
    ROW_ABC(fnms)
    ROW_ABC(dfma)
    ROW_ABC(dfms)
    ROW_ABC(dfnms)
    ROW_ABC(dfnma)
    ROW_A_IMMEDIATE(cbd)
    ROW_A_IMMEDIATE(chd)
    ROW_A_IMMEDIATE(cwd)
    ROW_A_IMMEDIATE(cdd)
    ROW_A_IMMEDIATE(ahi)
    ROW_A_IMMEDIATE(ai)
    ROW_A_IMMEDIATE(sfhi)
    ROW_A_IMMEDIATE(sfi)
    ROW_A_IMMEDIATE(mpyi)
    ROW_A_IMMEDIATE(mpyui)
    ROW_A_IMMEDIATE(andbi)
    ROW_A_IMMEDIATE(andhi)
    ROW_A_IMMEDIATE(andi)
    ROW_A_IMMEDIATE(orbi)
    ROW_A_IMMEDIATE(orhi)
    ROW_A_IMMEDIATE(ori)
    ROW_A_IMMEDIATE(xorbi)
    ROW_A_IMMEDIATE(xorhi)
    ROW_A_IMMEDIATE(xori)
    ROW_A_IMMEDIATE(shlhi)
    ROW_A_IMMEDIATE(shli)
    ROW_A_IMMEDIATE(shlqbii)
    ROW_A_IMMEDIATE(shlqbyi)
    ROW_A_IMMEDIATE(rothi)
    ROW_A_IMMEDIATE(roti)
    ROW_A_IMMEDIATE(rotqbyi)
    ROW_A_IMMEDIATE(rotqbii)
    ROW_A_IMMEDIATE(rothmi)
    ROW_A_IMMEDIATE(rotmi)
    ROW_A_IMMEDIATE(rotqmbyi)
    ROW_A_IMMEDIATE(rotqmbii)
    ROW_A_IMMEDIATE(rotmahi)
    ROW_A_IMMEDIATE(rotmai)
    ROW_A_IMMEDIATE(ceqbi)
    ROW_A_IMMEDIATE(ceqhi)
    ROW_A_IMMEDIATE(ceqi)
    ROW_A_IMMEDIATE(cgtbi)
    ROW_A_IMMEDIATE(cgthi)
    ROW_A_IMMEDIATE(cgti)
    ROW_A_IMMEDIATE(clgtbi)
    ROW_A_IMMEDIATE(clgthi)
    ROW_A_IMMEDIATE(clgti)
    ROW_A_IMMEDIATE(csflt)
    ROW_A_IMMEDIATE(cflts)
    ROW_A_IMMEDIATE(cuflt)
    ROW_A_IMMEDIATE(cfltu)
    ROW_A_IMMEDIATE(dftsv)
    ROW_IMMEDIATE(ilh)
    ROW_IMMEDIATE(ilhu)
    ROW_IMMEDIATE(il)
    ROW_IMMEDIATE(ila)
    ROW_IMMEDIATE(fsmbi)
    {"iohl", [](const Operands& o, int i) { return si_iohl(o.c, i); }, true},
};
// clang-format on

const isa::OpcodeInfo& info_of(const std::string& mnemonic) {
  const auto all = isa::opcodes();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& each) { return mnemonic == each.mnemonic; });
  INFO(mnemonic);
  REQUIRE(found != all.end());
  return *found;
}

/// Those that a format's immediates can be, at their ends and between.
std::vector<int> immediates_of(const isa::OpcodeInfo& info) {
  using isa::Format;
  if (info.syntax == isa::Syntax::rt_ra_scale_155 || info.syntax == isa::Syntax::rt_ra_scale_173)
    return {0, 1, 8, 23, 31, 32, 64, 127};
  switch (info.format) {
  case Format::ri7:
    if (info.opcode == isa::Opcode::dftsv) return {0, 1, 2, 4, 8, 0x10, 0x20, 0x40, 0x7F};
    return {0, 1, 3, 7, 8, 13, 15, 16, 31, 32, 63, -1, -7, -8, -16, -31, -64};
  case Format::ri10:
    return {0, 1, -1, 15, 127, 128, 255, 511, -512, -128};
  case Format::ri16:
    if (info.syntax == isa::Syntax::rt_i16) return {0, 1, -1, 32767, -32768, 0x1234};
    return {0, 1, 0x8000, 0xFFFF, 0x1234, 0xAAAA, -3};
  default:
    return {0, 1, 0x3FFFF, 0x2AAAA};
  }
}

std::int32_t field_of(const isa::OpcodeInfo& info, int immediate) {
  if (info.syntax == isa::Syntax::rt_ra_scale_155) return 155 - immediate;
  if (info.syntax == isa::Syntax::rt_ra_scale_173) return 173 - immediate;
  return immediate;
}

struct Call {
  const Row* row;
  int immediate;
};

void check(const Call& call, const Results& expected) {
  si_fscrwr(qword{});
  unsigned differing = 0;
  for (std::size_t i = 0; i < operand_sets().size(); ++i) {
    const Operands& operands = operand_sets()[i];
    const qword result = call.row->function(operands, call.immediate);
    if (result.quadword() == expected.rt[i].quadword()) continue;
    ++differing;
    UNSCOPED_INFO(text_of(operands.a) << " | " << text_of(operands.b) << " | " << text_of(operands.c)
                                      << " -> " << text_of(result) << " and not " << text_of(expected.rt[i]));
  }
  INFO("si_" << call.row->mnemonic << ", immediate " << call.immediate);
  CHECK(differing == 0);
  CHECK(text_of(si_fscrrd()) == text_of(expected.status));
}

TEST_CASE("every si_ function computes what the simulated SPU does") {
  std::vector<Call> calls;
  std::vector<Code> codes;
  for (const Row& row : kRows) {
    const isa::OpcodeInfo& info = info_of(row.mnemonic);
    for (const int immediate : row.has_immediate ? immediates_of(info) : std::vector<int>{0}) {
      calls.push_back({&row, immediate});
      codes.push_back(
          Code().add(row.mnemonic,
                     {.rt = kRt, .ra = kRa, .rb = kRb, .rc = kRc, .immediate = field_of(info, immediate)}));
    }
  }
  const std::vector<Results> expected = execute_simulated(codes);
  for (std::size_t i = 0; i < calls.size(); ++i)
    check(calls[i], expected[i]);
}

TEST_CASE("every instruction that computes has its si_ function") {
  for (const isa::OpcodeInfo& info : isa::opcodes()) {
    using isa::Unit;
    const bool elsewhere = info.unit == Unit::ls || info.unit == Unit::hbr || info.unit == Unit::spr ||
                           info.unit == Unit::nop || info.unit == Unit::lnop ||
                           (info.unit == Unit::br && info.opcode != isa::Opcode::orx);
    const std::string name = info.mnemonic;
    const bool tested_below =
        name == "fscrrd" || name == "fscrwr" || (name[0] == 'h' && info.unit == Unit::fx2);
    INFO(name);
    CHECK((elsewhere || tested_below || std::any_of(std::begin(kRows), std::end(kRows), [&](const Row& row) {
             return name == row.mnemonic;
           })));
  }
}

struct Halt {
  const char* mnemonic;
  void (*function)(const Operands&);
  int immediate;
};
const Halt kHalts[] = {
    {"heq", [](const Operands& o) { si_heq(o.a, o.b); }, 0},
    {"hgt", [](const Operands& o) { si_hgt(o.a, o.b); }, 0},
    {"hlgt", [](const Operands& o) { si_hlgt(o.a, o.b); }, 0},
    {"heqi", [](const Operands& o) { si_heqi(o.a, -5); }, -5},
    {"hgti", [](const Operands& o) { si_hgti(o.a, -5); }, -5},
    {"hlgti", [](const Operands& o) { si_hlgti(o.a, -5); }, -5},
};

TEST_CASE("halts end the program as on the simulated SPU, with a diagnostic") {
  const unsigned words[] = {0, 5, 0xFFFFFFFB, 0xFFFFFFFC, 0x7FFFFFFF, 0x80000000};
  for (const Halt& halt : kHalts) {
    for (const unsigned a : words) {
      for (const unsigned b : {0u, 0xFFFFFFFBu, 0x7FFFFFFFu}) {
        const Operands operands{si_from_uint(a), si_from_uint(b), qword{}};
        Code code;
        const auto load = [&](std::uint32_t rt, unsigned word) {
          code.add("ilhu", {.rt = rt, .immediate = static_cast<std::int32_t>(word >> 16)});
          code.add("iohl", {.rt = rt, .immediate = static_cast<std::int32_t>(word & 0xFFFF)});
        };
        load(kRa, a);
        load(kRb, b);
        code.add(halt.mnemonic, {.ra = kRa, .rb = kRb, .immediate = halt.immediate});
        code.exit();
        const Bytes elf = code.elf();
        MachineConfig config = lockstep(1);
        config.backend = Backend::cell_sim;
        SpeProgram program("halt");
        program.add_image("elf", elf);
        const bool halts = emulate_on(*cell_emu::make_machine(config), program).broke(Rule::halted);
        const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu&) { halt.function(operands); });
        INFO(halt.mnemonic << " " << a << " " << b << "\n" << run.report());
        CHECK(run.broke(Rule::halted) == halts);
        CHECK(run.ok() != halts);
        if (halts) CHECK_THROWS_AS(halt.function(operands), SpeError);
      }
    }
  }
}

TEST_CASE("what does not compute is no instruction of the host") {
  const isa::Quadword zero = isa::Quadword::zero();
  for (const isa::Opcode opcode : {isa::Opcode::lqd, isa::Opcode::br, isa::Opcode::rdch, isa::Opcode::stop})
    CHECK_THROWS_AS(sdk::execute(opcode, zero, zero, zero, 0), InputError);
}

TEST_CASE("each SPE has a floating-point status of its own") {
  si_fscrwr(qword{});
  const EmulatedRun run = emulate(lockstep(2), [](EmulatedSpu& spu) {
    const qword largest = qword(vec_uint4{0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF});
    if (spu.id() == 0) si_fm(largest, largest);
    if (spu.id() == 0)
      spu.read_signal_1();
    else
      spu.send_signal(0, Signal::one, 1);
    CHECK(text_of(si_fscrrd()) ==
          (spu.id() == 0 ? "00000005 00000005 00000005 00000005" : "00000000 00000000 00000000 00000000"));
    spu.write_out_mailbox(1);
  });
  INFO(run.report());
  CHECK(run.ok());
  CHECK(text_of(si_fscrrd()) == "00000000 00000000 00000000 00000000");
}

TEST_CASE("what intrinsics compute takes virtual time") {
  const auto cycles_of = [](unsigned count) {
    return emulate(lockstep(1),
                   [=](EmulatedSpu&) {
                     qword sum{};
                     for (unsigned i = 0; i < count; ++i)
                       sum = si_fma(sum, sum, sum);
                   })
        .spes[0]
        .cycles;
  };
  CHECK(cycles_of(100).fp6 - cycles_of(0).fp6 == 100);
  CHECK(cycles_of(100).total_cycle > cycles_of(0).total_cycle + 100);
}

} // namespace
} // namespace celltrace::test

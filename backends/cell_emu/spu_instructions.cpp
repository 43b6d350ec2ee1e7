// Implements sdk::execute(): the interpreter executes single instructions on a thread's own registers.
#include "celltrace/spe/spu_instructions.hpp"

#include "backends/cell_emu/isa/instruction.hpp"
#include "backends/cell_emu/spu.hpp"

#include <memory>
#include <string>

namespace celltrace::sdk {
namespace {

using isa::Unit;

/// An environment in which only halt instructions work.
class HostEnvironment final : public isa::Environment {
public:
  void halt() override {
    if (cell_emu::Spu* const spu = cell_emu::Spu::running_or_null()) spu->halt_by_instruction();
    throw SpeError("an SPU instruction halted where no SPE program runs");
  }

  std::uint32_t read_channel(unsigned) override { refuse(); }
  void write_channel(unsigned, std::uint32_t) override { refuse(); }
  std::uint32_t channel_count(unsigned) override { refuse(); }
  void stop(std::uint32_t) override { refuse(); }
  void invalid_instruction(std::uint32_t) override { refuse(); }
  bool has_event() override { refuse(); }
  void enable_interrupts(bool) override { refuse(); }
  std::uint32_t srr0() override { refuse(); }
  void watched_load(std::uint32_t) override { refuse(); }
  void watched_store(std::uint32_t, const Quadword&) override { refuse(); }

private:
  [[noreturn]] static void refuse() { throw InputError("no instruction that computes"); }
};

bool computes(const isa::OpcodeInfo& info) {
  switch (info.unit) {
  case Unit::ls:
  case Unit::hbr:
  case Unit::spr:
    return false;
  case Unit::br:
    return info.opcode == Opcode::orx;
  default:
    return true;
  }
}

/// Counts an instruction. It counts as dependent on the instruction before, as in most sequences of
/// intrinsics.
void count(Unit unit) {
  // Cycles for which a double precision operation blocks issue; the rest of its latency is counted as a
  // conversion's.
  constexpr std::uint64_t kDoubleBlocks = 6;
  switch (unit) {
  case Unit::fx2:
    return cell_emu::count_chain({.fx2 = 1});
  case Unit::fx3:
    return cell_emu::count_chain({.fx3 = 1});
  case Unit::fxb:
    return cell_emu::count_chain({.fxb = 1});
  case Unit::fp6:
    return cell_emu::count_chain({.fp6 = 1});
  case Unit::fpd:
    cell_emu::operation_counts.waits += kDoubleBlocks;
    [[fallthrough]];
  case Unit::fp7:
    return cell_emu::count_chain({.fp7 = 1});
  case Unit::shuf:
    return cell_emu::count_chain({.shuf = 1});
  case Unit::br:
    return cell_emu::count_chain({.br = 1});
  default:
    return;
  }
}

/// Returns the immediate as decode() would return it, unsigned for some syntaxes.
std::int32_t decoded(std::int32_t immediate, isa::Syntax syntax) {
  if (syntax == isa::Syntax::rt_u16) return immediate & 0xFFFF;
  if (syntax == isa::Syntax::rt_u18) return immediate & 0x3FFFF;
  return immediate;
}

} // namespace

Quadword execute(Opcode opcode, const Quadword& a, const Quadword& b, const Quadword& c,
                 std::int32_t immediate) {
  const isa::OpcodeInfo& info = isa::opcodes()[static_cast<std::size_t>(opcode)];
  if (!computes(info)) throw InputError(std::string(info.mnemonic) + " is no instruction that computes");
  static HostEnvironment environment;
  // On the heap, because a library that is loaded at run time gets less than these two kilobytes of a
  // thread's static memory.
  static thread_local const auto registers = std::make_unique<isa::State>();
  static thread_local Quadword thread_status{};
  constexpr std::uint8_t kRt = 0, kRa = 1, kRb = 2, kRc = 3;
  isa::Instruction instruction{};
  instruction.immediate = decoded(immediate, info.syntax);
  instruction.rt = kRt;
  instruction.ra = kRa;
  instruction.rb = kRb;
  instruction.rc = kRc;
  isa::State& state = *registers;
  cell_emu::Spu* const spu = cell_emu::Spu::running_or_null();
  Quadword& status = spu != nullptr ? spu->floating_status() : thread_status;
  state.environment = &environment;
  state.fpscr = status;
  state.gpr[kRt] = state.gpr[kRc] = c;
  state.gpr[kRa] = a;
  state.gpr[kRb] = b;
  info.execute(state, instruction);
  status = state.fpscr;
  if (spu != nullptr) count(info.unit);
  return state.gpr[kRt];
}

void* local_quadword(std::uint32_t lsa) {
  const cell_emu::Spu& spu = cell_emu::Spu::running();
  cell_emu::count_chain({.ls = 1});
  const ea_t quadword = spu.addresses(spu.id()).local_store + (lsa & (isa::kLocalStoreLimit & ~15u));
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(quadword));
}

} // namespace celltrace::sdk

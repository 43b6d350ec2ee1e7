// frest, frsqest and fi against what a PlayStation 3 gives.
#include "backends/cell_emu/isa/instruction.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <string>

namespace celltrace::isa {
namespace {

struct Row {
  const char* operation;
  std::uint32_t operand, result;
};
constexpr Row kRows[] = {
#define ESTIMATE(operation, operand, result) {#operation, operand, result},
#include "estimates.inc"
#undef ESTIMATE
};

/// rt = 3, ra = 4, rb = 3
Quadword execute(State& state, const std::string& mnemonic) {
  for (const OpcodeInfo& info : opcodes())
    if (info.mnemonic == mnemonic) {
      const Instruction instruction = decode(info.code << 21 | 3u << 14 | 4u << 7 | 3u);
      instruction.execute(state, instruction);
      return state.gpr[3];
    }
  FAIL("no instruction " << mnemonic);
  return {};
}

TEST_CASE("estimates are the hardware's") {
  const auto state = std::make_unique<State>();
  for (const Row& row : kRows) {
    INFO(row.operation << ' ' << std::hex << row.operand);
    const std::string operation = row.operation;
    state->gpr[4] = Quadword::splat(row.operand);
    Quadword result = execute(*state, operation.substr(0, operation.find('_')));
    if (operation.find("_fi") != std::string::npos) result = execute(*state, "fi");
    for (unsigned slot = 0; slot < 4; ++slot)
      CHECK(result.word(slot) == row.result);
  }
}

} // namespace
} // namespace celltrace::isa

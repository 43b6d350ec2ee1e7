// What the tables of instructions have to cover.
#include "isa/instruction_rows.hpp"
#include "isa/machines.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <set>
#include <string>

using namespace celltrace;
using namespace celltrace::test;

TEST_CASE("every instruction has a row") {
  std::set<std::string> covered;
  for (const auto& rows : {integer_rows(), shift_rows(), shuffle_rows(), single_rows(), double_rows(),
                           memory_rows(), branch_rows(), channel_rows()})
    for (const Row& row : rows)
      covered.insert(row.op);
  std::string missing;
  for (const isa::OpcodeInfo& info : isa::opcodes())
    if (covered.count(info.mnemonic) == 0) missing += std::string(" ") + info.mnemonic;
  CHECK(missing.empty());
  CHECK(isa::opcodes().size() >= 199);
}

TEST_CASE("interpreter and reference know the same opcodes") {
  const auto interpreter = std::make_unique<InterpreterMachine>();
  const auto reference = std::make_unique<ReferenceMachine>();
  const auto invalid = [](const Machine& machine, std::uint32_t word) {
    return machine.effects() == std::vector<Effect>{{Effect::invalid, word}};
  };
  for (std::uint32_t opcode = 0; opcode < 1u << 11; ++opcode) {
    const std::uint32_t word = opcode << 21;
    INFO(isa::disassemble(word, 0));
    interpreter->execute(0, word);
    reference->execute(0, word);
    CHECK(invalid(*interpreter, word) == invalid(*reference, word));
    CHECK(invalid(*reference, word) == (isa::find_opcode(word) == nullptr));
  }
}

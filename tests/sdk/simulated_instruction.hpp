// Results of single instructions, as the simulated SPU computes them: machine code that loads operands from
// tables, executes the instruction and stores what it gives.
#pragma once

#include "celltrace/spe/spu_vectors.hpp"
#include "simulator/machine_code.hpp"

#include <string>
#include <vector>

namespace celltrace::test {

/// Values of registers ra, rb and rc; rt has that of rc before the instruction.
struct Operands {
  qword a, b, c;
};

/// The registers that code for one set of operands works on.
constexpr std::uint32_t kRa = 10, kRb = 11, kRc = 12, kRt = 13;

/// By instructions: numbers of each kind that are special, and random ones.
const std::vector<Operands>& operand_sets();

struct Results {
  std::vector<qword> rt; ///< by set
  qword status;          ///< the FPSCR, which was 0 before the first set
};

/// Each of the codes, executed for each of operand_sets().
std::vector<Results> execute_simulated(const std::vector<Code>& codes);

/// As words in hexadecimal.
std::string text_of(const qword& value);

} // namespace celltrace::test

// Tables of instructions: operands, and what the Instruction Set Architecture says comes of them.
#pragma once

#include "isa/reference.hpp"

#include <span>
#include <string_view>

namespace celltrace::test {

/// One instruction. Registers are text of hexadecimal digits, spaces do not count: a whole one, or a part
/// that all parts of it are like. Its registers are $3 for rt, $4 for ra, $5 for rb and $6 for rc.
struct Row {
  const char* op;
  const char* ra = "c1c2c3c4";
  const char* rb = "c5c6c7c8";
  const char* rc = "c9cacbcc";
  const char* rt = "cdcecfd0"; ///< before
  int immediate = 0;           ///< as the assembler's, but of lqd and branches as the word has it
  unsigned channel = 0;
  unsigned feature = 0; ///< D and E of indirect branches
  std::uint32_t pc = 0x1000;
  std::uint32_t at = 0x2000; ///< the quadword of local store that counts
  const char* holds = "00";
  const char* fpscr = "00";
  Answers answers = {};

  // What comes of it; nothing else may change.
  const char* gives = nullptr;       ///< rt
  const char* stores = nullptr;      ///< in the quadword
  const char* fpscr_after = nullptr; ///< null: as before
  std::uint32_t next = 0x1004;
  std::vector<Effect> effects = {};
};

constexpr unsigned kDisableInterrupts = 0x20, kEnableInterrupts = 0x10;

/// By duty.
std::span<const Row> integer_rows();
std::span<const Row> shift_rows();
std::span<const Row> shuffle_rows();
std::span<const Row> single_rows();
std::span<const Row> double_rows();
std::span<const Row> memory_rows();
std::span<const Row> branch_rows();
std::span<const Row> channel_rows();

Register register_of(std::string_view text);
/// In hexadecimal words.
std::string text_of(const Register& value);

/// Runs them on the interpreter and on the reference and checks all that they changed.
void check(std::span<const Row> rows);

} // namespace celltrace::test

// InlinedCalls finds the calls that the compiler inlined, by a program's DWARF information.
//
// DWARF Debugging Information Format, versions 2 to 4, sections 3.3.8, 7.5 and 2.17.
#pragma once

#include "backends/cell_emu/simulator/line_files.hpp"
#include "backends/cell_emu/simulator/spu_elf.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// A call that was replaced by the called function's body. Its strings live as long as the InlinedCalls.
struct InlinedCall {
  /// Name of the called function as in the source, with template arguments; empty: unknown.
  std::string_view callee;
  /// File that contains the call, as its name was passed to the compiler, with folder; null: unknown.
  const char* file = nullptr;
  std::uint32_t line = 0; ///< line of the call, from 1; 0: unknown
};

/// The inlined calls that .debug_info and related sections describe. Malformed parts are left out; the rest
/// of the sections is used. For sections of n bytes, time is proportional to n log n, memory to n. Functions
/// at address 0, where the SPU's interrupt handler lies, count as discarded by the linker. Thread safety: all
/// members are const.
class InlinedCalls {
public:
  struct Sections {
    std::span<const std::uint8_t> info, abbrev, ranges, line, strings;
  };

  explicit InlinedCalls(const SpuElf& elf);
  /// Reads sections, which must outlive this object.
  explicit InlinedCalls(const Sections& sections);
  InlinedCalls(InlinedCalls&&) = default;
  InlinedCalls& operator=(InlinedCalls&&) = default;

  /// Returns the calls whose inlined bodies contain the instruction at `lsa`, the innermost first; at most
  /// 64.
  std::vector<InlinedCall> at(std::uint32_t lsa) const;

  bool empty() const { return steps_.empty(); }

private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  /// A function, or the inlined body of a call.
  struct Scope {
    std::uint32_t outer = kNone;  ///< index in scopes_ of the scope around this scope; kNone for a function
    std::uint32_t depth = 0;      ///< number of scopes around this scope
    std::uint32_t callee = kNone; ///< offset in .debug_info of the function's entry
    std::uint32_t file = kNone;   ///< number of the call's file in files_
    std::uint32_t line = 0;
  };
  /// A function's entry in .debug_info, which has a name or refers to another entry.
  struct Function {
    std::uint32_t entry = 0; ///< offset of the entry
    std::uint32_t name = kNone;
    bool name_in_strings = false;
    std::uint32_t refers_to = kNone;
  };
  /// A range of a scope's code, which includes the code of inner scopes.
  struct Extent {
    std::uint32_t begin = 0, end = 0, scope = kNone;
  };
  /// An address from which on `scope` is the innermost scope.
  struct Step {
    std::uint32_t lsa = 0, scope = kNone;
  };
  class Unit;
  struct Reading;

  void read();
  void lay_out(std::vector<Extent> extents);
  std::string_view name_of(std::uint32_t entry) const;

  std::optional<SpuElf> elf_; // owner of the sections, if known
  Sections sections_;
  FileNames files_;
  std::vector<Scope> scopes_;
  std::vector<Function> functions_; // by ascending entry
  std::vector<Step> steps_;         // by ascending address; no two have the same address
};

} // namespace celltrace::cell_emu

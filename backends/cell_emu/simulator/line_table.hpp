// LineTable finds the source line of an instruction, by a program's DWARF line number information.
//
// DWARF Debugging Information Format, versions 2 to 4, section 6.2.
#pragma once

#include "backends/cell_emu/simulator/line_files.hpp"
#include "backends/cell_emu/simulator/spu_elf.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace celltrace::cell_emu {

/// A place in source text.
struct SourceLine {
  /// Name as it was passed to the compiler, with folder; lives as long as the LineTable.
  const char* file = nullptr;
  std::uint32_t line = 0; ///< from 1
};

/// The source lines that .debug_line describes. Malformed parts are left out; the rest of the section is
/// used. Time and memory are proportional to the size of the section. Thread safety: all members are const.
class LineTable {
public:
  explicit LineTable(const SpuElf& elf);
  explicit LineTable(std::span<const std::uint8_t> debug_line);
  LineTable(LineTable&&) = default;
  LineTable& operator=(LineTable&&) = default;

  /// Returns the line of an address; a null file and line 0 if it is unknown.
  SourceLine at(std::uint32_t lsa) const;

  bool empty() const { return rows_.empty(); }

private:
  struct Row {
    std::uint32_t lsa = 0;
    std::uint32_t line = 0; ///< 0: unknown from here on
    std::uint32_t file = 0; ///< number in files_
  };
  struct Sequence {
    std::vector<Row> rows; ///< by ascending address; the last row ends the sequence
    std::uint32_t first() const { return rows.front().lsa; }
    std::uint32_t end() const { return rows.back().lsa; }
  };
  class Unit;

  void merge(std::vector<Sequence> sequences);

  std::vector<Row> rows_; // by ascending address; no two have the same address
  FileNames files_;
};

} // namespace celltrace::cell_emu

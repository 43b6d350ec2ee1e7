// Which line of which source file an instruction comes from: the DWARF line number information of a program.
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
  const char* file = nullptr; ///< as the compiler was told, with its folder; lives as long as the LineTable
  std::uint32_t line = 0;     ///< from 1
};

/// Made from .debug_line. Whatever is malformed has no lines, but what else is in the section may. Work and
/// memory are proportional to the size of the section.
/// Thread safety: all members are const.
class LineTable {
public:
  explicit LineTable(const SpuElf& elf);
  explicit LineTable(std::span<const std::uint8_t> debug_line);
  LineTable(LineTable&&) = default;
  LineTable& operator=(LineTable&&) = default;

  /// A null file and line 0 where nothing is known.
  SourceLine at(std::uint32_t lsa) const;

  bool empty() const { return rows_.empty(); }

private:
  struct Row {
    std::uint32_t lsa = 0;
    std::uint32_t line = 0; ///< 0: from here on nothing is known
    std::uint32_t file = 0; ///< in files_
  };
  struct Sequence {
    std::vector<Row> rows; ///< by rising address; the last one ends it
    std::uint32_t first() const { return rows.front().lsa; }
    std::uint32_t end() const { return rows.back().lsa; }
  };
  class Unit;

  void merge(std::vector<Sequence> sequences);

  std::vector<Row> rows_; // by rising address, no two with the same
  FileNames files_;
};

} // namespace celltrace::cell_emu

// Reads the table of files in the header of each unit of .debug_line (DWARF versions 2 to 4, section 6.2.4).
// Line number programs and inlined calls refer to files by their numbers in this table.
#pragma once

#include "backends/cell_emu/simulator/dwarf_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// Names of files with their folders. Pointers to the names stay valid as long as the object lives, also when
/// it is moved.
class FileNames {
public:
  FileNames() = default;
  FileNames(FileNames&&) = default;
  FileNames& operator=(FileNames&&) = default;

  /// Adds a name and returns its number. A folder is left out if all names together would become much larger
  /// than the ELF file.
  std::uint32_t add(std::string_view folder, std::string_view name);
  const char* operator[](std::uint32_t number) const { return names_[number].c_str(); }

private:
  std::deque<std::string> names_;
  std::size_t bytes_ = 0;
};

/// The header of a line number program.
struct LineHeader {
  std::uint8_t instruction_bytes = 4, line_range = 1, opcode_base = 1;
  int line_base = 0;
  std::span<const std::uint8_t> operands; ///< number of operands of each standard opcode, from opcode 1 on
  DwarfReader tables;                     ///< tables of folders and files

  /// Reads the header of a unit, whose length has been read; leaves the reader in front of the program.
  /// Throws MalformedDwarf.
  static LineHeader read(DwarfReader& unit);
};

/// The table of files of one unit.
class LineFiles {
public:
  LineFiles() = default;
  /// Reads the table. Throws MalformedDwarf.
  explicit LineFiles(DwarfReader tables);

  /// Adds a file that a line number program defines. Throws MalformedDwarf.
  void define(DwarfReader entry);
  /// Returns the number in `names` of the file with number `file` (from 1) in this table, and adds its name
  /// if necessary; nothing if the file is not in this table.
  std::optional<std::uint32_t> in(FileNames& names, std::uint64_t file);

private:
  struct File {
    std::string_view folder, name;
    std::optional<std::uint32_t> number; ///< number in FileNames; none before the first request
  };

  void add(DwarfReader& entry, std::string_view name);

  std::vector<std::string_view> folders_{1};
  std::vector<File> files_;
};

} // namespace celltrace::cell_emu

#include "backends/cell_emu/simulator/line_files.hpp"

namespace celltrace::cell_emu {

std::uint32_t FileNames::add(std::string_view folder, std::string_view name) {
  // Limits for malicious tables: a folder's name is stored with each of its files, so that memory could be
  // quadratic.
  constexpr std::size_t kLongestPath = 4096, kMostBytes = 1 << 24;
  std::string path;
  if (!name.starts_with('/') && !folder.empty() && bytes_ < kMostBytes &&
      folder.size() + name.size() < kLongestPath) {
    path = folder;
    path += '/';
  }
  path += name;
  bytes_ += path.size();
  names_.push_back(std::move(path));
  return static_cast<std::uint32_t>(names_.size() - 1);
}

LineHeader LineHeader::read(DwarfReader& unit) {
  const auto version = unit.integer<std::uint16_t>();
  if (version < 2 || version > 4) throw MalformedDwarf();
  DwarfReader bytes(unit.take(unit.integer<std::uint32_t>()));
  LineHeader header;
  header.instruction_bytes = bytes.integer<std::uint8_t>();
  if (version >= 4) bytes.take(1); // operations per instruction: one on the SPU
  bytes.take(1);                   // default of is_stmt
  header.line_base = static_cast<std::int8_t>(bytes.integer<std::uint8_t>());
  header.line_range = bytes.integer<std::uint8_t>();
  header.opcode_base = bytes.integer<std::uint8_t>();
  if (header.line_range == 0 || header.opcode_base == 0) throw MalformedDwarf();
  header.operands = bytes.take(header.opcode_base - 1u);
  header.tables = bytes;
  return header;
}

LineFiles::LineFiles(DwarfReader tables) {
  for (std::string_view folder = tables.string(); !folder.empty(); folder = tables.string())
    folders_.push_back(folder);
  for (std::string_view name = tables.string(); !name.empty(); name = tables.string())
    add(tables, name);
}

void LineFiles::define(DwarfReader entry) {
  const std::string_view name = entry.string();
  add(entry, name);
}

void LineFiles::add(DwarfReader& entry, std::string_view name) {
  const std::uint64_t folder = entry.unsigned_leb();
  entry.unsigned_leb(); // time of change
  entry.unsigned_leb(); // size
  files_.push_back({folder < folders_.size() ? folders_[folder] : std::string_view(), name, {}});
}

std::optional<std::uint32_t> LineFiles::in(FileNames& names, std::uint64_t file) {
  if (file == 0 || file > files_.size()) return std::nullopt;
  File& wanted = files_[file - 1];
  if (!wanted.number) wanted.number = names.add(wanted.folder, wanted.name);
  return wanted.number;
}

} // namespace celltrace::cell_emu

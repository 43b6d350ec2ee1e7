#include "backends/cell_emu/simulator/line_table.hpp"

#include "backends/cell_emu/simulator/dwarf_reader.hpp"
#include "celltrace/spe/types.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace celltrace::cell_emu {

namespace {

constexpr std::uint8_t kCopy = 1, kAdvancePc = 2, kAdvanceLine = 3, kSetFile = 4, kConstAddPc = 8,
                       kFixedAdvancePc = 9;
constexpr std::uint8_t kEndSequence = 1, kSetAddress = 2, kDefineFile = 3;

} // namespace

/// One compilation unit: its header, and its line number program, whose execution makes rows.
class LineTable::Unit {
public:
  Unit(FileNames& names, std::vector<Sequence>& sequences) : names_(names), sequences_(sequences) {}

  /// Reads the unit. Throws MalformedDwarf; sequences that ended before the fault are kept.
  void read(DwarfReader unit) {
    header_ = LineHeader::read(unit);
    files_ = LineFiles(header_.tables);
    DwarfReader& program = unit;
    reset();
    while (!program.done())
      step(program);
  }

private:
  void step(DwarfReader& program) {
    const auto opcode = program.integer<std::uint8_t>();
    if (opcode >= header_.opcode_base) {
      const unsigned adjusted = opcode - header_.opcode_base;
      advance(adjusted / header_.line_range);
      line_ +=
          static_cast<std::uint32_t>(header_.line_base + static_cast<int>(adjusted % header_.line_range));
      add_row();
      return;
    }
    switch (opcode) {
    case 0:
      extended(program);
      break;
    case kCopy:
      add_row();
      break;
    case kAdvancePc:
      advance(program.unsigned_leb());
      break;
    case kAdvanceLine:
      line_ += static_cast<std::uint32_t>(program.signed_leb());
      break;
    case kSetFile:
      file_ = program.unsigned_leb();
      break;
    case kConstAddPc:
      advance((255u - header_.opcode_base) / header_.line_range);
      break;
    case kFixedAdvancePc:
      address_ += program.integer<std::uint16_t>();
      break;
    default: // unknown opcodes, and opcodes without effect on lines: skip the operands
      for (unsigned i = 0; i < header_.operands[opcode - 1u]; ++i)
        program.unsigned_leb();
    }
  }

  void extended(DwarfReader& program) {
    DwarfReader operation(program.take(program.unsigned_leb()));
    switch (operation.integer<std::uint8_t>()) {
    case kEndSequence:
      end_sequence();
      break;
    case kSetAddress:
      address_ = operation.integer<std::uint32_t>();
      break;
    case kDefineFile:
      files_.define(operation);
      break;
    default:
      break;
    }
  }

  void advance(std::uint64_t instructions) { address_ += instructions * header_.instruction_bytes; }

  void add_row() {
    if (address_ > kLocalStoreBytes || (!rows_.empty() && address_ < rows_.back().lsa)) sane_ = false;
    if (!sane_) return;
    if (!rows_.empty() && rows_.back().lsa == address_)
      rows_.pop_back(); // of several rows with one address, the last is used
    const std::optional<std::uint32_t> file = files_.in(names_, file_);
    rows_.push_back({static_cast<std::uint32_t>(address_), file ? line_ : 0, file.value_or(0)});
  }

  void end_sequence() {
    line_ = 0;
    add_row();
    if (sane_ && rows_.size() > 1) sequences_.push_back({std::move(rows_)});
    reset();
  }

  void reset() {
    address_ = 0;
    line_ = 1;
    file_ = 1;
    sane_ = true;
    rows_.clear();
  }

  FileNames& names_;
  std::vector<Sequence>& sequences_;

  LineHeader header_;
  LineFiles files_;

  std::uint64_t address_ = 0, file_ = 1;
  std::uint32_t line_ = 1;
  bool sane_ = true; // true if all rows of this sequence were inside local store and in ascending order
  std::vector<Row> rows_;
};

LineTable::LineTable(const SpuElf& elf)
    : LineTable(elf.section(".debug_line") != nullptr ? elf.section(".debug_line")->content
                                                      : std::span<const std::uint8_t>()) {
}

LineTable::LineTable(std::span<const std::uint8_t> debug_line) {
  std::vector<Sequence> sequences;
  DwarfReader section(debug_line);
  try {
    while (!section.done()) {
      const auto length = section.integer<std::uint32_t>();
      const DwarfReader unit(section.take(length));
      try {
        Unit(files_, sequences).read(unit);
      } catch (const MalformedDwarf&) { // go on with the next unit
      }
    }
  } catch (const MalformedDwarf&) { // after a wrong length no further unit can be found
  }
  merge(std::move(sequences));
}

void LineTable::merge(std::vector<Sequence> sequences) {
  // Functions that the linker discarded have the address 0. They are sorted last, so that they do not hide
  // code that exists.
  std::ranges::stable_sort(sequences, {}, [](const Sequence& sequence) {
    return std::pair(sequence.first() == 0, sequence.first());
  });
  std::map<std::uint32_t, const Sequence*> kept;
  for (const Sequence& sequence : sequences) {
    const auto next = kept.lower_bound(sequence.first());
    if (next != kept.end() && next->first < sequence.end()) continue;
    if (next != kept.begin() && std::prev(next)->second->end() > sequence.first()) continue;
    kept.emplace(sequence.first(), &sequence);
  }
  for (const auto& [first, sequence] : kept) {
    if (!rows_.empty() && rows_.back().lsa == first) rows_.pop_back();
    rows_.insert(rows_.end(), sequence->rows.begin(), sequence->rows.end());
  }
}

SourceLine LineTable::at(std::uint32_t lsa) const {
  const auto behind = std::ranges::upper_bound(rows_, lsa, {}, &Row::lsa);
  if (behind == rows_.begin()) return {};
  const Row& row = *std::prev(behind);
  if (row.line == 0) return {};
  return {files_[row.file], row.line};
}

} // namespace celltrace::cell_emu

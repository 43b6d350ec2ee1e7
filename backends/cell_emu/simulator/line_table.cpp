#include "backends/cell_emu/simulator/line_table.hpp"

#include "backends/cell_emu/simulator/big_endian.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace celltrace::cell_emu {

namespace {

constexpr std::uint64_t kLocalStoreBytes = 256 * 1024;
constexpr std::uint8_t kCopy = 1, kAdvancePc = 2, kAdvanceLine = 3, kSetFile = 4, kConstAddPc = 8,
                       kFixedAdvancePc = 9;
constexpr std::uint8_t kEndSequence = 1, kSetAddress = 2, kDefineFile = 3;

/// Thrown by a reader that meets the end of its bytes; never leaves this file.
struct Malformed {};

/// Reads from the front of some bytes.
class Reader {
public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool done() const { return rest_.empty(); }

  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > rest_.size()) throw Malformed();
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  template <class Integer> Integer integer() {
    return load_big_endian<Integer>(take(sizeof(Integer)).data());
  }

  /// LEB128; bits above the 64th are dropped.
  std::uint64_t unsigned_leb() { return leb().first; }
  std::int64_t signed_leb() {
    auto [value, bits] = leb();
    if (bits < 64 && (value >> (bits - 1) & 1) != 0) value |= ~std::uint64_t{0} << bits;
    return static_cast<std::int64_t>(value);
  }

  std::string_view string() {
    const auto end = std::ranges::find(rest_, 0);
    if (end == rest_.end()) throw Malformed();
    const auto bytes = take(static_cast<std::size_t>(end - rest_.begin()) + 1);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size() - 1};
  }

private:
  std::pair<std::uint64_t, unsigned> leb() {
    std::uint64_t value = 0;
    unsigned bits = 0;
    std::uint8_t byte = 0;
    do {
      byte = integer<std::uint8_t>();
      if (bits < 64) {
        value |= std::uint64_t{byte & 0x7Fu} << bits;
        bits += 7;
      }
    } while ((byte & 0x80) != 0);
    return {value, bits};
  }

  std::span<const std::uint8_t> rest_;
};

} // namespace

/// One compilation unit: its header, then its program, which is executed by a machine that builds rows.
class LineTable::Unit {
public:
  /// @param name_bytes in `names` so far
  Unit(std::deque<std::string>& names, std::size_t& name_bytes, std::vector<Sequence>& sequences)
      : names_(names), name_bytes_(name_bytes), sequences_(sequences) {}

  /// Throws Malformed; the sequences that ended before stay.
  void read(Reader unit) {
    Reader program = read_header(unit);
    reset();
    while (!program.done())
      step(program);
  }

private:
  struct File {
    std::string_view folder, name;
    std::optional<std::uint32_t> index; ///< in names_, once a row needs it
  };

  // Names of folders are stored again with every file in them: a malicious table could make that quadratic.
  static constexpr std::size_t kLongestPath = 4096, kMostNameBytes = 1 << 24;

  Reader read_header(Reader& unit) {
    const auto version = unit.integer<std::uint16_t>();
    if (version < 2 || version > 4) throw Malformed();
    Reader header(unit.take(unit.integer<std::uint32_t>()));
    instruction_bytes_ = header.integer<std::uint8_t>();
    if (version >= 4) header.take(1); // operations in an instruction: one on the SPU
    header.take(1);                   // whether rows are statements at first
    line_base_ = static_cast<std::int8_t>(header.integer<std::uint8_t>());
    line_range_ = header.integer<std::uint8_t>();
    opcode_base_ = header.integer<std::uint8_t>();
    if (line_range_ == 0 || opcode_base_ == 0) throw Malformed();
    operands_ = header.take(opcode_base_ - 1u);
    read_files(header);
    return unit;
  }

  void read_files(Reader& header) {
    std::vector<std::string_view> folders(1);
    for (std::string_view folder = header.string(); !folder.empty(); folder = header.string())
      folders.push_back(folder);
    for (std::string_view name = header.string(); !name.empty(); name = header.string())
      add_file(header, name, folders);
    folders_ = std::move(folders);
  }

  void add_file(Reader& reader, std::string_view name, const std::vector<std::string_view>& folders) {
    const std::uint64_t folder = reader.unsigned_leb();
    reader.unsigned_leb(); // time of change
    reader.unsigned_leb(); // size
    files_.push_back({folder < folders.size() ? folders[folder] : std::string_view(), name, {}});
  }

  void step(Reader& program) {
    const auto opcode = program.integer<std::uint8_t>();
    if (opcode >= opcode_base_) {
      const unsigned adjusted = opcode - opcode_base_;
      advance(adjusted / line_range_);
      line_ += static_cast<std::uint32_t>(line_base_ + static_cast<int>(adjusted % line_range_));
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
      advance((255u - opcode_base_) / line_range_);
      break;
    case kFixedAdvancePc:
      address_ += program.integer<std::uint16_t>();
      break;
    default: // without effect on lines, or unknown
      for (unsigned i = 0; i < operands_[opcode - 1u]; ++i)
        program.unsigned_leb();
    }
  }

  void extended(Reader& program) {
    Reader operation(program.take(program.unsigned_leb()));
    switch (operation.integer<std::uint8_t>()) {
    case kEndSequence:
      end_sequence();
      break;
    case kSetAddress:
      address_ = operation.integer<std::uint32_t>();
      break;
    case kDefineFile: {
      const std::string_view name = operation.string();
      add_file(operation, name, folders_);
      break;
    }
    default:
      break;
    }
  }

  void advance(std::uint64_t instructions) { address_ += instructions * instruction_bytes_; }

  void add_row() {
    if (address_ > kLocalStoreBytes || (!rows_.empty() && address_ < rows_.back().lsa)) sane_ = false;
    if (!sane_) return;
    if (!rows_.empty() && rows_.back().lsa == address_) rows_.pop_back(); // the last one counts
    rows_.push_back({static_cast<std::uint32_t>(address_), line_, file_index()});
    if (files_.size() < file_ || file_ == 0) rows_.back().line = 0;
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

  std::uint32_t file_index() {
    if (file_ == 0 || file_ > files_.size()) return 0;
    File& file = files_[file_ - 1];
    if (!file.index) file.index = store(file);
    return *file.index;
  }

  std::uint32_t store(const File& file) {
    const bool absolute = file.name.starts_with('/');
    std::string path;
    if (!absolute && !file.folder.empty() && name_bytes_ < kMostNameBytes &&
        file.folder.size() + file.name.size() < kLongestPath) {
      path = file.folder;
      path += '/';
    }
    path += file.name;
    name_bytes_ += path.size();
    names_.push_back(std::move(path));
    return static_cast<std::uint32_t>(names_.size() - 1);
  }

  std::deque<std::string>& names_;
  std::size_t& name_bytes_;
  std::vector<Sequence>& sequences_;

  std::uint8_t instruction_bytes_ = 4, line_range_ = 1, opcode_base_ = 1;
  int line_base_ = 0;
  std::span<const std::uint8_t> operands_;
  std::vector<std::string_view> folders_;
  std::vector<File> files_;

  std::uint64_t address_ = 0, file_ = 1;
  std::uint32_t line_ = 1;
  bool sane_ = true; // no row of this sequence was outside local store or before another
  std::vector<Row> rows_;
};

LineTable::LineTable(const SpuElf& elf)
    : LineTable(elf.section(".debug_line") != nullptr ? elf.section(".debug_line")->content
                                                      : std::span<const std::uint8_t>()) {
}

LineTable::LineTable(std::span<const std::uint8_t> debug_line) {
  std::vector<Sequence> sequences;
  std::size_t name_bytes = 0;
  Reader section(debug_line);
  try {
    while (!section.done()) {
      const auto length = section.integer<std::uint32_t>();
      const Reader unit(section.take(length));
      try {
        Unit(files_, name_bytes, sequences).read(unit);
      } catch (const Malformed&) { // the next unit may be sound
      }
    }
  } catch (const Malformed&) { // a length beyond the section: nothing follows that could be found
  }
  merge(std::move(sequences));
}

void LineTable::merge(std::vector<Sequence> sequences) {
  // Functions that the linker threw away are said to start at 0: what is really there has its turn first.
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
  return {files_[row.file].c_str(), row.line};
}

} // namespace celltrace::cell_emu

#include "backends/cell_emu/simulator/inlined_calls.hpp"

#include "backends/cell_emu/simulator/dwarf_reader.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

namespace celltrace::cell_emu {
namespace {

constexpr std::uint32_t kLocalStoreBytes = 256 * 1024;
constexpr std::uint8_t kAddressBytes = 4;

enum Tag : std::uint64_t { kInlinedSubroutine = 0x1D, kSubprogram = 0x2E };

enum Attribute : std::uint64_t {
  kName = 0x03,
  kLineProgram = 0x10,
  kLowPc = 0x11,
  kHighPc = 0x12,
  kAbstractOrigin = 0x31,
  kSpecification = 0x47,
  kRanges = 0x55,
  kCallFile = 0x58,
  kCallLine = 0x59,
};

enum Form : std::uint64_t {
  kAddress = 0x01,
  kBlock2 = 0x03,
  kBlock4 = 0x04,
  kData2 = 0x05,
  kData4 = 0x06,
  kData8 = 0x07,
  kString = 0x08,
  kBlock = 0x09,
  kBlock1 = 0x0A,
  kData1 = 0x0B,
  kFlag = 0x0C,
  kSignedData = 0x0D,
  kStringOffset = 0x0E,
  kUnsignedData = 0x0F,
  kReferenceAnywhere = 0x10,
  kReference1 = 0x11,
  kReference2 = 0x12,
  kReference4 = 0x13,
  kReference8 = 0x14,
  kReferenceUnsigned = 0x15,
  kIndirect = 0x16,
  kSectionOffset = 0x17,
  kExpression = 0x18,
  kFlagPresent = 0x19,
  kSignature = 0x20,
};

struct AttributeForm {
  std::uint64_t attribute, form;
};

/// A kind of entry in .debug_info, with the forms of its attributes.
struct Abbreviation {
  std::uint64_t tag = 0;
  bool has_children = false;
  std::vector<AttributeForm> attributes;
};
using Abbreviations = std::map<std::uint64_t, Abbreviation>;

/// An entry of .debug_info: its attributes that say where its code and its caller are.
struct Entry {
  std::uint32_t offset = 0; ///< offset of the entry in .debug_info
  const Abbreviation* kind = nullptr;
  std::uint64_t low = 0, high = 0;
  bool has_low = false, has_high = false, high_is_size = false;
  std::optional<std::uint32_t> ranges, name, origin, line_program;
  bool name_in_strings = false;
  std::uint64_t call_file = 0, call_line = 0;
};

std::span<const std::uint8_t> from(std::span<const std::uint8_t> section, std::uint64_t offset) {
  if (offset > section.size()) throw MalformedDwarf();
  return section.subspan(static_cast<std::size_t>(offset));
}

} // namespace

/// The state that the units of a program share while they are read.
struct InlinedCalls::Reading {
  explicit Reading(const Sections& sections)
      : abbreviation_bytes(sections.abbrev.size()), line_bytes(sections.line.size()),
        // In sound files each pair of addresses belongs to one entry, so no more pairs are read than the
        // section has.
        pairs(sections.ranges.size() / (2 * kAddressBytes)) {}

  const Abbreviations& abbreviations(std::span<const std::uint8_t> section, std::uint32_t offset);
  LineFiles* line_files(std::span<const std::uint8_t> section, std::uint32_t offset);

  std::vector<Extent> extents;
  // Tables by their offset, because units may share tables. Only malicious files have tables that overlap in
  // part.
  std::map<std::uint32_t, Abbreviations> known_abbreviations;
  std::map<std::uint32_t, LineFiles> known_line_files;
  /// Bytes, and pairs of addresses, that may still be read: limits for malicious files.
  std::size_t abbreviation_bytes, line_bytes, pairs;
};

const Abbreviations& InlinedCalls::Reading::abbreviations(std::span<const std::uint8_t> section,
                                                          std::uint32_t offset) {
  const auto [place, is_new] = known_abbreviations.try_emplace(offset);
  if (!is_new) return place->second;
  const auto all = from(section, offset);
  DwarfReader reader(all.first(std::min(all.size(), abbreviation_bytes)));
  const std::size_t before = reader.left();
  try {
    while (const std::uint64_t code = reader.unsigned_leb()) {
      Abbreviation made;
      made.tag = reader.unsigned_leb();
      made.has_children = reader.integer<std::uint8_t>() != 0;
      for (;;) {
        const std::uint64_t attribute = reader.unsigned_leb(), form = reader.unsigned_leb();
        if (attribute == 0 && form == 0) break;
        // Flags that are only present take no bytes of an entry and are not used here; keeping many of them
        // would only take time.
        if (form != kFlagPresent) made.attributes.push_back({attribute, form});
      }
      place->second.try_emplace(code, std::move(made));
    }
  } catch (const MalformedDwarf&) { // entries before the fault are kept
  }
  abbreviation_bytes -= before - reader.left();
  return place->second;
}

LineFiles* InlinedCalls::Reading::line_files(std::span<const std::uint8_t> section, std::uint32_t offset) {
  const auto [place, is_new] = known_line_files.try_emplace(offset);
  if (!is_new) return &place->second;
  try {
    DwarfReader reader(from(section, offset));
    DwarfReader unit(reader.take(reader.integer<std::uint32_t>()));
    const LineHeader header = LineHeader::read(unit);
    if (header.tables.left() > line_bytes) throw MalformedDwarf();
    line_bytes -= header.tables.left();
    place->second = LineFiles(header.tables);
  } catch (const MalformedDwarf&) { // calls of this unit have no files
  }
  return &place->second;
}

/// One compilation unit: a tree of entries.
class InlinedCalls::Unit {
public:
  /// Prepares to read the unit at `offset` of .debug_info. `bytes` begin with the unit's length.
  Unit(InlinedCalls& calls, Reading& reading, std::span<const std::uint8_t> bytes, std::uint32_t offset)
      : calls_(calls), reading_(reading), bytes_(bytes), offset_(offset) {}

  /// Reads the unit. Throws MalformedDwarf; entries that were read before stay.
  void read() {
    DwarfReader reader(bytes_);
    reader.integer<std::uint32_t>(); // its length
    const auto version = reader.integer<std::uint16_t>();
    if (version < 2 || version > 4) throw MalformedDwarf();
    const auto abbreviations = reader.integer<std::uint32_t>();
    if (reader.integer<std::uint8_t>() != kAddressBytes) throw MalformedDwarf();
    const Abbreviations& known = reading_.abbreviations(calls_.sections_.abbrev, abbreviations);
    std::vector<std::uint32_t> around; // for each open entry, the scope that its children are in
    while (!reader.done()) {
      const auto entry_offset = offset_ + static_cast<std::uint32_t>(bytes_.size() - reader.left());
      const std::uint64_t code = reader.unsigned_leb();
      if (code == 0) { // the end of an entry's children, or padding
        if (!around.empty()) around.pop_back();
        continue;
      }
      const auto kind = known.find(code);
      if (kind == known.end()) throw MalformedDwarf();
      Entry entry;
      entry.offset = entry_offset;
      entry.kind = &kind->second;
      for (const AttributeForm& each : kind->second.attributes)
        read_attribute(reader, each, entry);
      const std::uint32_t scope = take(entry, around.empty() ? kNone : around.back());
      if (kind->second.has_children) around.push_back(scope);
    }
  }

private:
  struct Value {
    std::uint64_t number = 0;
    bool is_address = false, is_in_strings = false;
  };

  Value read_value(DwarfReader& reader, std::uint64_t form) const {
    const auto here = [&] { return offset_ + static_cast<std::uint32_t>(bytes_.size() - reader.left()); };
    // Each indirection takes a byte, which bounds the loop.
    while (form == kIndirect)
      form = reader.unsigned_leb();
    switch (form) {
    case kAddress:
      return {reader.integer<std::uint32_t>(), true};
    case kData1:
    case kFlag:
      return {reader.integer<std::uint8_t>()};
    case kData2:
      return {reader.integer<std::uint16_t>()};
    case kData4:
    case kSectionOffset:
      return {reader.integer<std::uint32_t>()};
    case kData8:
    case kSignature:
      return {reader.integer<std::uint64_t>()};
    case kSignedData:
      return {static_cast<std::uint64_t>(reader.signed_leb())};
    case kUnsignedData:
      return {reader.unsigned_leb()};
    case kString: {
      const std::uint32_t start = here();
      reader.string();
      return {start};
    }
    case kStringOffset:
      return {reader.integer<std::uint32_t>(), false, true};
    case kReferenceAnywhere: // has the width of an address in version 2, of an offset later: both are 4 bytes
      return {reader.integer<std::uint32_t>()};
    case kReference1:
      return {offset_ + std::uint64_t{reader.integer<std::uint8_t>()}};
    case kReference2:
      return {offset_ + std::uint64_t{reader.integer<std::uint16_t>()}};
    case kReference4:
      return {offset_ + std::uint64_t{reader.integer<std::uint32_t>()}};
    case kReference8:
      return {offset_ + reader.integer<std::uint64_t>()};
    case kReferenceUnsigned:
      return {offset_ + reader.unsigned_leb()};
    case kBlock1:
      reader.take(reader.integer<std::uint8_t>());
      return {};
    case kBlock2:
      reader.take(reader.integer<std::uint16_t>());
      return {};
    case kBlock4:
      reader.take(reader.integer<std::uint32_t>());
      return {};
    case kBlock:
    case kExpression:
      reader.take(reader.unsigned_leb());
      return {};
    case kFlagPresent:
      return {1};
    default:
      throw MalformedDwarf();
    }
  }

  void read_attribute(DwarfReader& reader, const AttributeForm& what, Entry& entry) const {
    const Value value = read_value(reader, what.form);
    const auto offset = [&] {
      return static_cast<std::uint32_t>(std::min<std::uint64_t>(value.number, kNone));
    };
    switch (what.attribute) {
    case kName:
      entry.name = offset();
      entry.name_in_strings = value.is_in_strings;
      break;
    case kLineProgram:
      entry.line_program = offset();
      break;
    case kLowPc:
      entry.low = value.number;
      entry.has_low = true;
      break;
    case kHighPc:
      entry.high = value.number;
      entry.has_high = true;
      entry.high_is_size = !value.is_address;
      break;
    case kAbstractOrigin:
    case kSpecification:
      entry.origin = offset();
      break;
    case kRanges:
      entry.ranges = offset();
      break;
    case kCallFile:
      entry.call_file = value.number;
      break;
    case kCallLine:
      entry.call_line = value.number;
      break;
    default:
      break;
    }
  }

  /// Handles an entry. Returns the scope that the entry's children are in.
  std::uint32_t take(const Entry& entry, std::uint32_t outer) {
    if (entry.line_program) { // the unit's own entry
      base_ = entry.low;
      files_ = reading_.line_files(calls_.sections_.line, *entry.line_program);
    }
    if (entry.kind->tag == kSubprogram) {
      calls_.functions_.push_back(
          {entry.offset, entry.name.value_or(kNone), entry.name_in_strings, entry.origin.value_or(kNone)});
      if (!has_code(entry)) return kNone;
      return add_scope(entry, {});
    }
    if (entry.kind->tag != kInlinedSubroutine || outer == kNone) return outer;
    Scope scope;
    scope.outer = outer;
    scope.depth = calls_.scopes_[outer].depth + 1;
    scope.callee = entry.origin.value_or(kNone);
    const std::optional<std::uint32_t> file =
        files_ == nullptr ? std::nullopt : files_->in(calls_.files_, entry.call_file);
    if (file) scope.file = *file;
    scope.line = static_cast<std::uint32_t>(std::min<std::uint64_t>(entry.call_line, kNone));
    return add_scope(entry, scope);
  }

  static bool has_code(const Entry& entry) { return entry.has_low || entry.ranges; }

  std::uint32_t add_scope(const Entry& entry, const Scope& scope) {
    const auto number = static_cast<std::uint32_t>(calls_.scopes_.size());
    const std::size_t first = reading_.extents.size();
    calls_.scopes_.push_back(scope);
    add_extents(entry, number);
    const bool thrown_away =
        scope.outer == kNone && first < reading_.extents.size() && reading_.extents[first].begin == 0;
    if (!thrown_away) return number;
    reading_.extents.resize(first);
    return kNone;
  }

  void add_extents(const Entry& entry, std::uint32_t scope) {
    if (entry.ranges) return add_ranges(*entry.ranges, scope);
    if (entry.has_low && entry.has_high)
      add_extent(entry.low, entry.high_is_size ? entry.low + entry.high : entry.high, scope);
  }

  void add_ranges(std::uint32_t offset, std::uint32_t scope) {
    constexpr std::uint32_t kNewBase = 0xFFFFFFFFu;
    DwarfReader reader(from(calls_.sections_.ranges, offset));
    std::uint64_t base = base_;
    for (; reading_.pairs != 0; --reading_.pairs) {
      const auto begin = reader.integer<std::uint32_t>(), end = reader.integer<std::uint32_t>();
      if (begin == 0 && end == 0) return;
      if (begin == kNewBase)
        base = end;
      else
        add_extent(base + begin, base + end, scope);
    }
  }

  void add_extent(std::uint64_t begin, std::uint64_t end, std::uint32_t scope) {
    if (begin >= end || end > kLocalStoreBytes) return;
    reading_.extents.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), scope});
  }

  InlinedCalls& calls_;
  Reading& reading_;
  const std::span<const std::uint8_t> bytes_;
  const std::uint32_t offset_;
  std::uint64_t base_ = 0;
  LineFiles* files_ = nullptr;
};

InlinedCalls::InlinedCalls(const SpuElf& elf) : elf_(elf) {
  const auto content = [&](const char* name) {
    const ElfSection* section = elf_->section(name);
    return section != nullptr ? section->content : std::span<const std::uint8_t>();
  };
  sections_ = {content(".debug_info"), content(".debug_abbrev"), content(".debug_ranges"),
               content(".debug_line"), content(".debug_str")};
  read();
}

InlinedCalls::InlinedCalls(const Sections& sections) : sections_(sections) {
  read();
}

void InlinedCalls::read() {
  // Offsets have 32 bits, as in 32-bit DWARF.
  if (sections_.info.size() >= kNone) return;
  Reading reading(sections_);
  DwarfReader section(sections_.info);
  try {
    while (!section.done()) {
      const std::size_t start = sections_.info.size() - section.left();
      section.take(section.integer<std::uint32_t>());
      const std::size_t end = sections_.info.size() - section.left();
      try {
        Unit(*this, reading, sections_.info.subspan(start, end - start), static_cast<std::uint32_t>(start))
            .read();
      } catch (const MalformedDwarf&) { // go on with the next unit
      }
    }
  } catch (const MalformedDwarf&) { // after a wrong length no further unit can be found
  }
  lay_out(std::move(reading.extents));
}

void InlinedCalls::lay_out(std::vector<Extent> extents) {
  std::ranges::sort(extents, {}, [](const Extent& extent) { return std::tuple(extent.begin, extent.scope); });
  const auto is_outside = [&](const Extent& a, const Extent& b) {
    return std::tuple(scopes_[a.scope].depth, a.scope) < std::tuple(scopes_[b.scope].depth, b.scope);
  };
  // The extents that have begun, the innermost on top. An extent that has ended is removed when it comes to
  // the top.
  std::priority_queue<Extent, std::vector<Extent>, decltype(is_outside)> open(is_outside);
  const auto step_to = [&](std::uint32_t lsa, std::uint32_t scope) {
    if (!steps_.empty() && steps_.back().lsa == lsa)
      steps_.back().scope = scope;
    else
      steps_.push_back({lsa, scope});
  };
  const auto close_until = [&](std::uint64_t lsa) {
    while (!open.empty() && open.top().end <= lsa) {
      const std::uint32_t end = open.top().end;
      while (!open.empty() && open.top().end <= end)
        open.pop();
      step_to(end, open.empty() ? kNone : open.top().scope);
    }
  };
  for (const Extent& extent : extents) {
    close_until(extent.begin);
    open.push(extent);
    step_to(extent.begin, open.top().scope);
  }
  close_until(kLocalStoreBytes);
}

std::string_view InlinedCalls::name_of(std::uint32_t entry) const {
  // The entry of a body refers to its function's entry, which may refer to a declaration in a class.
  for (unsigned i = 0; i < 4; ++i) {
    const auto found = std::ranges::lower_bound(functions_, entry, {}, &Function::entry);
    if (found == functions_.end() || found->entry != entry) break;
    if (found->name != kNone)
      return string_at(found->name_in_strings ? sections_.strings : sections_.info, found->name);
    entry = found->refers_to;
  }
  return {};
}

std::vector<InlinedCall> InlinedCalls::at(std::uint32_t lsa) const {
  constexpr std::size_t kMostCalls = 64;
  std::vector<InlinedCall> calls;
  const auto behind = std::ranges::upper_bound(steps_, lsa, {}, &Step::lsa);
  if (behind == steps_.begin()) return calls;
  for (std::uint32_t number = std::prev(behind)->scope; number != kNone && calls.size() < kMostCalls;) {
    const Scope& scope = scopes_[number];
    if (scope.outer == kNone) break;
    InlinedCall call;
    call.callee = name_of(scope.callee);
    if (scope.file != kNone && scope.line != 0) {
      call.file = files_[scope.file];
      call.line = scope.line;
    }
    calls.push_back(call);
    number = scope.outer;
  }
  return calls;
}

} // namespace celltrace::cell_emu

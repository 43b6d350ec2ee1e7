#include "backends/cell_emu/simulator/spu_elf.hpp"

#include "backends/cell_emu/simulator/big_endian.hpp"
#include "celltrace/error.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>

namespace celltrace::cell_emu {

namespace {

constexpr std::uint32_t kLocalStoreBytes = 256 * 1024;

// Offsets in the file header, a program header and a section header of a 32-bit ELF file.
constexpr std::size_t kHeaderBytes = 52, kProgramHeaderBytes = 32, kSectionHeaderBytes = 40;
constexpr std::size_t kIdentClass = 4, kIdentData = 5, kIdentVersion = 6;
constexpr std::size_t kType = 16, kMachine = 18, kVersion = 20, kEntry = 24, kProgramHeaders = 28,
                      kSectionHeaders = 32, kProgramHeaderSize = 42, kProgramHeaderCount = 44,
                      kSectionHeaderSize = 46, kSectionHeaderCount = 48, kSectionNames = 50;
constexpr std::size_t kSegmentType = 0, kSegmentOffset = 4, kSegmentAddress = 8, kSegmentFileBytes = 16,
                      kSegmentBytes = 20, kSegmentFlags = 24;
constexpr std::size_t kSectionName = 0, kSectionType = 4, kSectionFlags = 8, kSectionAddress = 12,
                      kSectionOffset = 16, kSectionBytes = 20, kSectionLink = 24;

constexpr std::uint16_t kExecutableFile = 2, kSpu = 23;
constexpr std::uint32_t kLoad = 1, kFlagExecute = 1, kFlagWrite = 2, kFlagOverlay = 1u << 27;
constexpr std::uint32_t kNoBits = 8;

// Limit of a string's length, so that a string table without zero bytes is not searched to its end for every
// name.
constexpr std::size_t kLongestString = 16384;

[[noreturn]] void refuse(const std::string& why) {
  throw InputError("SPU program: " + why);
}

std::string hex(std::uint32_t value) {
  std::array<char, 11> text;
  std::snprintf(text.data(), text.size(), "0x%x", value);
  return text.data();
}

std::uint16_t half_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return load_big_endian<std::uint16_t>(bytes.data() + offset);
}

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return load_big_endian<std::uint32_t>(bytes.data() + offset);
}

bool contains(std::span<const std::uint8_t> file, std::uint64_t offset, std::uint64_t bytes) {
  return offset <= file.size() && bytes <= file.size() - offset;
}

ElfSegment read_segment(std::span<const std::uint8_t> file, std::span<const std::uint8_t> header,
                        std::size_t number) {
  const std::string name = "segment " + std::to_string(number);
  const std::uint32_t offset = word_at(header, kSegmentOffset), address = word_at(header, kSegmentAddress),
                      file_bytes = word_at(header, kSegmentFileBytes), bytes = word_at(header, kSegmentBytes),
                      flags = word_at(header, kSegmentFlags);
  if (address >= kLocalStoreBytes || bytes > kLocalStoreBytes - address)
    refuse(name + " is " + std::to_string(bytes) + " bytes at " + hex(address) +
           ", which does not fit the 256 KB of local store");
  if (file_bytes > bytes) refuse(name + " has more bytes in the file than in local store");
  if (!contains(file, offset, file_bytes)) refuse(name + " reaches over the end of the file");
  return {.lsa = address,
          .bytes = bytes,
          .content = file.subspan(offset, file_bytes),
          .executable = (flags & kFlagExecute) != 0,
          .writable = (flags & kFlagWrite) != 0,
          .overlay = (flags & kFlagOverlay) != 0};
}

std::shared_ptr<const std::uint8_t[]> copy_at_page(std::span<const std::uint8_t> bytes) {
  constexpr std::align_val_t kPage{4096};
  std::shared_ptr<std::uint8_t[]> copy(new (kPage) std::uint8_t[bytes.size()],
                                       [](std::uint8_t* block) { ::operator delete[](block, kPage); });
  std::copy(bytes.begin(), bytes.end(), copy.get());
  return copy;
}

} // namespace

std::string_view string_at(std::span<const std::uint8_t> strings, std::size_t offset) {
  if (offset >= strings.size()) return {};
  const auto* start = reinterpret_cast<const char*>(strings.data()) + offset;
  const void* end = std::memchr(start, 0, std::min(strings.size() - offset, kLongestString));
  if (end == nullptr) return {};
  return {start, static_cast<std::size_t>(static_cast<const char*>(end) - start)};
}

SpuElf::SpuElf(std::span<const std::uint8_t> image)
    : image_(copy_at_page(image)), image_bytes_(image.size()) {
  read_header();
  read_segments();
  check_overlaps();
  read_sections();
}

void SpuElf::read_header() {
  const std::span<const std::uint8_t> file = image();
  static constexpr std::uint8_t kMagic[4] = {0x7F, 'E', 'L', 'F'};
  if (file.size() < sizeof kMagic || std::memcmp(file.data(), kMagic, sizeof kMagic) != 0)
    refuse("not an ELF file");
  if (file.size() < kHeaderBytes) refuse("cut short in the file header");
  if (file[kIdentClass] != 1) refuse("not an ELF file of 32 bits");
  if (file[kIdentData] != 2) refuse("not big-endian");
  if (file[kIdentVersion] != 1 || word_at(file, kVersion) != 1) refuse("an unknown version of ELF");
  if (const unsigned machine = half_at(file, kMachine); machine != kSpu)
    refuse("for machine " + std::to_string(machine) + ", not for the SPU (23)");
  if (const unsigned type = half_at(file, kType); type != kExecutableFile)
    refuse("a file of type " + std::to_string(type) + ", not a linked program (2)");
  entry_ = word_at(file, kEntry);
  if (entry_ >= kLocalStoreBytes) refuse("its entry " + hex(entry_) + " is outside local store");
  if (entry_ % 4 != 0) refuse("its entry " + hex(entry_) + " is not a multiple of 4");
}

void SpuElf::read_segments() {
  const std::span<const std::uint8_t> file = image();
  const std::size_t table = word_at(file, kProgramHeaders), count = half_at(file, kProgramHeaderCount);
  if (count == 0) refuse("it has no program headers");
  if (half_at(file, kProgramHeaderSize) != kProgramHeaderBytes) refuse("program headers of a wrong size");
  if (!contains(file, table, count * kProgramHeaderBytes))
    refuse("its program headers reach over the end of the file");

  for (std::size_t i = 0; i < count; ++i) {
    const auto header = file.subspan(table + i * kProgramHeaderBytes, kProgramHeaderBytes);
    if (word_at(header, kSegmentType) != kLoad || word_at(header, kSegmentBytes) == 0) continue;
    segments_.push_back(read_segment(file, header, i));
    program_end_ = std::max(program_end_, segments_.back().lsa + segments_.back().bytes);
  }
  if (segments_.empty()) refuse("it has no segment to load");
}

void SpuElf::check_overlaps() {
  // The linker marks all segments of an overlay region as overlays, but the first of them has to be loaded.
  constexpr std::uint32_t kUnit = 16; // bytes
  std::vector<bool> used(kLocalStoreBytes / kUnit);
  std::vector<ElfSegment*> by_address;
  for (ElfSegment& segment : segments_) {
    const auto first = used.begin() + segment.lsa / kUnit;
    if (segment.overlay) segment.overlay = *first;
    std::fill(first, first + (segment.lsa % kUnit + segment.bytes + kUnit - 1) / kUnit, true);
    if (!segment.overlay) by_address.push_back(&segment);
  }
  std::ranges::sort(by_address, {}, &ElfSegment::lsa);
  for (std::size_t i = 1; i < by_address.size(); ++i)
    if (const ElfSegment& before = *by_address[i - 1]; before.lsa + before.bytes > by_address[i]->lsa)
      refuse("its segments at " + hex(before.lsa) + " and " + hex(by_address[i]->lsa) + " overlap");
}

void SpuElf::read_sections() {
  const std::span<const std::uint8_t> file = image();
  const std::size_t table = word_at(file, kSectionHeaders), count = half_at(file, kSectionHeaderCount);
  if (count == 0) return;
  if (half_at(file, kSectionHeaderSize) != kSectionHeaderBytes) refuse("section headers of a wrong size");
  if (!contains(file, table, count * kSectionHeaderBytes))
    refuse("its section headers reach over the end of the file");

  for (std::size_t i = 0; i < count; ++i) {
    const auto header = file.subspan(table + i * kSectionHeaderBytes, kSectionHeaderBytes);
    ElfSection section;
    section.type = word_at(header, kSectionType);
    section.flags = word_at(header, kSectionFlags);
    section.address = word_at(header, kSectionAddress);
    section.link = word_at(header, kSectionLink);
    const std::uint32_t offset = word_at(header, kSectionOffset), bytes = word_at(header, kSectionBytes);
    if (section.type != kNoBits && contains(file, offset, bytes))
      section.content = file.subspan(offset, bytes);
    sections_.push_back(section);
  }
  name_sections(half_at(file, kSectionNames));
}

void SpuElf::name_sections(std::uint32_t names) {
  if (names >= sections_.size()) return;
  const std::span<const std::uint8_t> file = image();
  const std::size_t table = word_at(file, kSectionHeaders);
  for (std::size_t i = 0; i < sections_.size(); ++i)
    sections_[i].name =
        string_at(sections_[names].content, word_at(file, table + i * kSectionHeaderBytes + kSectionName));
}

bool SpuElf::executable(std::uint32_t lsa) const {
  return std::ranges::any_of(segments_, [lsa](const ElfSegment& segment) {
    return segment.executable && lsa >= segment.lsa && lsa - segment.lsa < segment.bytes;
  });
}

void SpuElf::load(std::uint8_t* local_store) const {
  for (const ElfSegment& segment : segments_) {
    if (segment.overlay) continue;
    std::ranges::copy(segment.content, local_store + segment.lsa);
    std::fill_n(local_store + segment.lsa + segment.content.size(), segment.bytes - segment.content.size(),
                std::uint8_t{0});
  }
}

const ElfSection* SpuElf::section(std::string_view name) const {
  const auto found = std::ranges::find(sections_, name, &ElfSection::name);
  return found != sections_.end() ? &*found : nullptr;
}

} // namespace celltrace::cell_emu

// SpuElf: a program for the SPU as a linked ELF file, of 32 bits, big-endian, for machine 23.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// A part of the file that is loaded into local store.
struct ElfSegment {
  std::uint32_t lsa = 0;
  std::uint32_t bytes = 0;               ///< size in local store, above 0; lsa + bytes is at most 256 KB
  std::span<const std::uint8_t> content; ///< first bytes of the segment, at most `bytes`; the rest is zero
  bool executable = false;
  bool writable = false;
  /// True if the segment has the place of an earlier segment: it is not loaded, because the program fetches
  /// it when needed.
  bool overlay = false;
};

/// A part of the file with a name, such as debugging information.
struct ElfSection {
  std::string_view name;
  std::uint32_t type = 0;  ///< SHT_...
  std::uint32_t flags = 0; ///< SHF_...
  std::uint32_t address = 0;
  std::uint32_t link = 0;
  /// Empty if the section has no content (.bss), or its content is not all within the file.
  std::span<const std::uint8_t> content;
};

/// A checked program. The image need not be trusted: for any bytes, either the constructor throws or all
/// members keep their promises, in time and memory proportional to the size of the image. Copies share the
/// image; views stay valid as long as one copy lives. Thread safety: all members are const.
class SpuElf {
public:
  /// Copies the image. Throws InputError, with the reason, if the image is no executable for the SPU: if it
  /// is cut short, has another class, byte order, machine or type, has tables outside of the file, has no
  /// segment to load, has segments that do not fit into local store or that overlap without being marked as
  /// overlays, or has an entry that is outside of local store or not a multiple of 4.
  explicit SpuElf(std::span<const std::uint8_t> image);

  /// Returns the address where the program starts.
  std::uint32_t entry() const { return entry_; }

  /// Returns the segments, at least one, in the file's order.
  const std::vector<ElfSegment>& segments() const { return segments_; }

  /// Returns the first address behind all segments, where the heap starts: the linker's `_end`, apart from
  /// alignment.
  std::uint32_t program_end() const { return program_end_; }

  /// Returns true if the address lies in an executable segment.
  bool executable(std::uint32_t lsa) const;

  /// Loads all segments that are no overlays into local store; bytes between segments stay.
  /// @param local_store 256 KB
  void load(std::uint8_t* local_store) const;

  /// Returns the sections in the file's order; number 0 stands for no section. Empty if the file has been
  /// stripped of sections.
  const std::vector<ElfSection>& sections() const { return sections_; }
  /// Returns the first section of this name, or null.
  const ElfSection* section(std::string_view name) const;

  /// Returns the whole file. Its address is that of a page, as if the file were mapped, so that fetches of
  /// code modules take the same time in every run.
  std::span<const std::uint8_t> image() const { return {image_.get(), image_bytes_}; }

private:
  void read_header();
  void read_segments();
  void read_sections();
  void name_sections(std::uint32_t names);
  void check_overlaps();

  std::shared_ptr<const std::uint8_t[]> image_;
  std::size_t image_bytes_ = 0;
  std::uint32_t entry_ = 0;
  std::uint32_t program_end_ = 0;
  std::vector<ElfSegment> segments_;
  std::vector<ElfSection> sections_;
};

/// Returns the characters from `offset` up to the next zero byte, or none if `offset` is outside or no zero
/// byte follows within 16 KB.
std::string_view string_at(std::span<const std::uint8_t> strings, std::size_t offset);

} // namespace celltrace::cell_emu

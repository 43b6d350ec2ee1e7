// A program for the SPU as its linker writes it: an ELF file of 32 bits, big-endian, for machine 23.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {

/// A part of the file that belongs into local store.
struct ElfSegment {
  std::uint32_t lsa = 0;
  std::uint32_t bytes = 0;               ///< size in local store, more than 0; lsa + bytes is at most 256 KB
  std::span<const std::uint8_t> content; ///< the segment's first bytes, at most `bytes`; the rest is zero
  bool executable = false;
  bool writable = false;
  /// True if it lies in the place of an earlier segment, for the program to fetch itself when needed: not
  /// loaded.
  bool overlay = false;
};

/// A part of the file that debuggers find by name.
struct ElfSection {
  std::string_view name;
  std::uint32_t type = 0;  ///< SHT_...
  std::uint32_t flags = 0; ///< SHF_...
  std::uint32_t address = 0;
  std::uint32_t link = 0;
  std::span<const std::uint8_t> content; ///< empty if the file has none (.bss) or does not reach that far
};

/// A checked program. The image may come from anywhere: whatever its bytes, the constructor throws or every
/// promise made here holds, in time and memory proportional to the size of the image.
/// Copies share the image; views stay valid as long as one copy lives. Thread safety: all members are const.
class SpuElf {
public:
  /// Copies the image. Throws InputError, with the reason, if it is no executable for the SPU: cut
  /// short, of another class, byte order, machine or type, tables outside the file, no segment to load,
  /// segments that do not fit local store or (unless they are marked as overlays) overlap, an entry outside
  /// local store or not a multiple of 4.
  explicit SpuElf(std::span<const std::uint8_t> image);

  /// Returns the address where the program starts.
  std::uint32_t entry() const { return entry_; }

  /// Returns the segments, at least one, in the file's order.
  const std::vector<ElfSegment>& segments() const { return segments_; }

  /// Returns the first address behind all segments, where the heap starts: the linker's `_end` up to
  /// alignment.
  std::uint32_t program_end() const { return program_end_; }

  /// Returns whether the address lies in a segment that has instructions.
  bool executable(std::uint32_t lsa) const;

  /// Writes all segments that are no overlays; the bytes around them stay.
  /// @param local_store 256 KB
  void load(std::uint8_t* local_store) const;

  /// Returns the sections in the file's order; number 0 stands for none. Empty in a file stripped of them.
  const std::vector<ElfSection>& sections() const { return sections_; }
  /// Returns the first section of this name, or null.
  const ElfSection* section(std::string_view name) const;

  /// Returns the whole file. It starts at a page, like a file that a system maps: code that programs fetch
  /// from it then takes the same time in every run.
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

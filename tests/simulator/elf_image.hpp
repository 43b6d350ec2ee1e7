// Small programs for the SPU, made byte by byte, so that tests of the loader need no compiler.
#pragma once

#include "backends/cell_emu/simulator/big_endian.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace celltrace::test {

using Bytes = std::vector<std::uint8_t>;

template <class Integer> void put(Bytes& bytes, std::size_t offset, Integer value) {
  cell_emu::store_big_endian<Integer>(bytes.data() + offset, value);
}

/// Lays out an ELF file: header, program headers, contents, section headers.
class ElfImage {
public:
  std::uint32_t entry = 0x80;

  void add_segment(std::uint32_t lsa, Bytes content, std::uint32_t bytes, std::uint32_t flags) {
    segments_.push_back({lsa, std::move(content), bytes, flags});
  }
  /// Returns the section's number; number 0 and the names are there already.
  std::uint32_t add_section(std::string name, std::uint32_t type, Bytes content, std::uint32_t link = 0,
                            std::uint32_t address = 0, std::uint32_t flags = 0) {
    sections_.push_back({std::move(name), type, std::move(content), link, address, flags});
    return static_cast<std::uint32_t>(sections_.size());
  }

  Bytes build() const {
    const std::size_t count = segments_.size();
    Bytes file(52 + 32 * count);
    const std::uint8_t ident[] = {0x7F, 'E', 'L', 'F', 1, 2, 1};
    std::memcpy(file.data(), ident, sizeof ident);
    put<std::uint16_t>(file, 16, 2);
    put<std::uint16_t>(file, 18, 23);
    put<std::uint32_t>(file, 20, 1);
    put<std::uint32_t>(file, 24, entry);
    put<std::uint32_t>(file, 28, 52);
    put<std::uint16_t>(file, 40, 52);
    put<std::uint16_t>(file, 42, 32);
    put<std::uint16_t>(file, 44, static_cast<std::uint16_t>(count));
    for (std::size_t i = 0; i < count; ++i)
      place_segment(file, segments_[i], 52 + 32 * i);
    if (!sections_.empty()) place_sections(file);
    return file;
  }

private:
  struct Segment {
    std::uint32_t lsa;
    Bytes content;
    std::uint32_t bytes, flags;
  };
  struct Section {
    std::string name;
    std::uint32_t type;
    Bytes content;
    std::uint32_t link, address, flags;
  };

  static void place_segment(Bytes& file, const Segment& segment, std::size_t header) {
    put<std::uint32_t>(file, header, 1);
    put<std::uint32_t>(file, header + 4, static_cast<std::uint32_t>(file.size()));
    put<std::uint32_t>(file, header + 8, segment.lsa);
    put<std::uint32_t>(file, header + 12, segment.lsa);
    put<std::uint32_t>(file, header + 16, static_cast<std::uint32_t>(segment.content.size()));
    put<std::uint32_t>(file, header + 20, segment.bytes);
    put<std::uint32_t>(file, header + 24, segment.flags);
    put<std::uint32_t>(file, header + 28, 16);
    file.insert(file.end(), segment.content.begin(), segment.content.end());
  }

  void place_sections(Bytes& file) const {
    std::vector<Section> all = sections_;
    all.push_back({".shstrtab", 3, {}, 0, 0, 0});
    Bytes names(1);
    std::vector<std::uint32_t> name_offsets;
    for (const Section& section : all) {
      name_offsets.push_back(static_cast<std::uint32_t>(names.size()));
      names.insert(names.end(), section.name.begin(), section.name.end());
      names.push_back(0);
    }
    all.back().content = names;

    Bytes table(40);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t header = table.size();
      table.resize(header + 40);
      put<std::uint32_t>(table, header, name_offsets[i]);
      put<std::uint32_t>(table, header + 4, all[i].type);
      put<std::uint32_t>(table, header + 8, all[i].flags);
      put<std::uint32_t>(table, header + 12, all[i].address);
      put<std::uint32_t>(table, header + 16, static_cast<std::uint32_t>(file.size()));
      put<std::uint32_t>(table, header + 20, static_cast<std::uint32_t>(all[i].content.size()));
      put<std::uint32_t>(table, header + 24, all[i].link);
      file.insert(file.end(), all[i].content.begin(), all[i].content.end());
    }
    put<std::uint32_t>(file, 32, static_cast<std::uint32_t>(file.size()));
    put<std::uint16_t>(file, 46, 40);
    put<std::uint16_t>(file, 48, static_cast<std::uint16_t>(all.size() + 1));
    put<std::uint16_t>(file, 50, static_cast<std::uint16_t>(all.size()));
    file.insert(file.end(), table.begin(), table.end());
  }

  std::vector<Segment> segments_;
  std::vector<Section> sections_;
};

/// A program of four instructions (il $3, 42; bi $0; ...) and some data.
inline ElfImage small_program() {
  ElfImage elf;
  elf.add_segment(0x80, {0x40, 0x80, 0x15, 0x03, 0x35, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x20, 0}, 16, 1 | 4);
  elf.add_segment(0x100, {1, 2, 3, 4}, 0x40, 2 | 4);
  return elf;
}

inline Bytes read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace celltrace::test

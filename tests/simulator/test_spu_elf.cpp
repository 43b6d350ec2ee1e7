// The loader: what it makes of a program, and what it says of everything that is none.
#include "backends/cell_emu/simulator/spu_elf.hpp"
#include "celltrace/error.hpp"
#include "simulator/elf_image.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>

using namespace celltrace;
using namespace celltrace::test;
using cell_emu::SpuElf;

namespace {

std::string refusal(const Bytes& image) {
  try {
    SpuElf elf(image);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal_after(const std::function<void(Bytes&)>& damage) {
  Bytes image = small_program().build();
  damage(image);
  return refusal(image);
}

template <class Integer> std::string refusal_with(std::size_t offset, Integer value) {
  return refusal_after([=](Bytes& image) { put<Integer>(image, offset, value); });
}

} // namespace

TEST_CASE("a program's segments reach local store, their tails zero, what is around them as it was") {
  const SpuElf elf(small_program().build());
  CHECK(elf.entry() == 0x80);
  CHECK(elf.program_end() == 0x140);
  REQUIRE(elf.segments().size() == 2);
  CHECK(elf.segments()[0].executable);
  CHECK_FALSE(elf.segments()[0].writable);
  CHECK_FALSE(elf.segments()[1].executable);
  CHECK(elf.segments()[1].writable);
  CHECK(elf.segments()[1].bytes == 0x40);
  CHECK(elf.segments()[1].content.size() == 4);
  CHECK(elf.executable(0x8C));
  CHECK_FALSE(elf.executable(0x90));
  CHECK_FALSE(elf.executable(0x100));

  Bytes local_store(256 * 1024, 0xEE);
  elf.load(local_store.data());
  CHECK(local_store[0x7F] == 0xEE);
  CHECK(local_store[0x80] == 0x40);
  CHECK(local_store[0x90] == 0xEE);
  CHECK(local_store[0x103] == 4);
  CHECK(local_store[0x104] == 0);
  CHECK(local_store[0x13F] == 0);
  CHECK(local_store[0x140] == 0xEE);
}

TEST_CASE("a copy of a program outlives the image and the original") {
  auto image = std::make_unique<Bytes>(small_program().build());
  auto first = std::make_unique<SpuElf>(*image);
  const SpuElf copy = *first;
  first.reset();
  image.reset();
  CHECK(copy.segments()[1].content[3] == 4);
}

TEST_CASE("sections are found by name") {
  ElfImage image = small_program();
  image.add_section(".first", 1, {7});
  image.add_section(".second", 1, {8, 9}, 0, 0x100);
  const SpuElf elf(image.build());
  REQUIRE(elf.section(".second") != nullptr);
  CHECK(elf.section(".second")->content.size() == 2);
  CHECK(elf.section(".second")->address == 0x100);
  CHECK(elf.section(".third") == nullptr);
}

TEST_CASE("what is no program for the SPU is refused with its reason") {
  using Catch::Contains;
  CHECK_THAT(refusal({}), Contains("not an ELF file"));
  CHECK_THAT(refusal(Bytes(100)), Contains("not an ELF file"));
  CHECK_THAT(refusal_after([](Bytes& image) { image.resize(51); }), Contains("cut short"));
  CHECK_THAT(refusal_after([](Bytes& image) { image.resize(60); }), Contains("program headers"));
  CHECK_THAT(refusal_after([](Bytes& image) { image.pop_back(); }),
             Contains("segment 1 reaches over the end"));
  CHECK_THAT(refusal_with<std::uint8_t>(4, 2), Contains("32 bits"));
  CHECK_THAT(refusal_with<std::uint8_t>(5, 1), Contains("big-endian"));
  CHECK_THAT(refusal_with<std::uint8_t>(6, 0), Contains("version"));
  CHECK_THAT(refusal_with<std::uint16_t>(16, 1), Contains("type 1"));
  CHECK_THAT(refusal_with<std::uint16_t>(18, 20), Contains("machine 20"));
  CHECK_THAT(refusal_with<std::uint32_t>(20, 2), Contains("version"));
  CHECK_THAT(refusal_with<std::uint32_t>(24, 0x40000), Contains("entry 0x40000"));
  CHECK_THAT(refusal_with<std::uint32_t>(24, 0x82), Contains("multiple of 4"));
  CHECK_THAT(refusal_with<std::uint32_t>(28, 0xFFFFFFF0), Contains("program headers"));
  CHECK_THAT(refusal_with<std::uint16_t>(42, 31), Contains("program headers"));
  CHECK_THAT(refusal_with<std::uint16_t>(44, 0), Contains("no program headers"));
  CHECK_THAT(refusal_with<std::uint16_t>(44, 0xFFFF), Contains("program headers"));
}

TEST_CASE("segments that cannot be are refused") {
  using Catch::Contains;
  constexpr std::size_t first = 52, second = 52 + 32;
  CHECK_THAT(refusal_with<std::uint32_t>(first + 4, 0xFFFFFFFF), Contains("segment 0 reaches over the end"));
  CHECK_THAT(refusal_with<std::uint32_t>(first + 8, 0x40000), Contains("does not fit"));
  CHECK_THAT(refusal_with<std::uint32_t>(first + 20, 0xFFFFFFFF), Contains("does not fit"));
  CHECK_THAT(refusal_with<std::uint32_t>(second + 20, 0x3FF01), Contains("does not fit"));
  CHECK(refusal_with<std::uint32_t>(second + 20, 0x3FF00) == "accepted");
  CHECK_THAT(refusal_with<std::uint32_t>(first + 16, 17), Contains("more bytes in the file"));
  CHECK_THAT(refusal_with<std::uint32_t>(second + 8, 0x8F), Contains("overlap"));
  CHECK(refusal_with<std::uint32_t>(second + 8, 0x90) == "accepted");
  CHECK_THAT(refusal_after([](Bytes& image) {
               put<std::uint32_t>(image, first, 4);
               put<std::uint32_t>(image, second, 4);
             }),
             Contains("no segment to load"));
}

TEST_CASE("of segments marked as overlays of one place the first is loaded") {
  constexpr std::uint32_t kOverlay = 1u << 27 | 1 | 4;
  ElfImage image;
  image.add_segment(0x80, {1, 1, 1, 1}, 4, 1 | 4);
  image.add_segment(0x100, {2, 2, 2, 2}, 4, kOverlay);
  image.add_segment(0x100, {3, 3, 3, 3, 3, 3}, 6, kOverlay);
  const SpuElf elf(image.build());
  CHECK_FALSE(elf.segments()[1].overlay);
  CHECK(elf.segments()[2].overlay);
  Bytes local_store(256 * 1024);
  elf.load(local_store.data());
  CHECK(local_store[0x100] == 2);
  CHECK(local_store[0x104] == 0);
}

TEST_CASE("section tables outside the file are refused, sections outside are empty") {
  using Catch::Contains;
  ElfImage elf = small_program();
  elf.add_section(".data", 1, {1, 2, 3});
  Bytes image = elf.build();
  put<std::uint32_t>(image, 32, static_cast<std::uint32_t>(image.size() - 39));
  CHECK_THAT(refusal(image), Contains("section headers"));

  image = elf.build();
  put<std::uint32_t>(image, image.size() - 80 + 20, 0xFFFFFFFF); // the size of .data
  CHECK(SpuElf(image).section(".data")->content.empty());

  image = elf.build();
  put<std::uint16_t>(image, 50, 0xFFFF); // without names
  CHECK(SpuElf(image).section(".data") == nullptr);
}

#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

struct alignas(128) Line {
  std::uint32_t word[32];
};
struct Lines {
  Line shared;
  Line other;
  std::uint32_t found[8];
};

TEST_CASE("getllar and putllc make read-modify-write atomic between SPEs") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Lines lines{};
  const auto count = [](auto& spu, ea_t argument) {
    const ea_t shared = to_ea(&at<Lines>(argument).shared);
    auto* line = spu.template allocate<Line>();
    for (unsigned i = 0; i < 500; ++i) {
      do {
        spu.getllar(line, shared);
        for (std::uint32_t& word : line->word)
          ++word;
      } while (!spu.putllc(line, shared));
    }
  };
  run_on(key, 6, count, to_ea(&lines));
  for (const std::uint32_t word : lines.shared.word)
    CHECK(word == 3000);
}

TEST_CASE("a putllc needs the reservation of its line") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  Lines lines{};
  const auto lock_line = [](auto& spu, ea_t argument) {
    Lines& data = at<Lines>(argument);
    const ea_t shared = to_ea(&data.shared);
    const ea_t other = to_ea(&data.other);
    auto* line = spu.template allocate<Line>();
    data.found[0] = spu.putllc(line, shared);
    data.found[1] = spu.getllar(line, shared);
    line->word[0] = 5;
    data.found[2] = spu.putllc(line, shared);
    data.found[3] = spu.putllc(line, shared);
    spu.getllar(line, shared);
    spu.getllar(line, other);
    data.found[4] = spu.putllc(line, shared);
    line->word[0] = 9;
    data.found[5] = spu.putlluc(line, shared);
    line->word[0] = 8;
    spu.putqlluc(line, other, 4);
    spu.wait_all(1u << 4);
  };
  run_on(key, 1, lock_line, to_ea(&lines));
  CHECK(lines.found[0] == 0);
  CHECK(lines.found[1] == atomic_status::getllar_done);
  CHECK(lines.found[2] == 1);
  CHECK(lines.found[3] == 0);
  CHECK(lines.found[4] == 0);
  CHECK(lines.found[5] == atomic_status::putlluc_done);
  CHECK(lines.shared.word[0] == 9);
  CHECK(lines.other.word[0] == 8);
}

} // namespace
} // namespace celltrace::test

// Streams and the radix sort through local store, with counts around the borders of chunks and lines.
#include "kernel/entry/strategies.hpp"
#include "records/accelerator.hpp"
#include "records/object.hpp"
#include "scene_image/scene_image.hpp"
#include "spe/run_on.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <random>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

/// Main memory for `count` records, and a guard behind it.
template <class T> class Array {
public:
  static constexpr std::size_t kGuard = 256;

  explicit Array(std::size_t count) : count_(count), block_(round_up(count * sizeof(T)) + kGuard) {
    std::fill(block_.data(), block_.data() + block_.size(), std::byte{0x5A});
  }
  T* begin() { return reinterpret_cast<T*>(block_.data()); }
  T* end() { return begin() + count_; }
  T& operator[](std::size_t i) { return begin()[i]; }
  ea_t ea() const { return to_ea(block_.data()); }
  /// Nothing was written behind the quadword in which the last record ends.
  bool guard_is_whole() const {
    return std::all_of(block_.data() + round_up(count_ * sizeof(T)), block_.data() + block_.size(),
                       [](std::byte b) { return b == std::byte{0x5A}; });
  }

private:
  static std::size_t round_up(std::size_t bytes) { return (bytes + 15) / 16 * 16; }

  std::size_t count_;
  AlignedBlock block_;
};

struct Task {
  ea_t from, to;
  std::uint32_t count;
  std::uint32_t bits;
  std::uint32_t answer;
};

const std::vector<std::uint32_t> kCounts = {0,    1,    2,    3,    4,    5,     15,    16,   17,
                                            31,   127,  128,  129,  255,  256,   257,   511,  512,
                                            513,  1023, 1024, 1025, 2047, 2048,  2049,  4095, 4096,
                                            4097, 6144, 8191, 8192, 8193, 16384, 16385, 40000};

/// Reads all records and adds up a hash of their places and first words.
template <class T> void check_reader() {
  for (const std::string& key : spu_keys())
    for (std::uint32_t count : kCounts) {
      INFO(key << ", " << count);
      Array<T> source(count);
      std::uint32_t expected = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        reinterpret_cast<std::uint32_t&>(source[i]) = i * 2654435761u;
        expected = expected * 31 + (i ^ (i * 2654435761u));
      }
      Task task{source.ea(), 0, count, 0, 0};
      run_on(
          key, 1,
          [](auto& spu, ea_t argument) {
            Task& t = test::at<Task>(argument);
            StreamReader<std::decay_t<decltype(spu)>, T> reader(spu, 4);
            // Twice: a reader may be used again.
            for (int round = 0; round < 2; ++round) {
              t.answer = 0;
              reader.for_each(t.from, t.count, [&](const T& record, std::uint32_t index) {
                t.answer = t.answer * 31 + (index ^ reinterpret_cast<const std::uint32_t&>(record));
              });
            }
          },
          to_ea(&task));
      CHECK(task.answer == expected);
    }
}

template <class T> void check_writer() {
  for (const std::string& key : spu_keys())
    for (std::uint32_t count : kCounts) {
      INFO(key << ", " << count);
      Array<T> target(count);
      Task task{0, target.ea(), count, 0, 0};
      run_on(
          key, 1,
          [](auto& spu, ea_t argument) {
            Task& t = test::at<Task>(argument);
            StreamWriter<std::decay_t<decltype(spu)>, T> writer(spu, 6, t.to);
            for (std::uint32_t i = 0; i < t.count; ++i) {
              T record{};
              reinterpret_cast<std::uint32_t&>(record) = i * 2654435761u;
              writer.write(record);
            }
            writer.flush();
            t.answer = writer.count();
          },
          to_ea(&task));
      CHECK(task.answer == count);
      std::uint32_t wrong = 0;
      for (std::uint32_t i = 0; i < count; ++i)
        wrong += reinterpret_cast<std::uint32_t&>(target[i]) != i * 2654435761u ? 1 : 0;
      CHECK(wrong == 0);
      CHECK(target.guard_is_whole());
    }
}

using Keys = std::function<std::uint32_t(std::uint32_t)>;

void check_sort(const std::string& key, std::uint32_t count, std::uint32_t bits, const Keys& key_of) {
  Array<SortPair> a(count), b(count);
  std::vector<SortPair> expected;
  for (std::uint32_t i = 0; i < count; ++i) {
    a[i] = {key_of(i) & static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1), i};
    expected.push_back(a[i]);
  }
  std::stable_sort(expected.begin(), expected.end(),
                   [](const auto& x, const auto& y) { return x.key < y.key; });
  Task task{a.ea(), b.ea(), count, bits, 0};
  run_on(
      key, 1,
      [](auto& spu, ea_t argument) {
        using Spu = std::decay_t<decltype(spu)>;
        Task& t = test::at<Task>(argument);
        StreamReader<Spu, SortPair> reader(spu, 0);
        const ea_t buffers[2] = {t.from, t.to};
        t.answer = RadixSort<Spu>(spu, reader).sort(buffers, t.count, t.bits);
      },
      to_ea(&task));
  REQUIRE(task.answer <= 1);
  Array<SortPair>& sorted = task.answer == 0 ? a : b;
  CHECK(std::equal(sorted.begin(), sorted.end(), expected.begin(),
                   [](const auto& x, const auto& y) { return x.key == y.key && x.value == y.value; }));
  CHECK(a.guard_is_whole());
  CHECK(b.guard_is_whole());
}

} // namespace

TEST_CASE("Records of every size are read in order") {
  check_reader<std::uint32_t>();
  check_reader<SortPair>();
  check_reader<ObjectRecord>();
}

TEST_CASE("Records are written in order, and nothing behind them") {
  check_writer<std::uint32_t>();
  check_writer<CellRecord>();
}

TEST_CASE("Pairs are sorted stably by any number of digits") {
  std::mt19937 random(50);
  const std::vector<std::pair<const char*, Keys>> patterns = {
      {"random", [&](std::uint32_t) { return static_cast<std::uint32_t>(random()); }},
      {"equal", [](std::uint32_t) { return 0x01234567u; }},
      {"ascending", [](std::uint32_t i) { return i; }},
      {"descending", [](std::uint32_t i) { return ~i; }},
      {"two buckets", [](std::uint32_t i) { return (i % 17 < 8) ? 0xFFFFFFFFu : 0; }},
      {"all buckets in turn", [](std::uint32_t i) { return i * 0x01010101u; }}};
  for (const std::string& key : spu_keys())
    for (const auto& [name, pattern] : patterns)
      for (std::uint32_t count : kCounts) {
        const std::uint32_t bits = 1 + count % 32;
        INFO(key << ", " << name << ", " << count << " by " << bits << " bits");
        check_sort(key, count, bits, pattern);
      }
}

TEST_CASE("Nothing to sort by leaves pairs where they are") {
  for (const std::string& key : spu_keys())
    check_sort(key, 100, 0, [](std::uint32_t i) { return i; });
}

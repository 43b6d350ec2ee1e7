// What has no equation to be compared with, exactly: the tree that decides on surfaces at one place, noise,
// tables of random numbers. What is expected was found when pictures were like POV-Ray's.
#include "geometry/bounding_tree.hpp"
#include "geometry/noise.hpp"
#include "geometry/pattern_tables.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

using namespace celltrace;

namespace {

/// FNV-1a over whole numbers.
class Hash {
public:
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001B3u; }
  void add(const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis)
      add(std::bit_cast<std::uint64_t>(v[axis]));
  }
  std::string text() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
    return text;
  }

private:
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

/// In steps that floats hold, from -`size` to `size`.
class Numbers {
public:
  double operator()(double size) { return (static_cast<double>(random_() % 2001) - 1000) / 1024 * size; }
  Vec3 point(double size) {
    const double x = (*this)(size), y = (*this)(size), z = (*this)(size);
    return {x, y, z};
  }

private:
  std::mt19937 random_{7};
};

std::string tree_of(std::size_t count, std::size_t lights, double spread) {
  Numbers numbers;
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 a = numbers.point(spread), b = a + numbers.point(4);
    extents.push_back(i % 17 == 5 ? Extent::everywhere() : Extent::around({a, b}));
  }
  if (count > 8) extents[7].max.x = 1e7; // too long for a box
  const BoundingTree tree(extents, lights);
  Hash hash;
  for (std::size_t i = 0; i < count; ++i)
    hash.add(tree.rank(i));
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      const Vec3 from = numbers.point(2 * spread);
      Vec3 direction = numbers.point(spread) - from;
      if (b % 5 == 0) direction[static_cast<int>(a % 3)] = 0;
      hash.add(tree.tests_first(a, b, {from, direction}) ? 1 : 0);
    }
  return hash.text();
}

} // namespace

TEST_CASE("A tree of boxes is what it was") {
  CHECK(tree_of(2, 0, 10) == "d3df94cfb1360585");
  CHECK(tree_of(2, 1, 10) == "03f813c74093a9af");
  CHECK(tree_of(3, 0, 10) == "07d84da9c0d3c7c3");
  CHECK(tree_of(5, 2, 10) == "53adfb26dfa2ad93");
  CHECK(tree_of(20, 0, 10) == "589e3ed2a70d7ddc");
  CHECK(tree_of(90, 3, 30) == "bd26933a661318ac");
  CHECK(tree_of(90, 3, 0.5) == "85e3f5085b43d596");
}

TEST_CASE("Noise is what it was") {
  Numbers numbers;
  Hash values[3], vectors, turbulence;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = numbers.point(i % 3 == 0 ? 2 : 300);
    for (int generator = 1; generator <= 3; ++generator)
      values[generator - 1].add(std::bit_cast<std::uint64_t>(noise_value(p, generator)));
    vectors.add(noise_vector(p));
    turbulence.add(turbulence_vector(p, 1 + i % 7, 2.0 + i % 2, 0.5));
  }
  CHECK(values[0].text() == "e27722116002767d");
  CHECK(values[1].text() == "39da8b91140525b2");
  CHECK(values[2].text() == "befbd2a93b632e34");
  CHECK(vectors.text() == "1b063346cac7c55f");
  CHECK(turbulence.text() == "3450acd30f0c4a40");
}

TEST_CASE("Tables of patterns are what they were") {
  Hash hash;
  for (std::size_t i = 0; i < kernel::kGradients; ++i) {
    hash.add(gradient_tables().gradient[i]);
    hash.add(gradient_tables().next[i]);
  }
  CHECK(hash.text() == "a0acabf8a134fd2e");
  const auto words = [](const auto& records) {
    Hash all;
    all.add(records.size());
    const auto* const word = reinterpret_cast<const std::uint32_t*>(records.data());
    for (std::size_t i = 0; i < records.size() * sizeof records[0] / 4; ++i)
      all.add(word[i]);
    return all.text();
  };
  CHECK(words(make_features()) == "6b44c2146a4ce058");
  CHECK(words(make_gradients()) == "c02f2eaa96eb5d87");
  CHECK(words(make_waves(1)) == "04c0ea8f4028f574");
  CHECK(words(make_waves(10)) == "9e835807c8be7729");
  CHECK(words(make_waves(37)) == "80671ddd4b844348");
}

// the BVH: each object is in one leaf, boxes hold what is below them, and neither the memory
// nor the depth that is set aside is exceeded, whatever the objects.
#include "built_bvh.hpp"
#include "lanes.hpp"
#include "made_records.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

using Objects = std::vector<ObjectRecord>;

/// `make(i)` for i < count.
Objects objects(unsigned count, const std::function<ObjectRecord(unsigned)>& make) {
  Objects result;
  for (unsigned i = 0; i < count; ++i)
    result.push_back(make(i));
  return result;
}
Objects random_triangles(unsigned count, double reach, double size, unsigned seed = 1) {
  Random random(seed);
  return objects(count, [&](unsigned) {
    const Vec3 place = random.point(reach);
    return triangle(place + random.point(size), place + random.point(size), place + random.point(size));
  });
}

Aabb child_box(const NodeRecord& node, unsigned slot) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = node.bounds[2 * axis][slot];
    box.max[axis] = node.bounds[2 * axis + 1][slot];
  }
  return box;
}
bool contains(const Aabb& outer, const Aabb& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(outer.min[axis] <= inner.min[axis] && inner.max[axis] <= outer.max[axis])) return false;
  return true;
}

struct Shape {
  unsigned nodes = 0, depth = 0, largest_leaf = 0;
  std::set<std::uint32_t> objects;
};

/// Walks through the whole BVH and holds it against the format.
Shape check_tree(const BuiltBvh& tree) {
  struct Open {
    std::uint32_t offset;
    unsigned depth;
    Aabb box;
  };
  const float infinite = HUGE_VALF;
  const BvhRecord& bvh = tree.frame().bvh;
  std::vector<Open> open = {
      {bvh.node_offset, 0, {{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}}}};
  std::set<std::uint32_t> nodes;
  std::set<std::uint32_t> words;
  Shape shape;
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    REQUIRE(at.offset >= bvh.node_offset);
    REQUIRE((at.offset - bvh.node_offset) % 128 == 0);
    REQUIRE((at.offset - bvh.node_offset) / 128 < bvh.node_count);
    REQUIRE(nodes.insert(at.offset).second);
    shape.depth = std::max(shape.depth, at.depth);
    const NodeRecord& node = tree.node(at.offset);
    for (unsigned slot = 0; slot < 4; ++slot) {
      const Aabb box = child_box(node, slot);
      if (box.min[0] > box.max[0]) {
        REQUIRE(node.leaf[slot] == 0);
        continue;
      }
      REQUIRE(contains(at.box, box));
      double size[3];
      for (int axis = 0; axis < 3; ++axis)
        size[axis] = double{box.max[axis]} - box.min[axis];
      for (const double side : size) { // never flat, whatever rays round to
        REQUIRE(side > 0);
        REQUIRE(side >= 0.9e-6 * (size[0] + size[1] + size[2]));
      }
      if (node.leaf[slot] == 0) {
        open.push_back({node.child[slot], at.depth + 1, box});
        continue;
      }
      const std::uint32_t leaf = node.leaf[slot];
      shape.largest_leaf = std::max(shape.largest_leaf, leaf_word::count(leaf));
      for (std::uint32_t i = 0; i < leaf_word::count(leaf); ++i) {
        std::uint32_t object = node.child[slot] + i * leaf_word::step_bytes(leaf);
        if (leaf_word::is_list(leaf)) {
          const std::uint32_t word = node.child[slot] + i * 4;
          REQUIRE(words.insert(word).second);
          REQUIRE(word >= bvh.list_offset);
          REQUIRE((word - bvh.list_offset) / 4 < tree.frame().object_count);
          object = tree.list_word(word);
        }
        REQUIRE((object - tree.frame().object_offset) % 64 == 0);
        REQUIRE((object - tree.frame().object_offset) / 64 < tree.frame().object_count);
        REQUIRE(shape.objects.insert(object).second);
        REQUIRE(contains(box, bounding_box(tree.object(object))));
      }
    }
  }
  shape.nodes = static_cast<unsigned>(nodes.size());
  return shape;
}

Shape check(BuiltBvh& tree, const Objects& objects) {
  const std::uint32_t nodes = tree.build();
  REQUIRE(nodes >= 1);
  REQUIRE(nodes <= tree.capacity());
  const Shape shape = check_tree(tree);
  REQUIRE(shape.objects.size() == objects.size());
  REQUIRE(shape.depth <= bvh::kMaxDepth);
  REQUIRE(shape.largest_leaf <=
          (tree.frame().large_leaves != 0 ? bvh::kMaxLeaf : bvh::leaf_rule(false, false).most));
  return shape;
}

/// Not the bytes themselves, of which a failed check would print every one.
bool same_bytes(const BuiltBvh& a, const BuiltBvh& b) {
  return a.bytes() == b.bytes();
}

Shape check(const Objects& objects, bool large_leaves) {
  BuiltBvh tree(objects);
  tree.use_large_leaves(large_leaves);
  const Shape shape = check(tree, objects);
  BuiltBvh again(objects);
  again.use_large_leaves(large_leaves);
  again.build(3);
  REQUIRE(same_bytes(tree, again));
  return shape;
}

Shape check(const Objects& objects) {
  const Shape small = check(objects, false);
  const Shape large = check(objects, true);
  CHECK(large.nodes <= small.nodes);
  return small;
}

} // namespace

TEST_CASE("The word of a leaf says where each of its objects lies, before and behind the first") {
  for (const std::int32_t step : {1, 7, -1, -300, leaf_word::kMaxStep, -leaf_word::kMaxStep})
    for (const std::uint32_t count : {1u, 2u, 8u}) {
      const std::uint32_t word = leaf_word::make(count, step);
      CHECK(leaf_word::count(word) == count);
      CHECK_FALSE(leaf_word::is_list(word));
      CHECK(leaf_word::step_bytes(word) == static_cast<std::uint32_t>(std::int64_t{step} * 64));
    }
  CHECK(leaf_word::is_list(leaf_word::make(8, 0)));
  CHECK(leaf_word::make(1, -1) != 0); // a node
}

TEST_CASE("A BVH over few objects") {
  CHECK(check({}).nodes == 1);
  for (unsigned count = 1; count <= 40; ++count) {
    INFO(count << " objects");
    const Shape shape = check(random_triangles(count, 10, 1, count));
    if (count < 4) CHECK(shape.nodes == 1);
  }
}

TEST_CASE("Few objects that are far apart lie alone in their leaves, though they fill no nodes") {
  const bool large_leaves = GENERATE(false, true);
  Random random(5);
  for (unsigned count = 1; count <= 40; ++count) {
    INFO(count << " objects");
    const auto anywhere = [&](unsigned) { return sphere(random.point(10), 0.01); };
    CHECK(check(objects(count, anywhere), large_leaves).largest_leaf == 1);
    const auto in_pairs = [](unsigned i) {
      return sphere({i / 2 * 1000.0, i / 2 % 3 * 1000.0, i % 2 * 10.0}, 0.01);
    };
    CHECK(check(objects(2 * count, in_pairs), large_leaves).largest_leaf == 1);
  }
}

TEST_CASE("A BVH over objects of any kind and number") {
  Random random(2);
  for (unsigned count : {100u, 1000u, 5000u, 20000u, 70000u}) {
    INFO(count << " objects");
    const Shape shape = check(objects(static_cast<unsigned>(times(static_cast<int>(count))), [&](unsigned i) {
      const Vec3 place = random.point(100);
      if (i % 3 == 0) return sphere(place, random.uniform(0.1, 2));
      if (i % 3 == 1)
        return record_of(ObjectKind::ellipsoid,
                         {2, 0.1, 0, place.x, 0.2, 0.5, 0, place.y, 0, 0.3, 1, place.z});
      return triangle(place, place + random.point(2), place + random.point(2));
    }));
    CHECK(shape.depth <= 16);
  }
}

TEST_CASE("A BVH over objects that nothing tells apart") {
  const auto same = static_cast<unsigned>(times(50000));
  CHECK(check(objects(same, [](unsigned) { return sphere({1, 2, 3}, 1); })).depth <= 12);
  CHECK(check(objects(same, [](unsigned) { return triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}); })).depth <= 12);
  CHECK(check(objects(same, [](unsigned) { return triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}); })).depth <= 12);
  // Shells around one centre.
  CHECK(check(objects(same, [](unsigned i) { return sphere({1, 2, 3}, 1 + i); })).depth <= 16);
}

TEST_CASE("A BVH over scenes with one huge object") {
  Objects scene = random_triangles(static_cast<unsigned>(times(30000)), 1, 0.01);
  scene.push_back(sphere({0, 0, 0}, 1e6));
  check(scene);
  // All but one lie in what is a point by the measure of the whole.
  scene.back() = sphere({1e7, 1e7, 1e7}, 1);
  check(scene);
}

TEST_CASE("A BVH over flat scenes and lines") {
  Random random(3);
  const auto count = static_cast<unsigned>(times(30000));
  for (int axis = 0; axis < 3; ++axis) {
    const auto flat = [&](Vec3 p) {
      p[axis] = 0;
      return p;
    };
    CHECK(check(objects(count, [&](unsigned) {
            const Vec3 at = flat(random.point(100));
            return triangle(at, at + flat(random.point(1)), at + flat(random.point(1)));
          })).depth <= 20);
    CHECK(check(objects(count, [&](unsigned i) {
            Vec3 at(5, 5, 5);
            at[axis] = i;
            return triangle(at, at, at);
          })).depth <= 20);
  }
}

TEST_CASE("A BVH over objects that crowd at one place, scale by scale") {
  const auto spiral = [](double shrink) {
    return [=](unsigned i) {
      const double scale = std::pow(shrink, i % 700);
      return sphere(Vec3(std::cos(i), std::sin(i), std::cos(2.0 * i)) * scale, 0.1 * scale);
    };
  };
  for (double shrink : {0.97, 0.9, 0.5, 0.1})
    check(objects(static_cast<unsigned>(times(20000)), spiral(shrink)));
}

TEST_CASE("A BVH over objects at the end of the numbers") {
  for (double reach : {1e12, 1e18, 1e30, 1e37, 1e-12, 1e-30, 1e-37}) {
    INFO(reach);
    check(random_triangles(static_cast<unsigned>(times(10000)), reach, reach / 100));
  }
  // Large coordinates of small objects: their centres are a few numbers.
  Random random(4);
  check(objects(static_cast<unsigned>(times(10000)), [&](unsigned) {
    const Vec3 at = Vec3(1e6, 1e6, 1e6) + random.point(1);
    return triangle(at, at + random.point(0.1), at + random.point(0.1));
  }));
}

TEST_CASE("A lane for each cut makes the same of few references as bins do") {
  using Narrow = HostSimd<BaselineArch>;
  using bvh::Reference;
  static_assert(Narrow::kWidth < kSimdLanes, "splits by bins");
  Random random(5);
  const auto same = [](const bvh::LaneAabb<Narrow>& a, const bvh::LaneAabb<Narrow>& b) {
    Reference first, second;
    a.min.store(first.min);
    a.max.store(first.max);
    b.min.store(second.min);
    b.max.store(second.max);
    return std::equal(first.min, first.min + 3, second.min) &&
           std::equal(first.max, first.max + 3, second.max);
  };
  for (std::uint32_t count = 2; count <= bvh::kFewReferences; ++count)
    for (int round = 0; round < 20; ++round) {
      std::vector<Reference> references, spare(count);
      for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 place = random.point(round % 3 == 0 ? 1e-3 : 10);
        const Vec3 size = random.point(round % 5);
        Reference reference;
        for (int axis = 0; axis < 3; ++axis) {
          const double flat = axis == round % 4 ? 0 : 1;
          reference.min[axis] = static_cast<float>(flat * (place[axis] - std::abs(size[axis])));
          reference.max[axis] = static_cast<float>(flat * (place[axis] + std::abs(size[axis])));
        }
        reference.value = i;
        reference.weight = 1 + i % 3;
        references.push_back(reference);
      }
      INFO(count << " in round " << round);
      const auto range = bvh::range_of<Narrow>(references.data(), 0, count);
      if (range.box.area() == 0.0f) continue; // halved
      const bvh::LaneCuts<Narrow, bvh::kFewBins> cuts(references.data(), range);
      const std::uint32_t lane = cuts.best();
      bvh::Range<Narrow> left, right;
      bvh::split_range(references.data(), spare.data(), range, left, right);
      if (lane == cuts.kNone) {
        CHECK(left.count() == count / 2);
        continue;
      }
      bvh::Range<Narrow> left_of, right_of;
      cuts.sides_of(lane, range.weight, left_of, right_of);
      CHECK(same(left_of.box, left.box));
      CHECK(same(right_of.box, right.box));
      CHECK(left_of.weight == left.weight);
      CHECK(right_of.weight == right.weight);
      for (std::uint32_t i = 0; i < count; ++i)
        CHECK(cuts.is_on_left(references[i].value, lane) == (i < left.end ? 1 : 0));
    }
}

TEST_CASE("A BVH is the same whoever builds it") {
  for (unsigned count : {3u, 100u, 4500u, 60000u}) {
    const Objects scene = random_triangles(count, 100, 1);
    BuiltBvh alone(scene);
    const std::uint32_t nodes = alone.build();
    for (std::uint32_t threads : {1u, 2u, 5u, 8u, 32u, 33u}) {
      INFO(count << " objects, " << threads << " threads");
      BuiltBvh shared(scene);
      REQUIRE(shared.build(threads) == nodes);
      REQUIRE(same_bytes(shared, alone));
      // Over what the last build has left.
      shared.build(threads);
      REQUIRE(same_bytes(shared, alone));
    }
  }
}

namespace {

ObjectRecord moved(const ObjectRecord& from, const Vec3& by) {
  ObjectRecord object = from;
  for (int word = 0; word < 9; ++word)
    object.geometry[word] += static_cast<float>(by[word % 3]);
  return object;
}

/// `copies` of each of the prototypes, in turn, anywhere.
std::vector<CopiedRun> scattered(const std::vector<Objects>& prototypes, unsigned copies, double reach) {
  Random random(7);
  std::vector<CopiedRun> groups;
  for (unsigned copy = 0; copy < copies; ++copy)
    for (std::uint32_t p = 0; p < prototypes.size(); ++p) {
      CopiedRun group = {p, {}};
      const Vec3 by = random.point(reach);
      for (const ObjectRecord& object : prototypes[p])
        group.objects.push_back(moved(object, by));
      groups.push_back(group);
    }
  return groups;
}

Shape check(const Objects& objects, const std::vector<CopiedRun>& copies) {
  BuiltBvh tree(objects, copies);
  Objects all = objects;
  for (const CopiedRun& copy : copies)
    all.insert(all.end(), copy.objects.begin(), copy.objects.end());
  const Shape shape = check(tree, all);
  for (std::uint32_t threads : {2u, 5u, 32u}) {
    BuiltBvh shared(objects, copies);
    REQUIRE(shared.build(threads) == tree.frame().bvh.node_count);
    REQUIRE(same_bytes(shared, tree));
  }
  return shape;
}

} // namespace

TEST_CASE("A BVH over groups that are copies of others") {
  for (unsigned loose : {0u, 1u, 2u, 3u, 5u, 300u, 20000u})
    for (unsigned copies : {1u, 2u, 3u, 50u, 700u}) {
      INFO(loose << " objects beside, " << copies << " of each");
      const std::vector<Objects> prototypes = {
          random_triangles(100, 1, 0.3, 1), random_triangles(37, 1, 1, 2), random_triangles(3, 1, 1, 3),
          random_triangles(1, 1, 1, 4), random_triangles(256, 2, 0.1, 5)};
      const double reach = copies == 50 ? 0.5 : 100; // apart, or in one another
      CHECK(check(random_triangles(loose, reach, 1, 6), scattered(prototypes, copies, reach)).depth <= 20);
    }
}

TEST_CASE("Copies lie deeper than their prototypes, but not too deep") {
  // What is nearest to the origin lies deepest, and the prototype is as deep as its cuts allow.
  Objects prototype;
  for (unsigned i = 0; i < 200; ++i) {
    const double at = std::pow(0.8, i);
    prototype.push_back(triangle({at, 0, 0}, {at, 0.1 * at, 0}, {at, 0, 0.1 * at}));
  }
  std::vector<CopiedRun> groups;
  for (int i = 0; i < 120; ++i) {
    CopiedRun group = {0, {}};
    const auto scale = static_cast<float>(std::pow(0.5, i));
    for (ObjectRecord object : prototype) {
      for (float& coordinate : object.geometry)
        coordinate *= scale;
      group.objects.push_back(object);
    }
    groups.push_back(group);
  }
  CHECK(check({}, groups).depth > 8);
  std::reverse(groups.begin(), groups.end());
  check({}, groups);
}

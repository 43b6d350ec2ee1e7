// Building the grid: the lists are complete, without duplicates and not much longer than need be, on every
// SPU type.
#include "prepared_scene.hpp"
#include "reference/geometry.hpp"
#include "soups.hpp"
#include "spe/run_on.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::test;

namespace {

struct Answer {
  ea_t frame;
  PrepareResult result;
};

PrepareResult prepare_on(const std::string& key, const FrameBlock& frame) {
  Answer answer{to_ea(&frame), {0, false}};
  run_on(
      key, 1,
      [](auto& spu, ea_t argument) {
        Answer& a = test::at<Answer>(argument);
        FrameBlock* local = spu.template allocate<FrameBlock>();
        spu.get(local, a.frame, sizeof(FrameBlock), 0);
        spu.wait_all(1);
        a.result = build_grid(spu, *local);
      },
      to_ea(&answer));
  return answer.result;
}

using Lists = std::vector<std::vector<std::uint32_t>>;

/// The lists as written, after a check that they lie one behind the other and hold each object once.
Lists lists_of(const PreparedScene& scene, const PrepareResult& result) {
  REQUIRE(result.built);
  Lists lists(scene.cell_count());
  std::uint32_t end = scene.frame().grid.list_offset;
  for (std::uint32_t c = 0; c < scene.cell_count(); ++c) {
    const CellRecord& cell = scene.cell(c);
    if (cell.count != 0) REQUIRE(cell.list == end);
    for (std::uint32_t i = 0; i < cell.count; ++i) {
      const std::uint32_t offset = scene.record<std::uint32_t>(end + i * 4);
      REQUIRE((offset - scene.header().object_offset) % 64 == 0);
      REQUIRE((offset - scene.header().object_offset) / 64 < scene.object_count());
      lists[c].push_back((offset - scene.header().object_offset) / 64);
    }
    // In the order of the objects: the sort is stable.
    REQUIRE(std::is_sorted(lists[c].begin(), lists[c].end()));
    REQUIRE(std::adjacent_find(lists[c].begin(), lists[c].end()) == lists[c].end());
    end += cell.count * 4;
  }
  REQUIRE(end == scene.frame().grid.list_offset + result.entries * 4);
  return lists;
}

struct Box3 {
  Vec3 min, max;
};

Box3 voxel_box(const GridRecord& grid, std::uint32_t cell, double margin) {
  const std::uint32_t at[3] = {cell % grid.cells[0], cell / grid.cells[0] % grid.cells[1],
                               cell / grid.row_of_cells};
  Box3 box;
  for (int i = 0; i < 3; ++i) {
    const double size = grid.cell_size[i];
    box.min[i] = double{grid.min[i]} + at[i] * size - margin * size;
    box.max[i] = double{grid.min[i]} + (at[i] + 1) * size + margin * size;
  }
  return box;
}

bool sphere_touches(const ObjectRecord& object, const Box3& box) {
  const Vec3 centre(object.geometry[0], object.geometry[1], object.geometry[2]);
  const double radius = object.geometry[3];
  const Vec3 nearest = glm::clamp(centre, box.min, box.max) - centre;
  const Vec3 farthest = glm::max(glm::abs(box.min - centre), glm::abs(box.max - centre));
  return glm::length(nearest) <= radius && glm::length(farthest) >= radius;
}

/// Clips the triangle by the six planes of the box: is anything left?
bool triangle_touches(const ObjectRecord& object, const Box3& box) {
  std::vector<Vec3> polygon;
  for (int v = 0; v < 3; ++v)
    polygon.emplace_back(object.geometry[v * 3], object.geometry[v * 3 + 1], object.geometry[v * 3 + 2]);
  for (int plane = 0; plane < 6 && !polygon.empty(); ++plane) {
    const int axis = plane / 2;
    const auto depth = [&](const Vec3& p) {
      return plane % 2 == 0 ? p[axis] - box.min[axis] : box.max[axis] - p[axis];
    };
    std::vector<Vec3> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3& a = polygon[i];
      const Vec3& b = polygon[(i + 1) % polygon.size()];
      const double da = depth(a);
      const double db = depth(b);
      if (da >= 0) left.push_back(a);
      if ((da < 0) != (db < 0)) left.push_back(glm::mix(a, b, da / (da - db)));
    }
    polygon = left;
  }
  return !polygon.empty();
}

bool listed(const Lists& lists, std::uint32_t cell, std::uint32_t object) {
  return std::binary_search(lists[cell].begin(), lists[cell].end(), object);
}

/// Every voxel whose inner part the object touches lists it; no voxel lists it that it stays away from.
void check_exactly(const PreparedScene& scene, const Lists& lists) {
  for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
    const ObjectRecord& object = scene.object(i);
    const auto kind = static_cast<ObjectKind>(object.kind_and_flags & object_flag::kind_mask);
    if (kind == ObjectKind::ellipsoid) continue;
    const auto touches = [&](const Box3& box) {
      return kind == ObjectKind::sphere ? sphere_touches(object, box) : triangle_touches(object, box);
    };
    for (std::uint32_t cell = 0; cell < scene.cell_count(); ++cell) {
      if (touches(voxel_box(scene.frame().grid, cell, 1e-6)))
        REQUIRE(listed(lists, cell, i));
      else if (!touches(voxel_box(scene.frame().grid, cell, 0.02)))
        REQUIRE_FALSE(listed(lists, cell, i));
    }
  }
}

/// Points on the surfaces lie in voxels that list the surface.
void check_points(const PreparedScene& scene, const Scene& source, const Lists& lists) {
  const std::vector<reference::Shape> shapes = reference::shapes_of(source);
  REQUIRE(shapes.size() == scene.object_count());
  const GridRecord& grid = scene.frame().grid;
  Random random(20);
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const reference::Shape& shape = shapes[i];
    for (int k = 0; k < 300; ++k) {
      Vec3 point;
      if (shape.triangle) {
        const double u = random.uniform(0, 1);
        const double v = random.uniform(0, 1 - u);
        point = shape.vertex[0] * (1 - u - v) + shape.vertex[1] * u + shape.vertex[2] * v;
      } else {
        point = shape.object->transform.point(shape.sphere.centre + random.direction() * shape.sphere.radius);
      }
      std::uint32_t cell = 0;
      for (int axis = 2; axis >= 0; --axis) {
        const double at = (point[axis] - grid.min[axis]) / grid.cell_size[axis];
        REQUIRE(at >= 0);
        REQUIRE(at <= grid.cells[axis]);
        cell = cell * grid.cells[axis] + std::min(static_cast<std::uint32_t>(at), grid.cells[axis] - 1);
      }
      REQUIRE(listed(lists, cell, i));
    }
  }
}

void check_scene(const Scene& source, std::optional<GridRecord> grid = {}) {
  Lists expected;
  for (const std::string& key : spu_keys()) {
    INFO(key);
    PreparedScene scene(source, grid);
    const Lists lists = lists_of(scene, prepare_on(key, scene.frame()));
    if (!expected.empty()) {
      REQUIRE(lists == expected);
      continue;
    }
    expected = lists;
    if (scene.cell_count() <= 20000) check_exactly(scene, lists);
    check_points(scene, source, lists);
  }
}

} // namespace

TEST_CASE("The lists are complete and tight") {
  check_scene(soup(30, {100, 0, 0}, 10, 2));
  check_scene(soup(31, {0, 100, 0}, 10, 2));
  check_scene(soup(32, {0, 0, 100}, 10, 4));
  check_scene(soup(33, {40, 40, 40}, 10, 8));
  check_scene(soup(34, {40, 40, 40}, 1000, 300));
  check_scene(soup(35, {40, 40, 40}, 0.02, 0.01));
  check_scene(soup(36, {1, 0, 0}, 1, 1));
  check_scene(soup(37, {0, 1, 0}, 1, 1));
}

TEST_CASE("Without objects all lists are empty") {
  for (const std::string& key : spu_keys()) {
    PreparedScene scene(soup(38, {0, 0, 0}, 1, 1));
    const PrepareResult result = prepare_on(key, scene.frame());
    CHECK(result.entries == 0);
    for (const auto& list : lists_of(scene, result))
      CHECK(list.empty());
  }
}

TEST_CASE("Grids of any number of voxels, with one to three digits to sort by") {
  const Scene scene = soup(39, {20, 20, 20}, 9, 2);
  for (const auto& [x, y, z] : {std::array{1u, 1u, 1u},
                                {2u, 1u, 1u},
                                {16u, 16u, 1u},
                                {1u, 257u, 1u},
                                {4u, 8u, 8u},
                                {65u, 33u, 31u},
                                {64u, 64u, 33u}}) {
    INFO(x << " x " << y << " x " << z);
    check_scene(scene, grid_of({-12, -12, -12}, {12, 12, 12}, x, y, z));
  }
}

TEST_CASE("Long thin shapes are in all the voxels on their way") {
  Scene scene = soup(40, {0, 30, 30}, 8, 1);
  for (Object& object : scene.objects)
    object.transform =
        object.transform.then(Transform::scale({1, 0.02, 1})).then(Transform::rotate({20, 30, 40}));
  check_scene(scene, grid_of({-15, -15, -15}, {15, 15, 15}, 24, 24, 24));
}

TEST_CASE("Too little room is answered with how much it takes, and nothing is written") {
  const Scene source = soup(41, {100, 100, 100}, 10, 3);
  PreparedScene whole(source);
  const std::uint32_t pairs = whole.prepare().entries;
  REQUIRE(pairs > 2000);
  for (const std::string& key : spu_keys()) {
    INFO(key);
    for (std::uint32_t room : {0u, 1u, 16u, 1000u, pairs - 1}) {
      PreparedScene scene(source);
      scene.make_room(room);
      const std::uint32_t before = scene.cell(0).list;
      const PrepareResult result = prepare_on(key, scene.frame());
      CHECK_FALSE(result.built);
      CHECK(result.entries == pairs);
      CHECK(scene.cell(0).list == before);
      scene.make_room(result.entries);
      CHECK(lists_of(scene, prepare_on(key, scene.frame())).size() == scene.cell_count());
    }
  }
}

TEST_CASE("A chosen grid covers the scene and has some voxels an object") {
  for (unsigned count : {1u, 10u, 1000u, 20000u}) {
    const PreparedScene scene(soup(42, {count, 0, 0}, 10, 0.1));
    const GridRecord& grid = scene.frame().grid;
    CHECK(scene.cell_count() == grid.cells[0] * grid.cells[1] * grid.cells[2]);
    CHECK(scene.cell_count() >= count);
    CHECK(scene.cell_count() <= 20 * count);
    for (int i = 0; i < 3; ++i) {
      CHECK(grid.min[i] <= scene.header().bounds_min[i]);
      CHECK(grid.max[i] >= scene.header().bounds_max[i]);
      CHECK(grid.cell_size[i] * grid.inverse_cell_size[i] == Approx(1));
      CHECK(grid.min[i] + grid.cell_size[i] * static_cast<float>(grid.cells[i]) ==
            Approx(grid.max[i]).margin(1e-4));
    }
  }
}

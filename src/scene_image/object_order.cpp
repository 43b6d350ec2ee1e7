#include "scene_image/object_order.hpp"

#include "celltrace/spe/simd_host.hpp"
#include "kernel/direct/build_bvh_bounds.hpp"
#include "scene/parallel.hpp"
#include "scene/progress_monitor.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace celltrace {

using namespace kernel;

namespace {

using Simd = HostSimd<BaselineArch>;

constexpr std::uint32_t kObjectsPerCell = 4;
constexpr std::uint32_t kMaxCellBits = 18;
/// Limit on levels of grids within cells; objects in one cell of the deepest grid stay together.
constexpr int kMaxLevels = 24;

struct Bounds {
  float min[3], max[3];

  Bounds() {
    std::fill_n(min, 3, std::numeric_limits<float>::max());
    std::fill_n(max, 3, std::numeric_limits<float>::lowest());
  }
  void grow(const float (&low)[3], const float (&high)[3]) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = std::min(min[axis], low[axis]);
      max[axis] = std::max(max[axis], high[axis]);
    }
  }
};

Bounds bounds_of(const PlacedObject* objects, std::uint32_t begin, std::uint32_t end) {
  auto lanes = bvh::LaneAabb<Simd>::empty();
  for (std::uint32_t i = begin; i < end; ++i)
    lanes.grow(Simd::F4::load(objects[i].centre)); // reads and ignores the word after it
  bvh::Reference box;
  lanes.min.store(box.min); // also writes the neighbouring words
  lanes.max.store(box.max);
  Bounds bounds;
  bounds.grow(box.min, box.max);
  return bounds;
}

/// A grid with nearly cubic cells, numbered along a Morton curve: each bit of a number halves the cells along
/// the axis in which they are longest.
class CurveGrid {
public:
  CurveGrid(const Bounds& bounds, std::uint32_t objects) {
    const std::uint32_t wanted = objects / kObjectsPerCell;
    bits_ = std::min<std::uint32_t>(static_cast<std::uint32_t>(std::bit_width(wanted)) - (wanted != 0),
                                    kMaxCellBits);
    float extent[3];
    for (int axis = 0; axis < 3; ++axis)
      extent[axis] = bounds.max[axis] - bounds.min[axis];
    float length[3] = {extent[0], extent[1], extent[2]};
    std::uint32_t bits_of[3] = {0, 0, 0};
    int axis_of[kMaxCellBits];
    for (std::uint32_t bit = 0; bit < bits_; ++bit) {
      axis_of[bit] = static_cast<int>(std::max_element(length, length + 3) - length);
      length[axis_of[bit]] *= 0.5f;
      ++bits_of[axis_of[bit]];
    }
    for (int axis = 0; axis < 3; ++axis) {
      base_[axis] = bounds.min[axis];
      last_[axis] = static_cast<float>((1u << bits_of[axis]) - 1);
      scale_[axis] = extent[axis] > 1e-30f ? (last_[axis] + 1.0f) * 0.999999f / extent[axis] : 0.0f;
    }
    spread(axis_of, bits_of);
  }

  std::uint32_t count() const { return 1u << bits_; }

  std::uint32_t cell_of(const float (&centre)[3]) const {
    std::uint32_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float place = std::min((centre[axis] - base_[axis]) * scale_[axis], last_[axis]);
      const auto at = static_cast<std::uint32_t>(static_cast<std::int32_t>(place));
      cell |= low_[axis][at % kHalf] | high_[axis][at / kHalf];
    }
    return cell;
  }

private:
  static constexpr std::uint32_t kHalfBits = kMaxCellBits / 2;
  static constexpr std::uint32_t kHalf = 1u << kHalfBits;

  /// Fills the tables that move the bits of a coordinate's low and high half to their places in a cell's
  /// number.
  void spread(const int (&axis_of)[kMaxCellBits], std::uint32_t (&left)[3]) {
    std::uint32_t place[3][kMaxCellBits];
    const std::uint32_t used[3] = {left[0], left[1], left[2]};
    for (std::uint32_t bit = 0; bit < bits_; ++bit)
      place[axis_of[bit]][--left[axis_of[bit]]] = 1u << (bits_ - 1 - bit);
    for (int axis = 0; axis < 3; ++axis) {
      fill(low_[axis], place[axis], std::min(used[axis], kHalfBits));
      fill(high_[axis], place[axis] + kHalfBits, used[axis] > kHalfBits ? used[axis] - kHalfBits : 0);
    }
  }
  static void fill(std::uint32_t (&table)[kHalf], const std::uint32_t* place, std::uint32_t bits) {
    table[0] = 0;
    for (std::uint32_t bit = 0; bit < bits; ++bit)
      for (std::uint32_t i = 0; i < (1u << bit); ++i)
        table[(1u << bit) + i] = table[i] | place[bit];
  }

  std::uint32_t bits_;
  float base_[3], scale_[3], last_[3];
  std::uint32_t low_[3][kHalf], high_[3][kHalf];
};

class Orderer {
public:
  Orderer(PlacedObject* objects, PlacedObject* spare, std::uint32_t* cells)
      : objects_(objects), spare_(spare), cells_(cells) {}

  std::vector<std::uint32_t> order(std::uint32_t count, unsigned threads) {
    std::vector<Bounds> bounds(threads);
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(count, part, threads);
      bounds[part] = bounds_of(objects_, mine.begin, mine.end);
    });
    for (const Bounds& other : bounds)
      bounds[0].grow(other.min, other.max);
    const CurveGrid grid(bounds[0], count);

    std::vector<std::vector<std::uint32_t>> next(threads);
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(count, part, threads);
      next[part] = count_cells(grid, mine.begin, mine.end);
    });
    const std::vector<std::uint32_t> begins = add_up(next, 0);
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(count, part, threads);
      send(next[part], mine.begin, mine.end);
    });

    // Copies the ordered objects of each cell back to `objects_`.
    std::vector<std::vector<std::uint32_t>> groups(threads);
    for_each_part(threads, [&](unsigned part) {
      const HostPart mine(count, part, threads);
      const auto first = std::lower_bound(begins.begin(), begins.end(), mine.begin);
      const auto last = std::lower_bound(begins.begin(), begins.end(), mine.end);
      std::copy(spare_ + *first, spare_ + *last, objects_ + *first);
      for (auto cell = first; cell != last; ++cell) {
        ProgressMonitor::check_cancelled(static_cast<std::size_t>(cell - first));
        finish(cell[0], cell[1], 1, groups[part]);
      }
    });
    for (unsigned part = 1; part < threads; ++part)
      groups[0].insert(groups[0].end(), groups[part].begin(), groups[part].end());
    groups[0].push_back(count);
    return std::move(groups[0]);
  }

private:
  std::vector<std::uint32_t> count_cells(const CurveGrid& grid, std::uint32_t begin, std::uint32_t end) {
    std::vector<std::uint32_t> counts(grid.count());
    for (std::uint32_t i = begin; i < end; ++i) {
      ProgressMonitor::check_cancelled(i);
      cells_[i] = grid.cell_of(objects_[i].centre);
      ++counts[cells_[i]];
    }
    return counts;
  }

  /// Turns counts, one array for each part of the objects, into the place of each cell's first object.
  /// Returns the begins of the nonempty cells, followed by the end of the last one.
  static std::vector<std::uint32_t> add_up(std::vector<std::vector<std::uint32_t>>& counts,
                                           std::uint32_t place) {
    std::vector<std::uint32_t> begins;
    for (std::size_t cell = 0; cell < counts[0].size(); ++cell) {
      const std::uint32_t begin = place;
      for (std::vector<std::uint32_t>& part : counts) {
        const std::uint32_t objects = part[cell];
        part[cell] = place;
        place += objects;
      }
      if (place != begin) begins.push_back(begin);
    }
    begins.push_back(place);
    return begins;
  }

  void send(std::vector<std::uint32_t>& next, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      ProgressMonitor::check_cancelled(i);
      spare_[next[cells_[i]]++] = objects_[i];
    }
  }

  /// Divides a cell if it has many objects, else appends its begin to `groups`.
  void finish(std::uint32_t begin, std::uint32_t end, int level, std::vector<std::uint32_t>& groups) {
    if (end - begin <= kMaxRun || level == kMaxLevels || !divide(begin, end, level, groups))
      groups.push_back(begin);
  }

  /// Divides a cell. Returns false if all objects lie at one point.
  bool divide(std::uint32_t begin, std::uint32_t end, int level, std::vector<std::uint32_t>& groups) {
    const CurveGrid grid(bounds_of(objects_, begin, end), end - begin);
    std::vector<std::vector<std::uint32_t>> next = {count_cells(grid, begin, end)};
    const std::vector<std::uint32_t> begins = add_up(next, begin);
    if (begins.size() == 2) return false;
    send(next[0], begin, end);
    std::copy(spare_ + begin, spare_ + end, objects_ + begin);
    for (std::size_t cell = 0; cell + 1 < begins.size(); ++cell)
      finish(begins[cell], begins[cell + 1], level + 1, groups);
    return true;
  }

  PlacedObject* objects_;
  PlacedObject* spare_;
  std::uint32_t* cells_;
};

} // namespace

std::vector<std::uint32_t> order_along_curve(PlacedObject* objects, PlacedObject* spare, std::uint32_t* cells,
                                             std::uint32_t count, unsigned threads) {
  return Orderer(objects, spare, cells).order(count, threads);
}

} // namespace celltrace

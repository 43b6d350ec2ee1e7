// Maps of patterns: find the entry that a value stands for, or two entries that are blended, each of which
// may be a map again. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/packet.hpp"
#include "kernel/textures/pattern_value.hpp"

namespace celltrace::kernel {

/// Largest depth of nested maps.
constexpr uint32_t kDeepestMapWalk = 8;

/// Kind of the entries of a tree of maps if colours are wanted; if normals are wanted, the entries are
/// normals.
enum class MapOf : uint32_t { pigments, textures };

/// Returns the pattern of a texture map; kNoOffset: the material is no map.
inline uint32_t map_of(const MaterialRecord& material) {
  return (material.flags & material_flag::mapped) != 0 ? material.pattern : kNoOffset;
}

inline uint32_t map_entry_at(uint32_t entries, uint32_t number) {
  return entries + number * static_cast<uint32_t>(sizeof(MapEntryRecord));
}

/// Finds the places of values in a pattern's map: calls `at(lanes, number, entry)` if one entry counts, and
/// `between(lanes, number, below, above, share)` if two count; `number` and `share` are those of the upper
/// entry. The first call is for all lanes; later calls are for lanes below the last entry, once for each
/// lane: long maps consist mostly of intervals without a value. If several entries have one position, the
/// first counts below it and the last above it, as in POV-Ray.
template <class S, class Spu, class At, class Between>
[[gnu::always_inline]] inline void find_interval(SceneAccess<Spu>& scene, const PatternRecord& r,
                                                 const typename S::F& value, At at, Between between) {
  using F = typename S::F;
  using M = typename S::M;
  uint32_t number = r.entry_count - 1;
  MapEntryRecord room[2];
  const MapEntryRecord* above = keep<Spu>(scene.map_entry(map_entry_at(r.entries, number)), room[number & 1]);
  at(M::all(), number, *above);
  M within = value < F(above->position);
  for (; within.bits() != 0; --number) {
    if (number == 0) {
      at(within, 0, *above);
      return;
    }
    const MapEntryRecord* const below =
        keep<Spu>(scene.map_entry(map_entry_at(r.entries, number - 1)), room[(number - 1) & 1]);
    const M further = within & (value <= F(below->position)), here = within & !further;
    if (here.bits() != 0)
      between(here, number, *below, *above, (value - F(below->position)) * F(above->inverse_width));
    above = below;
    within = further;
  }
}

inline bool is_pigment(const PatternRecord& r) {
  return (r.kind_and_flags & pattern_flag::kind_mask) == kPatternKind<PigmentPattern>;
}

/// Applies a pattern's wave form, if it has one, to its values.
template <class S> typename S::F in_wave(const PatternRecord& r, const typename S::F& value) {
  return wave_of(r) == PatternWave::none ? value : in_wave_form<S>(r, value);
}

/// Visits the leaves of a tree of maps that count at the points of a packet (`S` is Spu::simd) or of a part
/// of it (Spu::rare_simd), with their weights, which add up to 1 in each lane. Without recursion: one level
/// of the tree is one of `levels_`. A map whose pattern is a pigment waits on its level until the leaves of
/// that pigment, on higher levels, have added up to their grey.
template <class Spu, TextureStage kStage, class S = typename Spu::rare_simd> class MapWalk {
public:
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;
  using Part = typename Spu::rare_simd;

  static constexpr CodeModule kModule = kStage == TextureStage::normals ? modules::kNormals
                                        : kStage == TextureStage::maps  ? modules::kMaps
                                                                        : modules::kTextures;

  /// Allocates nothing; `points` must outlive the walk.
  MapWalk(SceneAccess<Spu>& scene, const PatternPoints<S>& points, MapOf of = MapOf::pigments)
      : scene_(scene), of_(of), points_(&points) {
    if constexpr (!kIsPart) inside_ = kNoOffset;
  }
  MapWalk(SceneAccess<Spu>&, const PatternPoints<S>&&, MapOf = MapOf::pigments) = delete;

  /// Enters a pattern, whose leaves share `weight`.
  CELLTRACE_ONE_COPY void enter(uint32_t pattern, const F& weight, uint32_t lanes) {
    scene_.spu().run_in_module(kModule);
    Level& level = levels_[depth_++];
    level.weight = weight;
    level.pattern = pattern;
    level.lanes = lanes;
    level.state = State::fresh;
  }

  /// Finds the next leaf and its weight in `lanes`. Returns false if there are no more.
  CELLTRACE_ONE_COPY bool next(MapEntryRecord& leaf, F& weight, uint32_t& lanes) {
    scene_.spu().run_in_module(kModule);
    while (depth_ != ground_) {
      Level& level = levels_[depth_ - 1];
      if (level.state <= State::waits) {
        open(level);
        continue;
      }
      if (level.next == level.count) {
        --depth_;
        continue;
      }
      if (kHasColours && level.state == State::coloured) {
        ++level.next;
        weight = level.weight;
        lanes = level.lanes;
        leaf_is_coloured_ = true;
        leaf = {}; // nothing of it counts
        leaf.child = kNoOffset;
        if (grey_ == nullptr) return true;
        *grey_ = *grey_ + grey_of<S>(pigment(leaf).rgb) * weight;
        continue;
      }
      const uint32_t number = level.next++;
      leaf = *scene_.map_entry(map_entry_at(level.entries, number));
      weight = level.weight * (level.state == State::average ? F(leaf.position) : weight_of(level, number));
      lanes = level.lanes & (S::abs(weight) > F(0.0f)).bits(); // weights of an average may be negative
      if (lanes == 0) continue;
      if constexpr (kHasColours) leaf_is_coloured_ = false;
      const uint32_t pattern = pattern_of(leaf);
      if (pattern != kNoOffset)
        enter(pattern, weight, lanes);
      else if (!kIsPart || grey_ == nullptr)
        return true;
      else
        *grey_ = *grey_ + F(grey_of(leaf.rgb)) * weight;
    }
    return false;
  }

  /// Returns the colours of the leaf that next() has found.
  PigmentLanes<S> pigment(const MapEntryRecord& leaf) const {
    if constexpr (kHasColours)
      if (leaf_is_coloured_) return colours_;
    return pigment_of<S>(leaf);
  }

  /// Returns the grey of a pigment that is a map, at other points. May be called between two leaves: it uses
  /// the levels above those in use.
  CELLTRACE_ONE_COPY F grey_of_pigment(uint32_t pattern, const PatternPoints<S>& points, uint32_t lanes) {
    scene_.spu().run_in_module(kModule);
    const PatternPoints<S>* const own = points_;
    F grey(0.0f);
    points_ = &points;
    grey_ = &grey;
    ground_ = depth_;
    enter(pattern, F(1.0f), lanes);
    MapEntryRecord leaf;
    F weight;
    next(leaf, weight, lanes); // finds no leaf, as all are parts of the grey
    ground_ = 0;
    grey_ = nullptr;
    points_ = own;
    return grey;
  }

private:
  /// True for walks of parts of packets. Only these walks enter patterns that are pigments; walks of whole
  /// packets leave such patterns to them, part by part.
  static constexpr bool kIsPart = S::kLanes == Part::kLanes;

  /// True if leaves may be patterns that are colours, even if only in a pigment that is a pattern.
  static constexpr bool kHasColours = Patterns::kSomeAreColours && kIsPart;

  /// State of a level. `fresh`: its pattern has not been evaluated; `waits`: its pattern is a pigment that
  /// adds up in `upper`; `placed`: each lane has weights of its own; `average`: all lanes have the same
  /// weights; `coloured`: the level is one leaf, with the colours `colours_`.
  enum class State : uint32_t { fresh, waits, placed, average, coloured };
  struct Level {
    F weight;
    F upper;   ///< in each lane, the index of the entry above the value
    F share;   ///< share of that entry; the rest is the share of the entry before it
    F* around; ///< if the level waits: the grey to which leaves contribute after the level's own
    uint32_t pattern, entries, count, next, lanes;
    State state;
  };

  /// Evaluates the pattern of a level, as far as that is possible at once, and finds the entries that count.
  CELLTRACE_ONE_COPY void open(Level& level) {
    scene_.spu().run_in_module(kModule);
    Kept<Spu, PatternRecord> r = *scene_.pattern(level.pattern);
    level.entries = r.entries;
    level.count = r.entry_count;
    level.next = 0;
    if constexpr (kHasColours)
      if (is_colour(r.kind_and_flags & pattern_flag::kind_mask)) {
        const PatternPoints<Part> points = to_pattern_space<kStage>(scene_, r, *points_, level.lanes);
        scene_.spu().compute(scalar_work::kPattern);
        scene_.spu().enter_module(modules::kRarePatterns);
        module_rare::colour(scene_, r, points, colours_);
        level.count = 1;
        level.state = State::coloured;
        return;
      }
    if ((r.kind_and_flags & pattern_flag::average) != 0) {
      if (is_relative(r)) enter_space(r, level);
      level.state = State::average;
      return;
    }
    F value;
    if constexpr (kIsPart) {
      if (level.state == State::waits) {
        grey_ = level.around;
        value = in_wave<Part>(r, level.upper);
      } else if (is_pigment(r)) {
        level.state = State::waits;
        level.upper = F(0.0f);
        level.around = grey_;
        grey_ = &level.upper;
        enter(r.table, F(1.0f), level.lanes);
        return;
      } else {
        value = value_of(r, level.lanes);
      }
    } else {
      value = value_of(r, level.lanes);
    }
    if (is_relative(r)) enter_space(r, level);
    level.state = State::placed;
    if (Patterns::kAreLists[r.kind_and_flags & pattern_flag::kind_mask]) {
      level.upper = S::min(value, F(static_cast<float>(r.entry_count - 1)));
      level.share = F(1.0f);
      return;
    }
    const auto set = [&](const M& some, uint32_t number, const F& share) {
      level.upper = S::select(some, F(static_cast<float>(number)), level.upper);
      level.share = S::select(some, share, level.share);
    };
    find_interval<S>(
        scene_, r, value,
        [&](const M& some, uint32_t number, const MapEntryRecord&) { set(some, number, F(1.0f)); },
        [&](const M& some, uint32_t number, const MapEntryRecord&, const MapEntryRecord&, const F& share) {
          set(some, number, share);
        });
  }

  F value_of(const PatternRecord& r, uint32_t lanes) {
    if constexpr (kIsPart) {
      return pattern_value(scene_, r, to_pattern_space<kStage>(scene_, r, *points_, lanes));
    } else {
      F value;
      by_parts<Spu>(
          value,
          [&](const PatternPoints<Part>& of_packet) {
            const PatternPoints<Part> points = in_space(of_packet, lanes);
            if (is_pigment(r)) {
              MapWalk<Spu, kStage> walk(scene_, points);
              return in_wave<Part>(r,
                                   walk.grey_of_pigment(r.table, points, part_of<Spu>(lanes, points.first)));
            }
            return pattern_value(scene_, r, to_pattern_space<kStage>(scene_, r, points, lanes));
          },
          *points_);
      return value;
    }
  }

  static bool is_relative(const PatternRecord& r) {
    return kStage != TextureStage::normals && (r.kind_and_flags & pattern_flag::relative) != 0;
  }
  /// Enters the space of a relative map's pattern, in which the map's contents are evaluated. A whole packet
  /// has no room on an SPU's stack for points there: they are computed again, part by part.
  void enter_space(const PatternRecord& r, const Level& level) {
    if constexpr (kIsPart) {
      inside_ = to_pattern_space<kStage>(scene_, r, *points_, level.lanes);
      points_ = &inside_;
    } else {
      inside_ = level.pattern;
    }
  }
  PatternPoints<Part> in_space(const PatternPoints<Part>& points, uint32_t lanes) {
    if constexpr (!kIsPart)
      if (inside_ != kNoOffset) {
        Kept<Spu, PatternRecord> r = *scene_.pattern(inside_);
        return to_pattern_space<kStage>(scene_, r, points, lanes);
      }
    return points;
  }

  /// Returns the pattern whose map an entry is; kNoOffset: it is a leaf.
  uint32_t pattern_of(const MapEntryRecord& entry) {
    if constexpr (kStage == TextureStage::normals) {
      if (grey_ != nullptr) return entry.child;
      const NormalRecord& normal = *scene_.normal(entry.child);
      return normal.is_mapped != 0 ? normal.pattern : kNoOffset;
    }
    return of_ == MapOf::pigments || grey_ != nullptr ? entry.child : map_of(*scene_.material(entry.child));
  }

  static F weight_of(const Level& level, uint32_t number) {
    const F own = S::select(level.upper == F(static_cast<float>(number)), level.share, F(0.0f));
    return S::select(level.upper == F(static_cast<float>(number + 1)), F(1.0f) - level.share, own);
  }

  SceneAccess<Spu>& scene_;
  MapOf of_;
  const PatternPoints<S>* points_;
  /// In a relative map: points in its space, or the offset of its pattern.
  std::conditional_t<kIsPart, PatternPoints<S>, uint32_t> inside_;
  struct None {};
  std::conditional_t<kHasColours, PigmentLanes<S>, None> colours_;
  bool leaf_is_coloured_ = false; ///< for the leaf that next() has found
  F* grey_ = nullptr;             ///< sum of the leaves that are parts of a pattern
  uint32_t depth_ = 0;
  uint32_t ground_ = 0; ///< depth at which next() ends
  Level levels_[kDeepestMapWalk];
};

} // namespace celltrace::kernel

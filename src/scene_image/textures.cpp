#include "scene_image/textures.hpp"

#include "kernel/textures/list.hpp"
#include "scene_image/list_waves.hpp"
#include "scene_image/record_vectors.hpp"
#include "scene_image/surface_records.hpp"
#include "scene_image/texture_room.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <type_traits>

namespace celltrace {

using namespace kernel;

namespace {

std::size_t hash_of(const Vec3& vector) {
  const std::hash<double> hash;
  return (hash(vector.x) * 31 + hash(vector.y)) * 31 + hash(vector.z);
}

/// Returns the inverse width of an interval of a map; 0 if the interval is empty.
float inverse_width(double from, double to) {
  const float inverse = to > from ? static_cast<float>(1 / (to - from)) : 0;
  return std::isfinite(inverse) ? inverse : 0;
}

/// Returns the sum of the `count` greatest of the numbers of nodes that materials push.
std::uint32_t sum_of_greatest(std::vector<std::uint32_t> nodes, std::size_t count) {
  std::sort(nodes.begin(), nodes.end(), std::greater<>());
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < std::min(count, nodes.size()); ++i)
    sum = std::min(sum + nodes[i], kMostSurfaceNodes);
  return sum;
}
/// Returns the number of nodes that a mirror's rays take on the stack. A mirror with a reflection exponent
/// needs a second node, which collects the reflected light.
std::uint32_t nodes_of_mirror(const MaterialRecord& r) {
  if ((r.flags & material_flag::reflects) == 0) return 0;
  return (r.flags & material_flag::reflection_exponent) != 0 ? 2 : 1;
}

} // namespace

Material sky_of(const Scene& scene) {
  Material top;
  for (const Pigment& pigment : scene.sky_sphere) {
    const bool is_lowest = &pigment == &scene.sky_sphere.front();
    top = Material{pigment, {}, nullptr, is_lowest ? nullptr : std::make_shared<const Material>(top)};
  }
  return top;
}

void TextureTables::Traits::add(const Traits& other) {
  opaque = opaque && other.opaque;
  spawns = spawns || other.spawns;
  textured = textured || other.textured;
  disturbed = disturbed || other.disturbed;
  lit_behind = lit_behind || other.lit_behind;
  by_surface = by_surface || other.by_surface;
  nodes = std::max(nodes, other.nodes);
}

TextureTables::TextureTables(const Scene& scene) : scene_(scene), sharing_(scene.materials) {
  materials.resize(scene.materials.size());
  object_flags.reserve(scene.materials.size());
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Traits traits = fill_material(static_cast<std::uint32_t>(i), scene.materials[i], {}, Place::root);
    object_flags.push_back(
        (traits.opaque ? object_flag::opaque : 0) | (traits.two_sided ? object_flag::two_sided : 0) |
        (traits.by_surface ? object_flag::by_surface : 0) | (traits.spawns ? material_word::spawns : 0) |
        (traits.textured ? material_word::textured : 0) | (traits.disturbed ? material_word::disturbed : 0) |
        (traits.lit_behind ? material_word::lit_behind : 0));
    by_surface = by_surface || traits.by_surface;
    filters = filters || !traits.opaque;
    filters_by_surface = filters_by_surface || (traits.by_surface && !traits.opaque);
    if (scene.materials[i].map || scene.materials[i].inside)
      mapped_nodes_.push_back(traits.nodes);
    else
      unmapped_nodes_ = std::max(unmapped_nodes_, traits.nodes);
  }
  sky = scene.sky_sphere.empty() ? kNoOffset : add_material(sky_of(scene), {}, Place::root).index;
  for (const Rainbow& rainbow : scene.rainbows)
    if (is_visible(rainbow)) add_rainbow(rainbow);
}

std::uint32_t TextureTables::most_nodes(bool has_blends) const {
  // The rays of a node may hit surfaces without and with layers, and as many texture maps as a packet has
  // lanes.
  const std::uint32_t of_material = 2 * unmapped_nodes_ + sum_of_greatest(mapped_nodes_, kSimdLanes);
  return std::min(kMostSurfaceNodes, has_blends ? 3 * of_material : of_material);
}

TextureTables::Traits TextureTables::fill_material(std::uint32_t index, const Material& material,
                                                   const PatternSpace& outer, Place place) {
  MaterialRecord r{};
  r.pattern = r.normal = r.below = r.finish = r.inside = kNoOffset;
  Traits traits;
  std::uint32_t inside = kNoOffset;
  Traits inside_traits;
  if (material.inside) {
    const Known known = add_material(*material.inside, outer, Place::root);
    inside = known.index;
    inside_traits = known.traits;
  }
  if (material.map) {
    const Known map = add_map(material.map, outer, place);
    r.flags = material_flag::mapped;
    r.pattern = map.index;
    traits = map.traits;
    traits.spawns = traits.textured = true;
  } else {
    r = make_record(material, scene_);
    traits.lit_behind = material.finish.diffuse_behind != 0;
    if (has_record(material.finish)) {
      r.finish = static_cast<std::uint32_t>(finishes.size());
      finishes.push_back(make_record(material.finish, scene_));
    }
    if (material.pigment.map) {
      const Known map = add_map(material.pigment.map, outer, Place::root);
      r.flags |= material_flag::patterned;
      r.pattern = map.index;
      traits.add(map.traits);
      traits.textured = true;
    } else {
      traits.opaque = is_opaque(material.pigment);
    }
    traits.spawns = !traits.opaque || (r.flags & material_flag::reflects) != 0;
    const std::uint32_t mirrors = nodes_of_mirror(r);
    traits.nodes = mirrors + (traits.opaque ? 0 : 1);
    if (material.normal) {
      r.flags |= material_flag::disturbed;
      const Known normal = add_normal(*material.normal, outer);
      r.normal = normal.index;
      traits.disturbed = traits.textured = true;
      traits.by_surface = traits.by_surface || normal.traits.by_surface;
    }
    if (material.below) {
      const Known below = add_material(*material.below, outer, Place::inside);
      r.flags |= material_flag::layered;
      r.below = below.index;
      // Light that a layer lets through needs no ray to reach the layer below. A Fresnel mirror needs to know
      // which object the ray is in.
      traits.opaque = traits.opaque || below.traits.opaque;
      constexpr std::uint32_t kNeedsRays = material_flag::reflects | material_flag::fresnel;
      traits.spawns = (r.flags & kNeedsRays) != 0 || below.traits.spawns;
      traits.nodes = mirrors + below.traits.nodes;
      traits.disturbed = traits.disturbed || below.traits.disturbed;
      traits.lit_behind = traits.lit_behind || below.traits.lit_behind;
      traits.by_surface = traits.by_surface || below.traits.by_surface;
      traits.textured = true;
    }
  }
  if (material.inside) {
    r.inside = inside;
    traits.add(inside_traits);
    traits.two_sided = true;
    has_translucent_side = has_translucent_side || !traits.opaque;
  }
  materials[index] = r;
  return traits;
}

TextureTables::Known TextureTables::add_material(const Material& material, const PatternSpace& outer,
                                                 Place place) {
  const auto index = static_cast<std::uint32_t>(materials.size());
  make_room(materials, 1, "layers");
  materials.emplace_back();
  const Traits traits = fill_material(index, material, outer, place);
  return {index, traits};
}

/// Returns the material of an entry of a relative map; adds it if no equal material has been added.
TextureTables::Known TextureTables::add_shared_material(const Material& material) {
  const auto words = {hash_of(material.pigment.rgb), hash_of(material.finish.ambient),
                      std::hash<const void*>()(material.map.get()),
                      std::hash<const void*>()(material.below.get())};
  std::size_t hash = 0;
  for (const std::size_t word : words)
    hash = hash * 31 + word;
  const auto [first, last] = known_materials_.equal_range(hash);
  const auto known =
      std::find_if(first, last, [&](const auto& one) { return *one.second.first == material; });
  if (known != last) return known->second.second;
  const Known added = add_material(material, {}, Place::inside);
  known_materials_.emplace(hash, std::pair(&material, added));
  return added;
}

/// Returns the index of the first entry of an equal block, and removes this block; if there is no equal
/// block, returns the index of this block's first entry. Looks only for blocks at the end of the table.
std::uint32_t TextureTables::share_entries(const EntryBlock& block) {
  const auto bytes_of = [this](const EntryBlock& one) {
    return std::string_view(reinterpret_cast<const char*>(entries.data() + one.first),
                            one.count * sizeof(MapEntryRecord));
  };
  if (block.first + block.count != entries.size()) return block.first;
  const std::size_t hash = std::hash<std::string_view>()(bytes_of(block));
  const auto [first, last] = blocks_.equal_range(hash);
  const auto known = std::find_if(first, last, [&](const auto& one) {
    return children_[one.second.first] == children_[block.first] && bytes_of(one.second) == bytes_of(block);
  });
  if (known == last) {
    blocks_.emplace(hash, block);
    return block.first;
  }
  entries.resize(block.first);
  children_.resize(block.first);
  return known->second.first;
}

TextureTables::Traits TextureTables::fill(MapEntryRecord& entry, const Pigment& pigment) {
  for (int i = 0; i < 3; ++i)
    entry.rgb[i] = static_cast<float>(pigment.rgb[i]);
  entry.filter = static_cast<float>(pigment.filter);
  entry.transmit = static_cast<float>(pigment.transmit);
  Traits traits;
  traits.opaque = is_opaque(pigment);
  return traits;
}

template <class T>
TextureTables::Known TextureTables::add_map(const std::shared_ptr<const PatternMap<T>>& map,
                                            const PatternSpace& outer, Place place) {
  const bool is_shared = outer.is_scene() || (std::is_same_v<T, Pigment> && map->pattern.uv_mapping);
  const std::pair<const void*, Place> key(map.get(), sharing_.is_needed() ? place : Place::inside);
  if (is_shared)
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
  if (!map->is_average && blends_list(map->pattern)) {
    const auto list = without_wave(*map);
    made_.push_back(list);
    const Known known = add_map(list, outer, place);
    if (is_shared) known_[key] = known;
    return known;
  }
  const bool is_relative = sharing_.is_needed() && place == Place::root && sharing_.may_be_relative(*map);
  const PatternSpace composed = space_inside(map->pattern, outer);
  const PatternSpace inside = is_relative ? PatternSpace() : composed;
  const std::size_t count = map->entries.size();
  make_room(entries, count, "entries of maps");
  const auto first = static_cast<std::uint32_t>(entries.size());
  entries.resize(entries.size() + count);
  children_.resize(entries.size());
  bool is_nested = false;
  double weights = 0;
  for (const auto& entry : map->entries)
    weights += entry.position;
  Traits traits;
  std::vector<std::uint32_t> nodes; // numbers of nodes, by entry
  for (std::size_t i = 0; i < count; ++i) {
    const auto& from = map->entries[i];
    MapEntryRecord entry{};
    entry.position = static_cast<float>(map->is_average ? from.position / weights : from.position);
    entry.inverse_width = i == 0 ? 0 : inverse_width(map->entries[i - 1].position, from.position);
    entry.child = kNoOffset;
    if constexpr (!std::is_same_v<T, Normal>) {
      // Between two equal entries a map is constant: only the lower entry counts, so that it is evaluated
      // once.
      if (i != 0 && from.value == map->entries[i - 1].value) {
        const float position = entry.position;
        entry = entries[first + i - 1];
        entry.position = position;
        entry.inverse_width = 0;
        children_[first + i] = children_[first + i - 1];
        entries[first + i] = entry;
        if (!nodes.empty()) nodes.push_back(nodes.back());
        continue;
      }
    }
    if constexpr (std::is_same_v<T, Pigment>) {
      children_[first + i] = Child::pattern;
      Traits own = fill(entry, from.value);
      if (from.value.map) {
        const Known nested = add_map(from.value.map, inside, Place::inside);
        entry.child = nested.index;
        is_nested = true;
        own = nested.traits;
      }
      traits.add(own);
    } else if constexpr (std::is_same_v<T, Normal>) {
      children_[first + i] = Child::normal;
      const Known normal = add_normal(from.value, inside);
      entry.child = normal.index;
      traits.add(normal.traits);
    } else {
      children_[first + i] = Child::material;
      const Known material =
          is_relative ? add_shared_material(from.value) : add_material(from.value, inside, Place::inside);
      entry.child = material.index;
      traits.add(material.traits);
      nodes.push_back(material.traits.nodes);
    }
    entries[first + i] = entry;
  }
  const auto [pattern, of_pattern] = add_pattern(map->pattern, outer, composed, map->is_average, count);
  patterns[pattern].entries = sharing_.is_needed() ? share_entries({first, count}) : first;
  if (is_relative) patterns[pattern].kind_and_flags |= pattern_flag::relative;
  if (is_nested) patterns[pattern].kind_and_flags |= pattern_flag::nested;
  traits.by_surface = traits.by_surface || of_pattern.by_surface;
  // In an average all entries count, in any other map two entries in each lane.
  traits.nodes = sum_of_greatest(nodes, map->is_average ? count : 2 * kSimdLanes);
  if (is_shared) known_[key] = {pattern, traits};
  return {pattern, traits};
}

TextureTables::Known TextureTables::add_normal(const Normal& normal, const PatternSpace& outer) {
  NormalRecord r{};
  Traits traits;
  if (normal.map) {
    const Known map = add_map(normal.map, outer, Place::inside);
    r.is_mapped = 1;
    r.pattern = map.index;
    traits = map.traits;
  } else {
    const bool has_slopes =
        !normal.slopes.empty() &&
        !disturbs(pattern_words(normal.pattern.kind, 1).kind_and_flags & pattern_flag::kind_mask);
    const std::uint32_t first = has_slopes ? add_slopes(normal.slopes) : 0;
    // A pigment that the pattern consists of is evaluated at points of the pattern's own space.
    const Known pattern =
        add_pattern(normal.pattern, outer, {}, false, has_slopes ? normal.slopes.size() : 0);
    r.pattern = pattern.index;
    patterns[r.pattern].entries = first;
    if (!has_slopes && blends_list(normal.pattern)) set_list_heights(patterns[r.pattern], normal.pattern);
    const auto* facets = std::get_if<pattern::Facets>(&normal.pattern.kind);
    r.amount = static_cast<float>(!facets ? normal.amount : facets->size > 0 ? 1 : facets->coords);
    r.accuracy = static_cast<float>(normal.accuracy);
    const Transform map = whole_map(space_of(normal.pattern, outer)).inverse();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        r.linear[row * 3 + column] = static_cast<float>(map.rows[column][row]);
    traits.by_surface = pattern.traits.by_surface;
  }
  traits.disturbed = traits.textured = true;
  make_room(normals, 1, "normals");
  normals.push_back(r);
  return {static_cast<std::uint32_t>(normals.size() - 1), traits};
}

/// Turns a list with a wave, used as a normal, into a slope map over the list's indices, which are scaled by
/// a power of two.
void TextureTables::set_list_heights(PatternRecord& r, const Pattern& pattern) {
  constexpr double kShare = 0.125;
  static_assert(kShare * kMostListEntries <= 1);
  std::vector<SlopePoint> heights;
  for (std::size_t i = 0; i < kMostListEntries; ++i)
    heights.push_back({static_cast<double>(i) * kShare, in_wave(pattern, i), 0});
  r.entries = add_slopes(heights);
  r.entry_count = static_cast<std::uint32_t>(heights.size());
  r.kind_and_flags &= ~(pattern_flag::wave_mask << pattern_flag::wave_shift);
  static_assert(static_cast<std::uint32_t>(PatternWave::ramp) == 0);
  r.frequency = static_cast<float>(kShare);
  r.phase = 0;
}

std::uint32_t TextureTables::add_slopes(const std::vector<SlopePoint>& points) {
  make_room(entries, points.size(), "entries of maps");
  const auto first = static_cast<std::uint32_t>(entries.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    MapEntryRecord entry{};
    entry.position = static_cast<float>(points[i].position);
    entry.inverse_width = i == 0 ? 0 : inverse_width(points[i - 1].position, points[i].position);
    entry.rgb[0] = static_cast<float>(points[i].height);
    entry.rgb[1] = static_cast<float>(points[i].slope);
    entry.child = kNoOffset;
    entries.push_back(entry);
  }
  children_.resize(entries.size(), Child::none);
  return first;
}

void TextureTables::add_rainbow(const Rainbow& rainbow) {
  const std::vector<Rainbow::Colour>& colours = rainbow.colours;
  make_room(entries, colours.size(), "entries of maps");
  RainbowRecord r = make_record(rainbow);
  r.entries = static_cast<std::uint32_t>(entries.size());
  r.entry_count = static_cast<std::uint32_t>(colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    MapEntryRecord entry{};
    entry.position = static_cast<float>(colours[i].position);
    entry.inverse_width = i == 0 ? 0 : inverse_width(colours[i - 1].position, colours[i].position);
    copy(colours[i].rgb, entry.rgb);
    entry.filter = static_cast<float>(colours[i].filter);
    entry.transmit = static_cast<float>(colours[i].transmit);
    entry.child = kNoOffset;
    entries.push_back(entry);
  }
  children_.resize(entries.size(), Child::none);
  rainbows.push_back(r);
}

/// Adds a pigment as a pattern with a map, even if it has a single colour. Returns the pattern's index and
/// traits.
TextureTables::Known TextureTables::add_pigment(const Pigment& pigment, const PatternSpace& outer) {
  if (pigment.map) return add_map(pigment.map, outer, Place::inside);
  auto map = std::make_shared<PatternMap<Pigment>>();
  map->is_average = true;
  map->entries = {{1, pigment}};
  made_.push_back(map);
  return add_map<Pigment>(map, outer, Place::inside);
}

} // namespace celltrace

// Maps and lists of patterns, for pigments, normals and textures.
#include "pov/actions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>

namespace celltrace::pov {

namespace {

/// Adds an entry to its map; part of adding any kind of entry.
template <class T>
void add(Session& session, MapDefinition<T>& map, double position, const T& value, int depth, bool is_opaque,
         const UnsupportedPtr& unsupported, const Location& where) {
  if (map.entries.size() >= static_cast<std::size_t>(kMostMapEntries))
    session.fail(where, "a map has at most " + std::to_string(kMostMapEntries) + " entries");
  map.entries.push_back({position, value});
  map.depth = std::max(map.depth, depth + 1);
  if (map.depth > kDeepestMap)
    session.fail(where, "maps are nested more than " + std::to_string(kDeepestMap) + " deep");
  map.is_opaque = map.is_opaque && is_opaque;
  mark(map.unsupported, unsupported);
}

/// Sets `entry` to the mean of two entries if that is simple; otherwise leaves it unchanged.
template <class Entry> void set_between(Entry&, const Entry&, const Entry&, double) {
}
void set_between(PatternMap<Pigment>::Entry& entry, const PatternMap<Pigment>::Entry& below,
                 const PatternMap<Pigment>::Entry& above, double share) {
  const Pigment &a = below.value, &b = above.value;
  if (a.map || b.map) return;
  entry.value = {glm::mix(a.rgb, b.rgb, share), std::lerp(a.filter, b.filter, share),
                 std::lerp(a.transmit, b.transmit, share)};
}

/// Makes positions ascend, as a Scene's maps need. For each value POV-Ray first looks whether it has passed
/// the last entry; if not, POV-Ray looks for the first entry that the value has not passed, and takes the
/// entry before that one as written, even if its position is greater than the values that reach it.
template <class Entries> void make_ascending(Entries& entries) {
  const double last = entries.back().position;
  auto before = entries.front(); // as written
  double reached = std::min(before.position, last);
  entries.front().position = reached;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const auto written = entries[i];
    if (written.position > reached && reached < last) {
      const double width = written.position - before.position;
      if (before.position < reached)
        set_between(entries[i - 1], before, written, (reached - before.position) / width);
      if (written.position > last) set_between(entries[i], before, written, (last - before.position) / width);
    }
    reached = std::max(reached, std::min(written.position, last));
    entries[i].position = reached;
    before = written;
  }
}
template <class T> std::shared_ptr<const MapDefinition<T>> ascending(MapDefinition<T> map) {
  make_ascending(map.entries);
  return std::make_shared<const MapDefinition<T>>(std::move(map));
}

/// Returns the sum of the weights of an average's entries.
template <class T> double total_weight(const MapDefinition<T>& map) {
  return std::accumulate(map.entries.begin(), map.entries.end(), 0.0,
                         [](double sum, const auto& entry) { return sum + entry.position; });
}

/// Returns the map in the form that `pattern` needs.
template <class T>
std::shared_ptr<const MapDefinition<T>> map_for(Session& session, const PatternDefinition& pattern,
                                                const MapDefinition<T>& map, const Location& where) {
  if (!pattern.exists() && pattern.unsupported) return nullptr;
  if (!pattern.exists()) session.fail(where, "a map needs a pattern in front of it");
  if (pattern.list_length() > 0) session.fail(where, "this pattern takes a list, not a map");
  if (!pattern.is_average()) return ascending(map);
  return std::make_shared<const MapDefinition<T>>(map);
}

/// Returns a list of the colours that a map has at the indices of the list's entries.
PigmentMap list_of(const PigmentMap& map, std::size_t length) {
  auto entries = map.entries;
  make_ascending(entries);
  PigmentMap list = map;
  list.entries.clear();
  for (std::size_t i = 0; i < length; ++i) {
    const auto number = static_cast<double>(i);
    const auto above = std::find_if(entries.begin(), entries.end(),
                                    [number](const auto& entry) { return entry.position > number; });
    auto entry = above == entries.begin() ? entries.front() : *(above - 1);
    if (above != entries.begin() && above != entries.end())
      set_between(entry, *(above - 1), *above,
                  (number - entry.position) / (above->position - entry.position));
    list.entries.push_back(entry);
  }
  return list;
}

/// Returns a list whose entries have their indices as positions.
template <class T>
std::shared_ptr<const MapDefinition<T>> list_for(Session& session, const PatternDefinition& pattern,
                                                 MapDefinition<T> list, const Location& where) {
  if (list.entries.size() > pattern.list_length())
    session.fail(where, "this pattern takes a list of " + std::to_string(pattern.list_length()) +
                            ", but it has " + std::to_string(list.entries.size()) + " entries");
  for (std::size_t i = 0; i < list.entries.size(); ++i)
    list.entries[i].position = static_cast<double>(i);
  return std::make_shared<const MapDefinition<T>>(std::move(list));
}

} // namespace

void add(Session& session, PigmentMap& map, double position, const PigmentDefinition& pigment,
         const Location& where) {
  add(session, map, position, pigment.finish(), pigment.depth(), pigment.is_opaque(),
      pigment.first_unsupported(), where);
  map.depends_on_surface = map.depends_on_surface || pigment.depends_on_surface();
}

void add(Session& session, NormalMap& map, double position, const NormalDefinition& normal,
         const Location& where) {
  add(session, map, position, normal.finish(), normal.depth(), true, normal.first_unsupported(), where);
  map.depends_on_surface = map.depends_on_surface || normal.depends_on_surface();
}

void add(Session& session, TextureMap& map, double position, const TexturePtr& texture,
         const Location& where) {
  add(session, map, position, texture, texture->depth(), texture->is_opaque(), texture->first_unsupported(),
      where);
  map.depends_on_surface = map.depends_on_surface || texture->depends_on_surface();
}

void add(Session& session, PigmentMap& map, double position, const Pigment& colour, const Location& where) {
  PigmentDefinition pigment;
  pigment.value = colour;
  add(session, map, position, pigment, where);
}

void add_colour(Session& session, PigmentMap& map, double position, const Quantity& colour,
                const Location& where) {
  if (colour.is_float()) session.fail(where, "expected a colour, found a float");
  add(session, map, position, session.colour(colour, where), where);
}

void add(Session& session, PigmentMap& map, const PigmentMap& entries, const Location& where) {
  for (const auto& [position, pigment] : entries.entries)
    add(session, map, position, pigment, entries.depth - 1, entries.is_opaque, entries.unsupported, where);
  map.depends_on_surface = map.depends_on_surface || entries.depends_on_surface;
}

void add(Session& session, std::vector<SlopePoint>& map, double position, const Vec3& height_and_slope,
         const Location& where) {
  if (map.size() >= static_cast<std::size_t>(kMostMapEntries))
    session.fail(where, "a map has at most " + std::to_string(kMostMapEntries) + " entries");
  map.push_back({position, height_and_slope.x, height_and_slope.y});
}

std::vector<SlopePoint> ascending(std::vector<SlopePoint> map) {
  make_ascending(map);
  return map;
}

void set_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where) {
  if (pigment.pattern.is_average() && total_weight(map) == 0) {
    session.diagnostics.warn_once(where, "an average whose weights add up to 0 is black");
    return set_colour(pigment, {});
  }
  if (!pigment.pattern.exists() && !pigment.pattern.unsupported && pigment.value == Pigment()) {
    session.diagnostics.warn_once(where, "a map without a pattern in front of it leaves this pigment black");
    return;
  }
  pigment.map = map_for(session, pigment.pattern, map, where);
  if (!pigment.map) pigment.value = map.entries.front().value; // the pattern is unsupported and left out
}

void set_old_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where) {
  if (pigment.pattern.list_length() > 0)
    pigment.map = list_for(session, pigment.pattern, list_of(map, pigment.pattern.list_length()), where);
  else if (pigment.pattern.exists())
    set_map(session, pigment, map, where);
  else
    pigment.map = ascending(map);
}

void set_map(Session& session, NormalDefinition& normal, const NormalMap& map, const Location& where) {
  if (normal.pattern.is_average() && total_weight(map) == 0) {
    session.diagnostics.warn_once(where, "an average of normals whose weights add up to 0 is black");
    normal.pattern = {};
    normal.is_undefined = true;
    return;
  }
  normal.map = map_for(session, normal.pattern, map, where);
}

TexturePtr with_map(Session& session, const TexturePtr& texture, const TextureMap& map,
                    const Location& where) {
  auto changed = std::make_shared<TextureDefinition>(*texture);
  if (texture->pattern.is_average() && total_weight(map) == 0) {
    session.diagnostics.warn_once(where, "an average of textures whose weights add up to 0 is black");
    return std::make_shared<const TextureDefinition>();
  }
  changed->map = map_for(session, texture->pattern, map, where);
  if (!changed->map) { // the pattern is unsupported and left out
    *changed = *map.entries.front().value;
    mark(changed->unsupported, texture->pattern.unsupported);
  }
  return changed;
}

void set_colours(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
                 const Location& where) {
  choose(pigment.pattern, pattern);
  const auto colours = pigment.pattern.default_colours();
  for (std::size_t i = list.entries.size(); i < colours.size(); ++i)
    list.entries.push_back(colours[i]);
  pigment.map = list_for(session, pigment.pattern, std::move(list), where);
}

void set_list(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
              const Location& where) {
  choose(pigment.pattern, pattern);
  while (list.entries.size() < pigment.pattern.list_length())
    add(session, list, 0, session.builder.default_texture->pigment, where);
  pigment.map = list_for(session, pigment.pattern, std::move(list), where);
}

void set_list(Session& session, NormalDefinition& normal, int pattern, NormalMap list,
              const Location& where) {
  choose(normal.pattern, pattern);
  while (list.entries.size() < normal.pattern.list_length())
    add(session, list, 0, NormalDefinition(), where);
  normal.map = list_for(session, normal.pattern, std::move(list), where);
}

void set_colours(Session& session, PigmentDefinition& pigment, const Limit& object, PigmentMap list,
                 const Location& where) {
  const pattern::Inside inside = inside_of(session, object, where);
  set_colours(session, pigment, number_of(inside), std::move(list), where);
  choose(pigment.pattern, inside);
}

void set_list(Session& session, PigmentDefinition& pigment, const Limit& object, PigmentMap list,
              const Location& where) {
  const pattern::Inside inside = inside_of(session, object, where);
  set_list(session, pigment, number_of(inside), std::move(list), where);
  choose(pigment.pattern, inside);
}

void set_list(Session& session, NormalDefinition& normal, const Limit& object, NormalMap list,
              const Location& where) {
  const pattern::Inside inside = inside_of(session, object, where);
  set_list(session, normal, number_of(inside), std::move(list), where);
  choose(normal.pattern, inside);
}

TexturePtr with_pattern(Session& session, const TexturePtr& texture, const PatternChange& pattern) {
  auto changed = std::make_shared<TextureDefinition>(*texture);
  pattern(session, changed->pattern);
  return changed;
}

TexturePtr with_list(Session& session, const TexturePtr& texture, int pattern, TextureMap list,
                     const Location& where) {
  auto changed = std::make_shared<TextureDefinition>(*texture);
  choose(changed->pattern, pattern);
  while (list.entries.size() < changed->pattern.list_length())
    add(session, list, 0, session.builder.default_texture, where);
  changed->map = list_for(session, changed->pattern, std::move(list), where);
  return changed;
}

TexturePtr with_tiles(Session& session, const TexturePtr& texture, const TexturePtr& first,
                      const TexturePtr& second, const Location& where) {
  TextureMap list;
  add(session, list, 0, second, where);
  add(session, list, 0, first, where);
  return with_list(session, texture, number_of(pattern::Checker()), std::move(list), where);
}

TexturePtr with_object(Session& session, const TexturePtr& texture, const Limit& object, TextureMap list,
                       const Location& where) {
  const pattern::Inside inside = inside_of(session, object, where);
  const TexturePtr listed = with_list(session, texture, number_of(inside), std::move(list), where);
  return with_pattern(session, listed,
                      [&](Session&, PatternDefinition& pattern) { choose(pattern, inside); });
}

namespace {

void refuse_in_colours(Session& session, const PatternDefinition& pattern, const Location& where) {
  if (pattern.is_for_normals_alone()) session.fail(where, "'facets' is a pattern of normals alone");
}

} // namespace

void check(Session& session, const PigmentDefinition& pigment, const Location& where) {
  refuse_in_colours(session, pigment.pattern, where);
  if (pigment.pattern.is_average() && !pigment.map && !pigment.pattern.unsupported)
    session.fail(where, "an average needs a map");
}

void check(Session& session, NormalDefinition& normal, const Location& where) {
  if (normal.pattern.is_average() && !normal.map && !normal.first_unsupported())
    session.fail(where, "an average needs a map");
  if (normal.accuracy > 0) return;
  normal.accuracy = NormalDefinition().accuracy;
  if (!normal.pattern.exists() || normal.map || has_own_slopes(normal.pattern)) return;
  session.diagnostics.warn_once(where, "a normal whose 'accuracy' is 0 makes its surface black");
  normal.is_undefined = true;
}

void check(Session& session, const TexturePtr& texture, const Location& where) {
  refuse_in_colours(session, texture->pattern, where);
  if (texture->pattern.exists() && !texture->map && !texture->first_unsupported())
    session.fail(where, "a pattern of textures needs a 'texture_map'");
}

} // namespace celltrace::pov

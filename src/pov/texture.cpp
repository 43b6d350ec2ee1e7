#include "pov/texture.hpp"

#include <initializer_list>
#include <unordered_map>
#include <utility>

namespace celltrace::pov {

namespace {

/// Returns the map as a Scene has it.
template <class T>
std::shared_ptr<const PatternMap<T>> finish_map(const PatternDefinition& pattern,
                                                const std::vector<typename PatternMap<T>::Entry>& entries) {
  auto map = std::make_shared<PatternMap<T>>();
  map->pattern = pattern.value();
  map->is_average = pattern.is_average();
  map->entries = entries;
  return map;
}

UnsupportedPtr all(std::initializer_list<UnsupportedPtr> marks) {
  UnsupportedPtr result;
  for (const UnsupportedPtr& one : marks)
    mark(result, one);
  return result;
}

std::shared_ptr<TextureDefinition> copy(const TexturePtr& texture) {
  return std::make_shared<TextureDefinition>(*texture);
}

/// Makes pigments transmit what they filter. A map that several of them share is changed once.
class FilterAsTransmit {
public:
  /// Changes a pigment; returns whether anything has changed.
  bool apply(PigmentDefinition& pigment) {
    if (!pigment.pattern.exists()) return apply(pigment.value);
    if (!pigment.map) return false;
    auto map = std::make_shared<PigmentMap>(*pigment.map);
    if (!apply_all(map->entries)) return false;
    pigment.map = std::move(map);
    return true;
  }

private:
  using Map = std::shared_ptr<const PatternMap<Pigment>>;

  bool apply(Pigment& pigment) {
    if (pigment.map) {
      const Map changed = of(pigment.map);
      return std::exchange(pigment.map, changed) != changed;
    }
    pigment.transmit += pigment.filter;
    return std::exchange(pigment.filter, 0) != 0;
  }

  bool apply_all(std::vector<PatternMap<Pigment>::Entry>& entries) {
    bool has_changed = false;
    for (auto& entry : entries)
      has_changed |= apply(entry.value);
    return has_changed;
  }

  Map of(const Map& map) {
    Map& known = known_[map.get()];
    if (known) return known;
    auto changed = std::make_shared<PatternMap<Pigment>>(*map);
    return known = apply_all(changed->entries) ? std::move(changed) : map;
  }

  std::unordered_map<const PatternMap<Pigment>*, Map> known_;
};

} // namespace

UnsupportedPtr PigmentDefinition::first_unsupported() const {
  return all({pattern.unsupported, unsupported, map ? map->unsupported : nullptr});
}

bool NormalDefinition::depends_on_surface() const {
  return pov::depends_on_surface(pattern) || (pattern.exists() && map && map->depends_on_surface);
}

bool TextureDefinition::depends_on_surface() const {
  for (const TextureDefinition* layer = this; layer; layer = layer->below.get())
    if (layer->is_on_surface || pov::depends_on_surface(layer->pattern) ||
        layer->pigment.depends_on_surface() || (layer->normal && layer->normal->depends_on_surface()) ||
        (layer->map && layer->map->depends_on_surface))
      return true;
  return false;
}

bool PigmentDefinition::depends_on_surface() const {
  return pov::depends_on_surface(pattern) || (pattern.exists() && map && map->depends_on_surface);
}

bool PigmentDefinition::is_opaque() const {
  if (quick_colour) return quick_colour->filter == 0 && quick_colour->transmit == 0;
  if (pattern.exists()) return !map || map->is_opaque;
  return value.filter == 0 && value.transmit == 0;
}

Pigment PigmentDefinition::finish() const {
  if (quick_colour) return *quick_colour;
  Pigment pigment = value;
  if (pattern.exists())
    pigment.map = finish_map<Pigment>(pattern, map ? map->entries : pattern.default_colours());
  return pigment;
}

UnsupportedPtr NormalDefinition::first_unsupported() const {
  return all({pattern.unsupported, unsupported, map ? map->unsupported : nullptr});
}

Normal NormalDefinition::finish() const {
  Normal normal;
  normal.pattern = pattern.value();
  normal.amount = is_smooth() ? 0 : amount;
  normal.accuracy = accuracy;
  normal.slopes = slopes;
  if (map) normal.map = finish_map<Normal>(pattern, map->entries);
  return normal;
}

UnsupportedPtr TextureDefinition::first_unsupported() const {
  UnsupportedPtr result;
  for (const TextureDefinition* layer = this; layer; layer = layer->below.get())
    mark(result, all({layer->map ? nullptr : layer->pigment.first_unsupported(),
                      layer->map || !layer->normal ? nullptr : layer->normal->first_unsupported(),
                      layer->map ? nullptr : layer->finish->unsupported, layer->pattern.unsupported,
                      layer->unsupported, layer->map ? layer->map->unsupported : nullptr}));
  return result;
}

bool TextureDefinition::is_opaque() const {
  if (map) return map->is_opaque;
  for (const TextureDefinition* layer = this; layer; layer = layer->below.get())
    if (layer->pigment.is_opaque()) return true;
  return false;
}

bool TextureDefinition::is_constant() const {
  const auto moves = [](const PatternDefinition& own) { return own.exists() && !own.value().uv_mapping; };
  for (const TextureDefinition* layer = this; layer; layer = layer->below.get()) {
    const bool has_normal = layer->normal && !layer->normal->is_smooth();
    if (moves(layer->pattern) || (layer->normal && moves(layer->normal->pattern)) ||
        moves(layer->pigment.pattern) || (layer->is_on_surface && (layer->map || has_normal)))
      return false;
  }
  return true;
}

TexturePtr with_pigment(const TexturePtr& texture, const PigmentDefinition& pigment) {
  auto changed = copy(texture);
  changed->pigment = pigment;
  return changed;
}

TexturePtr with_normal(const TexturePtr& texture, const NormalPtr& normal) {
  auto changed = copy(texture);
  changed->normal = normal;
  return changed;
}

TexturePtr with_finish(const TexturePtr& texture, const FinishDefinition& finish) {
  auto changed = copy(texture);
  changed->finish = finish;
  return changed;
}

TexturePtr with_unsupported(const TexturePtr& texture, const UnsupportedPtr& unsupported) {
  auto changed = copy(texture);
  mark(changed->unsupported, unsupported);
  return changed;
}

TexturePtr with_uv_mapping(const TexturePtr& texture) {
  auto changed = copy(texture);
  changed->uv_mapping = true;
  return changed;
}

void finish_uv_mapping(PigmentDefinition& pigment) {
  if (pigment.uv_mapping) put_on_surface(pigment.pattern);
  pigment.uv_mapping = false;
}

void finish_uv_mapping(NormalDefinition& normal) {
  if (normal.uv_mapping) put_on_surface(normal.pattern);
  normal.uv_mapping = false;
}

TexturePtr on_surface(const TexturePtr& texture) {
  auto changed = copy(texture);
  changed->uv_mapping = false;
  changed->is_on_surface = true;
  put_on_surface(changed->pattern);
  put_on_surface(changed->pigment.pattern);
  if (changed->normal) {
    auto normal = std::make_shared<NormalDefinition>(*changed->normal);
    put_on_surface(normal->pattern);
    changed->normal = std::move(normal);
  }
  if (changed->below) changed->below = on_surface(changed->below);
  return changed;
}

TexturePtr with_finished_uv_mapping(const TexturePtr& texture) {
  return texture->uv_mapping ? on_surface(texture) : texture;
}

TexturePtr transformed(const TexturePtr& texture, const Transform& next) {
  const bool is_constant = texture->is_constant();
  // A texture that no change can affect stays the same object.
  if (next.is_identity() || (is_constant && !texture->is_plain())) return texture;
  auto changed = copy(texture);
  const auto move = [&](PatternDefinition& pattern) {
    if (texture->is_on_surface)
      pattern.own().normal_space = pattern.value().normal_space.then(next);
    else if (!pattern.value().uv_mapping)
      append(pattern.own().space, next);
  };
  if (changed->pattern.exists()) move(changed->pattern);
  if (changed->is_plain() || changed->pigment.pattern.exists()) move(changed->pigment.pattern);
  if (changed->normal) {
    auto normal = std::make_shared<NormalDefinition>(*changed->normal);
    move(normal->pattern);
    changed->normal = std::move(normal);
  }
  if (is_constant)
    changed->original.texture = original(texture);
  else if (changed->below)
    changed->below = transformed(changed->below, next);
  return changed;
}

const TexturePtr& original(const TexturePtr& texture) {
  return texture->original.texture ? texture->original.texture : texture;
}

TexturePtr layered(const TexturePtr& below, const TexturePtr& top) {
  if (!below || (top->is_opaque() && !top->first_unsupported())) return top;
  auto changed = copy(top);
  changed->below = top->below ? layered(below, top->below) : below;
  changed->layers = 1 + changed->below->layers;
  return changed;
}

TexturePtr with_filter_as_transmit(const TexturePtr& texture, bool also_lowest) {
  const TexturePtr below = texture->below ? with_filter_as_transmit(texture->below, also_lowest) : nullptr;
  PigmentDefinition pigment = texture->pigment;
  const bool has_changed = (below || also_lowest) && FilterAsTransmit().apply(pigment);
  if (!has_changed && below == texture->below) return texture;
  auto changed = copy(texture);
  changed->below = below;
  changed->pigment = std::move(pigment);
  return changed;
}

} // namespace celltrace::pov

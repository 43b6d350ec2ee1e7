#include "scene_image/light_sets.hpp"

#include "celltrace/error.hpp"
#include "records/object.hpp"

#include <algorithm>
#include <string>

namespace celltrace {

LightSets::LightSets(const Scene& scene)
    : count_(static_cast<std::uint32_t>(scene.light_groups.size()) + 1),
      first_words_(scene.lights.size(), kNoIndex) {
  if (count_ == 1 && std::all_of(scene.lights.begin(), scene.lights.end(),
                                 [](const Light& light) { return light.is_global; }))
    return;
  constexpr std::uint32_t kBits = 32;
  const std::uint32_t per_light = (count_ + kBits - 1) / kBits;
  std::vector<std::uint32_t> words(scene.lights.size() * per_light);
  const auto add = [&](std::size_t light, std::uint32_t set) {
    words[light * per_light + set / kBits] |= 1u << set % kBits;
  };
  for (std::size_t light = 0; light < scene.lights.size(); ++light) {
    if (!scene.lights[light].is_global) continue;
    add(light, 0);
    for (std::uint32_t set = 1; set < count_; ++set)
      if (scene.light_groups[set - 1].global_lights) add(light, set);
  }
  for (std::uint32_t set = 1; set < count_; ++set)
    for (const Index light : scene.light_groups[set - 1].lights)
      add(light, set);
  for (std::size_t light = 0; light < scene.lights.size(); ++light) {
    const auto own = words.begin() + static_cast<std::ptrdiff_t>(light * per_light);
    std::uint32_t sets = 0;
    for (std::uint32_t set = 0; set < count_; ++set)
      sets += own[set / kBits] >> set % kBits & 1;
    if (sets == count_) continue;
    first_words_[light] = static_cast<Index>(words_.size());
    words_.insert(words_.end(), own, own + per_light);
  }
}

void validate_light_groups(const Scene& scene) {
  static_assert(kMostLightGroups < kernel::kMaxLightSets);
  if (scene.light_groups.size() > kMostLightGroups)
    throw InputError("the scene has more than " + std::to_string(kMostLightGroups) + " light groups");
  for (std::size_t i = 0; i < scene.light_groups.size(); ++i)
    for (const Index light : scene.light_groups[i].lights)
      if (light >= scene.lights.size())
        throw InputError("light group " + std::to_string(i) + ": index " + std::to_string(light) +
                         " is out of range, there are " + std::to_string(scene.lights.size()));
}

} // namespace celltrace

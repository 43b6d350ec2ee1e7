// Decides whether textures that many objects have at different places should share their maps, and which maps
// can be shared.
#pragma once

#include "celltrace/texture.hpp"

#include <map>
#include <vector>

namespace celltrace {

/// Decides for the textures of a scene, which must outlive this object.
class TextureSharing {
public:
  explicit TextureSharing(const std::vector<Material>& materials);

  /// Returns whether maps should be shared: there would be too many entries if each texture had its own maps.
  bool is_needed() const { return is_needed_; }

  /// Returns whether a map has nested maps that can be evaluated at points of its own space.
  bool may_be_relative(const PatternMap<Pigment>& map) const;
  /// Returns whether the textures in a map can be evaluated at points of the map's own space: they have no
  /// patterns and normals, which are always evaluated at points of the scene.
  bool may_be_relative(const PatternMap<Material>& map);
  static bool may_be_relative(const PatternMap<Normal>&) { return false; }

private:
  bool is_same_everywhere(const Material& material);

  bool is_needed_ = false;
  std::map<const PatternMap<Material>*, bool> same_everywhere_;
};

} // namespace celltrace

// Decides for textures that many objects have, each at another place, whether their maps are worth sharing,
// and which maps can be shared.
#pragma once

#include "celltrace/texture.hpp"

#include <map>
#include <vector>

namespace celltrace {

/// Decides about the textures of a scene, which must outlive this object.
class TextureSharing {
public:
  explicit TextureSharing(const std::vector<Material>& materials);

  /// Returns whether the maps would have too many entries if each texture had its own.
  bool is_needed() const { return is_needed_; }

  /// Returns whether a map has nested maps that can be evaluated at points of its own space.
  bool may_be_relative(const PatternMap<Pigment>& map) const;
  /// Returns the same for a map of textures; the patterns and normals in a texture are always evaluated at
  /// points of the scene.
  bool may_be_relative(const PatternMap<Material>& map);
  static bool may_be_relative(const PatternMap<Normal>&) { return false; }

private:
  bool is_same_everywhere(const Material& material);

  bool is_needed_ = false;
  std::map<const PatternMap<Material>*, bool> same_everywhere_;
};

} // namespace celltrace

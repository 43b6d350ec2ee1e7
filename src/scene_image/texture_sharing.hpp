// Textures that many objects have, each at another place: whether what is in their maps is worth sharing, and
// where it may be.
#pragma once

#include "celltrace/texture.hpp"

#include <map>
#include <vector>

namespace celltrace {

/// Looks at the textures of a scene, which stay as long as this lives.
class TextureSharing {
public:
  explicit TextureSharing(const std::vector<Material>& materials);

  /// Whether the maps would have too many entries if each of them had its own.
  bool is_needed() const { return is_needed_; }

  /// Whether a map has others in it that may be asked at points of its own space.
  bool may_be_relative(const PatternMap<Pigment>& map) const;
  /// Patterns and normals in a texture are asked at points of the scene in any case.
  bool may_be_relative(const PatternMap<Material>& map);
  static bool may_be_relative(const PatternMap<Normal>&) { return false; }

private:
  bool is_same_everywhere(const Material& material);

  bool is_needed_ = false;
  std::map<const PatternMap<Material>*, bool> same_everywhere_;
};

} // namespace celltrace

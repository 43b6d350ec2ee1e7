// Evaluates pigments and patterns at single points in double precision, for functions of the language that
// need them while a scene is read. The code of the patterns is the kernel's.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>

namespace celltrace {

/// A pigment, or a pattern, as a function of points. Not safe for use by several threads at once.
class PointTexture {
public:
  /// Prepares the pigment. `noise_generator`, 1 to 3, is for patterns that name none. Ripples and waves have
  /// 10 waves. No pattern may depend on surface coordinates or on a surface's normal. Throws InputError if a
  /// number in the pigment is invalid.
  PointTexture(const Pigment& pigment, int noise_generator);
  PointTexture(PointTexture&&) noexcept;
  PointTexture& operator=(PointTexture&&) noexcept;
  ~PointTexture();

  /// Returns the colour at a point, without a map.
  Pigment pigment_at(const Vec3& point) const;
  /// Returns the value of the outermost pattern after its wave or, if this pattern is a list, the index of
  /// the chosen entry. The pigment must have a pattern.
  double pattern_at(const Vec3& point) const;

  /// Returns the size of the prepared pigment in bytes.
  std::size_t bytes() const;

private:
  struct Image;
  std::unique_ptr<Image> image_;
};

} // namespace celltrace

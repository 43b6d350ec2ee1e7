// Pigments and patterns at single points, in double precision: what the language computes with them while a
// scene is read. The patterns' code is the kernel's.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>

namespace celltrace {

/// A pigment, or a pattern, as a function of points. Not for several threads at once.
class PointTexture {
public:
  /// `noise_generator`: of patterns that name none, 1 to 3. Ripples and waves have 10 waves. No pattern may
  /// be on surface coordinates or ask for a surface's normal. Throws InputError if some number in the pigment
  /// means nothing.
  PointTexture(const Pigment& pigment, int noise_generator);
  PointTexture(PointTexture&&) noexcept;
  PointTexture& operator=(PointTexture&&) noexcept;
  ~PointTexture();

  /// The colour at a point, without a map.
  Pigment pigment_at(const Vec3& point) const;
  /// The number of the outermost pattern, in its wave; of lists, the entry's. There must be one.
  double pattern_at(const Vec3& point) const;

  /// What it holds in memory.
  std::size_t bytes() const;

private:
  struct Image;
  std::unique_ptr<Image> image_;
};

} // namespace celltrace

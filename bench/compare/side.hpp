// A ray tracer that is measured: it renders pictures of a model, again and again.
#pragma once

#include "celltrace/image.hpp"
#include "model.hpp"
#include "stopwatch.hpp"

#include <cstdint>

namespace celltrace::compare {

/// A frame that was rendered: one primary ray a pixel, a shadow ray where the hit surface faces the light.
struct Frame {
  Seconds build; ///< of the accelerator, with all that this needs
  Seconds trace;
  std::uint64_t primary_rays = 0;
  std::uint64_t shadow_rays = 0;

  std::uint64_t rays() const { return primary_rays + shadow_rays; }
};

class Side {
public:
  virtual ~Side() = default;
  /// Lays out the model to render in the form that the ray tracer takes, which is not part of what is
  /// measured.
  virtual void take(const Model& model) = 0;
  /// Builds the accelerator of the model taken last and renders a frame.
  virtual Frame build_and_trace() = 0;
  /// Renders the frame again, with the accelerator there is.
  virtual Frame trace() = 0;
  /// Of the last frame.
  virtual const Image& picture() const = 0;
  /// What the accelerator takes, in bytes, the primitives as they were given not counted.
  virtual std::uint64_t accelerator_bytes() const = 0;
};

/// Pixels that show the model and not the background.
std::uint64_t covered_pixels(const Image& picture);

} // namespace celltrace::compare

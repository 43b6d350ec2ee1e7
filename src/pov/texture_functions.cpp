// Pigments and patterns as functions of points.
#include <optional>
#include <utility>

#include "celltrace/error.hpp"
#include "pov/memory.hpp"
#include "pov/texture.hpp"
#include "pov/user_function.hpp"
#include "scene_image/point_texture.hpp"

namespace celltrace::pov {

namespace {

/// A texture that is prepared for evaluation at its first call, and again if the scene's noise generator has
/// changed.
class TextureFunction : public NativeFunction {
public:
  TextureFunction(Pigment pigment, std::size_t results)
      : NativeFunction(3, results), pigment_(std::move(pigment)) {}

protected:
  const PointTexture& texture(const FunctionContext& context) const {
    if (texture_ && context == context_) return *texture_;
    try {
      PointTexture texture(pigment_, context.noise_generator);
      if (!texture_) memory_.take(texture.bytes());
      texture_.emplace(std::move(texture));
      context_ = context;
      return *texture_;
    } catch (const InputError& error) {
      throw FunctionFault{error.what()};
    }
  }

private:
  Pigment pigment_;
  mutable FunctionContext context_;
  mutable std::optional<PointTexture> texture_;
  mutable MemoryShare memory_;
};

class PigmentFunction final : public TextureFunction {
public:
  explicit PigmentFunction(Pigment pigment) : TextureFunction(std::move(pigment), 5) {}
  void evaluate(const double* point, const FunctionContext& context, double* results) const override {
    const Pigment colour = texture(context).pigment_at({point[0], point[1], point[2]});
    for (int i = 0; i < 3; ++i)
      results[i] = colour.rgb[i];
    results[3] = colour.filter;
    results[4] = colour.transmit;
  }
};

class PatternFunction final : public TextureFunction {
public:
  explicit PatternFunction(Pigment pigment) : TextureFunction(std::move(pigment), 1) {}
  void evaluate(const double* point, const FunctionContext& context, double* results) const override {
    *results = texture(context).pattern_at({point[0], point[1], point[2]});
  }
};

} // namespace

std::shared_ptr<const NativeFunction> pigment_function(const PigmentDefinition& pigment) {
  if (const UnsupportedPtr unsupported = pigment.first_unsupported())
    return unsupported_function(unsupported->what, 3, 5);
  if (pigment.depends_on_surface())
    return unsupported_function("a pigment of surface coordinates or slopes as a function", 3, 5);
  return std::make_shared<PigmentFunction>(pigment.finish());
}

std::shared_ptr<const NativeFunction> pattern_function(const PigmentDefinition& pigment) {
  if (pigment.pattern.unsupported) return unsupported_function(pigment.pattern.unsupported->what, 3, 1);
  if (pigment.unsupported) return unsupported_function(pigment.unsupported->what, 3, 1);
  if (depends_on_surface(pigment.pattern))
    return unsupported_function("a pattern of surface coordinates or slopes as a function", 3, 1);
  return std::make_shared<PatternFunction>(pigment.finish());
}

} // namespace celltrace::pov

#include "scene_image/patterns.hpp"

#include "celltrace/error.hpp"
#include "kernel/textures/list.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

using Parameters = float (&)[5];

// One overload of put() for each kind of pattern: returns the kind's number in the kernel, and sets the
// parameters.

std::uint32_t put(const pattern::Checker&, Parameters) {
  return kPatternKind<CheckerPattern>;
}
std::uint32_t put(const pattern::Gradient& gradient, Parameters parameter) {
  const double length = glm::length(gradient.direction);
  if (!(length > 0)) throw InputError("a gradient has no direction");
  for (int i = 0; i < 3; ++i)
    parameter[i] = static_cast<float>(gradient.direction[i] / length);
  return kPatternKind<GradientPattern>;
}
std::uint32_t put(const pattern::Bozo&, Parameters) {
  return kPatternKind<BozoPattern>;
}
std::uint32_t put(const pattern::Bumps&, Parameters) {
  return kPatternKind<BumpsPattern>;
}

std::uint32_t put(const pattern::Boxed&, Parameters) {
  return kPatternKind<BoxedPattern>;
}
std::uint32_t put(const pattern::Spherical&, Parameters) {
  return kPatternKind<SphericalPattern>;
}
std::uint32_t put(const pattern::Cylindrical&, Parameters) {
  return kPatternKind<CylindricalPattern>;
}
std::uint32_t put(const pattern::Planar&, Parameters) {
  return kPatternKind<PlanarPattern>;
}
std::uint32_t put(const pattern::Onion&, Parameters) {
  return kPatternKind<OnionPattern>;
}
std::uint32_t put(const pattern::Leopard&, Parameters) {
  return kPatternKind<LeopardPattern>;
}
std::uint32_t put(const pattern::Radial&, Parameters) {
  return kPatternKind<RadialPattern>;
}
std::uint32_t put(const pattern::Square&, Parameters) {
  return kPatternKind<SquarePattern>;
}
std::uint32_t put(const pattern::Triangular&, Parameters) {
  return kPatternKind<TriangularPattern>;
}
std::uint32_t put(const pattern::Hexagon&, Parameters) {
  return kPatternKind<HexagonPattern>;
}
std::uint32_t put(const pattern::Cubic&, Parameters) {
  return kPatternKind<CubicPattern>;
}
std::uint32_t put(const pattern::Dents&, Parameters) {
  return kPatternKind<DentsPattern>;
}
std::uint32_t put(const pattern::Granite&, Parameters) {
  return kPatternKind<GranitePattern>;
}
std::uint32_t put(const pattern::Wrinkles&, Parameters) {
  return kPatternKind<WrinklesPattern>;
}
std::uint32_t put(const pattern::Marble&, Parameters) {
  return kPatternKind<MarblePattern>;
}
std::uint32_t put(const pattern::Wood&, Parameters) {
  return kPatternKind<WoodPattern>;
}
std::uint32_t put(const pattern::Spiral& spiral, Parameters parameter) {
  parameter[0] = static_cast<float>(spiral.arms);
  return spiral.is_crossed ? kPatternKind<Spiral2Pattern> : kPatternKind<Spiral1Pattern>;
}
std::uint32_t put(const pattern::Quilted& quilted, Parameters parameter) {
  for (int i = 0; i < 2; ++i)
    parameter[i] = static_cast<float>(quilted.control[i]);
  return kPatternKind<QuiltedPattern>;
}
std::uint32_t put(const pattern::Brick& brick, Parameters parameter) {
  for (int i = 0; i < 3; ++i) {
    if (brick.size[i] == 0) throw InputError("a brick has no size");
    parameter[i] = static_cast<float>(1 / brick.size[i]);
  }
  parameter[3] = static_cast<float>(brick.mortar);
  return kPatternKind<BrickPattern>;
}
std::uint32_t put(const pattern::Agate& agate, Parameters parameter) {
  parameter[0] = static_cast<float>(agate.turbulence);
  return kPatternKind<AgatePattern>;
}

std::uint32_t put(const pattern::Cells&, Parameters) {
  return kPatternKind<CellsPattern>;
}
/// Solid crackle reads noise at the nearest points: it has bozo's kind, for which the noise generator counts.
std::uint32_t put(const pattern::Crackle& crackle, Parameters parameter) {
  if (!(crackle.metric > 0)) throw InputError("a crackle's metric is not greater than 0");
  for (int i = 0; i < 3; ++i)
    parameter[i] = static_cast<float>(crackle.form[i]);
  parameter[3] = static_cast<float>(crackle.metric);
  const double offset = std::abs(crackle.offset);
  parameter[4] = static_cast<float>(crackle.metric == 2   ? offset * offset
                                    : crackle.metric == 1 ? crackle.offset
                                                          : std::pow(offset, crackle.metric));
  return crackle.is_solid ? kPatternKind<BozoPattern> | pattern_flag::at_features
                          : kPatternKind<CracklePattern>;
}
std::uint32_t put(const pattern::Facets& facets, Parameters parameter) {
  if (facets.size != 0 && facets.coords != 0) throw InputError("facets have both 'coords' and 'size'");
  if (!(facets.metric > 0)) throw InputError("the metric of facets is not greater than 0");
  if (facets.size > 0) parameter[0] = static_cast<float>(1 / facets.size);
  parameter[3] = static_cast<float>(facets.metric);
  return kPatternKind<BumpsPattern> | pattern_flag::at_features;
}
std::uint32_t put(const pattern::Fractal& fractal, Parameters parameter) {
  constexpr int kMostIterations = 65535, kMostType = 8;
  if (fractal.iterations < 0 || fractal.iterations > kMostIterations)
    throw InputError("a fractal's iterations are not 0 to " + std::to_string(kMostIterations));
  if (fractal.exponent < 2 || fractal.exponent > 33 || fractal.magnet < 0 || fractal.magnet > 2 ||
      fractal.exterior < 0 || fractal.exterior > kMostType || fractal.interior < 0 ||
      fractal.interior > kMostType)
    throw InputError("a fractal is of no kind that there is");
  parameter[0] = static_cast<float>(fractal.c[0]);
  parameter[1] = static_cast<float>(fractal.c[1]);
  parameter[2] = static_cast<float>(fractal.iterations);
  parameter[3] = static_cast<float>(fractal.exterior_factor);
  parameter[4] = static_cast<float>(fractal.interior_factor);
  return kPatternKind<FractalPattern>;
}
std::uint32_t put(const pattern::Ripples&, Parameters) {
  return kPatternKind<RipplesPattern>;
}
std::uint32_t put(const pattern::Waves&, Parameters) {
  return kPatternKind<WavesPattern>;
}

std::uint32_t put(const pattern::Slope& slope, Parameters) {
  if (slope.direction == Vec3(0) && slope.altitude == Vec3(0))
    throw InputError("a slope has neither direction nor altitude");
  if (slope.least == slope.most || slope.lowest == slope.highest)
    throw InputError("a slope has a range of no width");
  return kPatternKind<SlopePattern>;
}

std::uint32_t put(const pattern::Grey& grey, Parameters) {
  if (!grey.of) throw InputError("a pattern of a pigment has none");
  return kPatternKind<PigmentPattern>;
}
std::uint32_t put(const pattern::Inside& inside, Parameters) {
  if (!inside.of) throw InputError("a pattern of an object has none");
  return kPatternKind<ObjectPattern>;
}

std::uint32_t put(const pattern::ImageMap& image, Parameters) {
  if (!image.map.picture) throw InputError("an image_map has no picture");
  return kPatternKind<ImageMapPattern>;
}
std::uint32_t put(const pattern::ImageGrey& image, Parameters) {
  if (!image.map.picture) throw InputError("an image_pattern has no picture");
  return kPatternKind<ImagePattern>;
}

std::uint32_t put(const pattern::Function& function, Parameters) {
  if (!function.code) throw InputError("a pattern of a function has none");
  return kPatternKind<FunctionPattern>;
}

PictureRecord record_of(const pattern::PictureMap& map, bool reads_transmit) {
  const Picture& picture = *map.picture;
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (picture.width < 1 || picture.height < 1 || picture.width > 65535 || picture.height > 65535 ||
      picture.texels.size() != pixels)
    throw InputError("a picture of a pattern has not as many pixels as its size says");
  PictureRecord r{};
  r.width = static_cast<std::uint32_t>(picture.width);
  r.height = static_cast<std::uint32_t>(picture.height);
  r.tile_columns = (r.width + TexelTileRecord::kSide - 1) / TexelTileRecord::kSide;
  r.mapping = static_cast<std::uint32_t>(map.mapping);
  r.interpolation = static_cast<std::uint32_t>(map.interpolation);
  r.once = map.once ? 1 : 0;
  r.reads_transmit = reads_transmit ? 1 : 0;
  for (int i = 0; i < 2; ++i) {
    r.repeat[i] = static_cast<float>(map.repeat[i]);
    r.offset[i] = static_cast<float>(map.offset[i]);
  }
  r.scale = static_cast<float>(picture.scale);
  r.filter = static_cast<float>(map.filter);
  r.transmit = static_cast<float>(map.transmit);
  return r;
}

SlopeRecord record_of(const pattern::Slope& slope) {
  const double facing = glm::length(slope.direction), climbing = glm::length(slope.altitude);
  const double weight = 1 / ((facing + climbing) * (slope.most - slope.least));
  SlopeRecord r{};
  double offset = 0;
  if (facing > 0) {
    r.factor = static_cast<float>(facing * weight);
    offset -= slope.least * facing * weight;
  }
  // The height is measured along the altitude's direction, and weighted by the altitude's share of both
  // lengths.
  const double height = 1 / ((facing + climbing) * (slope.highest - slope.lowest));
  if (climbing > 0) offset -= slope.lowest * climbing * height;
  for (int i = 0; i < 3; ++i) {
    r.direction[i] = facing > 0 ? static_cast<float>(slope.direction[i] / facing) : 0.0f;
    r.altitude[i] = static_cast<float>(slope.altitude[i] * height);
  }
  r.offset = static_cast<float>(offset);
  return r;
}

std::uint32_t word_of(const pattern::Fractal& fractal) {
  return static_cast<std::uint32_t>(fractal.exponent) |
         static_cast<std::uint32_t>(fractal.exterior) << fractal_word::exterior_shift |
         static_cast<std::uint32_t>(fractal.interior) << fractal_word::interior_shift |
         static_cast<std::uint32_t>(fractal.magnet) << fractal_word::magnet_shift |
         (fractal.is_julia ? fractal_word::julia : 0);
}

} // namespace

PatternTable pattern_table(std::uint32_t kind_and_flags) {
  if ((kind_and_flags & pattern_flag::gradient_noise) != 0) return PatternTable::gradients;
  if ((kind_and_flags & pattern_flag::at_features) != 0) return PatternTable::features;
  switch (kind_and_flags & pattern_flag::kind_mask) {
  case kPatternKind<CellsPattern>:
  case kPatternKind<CracklePattern>:
    return PatternTable::features;
  case kPatternKind<RipplesPattern>:
  case kPatternKind<WavesPattern>:
    return PatternTable::waves;
  case kPatternKind<SlopePattern>:
    return PatternTable::slopes;
  case kPatternKind<PigmentPattern>:
    return PatternTable::pigments;
  case kPatternKind<ObjectPattern>:
    return PatternTable::objects;
  case kPatternKind<ImageMapPattern>:
  case kPatternKind<ImagePattern>:
    return PatternTable::pictures;
  case kPatternKind<FunctionPattern>:
    return PatternTable::functions;
  default:
    return PatternTable::none;
  }
}

PatternWords pattern_words(const pattern::Kind& kind, int number_of_waves) {
  PatternWords words;
  words.kind_and_flags = std::visit([&](const auto& one) { return put(one, words.parameter); }, kind);
  words.table = pattern_table(words.kind_and_flags);
  if (const auto* fractal = std::get_if<pattern::Fractal>(&kind)) words.fractal = word_of(*fractal);
  if (const auto* slope = std::get_if<pattern::Slope>(&kind)) words.slope = record_of(*slope);
  if (const auto* image = std::get_if<pattern::ImageMap>(&kind)) words.picture = record_of(image->map, false);
  if (const auto* image = std::get_if<pattern::ImageGrey>(&kind))
    words.picture = record_of(image->map, image->is_transmittance);
  if (words.table == PatternTable::waves) words.parameter[0] = static_cast<float>(number_of_waves);
  return words;
}

} // namespace celltrace

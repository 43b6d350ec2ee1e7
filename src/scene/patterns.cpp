#include "scene/patterns.hpp"

#include "celltrace/error.hpp"
#include "kernel/textures/list.hpp"

#include <string>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

using Parameters = float (&)[6];

// One for each kind that the kernel has: its number, and its parameters.

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
    parameter[3 + i] = static_cast<float>(1 - brick.mortar / brick.size[i]);
  }
  return kPatternKind<BrickPattern>;
}
std::uint32_t put(const pattern::Agate& agate, Parameters parameter) {
  parameter[0] = static_cast<float>(agate.turbulence);
  return kPatternKind<AgatePattern>;
}

// Those that the kernel lacks.

const char* name_of(const pattern::Ripples&) {
  return "ripples";
}
const char* name_of(const pattern::Waves&) {
  return "waves";
}
const char* name_of(const pattern::Cells&) {
  return "cells";
}
const char* name_of(const pattern::Crackle&) {
  return "crackle";
}
template <class Kind> std::uint32_t put(const Kind& kind, Parameters) {
  throw InputError("the pattern '" + std::string(name_of(kind)) + "' is not supported yet");
}

} // namespace

std::uint32_t pattern_parameters(const pattern::Kind& kind, float (&parameter)[6]) {
  for (float& number : parameter)
    number = 0;
  return std::visit([&](const auto& one) { return put(one, parameter); }, kind);
}

} // namespace celltrace

#include "scene/patterns.hpp"

#include "celltrace/error.hpp"
#include "kernel/textures/list.hpp"

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

template <class Kind> std::uint32_t put(const Kind&, Parameters) {
  throw InputError("a pattern is not supported yet");
}

} // namespace

std::uint32_t pattern_parameters(const pattern::Kind& kind, float (&parameter)[6]) {
  for (float& number : parameter)
    number = 0;
  return std::visit([&](const auto& one) { return put(one, parameter); }, kind);
}

} // namespace celltrace

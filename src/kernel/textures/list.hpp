// All patterns. The order gives each its kind, a number in its records. Kernel dialect.
//
// A pattern P has
//   kName
//   kIsList        whether its value is the number of a map's entry
//   kNeedsNoise    whether its code is in the module that has the noise
//   kDisturbs      whether a normal of it is something else than the slope of its value; its code is with the
//   noise's value(p, record), and if it disturbs, disturbance(p, record)
#pragma once

#include "kernel/textures/bozo.hpp"
#include "kernel/textures/bumps.hpp"
#include "kernel/textures/checker.hpp"
#include "kernel/textures/gradient.hpp"
#include "kernel/type_list.hpp"

namespace celltrace::kernel {

template <class... P> struct PatternList : TypeList<P...> {
  static constexpr bool kNeedNoise[] = {P::kNeedsNoise...};
  static constexpr bool kAreLists[] = {P::kIsList...};
  static constexpr bool kDisturb[] = {P::kDisturbs...};
};

using Patterns = PatternList<CheckerPattern, GradientPattern, BozoPattern, BumpsPattern>;
constexpr bool disturbs(uint32_t kind) {
  return Patterns::kDisturb[kind];
}
template <class P> constexpr uint32_t kPatternKind = Patterns::number<P>();

} // namespace celltrace::kernel

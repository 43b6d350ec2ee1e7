// Converts a scene's vectors to the fields of records, which are single precision.
#pragma once

#include "celltrace/transform.hpp"

namespace celltrace {

inline void copy(const Vec3& from, float* to) {
  for (int i = 0; i < 3; ++i)
    to[i] = static_cast<float>(from[i]);
}
inline void copy(const Vec3f& from, float* to) {
  for (int i = 0; i < 3; ++i)
    to[i] = from[i];
}

} // namespace celltrace

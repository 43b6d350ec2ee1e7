// Scalar arithmetic for setup code, without the library. Kernel dialect.
#pragma once

namespace celltrace::kernel {

inline float smaller(float a, float b) {
  return a < b ? a : b;
}
inline float larger(float a, float b) {
  return a > b ? a : b;
}
inline float magnitude(float a) {
  return a < 0.0f ? -a : a;
}

inline float absolute_sum(const float (&v)[3]) {
  return magnitude(v[0]) + magnitude(v[1]) + magnitude(v[2]);
}

/// Returns the square root by Newton's iteration from above. For setup code, where a library call would cost
/// more than it saves.
inline float square_root(float x) {
  if (x <= 0.0f) return 0.0f;
  float guess = x > 1.0f ? x : 1.0f;
  for (int i = 0; i < 64; ++i) {
    const float next = 0.5f * (guess + x / guess);
    if (next >= guess) return guess;
    guess = next;
  }
  return guess;
}

} // namespace celltrace::kernel

// Something to profile: nearly all cycles in one function, the others in one that is called once.
#include <spu_intrinsics.h>

static vec_float4 values[256];

__attribute__((noinline)) static vec_float4 hot(vec_float4 sum, int rounds) {
  int i, round;
  for (round = 0; round < rounds; ++round)
    for (i = 0; i < 256; ++i)
      sum = spu_madd(values[i], values[i], sum);
  return sum;
}

__attribute__((noinline)) static void fill(void) {
  int i;
  for (i = 0; i < 256; ++i)
    values[i] = spu_splats((float)i);
}

__attribute__((noinline, used)) static int never_entered(int x) {
  return x + 1;
}

int main(void) {
  fill();
  return spu_extract(hot(spu_splats(0.0f), 64), 0) > 0.0f ? 0 : never_entered(0);
}

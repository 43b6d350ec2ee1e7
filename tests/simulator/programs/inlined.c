/* The tests know these lines by number. */
#include <spu_mfcio.h>

static char buffer[128] __attribute__((aligned(128)));

static inline __attribute__((always_inline)) void fetch(unsigned bytes) {
  mfc_get(buffer, 0x100000, bytes, 0, 0, 0);
}

static inline __attribute__((always_inline)) void fetch_odd(void) {
  fetch(100);
}

int main(void) {
  fetch_odd();
  return 0;
}

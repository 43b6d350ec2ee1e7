// Prints the argv of the PPE that argp is the address of, as main(speid, argp, envp) has to: by DMA.
#include <spu_mfcio.h>

#include <stdio.h>

static unsigned long long pointers[16] __attribute__((aligned(128)));
static char text[128] __attribute__((aligned(128)));

static void fetch(void* to, unsigned long long from, unsigned bytes) {
  mfc_get(to, from, bytes, 1, 0, 0);
  mfc_write_tag_mask(1 << 1);
  mfc_read_tag_status_all();
}

int main(unsigned long long speid, unsigned long long argp, unsigned long long envp) {
  int i;
  if (speid == 0 || envp != 0) return 1;
  if (argp == 0) {
    puts("no arguments");
    return 0;
  }
  fetch(pointers, argp, sizeof pointers);
  for (i = 0; pointers[i] != 0; ++i) {
    fetch(text, pointers[i], 16);
    printf("%d: %s\n", i, text);
  }
  return 0;
}

/* Tries main memory by effective address, without the compiler's cache for it: allocation, and what files and
   main memory exchange. Needs a folder that it may write to. The exit code is 0 if all is well. */
#include <ea.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <spu_mfcio.h>

static char buffer[256] __attribute__((aligned(128)));

static void put(uint32_t ea, unsigned bytes) {
  mfc_put(buffer, ea, bytes, 3, 0, 0);
  mfc_write_tag_mask(1 << 3);
  mfc_read_tag_status_all();
}

static void get(uint32_t ea, unsigned bytes) {
  mfc_get(buffer, ea, bytes, 3, 0, 0);
  mfc_write_tag_mask(1 << 3);
  mfc_read_tag_status_all();
}

int main(void) {
  const uint32_t first = (uint32_t)malloc_ea(1000);
  if (first == 0 || first % 128 != 0) return 1;
  strcpy(buffer, "through main memory");
  put(first, 32);
  const uint32_t second = (uint32_t)realloc_ea((__ea void*)first, 100000);
  if (second == 0) return 2;
  memset(buffer, 0, sizeof buffer);
  get(second, 32);
  if (strcmp(buffer, "through main memory") != 0) return 3;

  const int file = open("memory", O_RDWR | O_CREAT | O_TRUNC, 0600);
  if (write_ea(file, (__ea void*)second, 19) != 19) return 4;
  if (pread_ea(file, (__ea void*)(second + 128), 10, 8) != 10) return 5;
  get(second + 128, 16);
  if (memcmp(buffer, "main memory", 10) != 0) return 6;

  const unsigned long long mapped = mmap_eaddr(0, 4096, PROT_READ, MAP_PRIVATE, file, 0);
  if (mapped == MAP_FAILED_EADDR) return 7;
  get((uint32_t)mapped, 32);
  if (memcmp(buffer, "through main memory", 20) != 0) return 8;
  if (munmap_eaddr(mapped, 4096) != 0) return 9;
  close(file);
  unlink("memory");
  free_ea((__ea void*)second);
  puts("all is well");
  return 0;
}

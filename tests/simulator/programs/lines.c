/* The tests know these lines by number. */
#include <stdio.h>

int table[4] = {3, 1, 4, 1};

__attribute__((noinline)) static int sum(const int* values, int count) {
  int total = 0;
  for (int i = 0; i < count; ++i)
    total += values[i];
  return total;
}

int main(void) {
  printf("sum %d\n", sum(table, 4));
  return 0;
}

/* What the PPE tells an SPE of its part of y = a * x + y. */
#ifndef SAXPY_H
#define SAXPY_H

struct saxpy_control {
  unsigned long long x;        /* effective address, 128-byte aligned */
  unsigned long long y;        /* likewise */
  unsigned long long finished; /* of a line whose first word counts the SPEs that are done */
  unsigned int blocks;         /* of SAXPY_BLOCK elements */
  float a;
} __attribute__((aligned(128)));

#define SAXPY_BLOCK 1024

#endif

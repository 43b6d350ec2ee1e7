/* What the PPE tells the SPE of the vectors that it is to bring to length 1. */
#ifndef NORMALS_H
#define NORMALS_H

struct normals_control {
  unsigned long long x, y, z; /* effective addresses of the components, 128-byte aligned */
  unsigned int blocks;        /* of NORMALS_BLOCK vectors */
  unsigned int unused;
} __attribute__((aligned(16)));

#define NORMALS_BLOCK 1024

#endif

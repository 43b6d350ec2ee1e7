/* Brings vectors to length 1 on an SPE, block by block, and tells the PPE by mailbox how many had none: a
 * program with the SPU's intrinsics as it is written for the SDK. What had to be done for a PC is where its
 * buffers lie. */
#include "normals.h"

#include <spu_intrinsics.h>
#include <spu_mfcio.h>

#define QUADWORDS (NORMALS_BLOCK / 4)

struct local_data {
  vec_float4 x[QUADWORDS], y[QUADWORDS], z[QUADWORDS];
  struct normals_control control;
};

#ifdef __SPU__
static struct local_data local __attribute__((aligned(128)));
#else
#include <celltrace/spe/local_store.hpp>
static celltrace::LocalStore<local_data> local_data_in_local_store;
#define local (*local_data_in_local_store)
#endif

static void wait_for_tag(unsigned int tag) {
  mfc_write_tag_mask(1 << tag);
  mfc_read_tag_status_all();
}

/* 1 / sqrt(a), the estimate and a step of Newton's method; 0 for 0. */
static vector float inverse_root(vector float a) {
  const vector float estimate = spu_rsqrte(a);
  const vector float half = spu_mul(a, spu_splats(0.5f));
  const vector float correction = spu_nmsub(half, spu_mul(estimate, estimate), spu_splats(1.5f));
  const vector unsigned int is_zero = spu_cmpeq(a, spu_splats(0.0f));
  return spu_sel(spu_mul(estimate, correction), spu_splats(0.0f), is_zero);
}

/* Returns how many of each fourth vector have the length 0. */
static vec_uint4 normalise_block(void) {
  vec_uint4 zeros = spu_splats(0u);
  int i;
  for (i = 0; i < QUADWORDS; i++) {
    vec_float4 x = local.x[i], y = local.y[i], z = local.z[i];
    vec_float4 squared = spu_madd(x, x, spu_madd(y, y, spu_mul(z, z)));
    vec_float4 factor = inverse_root(squared);
    zeros = spu_sub(zeros, spu_cmpeq(squared, spu_splats(0.0f))); /* true is -1 */
    local.x[i] = spu_mul(x, factor);
    local.y[i] = spu_mul(y, factor);
    local.z[i] = spu_mul(z, factor);
  }
  return zeros;
}

int main(unsigned long long speid, unsigned long long argp, unsigned long long envp) {
  vec_uint4 zeros = spu_splats(0u);
  unsigned int block;
  (void)speid;
  (void)envp;
  mfc_get(&local.control, argp, sizeof local.control, 0, 0, 0);
  wait_for_tag(0);

  for (block = 0; block < local.control.blocks; block++) {
    const unsigned long long offset = (unsigned long long)block * sizeof local.x;
    mfc_get(local.x, local.control.x + offset, sizeof local.x, 1, 0, 0);
    mfc_get(local.y, local.control.y + offset, sizeof local.y, 1, 0, 0);
    mfc_get(local.z, local.control.z + offset, sizeof local.z, 1, 0, 0);
    wait_for_tag(1);
    zeros = spu_add(zeros, normalise_block());
    mfc_put(local.x, local.control.x + offset, sizeof local.x, 1, 0, 0);
    mfc_put(local.y, local.control.y + offset, sizeof local.y, 1, 0, 0);
    mfc_put(local.z, local.control.z + offset, sizeof local.z, 1, 0, 0);
    wait_for_tag(1);
  }

  /* The sum of the four counts is in every element. */
  zeros = spu_add(zeros, spu_rlqwbyte(zeros, 8));
  zeros = spu_add(zeros, spu_rlqwbyte(zeros, 4));
  spu_write_out_mbox(spu_extract(zeros, 0));
  return 0;
}

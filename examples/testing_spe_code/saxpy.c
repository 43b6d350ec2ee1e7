/* y = a * x + y on an SPE, block by block through BUFFERS buffers: an SPE program in C as it is written for
 * the SDK. What had to be done for the tests is in the #else of the first #ifdef. */
#include "saxpy.h"

#include <spu_intrinsics.h>
#include <spu_mfcio.h>

#ifndef BUFFERS
#define BUFFERS 2
#endif

struct local_data {
  float x[BUFFERS][SAXPY_BLOCK];
  float y[BUFFERS][SAXPY_BLOCK];
  unsigned int line[32];
  struct saxpy_control control;
};

#ifdef __SPU__
static struct local_data local __attribute__((aligned(128)));
#define DECLARE_WORK(quadwords)
#else
#include <celltrace/spe/local_store.hpp>
/* A static object that DMA reaches, on a PC. */
static celltrace::LocalStore<local_data> local_data_in_local_store;
#define local (*local_data_in_local_store)
/* What the SPU computes, for the virtual clock: two loads, a multiply-add, a store; the loop is unrolled
 * by 4. */
#define DECLARE_WORK(quadwords)                                                                              \
  celltrace::cell_emu::Spu::running().compute({.fixed = (quadwords) / 2,                                     \
                                               .floating = (quadwords),                                      \
                                               .memory = 3 * (quadwords),                                    \
                                               .branches = (quadwords) / 4})
#endif

#define TAG_CONTROL 2 /* the buffers have the tags 0 and 1 */

static void wait_for(unsigned int tag) {
  mfc_write_tag_mask(1 << tag);
  mfc_read_tag_status_all();
}

static void get_block(unsigned int block) {
  const unsigned int buffer = block % BUFFERS;
  const unsigned long long offset = (unsigned long long)block * sizeof local.x[0];
  mfc_get(local.x[buffer], local.control.x + offset, sizeof local.x[0], buffer, 0, 0);
  /* The fence: the buffer's last results have to be out before. */
  mfc_getf(local.y[buffer], local.control.y + offset, sizeof local.y[0], buffer, 0, 0);
}

static void put_block(unsigned int block) {
  const unsigned int buffer = block % BUFFERS;
  const unsigned long long offset = (unsigned long long)block * sizeof local.y[0];
  mfc_put(local.y[buffer], local.control.y + offset, sizeof local.y[0], buffer, 0, 0);
}

static void compute(float* y, const float* x, float a) {
  unsigned int i;
  for (i = 0; i < SAXPY_BLOCK; i++)
    y[i] += a * x[i];
  DECLARE_WORK(SAXPY_BLOCK / 4);
}

/* The count is everybody's: a lock line. */
static void count_as_finished(void) {
  do {
    mfc_getllar(local.line, local.control.finished, 0, 0);
    (void)mfc_read_atomic_status();
    local.line[0]++;
    mfc_putllc(local.line, local.control.finished, 0, 0);
  } while (mfc_read_atomic_status() & MFC_PUTLLC_STATUS);
}

int main(unsigned long long speid, unsigned long long argp, unsigned long long envp) {
  unsigned int block;
  (void)speid;
  (void)envp;
  mfc_get(&local.control, argp, sizeof local.control, TAG_CONTROL, 0, 0);
  wait_for(TAG_CONTROL);

  for (block = 0; block + 1 < BUFFERS && block < local.control.blocks; block++)
    get_block(block);
  for (block = 0; block < local.control.blocks; block++) {
    const unsigned int ahead = block + BUFFERS - 1;
    if (ahead < local.control.blocks) get_block(ahead);
#ifndef FORGET_THE_WAIT
    wait_for(block % BUFFERS);
#endif
    compute(local.y[block % BUFFERS], local.x[block % BUFFERS], local.control.a);
    put_block(block);
  }
  for (block = 0; block < BUFFERS; block++)
    wait_for(block);
  count_as_finished();
  return 0;
}

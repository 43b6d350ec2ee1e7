#ifndef EVERY_INTRINSIC_H
#define EVERY_INTRINSIC_H

/* At most so many results; as many bytes as 16 of them are one DMA command. */
#define EVERY_INTRINSIC_RESULTS 512

#endif

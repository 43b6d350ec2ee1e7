// The constants of the SDK's <spu_mfcio.h>, see spu_mfcio.hpp.
#pragma once

#include "celltrace/spe/types.hpp"

// Sizes of transfers and lists.

constexpr unsigned int MFC_MIN_DMA_SIZE_SHIFT = 4;
constexpr unsigned int MFC_MAX_DMA_SIZE_SHIFT = 14;
constexpr unsigned int MFC_MIN_DMA_SIZE = 16;
constexpr unsigned int MFC_MAX_DMA_SIZE = celltrace::kMaxDmaBytes;
constexpr unsigned int MFC_MIN_DMA_SIZE_MASK = MFC_MIN_DMA_SIZE - 1;
constexpr unsigned int MFC_MAX_DMA_SIZE_MASK = MFC_MAX_DMA_SIZE - 1;
constexpr unsigned int MFC_MIN_DMA_LIST_ELEMENTS = 1;
constexpr unsigned int MFC_MAX_DMA_LIST_ELEMENTS = celltrace::kMaxListElements;
constexpr unsigned int MFC_MIN_DMA_LIST_SIZE = 8;
constexpr unsigned int MFC_MAX_DMA_LIST_SIZE = 8 * MFC_MAX_DMA_LIST_ELEMENTS;

// Commands, and the bits that commands consist of.

constexpr unsigned int MFC_BARRIER_ENABLE = 0x01;
constexpr unsigned int MFC_FENCE_ENABLE = 0x02;
constexpr unsigned int MFC_LIST_ENABLE = 0x04;
constexpr unsigned int MFC_RESULT_ENABLE = 0x10;

constexpr unsigned int MFC_PUT_CMD = 0x20;
constexpr unsigned int MFC_PUTB_CMD = 0x21;
constexpr unsigned int MFC_PUTF_CMD = 0x22;
constexpr unsigned int MFC_PUTL_CMD = 0x24;
constexpr unsigned int MFC_PUTLB_CMD = 0x25;
constexpr unsigned int MFC_PUTLF_CMD = 0x26;
constexpr unsigned int MFC_PUTR_CMD = 0x30;
constexpr unsigned int MFC_PUTRB_CMD = 0x31;
constexpr unsigned int MFC_PUTRF_CMD = 0x32;
constexpr unsigned int MFC_PUTRL_CMD = 0x34;
constexpr unsigned int MFC_PUTRLB_CMD = 0x35;
constexpr unsigned int MFC_PUTRLF_CMD = 0x36;
constexpr unsigned int MFC_GET_CMD = 0x40;
constexpr unsigned int MFC_GETB_CMD = 0x41;
constexpr unsigned int MFC_GETF_CMD = 0x42;
constexpr unsigned int MFC_GETL_CMD = 0x44;
constexpr unsigned int MFC_GETLB_CMD = 0x45;
constexpr unsigned int MFC_GETLF_CMD = 0x46;
constexpr unsigned int MFC_SNDSIG_CMD = 0xA0;
constexpr unsigned int MFC_SNDSIGB_CMD = 0xA1;
constexpr unsigned int MFC_SNDSIGF_CMD = 0xA2;
constexpr unsigned int MFC_PUTLLUC_CMD = 0xB0;
constexpr unsigned int MFC_PUTLLC_CMD = 0xB4;
constexpr unsigned int MFC_PUTQLLUC_CMD = 0xB8;
constexpr unsigned int MFC_BARRIER_CMD = 0xC0;
constexpr unsigned int MFC_EIEIO_CMD = 0xC8;
constexpr unsigned int MFC_SYNC_CMD = 0xCC;
constexpr unsigned int MFC_GETLLAR_CMD = 0xD0;
constexpr unsigned int MFC_SDCRT_CMD = 0x80;
constexpr unsigned int MFC_SDCRTST_CMD = 0x81;
constexpr unsigned int MFC_SDCRZ_CMD = 0x89;
constexpr unsigned int MFC_SDCRST_CMD = 0x8D;
constexpr unsigned int MFC_SDCRF_CMD = 0x8F;

// Events.

constexpr unsigned int MFC_TAG_STATUS_UPDATE_EVENT = 0x1;
constexpr unsigned int MFC_LIST_STALL_NOTIFY_EVENT = 0x2;
constexpr unsigned int MFC_COMMAND_QUEUE_AVAILABLE_EVENT = 0x8;
constexpr unsigned int MFC_IN_MBOX_AVAILABLE_EVENT = 0x10;
constexpr unsigned int MFC_DECREMENTER_EVENT = 0x20;
constexpr unsigned int MFC_OUT_INTR_MBOX_AVAILABLE_EVENT = 0x40;
constexpr unsigned int MFC_OUT_MBOX_AVAILABLE_EVENT = 0x80;
constexpr unsigned int MFC_SIGNAL_NOTIFY_2_EVENT = 0x100;
constexpr unsigned int MFC_SIGNAL_NOTIFY_1_EVENT = 0x200;
constexpr unsigned int MFC_LLR_LOST_EVENT = 0x400;
constexpr unsigned int MFC_PRIV_ATTN_EVENT = 0x800;
constexpr unsigned int MFC_MULTI_SRC_SYNC_EVENT = 0x1000;

// Tag groups, lock lines and the tag manager.

constexpr unsigned int MFC_TAG_UPDATE_IMMEDIATE = 0;
constexpr unsigned int MFC_TAG_UPDATE_ANY = 1;
constexpr unsigned int MFC_TAG_UPDATE_ALL = 2;

constexpr unsigned int MFC_PUTLLC_STATUS = 0x1;
constexpr unsigned int MFC_PUTLLUC_STATUS = 0x2;
constexpr unsigned int MFC_GETLLAR_STATUS = 0x4;

constexpr unsigned int MFC_TAG_VALID = 0;
constexpr unsigned int MFC_TAG_INVALID = 0xFFFFFFFF;

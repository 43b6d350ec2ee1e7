// The SPU's channels: names, directions, and whether a channel stalls.
#pragma once

#include "celltrace/spe/types.hpp"

namespace celltrace {

constexpr const char* name_of(Channel channel) {
  switch (channel) {
  case Channel::rd_event_stat:
    return "SPU_RdEventStat";
  case Channel::wr_event_mask:
    return "SPU_WrEventMask";
  case Channel::wr_event_ack:
    return "SPU_WrEventAck";
  case Channel::rd_sig_notify_1:
    return "SPU_RdSigNotify1";
  case Channel::rd_sig_notify_2:
    return "SPU_RdSigNotify2";
  case Channel::wr_dec:
    return "SPU_WrDec";
  case Channel::rd_dec:
    return "SPU_RdDec";
  case Channel::wr_ms_sync_req:
    return "MFC_WrMSSyncReq";
  case Channel::rd_event_mask:
    return "SPU_RdEventMask";
  case Channel::rd_tag_mask:
    return "MFC_RdTagMask";
  case Channel::rd_mach_stat:
    return "SPU_RdMachStat";
  case Channel::wr_srr0:
    return "SPU_WrSRR0";
  case Channel::rd_srr0:
    return "SPU_RdSRR0";
  case Channel::mfc_lsa:
    return "MFC_LSA";
  case Channel::mfc_eah:
    return "MFC_EAH";
  case Channel::mfc_eal:
    return "MFC_EAL";
  case Channel::mfc_size:
    return "MFC_Size";
  case Channel::mfc_tag_id:
    return "MFC_TagID";
  case Channel::mfc_cmd:
    return "MFC_Cmd";
  case Channel::wr_tag_mask:
    return "MFC_WrTagMask";
  case Channel::wr_tag_update:
    return "MFC_WrTagUpdate";
  case Channel::rd_tag_stat:
    return "MFC_RdTagStat";
  case Channel::rd_list_stall_stat:
    return "MFC_RdListStallStat";
  case Channel::wr_list_stall_ack:
    return "MFC_WrListStallAck";
  case Channel::rd_atomic_stat:
    return "MFC_RdAtomicStat";
  case Channel::wr_out_mbox:
    return "SPU_WrOutMbox";
  case Channel::rd_in_mbox:
    return "SPU_RdInMbox";
  case Channel::wr_out_intr_mbox:
    return "SPU_WrOutIntrMbox";
  case Channel::set_bookmark_tag:
    return "SPU_Set_Bkmk_Tag";
  case Channel::pm_start_event:
    return "SPU_PM_Start_Ev";
  case Channel::pm_stop_event:
    return "SPU_PM_Stop_Ev";
  }
  return "no channel";
}

constexpr bool is_readable(Channel channel) {
  switch (channel) {
  case Channel::rd_event_stat:
  case Channel::rd_sig_notify_1:
  case Channel::rd_sig_notify_2:
  case Channel::rd_dec:
  case Channel::rd_event_mask:
  case Channel::rd_tag_mask:
  case Channel::rd_mach_stat:
  case Channel::rd_srr0:
  case Channel::rd_tag_stat:
  case Channel::rd_list_stall_stat:
  case Channel::rd_atomic_stat:
  case Channel::rd_in_mbox:
    return true;
  default:
    return false;
  }
}

constexpr bool exists(Channel channel) {
  return name_of(channel)[0] != 'n';
}

/// Returns true for the channels of the SPU's own MFC, whose counts depend on the commands of this SPU alone.
constexpr bool belongs_to_mfc(Channel channel) {
  return channel >= Channel::mfc_lsa && channel <= Channel::rd_atomic_stat;
}

/// Returns true if an access stalls while the count is 0. Channel 23 (MFC_WrTagUpdate) is documented as
/// stalling, too, but its count is always 1.
constexpr bool may_stall(Channel channel) {
  switch (channel) {
  case Channel::rd_event_stat:
  case Channel::rd_sig_notify_1:
  case Channel::rd_sig_notify_2:
  case Channel::mfc_cmd:
  case Channel::rd_tag_stat:
  case Channel::rd_list_stall_stat:
  case Channel::rd_atomic_stat:
  case Channel::wr_out_mbox:
  case Channel::rd_in_mbox:
  case Channel::wr_out_intr_mbox:
    return true;
  default:
    return false;
  }
}

} // namespace celltrace

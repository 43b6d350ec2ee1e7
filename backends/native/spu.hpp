// The SPU of the native backend: the interface of celltrace/spe/spu.hpp on a host thread.
//
// Kernels are compiled once for each instruction set, and `Arch` is part of all their names. Code that does
// not depend on the instruction set is compiled once, elsewhere (spe.hpp, channels.hpp, mfc.hpp): an inline
// function here without `Arch` in its name could be compiled for a wide CPU and then be linked into code for
// all CPUs.
#pragma once

#include "backends/native/spe.hpp"
#include "celltrace/spe/simd_host.hpp"
#include "celltrace/spe/spu.hpp"

#include <stdint.h>

namespace celltrace::native {

/// Names of the SPU types: "native." followed by the name of the SIMD level.
template <class Arch> constexpr const char* kSpuKey = nullptr;
#ifdef CELLTRACE_HAS_XSIMD
template <> inline constexpr const char* kSpuKey<xsimd::sse2> = "native.sse2";
template <> inline constexpr const char* kSpuKey<xsimd::avx2> = "native.avx2";
template <> inline constexpr const char* kSpuKey<xsimd::avx512dq> = "native.avx512";
template <> inline constexpr const char* kSpuKey<xsimd::neon64> = "native.neon64";
#endif
template <> inline constexpr const char* kSpuKey<GenericArch> = "native.generic";

/// A native SPU. A transfer is a memmove that is complete when the call returns; nothing is checked; stalls
/// sleep. See Mfc and Reservations for deviations from the Cell.
template <class Arch> class Spu : public SpuBase<Spu<Arch>> {
public:
  static constexpr bool direct_memory = true;
  static constexpr const char* kKey = kSpuKey<Arch>;
  using simd = HostSimd<Arch>;
  using rare_simd = simd;

  explicit Spu(Spe& spe) : spe_(spe) { this->initialise_base(); }

  uint32_t id() const { return spe_.id; }
  uint32_t count() const { return static_cast<uint32_t>(spe_.all->size()); }
  SpeAddresses addresses(uint32_t spe) const {
    if (spe >= spe_.all->size()) spe_.halt(HaltCode::bad_argument);
    return (*spe_.all)[spe];
  }

  template <Channel c> uint32_t read_channel() {
    if constexpr (c == Channel::rd_event_stat)
      return spe_.channels.read_event_status();
    else if constexpr (c == Channel::rd_event_mask)
      return spe_.channels.read_event_mask();
    else if constexpr (c == Channel::rd_sig_notify_1)
      return spe_.channels.read_signal(Signal::one);
    else if constexpr (c == Channel::rd_sig_notify_2)
      return spe_.channels.read_signal(Signal::two);
    else if constexpr (c == Channel::rd_dec)
      return spe_.channels.read_decrementer();
    else if constexpr (c == Channel::rd_in_mbox)
      return spe_.channels.read_in_mailbox();
    else if constexpr (c == Channel::rd_tag_mask)
      return spe_.mfc->read_tag_mask();
    else if constexpr (c == Channel::rd_tag_stat)
      return spe_.mfc->read_tag_status();
    else if constexpr (c == Channel::rd_list_stall_stat)
      return spe_.mfc->read_list_stall_status();
    else {
      static_assert(c == Channel::rd_atomic_stat, "not a channel to read");
      return spe_.mfc->read_atomic_status();
    }
  }

  template <Channel c> void write_channel(uint32_t value) {
    if constexpr (c == Channel::wr_event_mask)
      spe_.channels.write_event_mask(value);
    else if constexpr (c == Channel::wr_event_ack)
      spe_.channels.acknowledge_events(value);
    else if constexpr (c == Channel::wr_dec)
      spe_.channels.write_decrementer(value);
    else if constexpr (c == Channel::wr_tag_mask)
      spe_.mfc->write_tag_mask(value);
    else if constexpr (c == Channel::wr_tag_update)
      spe_.mfc->write_tag_update(static_cast<TagUpdate>(value));
    else if constexpr (c == Channel::wr_list_stall_ack)
      spe_.mfc->acknowledge_list_stall(value);
    else {
      static_assert(c == Channel::wr_out_mbox || c == Channel::wr_out_intr_mbox, "not a channel to write");
      spe_.counters.mailbox_words_sent.add(1);
      spe_.channels.write_out_mailbox(out_mailbox<c>(), value);
    }
  }

  template <Channel c> uint32_t channel_count() {
    if constexpr (c == Channel::rd_event_stat)
      return spe_.channels.event_count();
    else if constexpr (c == Channel::rd_sig_notify_1)
      return spe_.channels.signal_count(Signal::one);
    else if constexpr (c == Channel::rd_sig_notify_2)
      return spe_.channels.signal_count(Signal::two);
    else if constexpr (c == Channel::rd_in_mbox)
      return spe_.channels.in_mailbox_count();
    else if constexpr (c == Channel::wr_out_mbox || c == Channel::wr_out_intr_mbox)
      return spe_.channels.out_mailbox_count(out_mailbox<c>());
    else if constexpr (c == Channel::mfc_cmd)
      return spe_.mfc->queue_space();
    else if constexpr (c == Channel::rd_tag_stat)
      return spe_.mfc->tag_status_count();
    else if constexpr (c == Channel::rd_list_stall_stat)
      return spe_.mfc->list_stall_count();
    else if constexpr (c == Channel::rd_atomic_stat)
      return spe_.mfc->atomic_status_count();
    else
      return 1;
  }

  template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, uint32_t size, uint32_t tag) {
    spe_.mfc->command(op, ls, ea, size, tag);
  }
  template <MfcOpcode op>
  void mfc_list_command(void* ls, ea_t ea, const ListElement* list, uint32_t bytes, uint32_t tag) {
    spe_.mfc->list_command(op, ls, ea, list, bytes, tag);
  }

  template <uint32_t code> void stop() { spe_.stop(code); }
  [[noreturn]] void halt(HaltCode code) { spe_.halt(code); }
  ArenaState& arena() { return spe_.tracked_arena(); }

private:
  template <Channel c> static constexpr OutMailbox out_mailbox() {
    return c == Channel::wr_out_mbox ? OutMailbox::plain : OutMailbox::interrupting;
  }

  Spe& spe_;
};

} // namespace celltrace::native

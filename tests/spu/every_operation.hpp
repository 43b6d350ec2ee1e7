// A kernel that uses every operation of the runtime's contract and of the SIMD facade once. It is compiled,
// not run.
#pragma once

#include "celltrace/spe/spu.hpp"

#include <stdint.h>

namespace celltrace::test {

template <class Spu> void every_command(Spu& spu, ea_t ea) {
  uint8_t* ls = spu.template allocate<uint8_t>(512);
  ListElement* list = spu.template allocate<ListElement>(2, 16);
  list[0] = ListElement::make(128, ea, true);
  list[1] = ListElement::make(128, ea + 128);
  spu.get(ls, ea, 128, 0);
  spu.getf(ls, ea, 128, 0);
  spu.getb(ls, ea, 128, 0);
  spu.put(ls, ea, 128, 0);
  spu.putf(ls, ea, 128, 0);
  spu.putb(ls, ea, 128, 0);
  spu.getl(ls, ea, list, 2, 1);
  spu.getlf(ls, ea, list, 2, 1);
  spu.getlb(ls, ea, list, 2, 1);
  spu.putl(ls, ea, list, 2, 1);
  spu.putlf(ls, ea, list, 2, 1);
  spu.putlb(ls, ea, list, 2, 1);
  spu.mfc_barrier(2);
  spu.acknowledge_list_stall(spu.read_list_stall_status());
  uint32_t done = spu.completed(0x7) | spu.wait_any(0x7) | spu.wait_all(0x7);
  done |= spu.getllar(ls, ea);
  if (!spu.putllc(ls, ea)) done |= spu.putlluc(ls, ea);
  spu.putqlluc(ls, ea, 3);
  spu.write_out_mailbox(done);
}

template <class Spu> void every_channel(Spu& spu) {
  const uint32_t next = spu.id() + 1 == spu.count() ? 0 : spu.id() + 1;
  spu.write_event_mask(event::in_mailbox | event::signal_1 | event::signal_2 | event::decrementer);
  spu.write_decrementer(1000);
  if (spu.event_count() != 0) spu.acknowledge_events(spu.read_event_status());
  uint32_t sum = spu.read_event_mask() + spu.read_decrementer();
  if (spu.in_mailbox_count() != 0) sum += spu.read_in_mailbox();
  if (spu.signal_1_count() != 0) sum += spu.read_signal_1();
  if (spu.signal_2_count() != 0) sum += spu.read_signal_2();
  spu.send_signal(next, Signal::one, sum);
  spu.send_signal(next, Signal::two, sum);
  spu.send_mailbox(next, sum);
  if (spu.out_mailbox_count() != 0) spu.write_out_mailbox(sum);
  if (spu.out_interrupt_mailbox_count() != 0) spu.write_out_interrupt_mailbox(spu.available());
}

/// Kept out of line: its code in the map shows at a glance whether the facade stays within vector
/// instructions.
template <class Simd>
__attribute__((noinline)) void every_simd_operation(const float* in, const int32_t* ints, float* out,
                                                    int32_t* bits) {
  using F = typename Simd::F;
  using I = typename Simd::I;
  using M = typename Simd::M;
  const F a = F::load(in);
  const F b = F::load(in + 16);
  const I i = I::load(ints);
  const M less = (a < b) & (a <= b);
  const M more = (a > b) | (a >= b) | !(a == b);
  const M whole = (i == I::splat(3)) | (i < Simd::to_int(a)) | M::from_bits(static_cast<uint32_t>(bits[0]));
  const F mean = Simd::sqrt(Simd::abs(a * b)) + (a - b) / (Simd::max(a, b) - Simd::min(-a, F(2.0f)));
  const I mixed = (Simd::bits_of(mean) & i) + (i | I::splat(1)) - Simd::template shift_left<3>(i);
  Simd::select(less & M::all(), mean, Simd::floor(Simd::to_float(mixed))).store(out);
  Simd::select(more | M::none(), Simd::template shift_right<5>(mixed), i).store(bits + 16);
  Simd::float_of(mixed).store(out + 16);
  bits[1] = static_cast<int32_t>(whole.bits());
}

template <class Simd> uint32_t find_tag(const uint32_t* tags, uint32_t tag, uint32_t* copy) {
  using U4 = typename Simd::U4;
  const U4 all = U4::load(tags);
  ((all & U4::splat(~1u)) | U4::splat(2)).store(copy);
  return equal_bits(all, U4::splat(tag));
}

template <class Spu> void every_operation(Spu& spu, ea_t argument) {
  static_assert(!Spu::direct_memory, "an effective address is no pointer on an SPE");
  uint8_t* const mark = spu.mark();
  float* floats = spu.template allocate<float>(64);
  int32_t* ints = spu.template allocate<int32_t>(64);
  uint32_t* tags = spu.template allocate<uint32_t>(8);
  every_command(spu, argument);
  every_channel(spu);
  every_simd_operation<typename Spu::simd>(floats, ints, floats + 32, ints + 16);
  if (find_tag<typename Spu::simd>(tags, 7, tags + 4) != 0) spu.halt(HaltCode::bad_argument);
  if (spu.addresses(0).local_store == argument) spu.halt(HaltCode::internal_error);
  spu.release(mark);
}

} // namespace celltrace::test

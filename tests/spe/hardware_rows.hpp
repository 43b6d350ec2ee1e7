// What Cell hardware does and a model easily misses, as programs that run on host code and as SPU machine
// code alike: one kernel, in which a number picks the row. emu_conformance_hardware.cpp has the table of
// them, with what each has to lead to. Kernel dialect.
#pragma once

#include "celltrace/spe/spu.hpp"

#include <stdint.h>

namespace celltrace::test {

enum class HardwareRow : uint32_t {
  none,
  // the queue, when all of it is free
  drained_get,
  drained_put,
  drained_buffer_again,
  drained_and_waited,
  drained_get_read_and_waited,
  drained_put_changed_and_waited,
  room_is_not_all,
  // the tag status event
  immediate_is_event,
  event_of_status_rises_once,
  // putqlluc
  putqlluc_behind_put,
  putqlluc_behind_get,
  putqlluc_from_get,
  putqlluc_of_other_tag,
  // channels and events
  srr0_bits,
  stall_event_once,
  measurement_channels,
  decrementer_phantom,
  decrementer_written_negative,
  // what a command may not be
  list_count_wraps,
  get_of_given_address,
  put_to_given_address,
  line_of_given_address,
  list_to_given_address,
  signal_from_given_word,
  // order
  put_behind_barrier,
  get_behind_list_barrier,
  // no end
  poll_for_ever,
  wait_of_two,
};

/// The block at the kernel's argument: 128 bytes of input, and behind them 128 bytes of result for every SPE.
/// 32-bit words in the byte order of the SPU; addresses are two, the high one first.
namespace block {
constexpr uint32_t kWords = 32;
// input
constexpr uint32_t kRow = 0;
constexpr uint32_t kFrom = 2;  ///< address of 4096 words 1, 2, 3, ...
constexpr uint32_t kTo = 4;    ///< address of 4096 words 0
constexpr uint32_t kGiven = 6; ///< an address that the row is about
constexpr uint32_t kValue = 8; ///< a number likewise
// result
constexpr uint32_t kFinished = 0;   ///< 1 if the row came to its end
constexpr uint32_t kFailedLine = 1; ///< of the first check that failed; 0: none
constexpr uint32_t kFound = 2;
constexpr uint32_t kExpected = 3;
constexpr uint32_t kCulpritLine = 4; ///< what a diagnostic has to name
} // namespace block

/// A row's view of its block. Results leave by putlluc, which no tag and no queue knows of.
template <class Spu> class RowBook {
public:
  RowBook(Spu& spu, ea_t argument)
      : spu_(spu), input_(spu.template allocate<uint32_t>(block::kWords)),
        result_(spu.template allocate<uint32_t>(block::kWords)),
        home_(argument + (1 + spu.id()) * sizeof(uint32_t) * block::kWords) {
    spu.get(input_, argument, sizeof(uint32_t) * block::kWords, kTag);
    spu.wait_all(1u << kTag);
    // The row finds the channels as after a reset.
    spu.template write_channel<Channel::wr_tag_mask>(0);
    spu.acknowledge_events(~0u);
  }

  HardwareRow row() const { return static_cast<HardwareRow>(input_[block::kRow]); }
  ea_t from(uint32_t word = 0) const { return address(block::kFrom) + 4 * word; }
  ea_t to(uint32_t word = 0) const { return address(block::kTo) + 4 * word; }
  ea_t given() const { return address(block::kGiven); }
  uint32_t value() const { return input_[block::kValue]; }

  void is(uint32_t found, uint32_t expected, CallSite site = CallSite::here()) {
    if (found == expected || result_[block::kFailedLine] != 0) return;
    result_[block::kFailedLine] = site.line;
    result_[block::kFound] = found;
    result_[block::kExpected] = expected;
    write();
  }
  /// The operation on the next line is what the diagnostic has to name.
  void next_line(CallSite site = CallSite::here()) {
    result_[block::kCulpritLine] = site.line + 1;
    write();
  }
  void finish() {
    result_[block::kFinished] = 1;
    write();
  }

private:
  static constexpr uint32_t kTag = 30;

  ea_t address(uint32_t word) const { return (ea_t{input_[word]} << 32) | input_[word + 1]; }
  void write() { spu_.putlluc(result_, home_); }

  Spu& spu_;
  uint32_t* input_;
  uint32_t* result_;
  ea_t home_;
};

namespace rows {

template <class Spu> uint32_t* lines_of(Spu& spu, uint32_t lines = 1) {
  return spu.template allocate<uint32_t>(32 * lines);
}

/// A list of two lines that notifies behind the first.
template <class Spu> const ListElement* stopping_list(Spu& spu, ea_t from) {
  ListElement* list = spu.template allocate<ListElement>(2);
  list[0] = ListElement::make(128, from, true);
  list[1] = ListElement::make(128, from + 128);
  return list;
}

template <class Spu> uint32_t room(Spu& spu, CallSite site = CallSite::here()) {
  spu.at(site);
  return spu.template channel_count<Channel::mfc_cmd>();
}
template <class Spu> void write_tag_mask(Spu& spu, uint32_t mask) {
  spu.template write_channel<Channel::wr_tag_mask>(mask);
}
template <class Spu> void request_tags(Spu& spu, TagUpdate update) {
  spu.template write_channel<Channel::wr_tag_update>(static_cast<uint32_t>(update));
}
template <class Spu> uint32_t tag_status(Spu& spu) {
  return spu.template read_channel<Channel::rd_tag_stat>();
}

template <class Spu>
void send_word(Spu& spu, uint32_t* word, ea_t signal, uint32_t tag, CallSite site = CallSite::here()) {
  spu.at(site);
  spu.template mfc_command<MfcOpcode::sndsig>(word, signal, 4, tag);
}

/// Long enough for whatever can happen by itself: some 24,000 cycles of polls, on any schedule.
template <class Spu> void idle(Spu& spu) {
  for (uint32_t i = 0; i < 4000; ++i)
    spu.in_mailbox_count();
}

// --- the queue, when all of it is free ---

template <class Spu> void drained_get(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  spu.get(line, book.from(), 128, 1);
  book.next_line();
  while (room(spu) != kMfcQueueEntries) {
  }
  book.is(line[0], 1);
  book.is(line[31], 32);
}

template <class Spu> void drained_put(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  line[0] = 7;
  spu.put(line, book.to(), 128, 1);
  book.next_line();
  while (room(spu) != kMfcQueueEntries) {
  }
  line[0] = 8;
}

template <class Spu> void drained_buffer_again(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  for (uint32_t i = 0; i < 3; ++i) {
    spu.get(line, book.from(32 * i), 128, 1);
    book.next_line();
    while (room(spu) != kMfcQueueEntries) {
    }
    book.is(line[0], 32 * i + 1);
    spu.put(line, book.to(32 * i), 128, 2);
    while (room(spu) != kMfcQueueEntries) {
    }
  }
}

template <class Spu> void drained_and_waited(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  for (uint32_t i = 0; i < 3; ++i) {
    spu.get(line, book.from(32 * i), 128, 1);
    while (room(spu) != kMfcQueueEntries) {
    }
    spu.wait_all(1u << 1);
    book.is(line[0], 32 * i + 1);
  }
}

template <class Spu> void drained_get_read_and_waited(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  for (uint32_t i = 0; i < 2; ++i) {
    spu.get(line, book.from(32 * i), 128, 1);
    if (i == 0) book.next_line();
    while (room(spu) != kMfcQueueEntries) {
    }
    book.is(line[0], 32 * i + 1);
    spu.wait_all(1u << 1);
  }
}

template <class Spu> void drained_put_changed_and_waited(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  for (uint32_t i = 0; i < 2; ++i) {
    line[0] = 7 + i;
    spu.put(line, book.to(32 * i), 128, 1);
    if (i == 0) book.next_line();
    while (room(spu) != kMfcQueueEntries) {
    }
    line[0] = 0;
    spu.wait_all(1u << 1);
  }
}

template <class Spu> void room_is_not_all(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 3);
  const ListElement* list = stopping_list(spu, book.from());
  spu.getl(lines, book.from(), list, 2, 3);
  spu.read_list_stall_status();
  book.next_line();
  spu.get(lines + 64, book.from(), 128, 1);
  while (room(spu) != kMfcQueueEntries - 1) {
  }
  spu.acknowledge_list_stall(3);
  spu.wait_all(1u << 3);
}

// --- the tag status event ---

template <class Spu> void immediate_is_event(Spu& spu, RowBook<Spu>& book) {
  spu.write_event_mask(event::tag_status);
  book.is(spu.event_count(), 0);
  write_tag_mask(spu, 1u << 4);
  request_tags(spu, TagUpdate::immediate);
  book.is(spu.event_count(), 1);
  book.is(spu.read_event_status(), event::tag_status);
  book.is(tag_status(spu), 1u << 4);
}

template <class Spu> void event_of_status_rises_once(Spu& spu, RowBook<Spu>& book) {
  spu.write_event_mask(event::tag_status);
  write_tag_mask(spu, 1u << 4);
  request_tags(spu, TagUpdate::immediate);
  book.is(spu.read_event_status(), event::tag_status);
  spu.acknowledge_events(event::tag_status);
  // The answer is replaced, but the count of its channel stays 1.
  write_tag_mask(spu, 1u << 6);
  request_tags(spu, TagUpdate::all);
  book.is(spu.event_count(), 0);
  book.is(tag_status(spu), 1u << 6);
  request_tags(spu, TagUpdate::any);
  book.is(spu.event_count(), 1);
  book.is(spu.read_event_status(), event::tag_status);
  book.is(tag_status(spu), 1u << 6);
}

// --- putqlluc ---

template <class Spu> void putqlluc_behind_put(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 2);
  lines[0] = 1;
  lines[32] = 2;
  spu.put(lines, book.to(), 128, 5);
  spu.putqlluc(lines + 32, book.to(), 5);
  spu.wait_all(1u << 5);
  spu.get(lines, book.to(), 128, 5);
  spu.wait_all(1u << 5);
  book.is(lines[0], 2);
}

template <class Spu> void putqlluc_behind_get(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 2);
  lines[32] = 2;
  spu.get(lines, book.to(), 128, 5);
  spu.putqlluc(lines + 32, book.to(), 5);
  spu.wait_all(1u << 5);
  book.is(lines[0], 0);
}

template <class Spu> void putqlluc_from_get(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 2);
  spu.get(lines, book.from(), 128, 5);
  spu.putqlluc(lines, book.to(), 5);
  spu.wait_all(1u << 5);
  spu.get(lines + 32, book.to(), 128, 5);
  spu.wait_all(1u << 5);
  book.is(lines[32], 1);
  book.is(lines[63], 32);
}

template <class Spu> void putqlluc_of_other_tag(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  spu.get(line, book.from(), 128, 5);
  book.next_line();
  spu.putqlluc(line, book.to(), 6);
  spu.wait_all(3u << 5);
}

// --- channels and events ---

template <class Spu> void srr0_bits(Spu& spu, RowBook<Spu>& book) {
  spu.template write_channel<Channel::wr_srr0>(~0u);
  book.is(spu.template read_channel<Channel::rd_srr0>(), 0x3FFFC);
  spu.template write_channel<Channel::wr_srr0>(0x12345679);
  book.is(spu.template read_channel<Channel::rd_srr0>(), 0x05678);
}

template <class Spu> void stall_event_once(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 4);
  const ListElement* list = stopping_list(spu, book.from());
  spu.write_event_mask(event::list_stall);
  spu.getl(lines, book.from(), list, 2, 3);
  book.is(spu.read_event_status(), event::list_stall);
  spu.acknowledge_events(event::list_stall);
  // The second list joins a status that is unread: no event.
  spu.getl(lines + 64, book.from(), list, 2, 4);
  idle(spu);
  book.is(spu.event_count(), 0);
  book.is(spu.read_list_stall_status(), 3u << 3);
  spu.acknowledge_list_stall(3);
  spu.acknowledge_list_stall(4);
  spu.wait_all(3u << 3);
  book.is(lines[32], 33);
  book.is(lines[96], 33);
}

template <class Spu> void measurement_channels(Spu& spu, RowBook<Spu>& book) {
  book.is(spu.template channel_count<Channel::set_bookmark_tag>(), 1);
  book.is(spu.template channel_count<Channel::pm_start_event>(), 1);
  book.is(spu.template channel_count<Channel::pm_stop_event>(), 1);
  spu.template write_channel<Channel::set_bookmark_tag>(0x80000001);
  spu.template write_channel<Channel::pm_start_event>(0);
  spu.template write_channel<Channel::pm_stop_event>(0);
  book.is(spu.template channel_count<Channel::pm_stop_event>(), 1);
}

template <class Spu> void decrementer_phantom(Spu& spu, RowBook<Spu>& book) {
  spu.write_event_mask(event::decrementer);
  spu.write_decrementer(10);
  idle(spu);
  // It has expired under the old mask; the new one leaves the count without its event.
  spu.write_event_mask(0);
  book.is(spu.event_count(), 1);
  book.is(spu.read_event_status(), 0);
  spu.write_event_mask(event::decrementer);
  book.is(spu.read_event_status(), event::decrementer);
}

template <class Spu> void decrementer_written_negative(Spu& spu, RowBook<Spu>& book) {
  spu.write_event_mask(event::decrementer);
  spu.write_decrementer(0x7FFFFFFF);
  book.is(spu.event_count(), 0);
  // Not 0x80000000, whose top bit falls with the next tick, so that the next write would be an event again.
  spu.write_decrementer(0x90000000);
  book.is(spu.event_count(), 1);
  book.is(spu.read_event_status(), event::decrementer);
  spu.acknowledge_events(event::decrementer);
  spu.write_decrementer(0xC0000000);
  book.is(spu.event_count(), 0);
  spu.write_decrementer(1000000);
  book.is(spu.event_count(), 0);
}

// --- what a command may not be ---

template <class Spu> void list_count_wraps(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 2);
  ListElement* list = spu.template allocate<ListElement>(1);
  list[0] = ListElement::make(128, book.from());
  const uint32_t elements = (1u << 29) + 1;
  book.next_line();
  spu.getl(lines, book.from(), list, elements, 3);
  spu.wait_all(1u << 3);
}

template <class Spu> void get_of_given_address(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  book.next_line();
  spu.get(line, book.given(), 128, 1);
  spu.wait_all(1u << 1);
  book.is(line[0], book.value());
}

template <class Spu> void put_to_given_address(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  line[0] = book.value();
  book.next_line();
  spu.put(line, book.given(), 128, 1);
  spu.wait_all(1u << 1);
}

template <class Spu> void line_of_given_address(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  book.next_line();
  spu.getllar(line, book.given());
  book.is(line[0], book.value());
}

template <class Spu> void list_to_given_address(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 2);
  ListElement* list = spu.template allocate<ListElement>(2);
  list[0] = ListElement::make(128, book.given());
  list[1] = ListElement::make(128, book.given() + 128);
  lines[0] = lines[32] = book.value();
  book.next_line();
  spu.putl(lines, book.given(), list, 2, 1);
  spu.wait_all(1u << 1);
}

/// The word of a quadword whose number is given.
template <class Spu> void signal_from_given_word(Spu& spu, RowBook<Spu>& book) {
  uint32_t* line = lines_of(spu);
  const ea_t signal = spu.addresses(spu.id()).signal_1;
  line[book.value()] = 5;
  book.next_line();
  send_word(spu, line + book.value(), signal, 1);
  spu.wait_all(1u << 1);
  book.is(spu.read_signal_1(), 5);
}

// --- order ---

template <class Spu> void put_behind_barrier(Spu& spu, RowBook<Spu>& book) {
  constexpr uint32_t kLines = 64;
  uint32_t* lines = lines_of(spu, kLines);
  // The barriered command is long and the one behind it short.
  spu.getb(lines, book.from(), 128 * kLines, 1);
  spu.put(lines + 32 * (kLines - 1), book.to(), 16, 1);
  spu.wait_all(1u << 1);
  spu.get(lines, book.to(), 16, 1);
  spu.wait_all(1u << 1);
  book.is(lines[0], 32 * (kLines - 1) + 1);
}

template <class Spu> void get_behind_list_barrier(Spu& spu, RowBook<Spu>& book) {
  uint32_t* lines = lines_of(spu, 3);
  const ListElement* list = stopping_list(spu, book.from());
  spu.getlb(lines, book.from(), list, 2, 1);
  spu.get(lines + 64, book.from(), 128, 1);
  spu.read_list_stall_status();
  // The get has to wait for what is left of the list.
  idle(spu);
  book.is(room(spu), kMfcQueueEntries - 2);
  spu.acknowledge_list_stall(1);
  spu.wait_all(1u << 1);
  book.is(lines[32], 33);
  book.is(lines[64], 1);
}

// --- no end ---

template <class Spu> void poll_for_ever(Spu& spu, RowBook<Spu>& book) {
  book.next_line();
  while (spu.in_mailbox_count() != 5) {
  }
}

/// SPE 0 polls for ever, and the others wait for it.
template <class Spu> void wait_of_two(Spu& spu, RowBook<Spu>& book) {
  if (spu.id() != 0) {
    spu.read_signal_1();
    return;
  }
  book.next_line();
  while (spu.in_mailbox_count() != 5) {
  }
}

} // namespace rows

/// Runs the row that the block at `argument` names.
template <class Spu> void hardware_rows(Spu& spu, ea_t argument) {
  RowBook<Spu> book(spu, argument);
#define CELLTRACE_ROW(name)                                                                                  \
  case HardwareRow::name:                                                                                    \
    rows::name(spu, book);                                                                                   \
    break
  switch (book.row()) {
    CELLTRACE_ROW(drained_get);
    CELLTRACE_ROW(drained_put);
    CELLTRACE_ROW(drained_buffer_again);
    CELLTRACE_ROW(drained_and_waited);
    CELLTRACE_ROW(drained_get_read_and_waited);
    CELLTRACE_ROW(drained_put_changed_and_waited);
    CELLTRACE_ROW(room_is_not_all);
    CELLTRACE_ROW(immediate_is_event);
    CELLTRACE_ROW(event_of_status_rises_once);
    CELLTRACE_ROW(putqlluc_behind_put);
    CELLTRACE_ROW(putqlluc_behind_get);
    CELLTRACE_ROW(putqlluc_from_get);
    CELLTRACE_ROW(putqlluc_of_other_tag);
    CELLTRACE_ROW(srr0_bits);
    CELLTRACE_ROW(stall_event_once);
    CELLTRACE_ROW(measurement_channels);
    CELLTRACE_ROW(decrementer_phantom);
    CELLTRACE_ROW(decrementer_written_negative);
    CELLTRACE_ROW(list_count_wraps);
    CELLTRACE_ROW(get_of_given_address);
    CELLTRACE_ROW(put_to_given_address);
    CELLTRACE_ROW(line_of_given_address);
    CELLTRACE_ROW(list_to_given_address);
    CELLTRACE_ROW(signal_from_given_word);
    CELLTRACE_ROW(put_behind_barrier);
    CELLTRACE_ROW(get_behind_list_barrier);
    CELLTRACE_ROW(poll_for_ever);
    CELLTRACE_ROW(wait_of_two);
  case HardwareRow::none:
    break;
  }
#undef CELLTRACE_ROW
  book.finish();
}

} // namespace celltrace::test

// List commands of the MFC: their elements, and the stops at notify elements.
#include "backends/cell_emu/mfc.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "celltrace/spe/channels.hpp"

#include <algorithm>
#include <cstring>

namespace celltrace::cell_emu {

void Mfc::read_list(Entry& entry) const {
  entry.elements.resize(entry.command.size / sizeof(ListElement));
  if (entry.elements.empty()) return;
  std::memcpy(entry.elements.data(),
              bus_.map().local_store(spe_) + static_cast<std::uint32_t>(entry.command.ea),
              entry.command.size);
  for (ListElement& element : entry.elements)
    element = {context_.from_spu(element.notify_and_size), context_.from_spu(element.ea_low)};
}

void Mfc::begin_part(Entry& entry, Cycle now) {
  while (entry.next_element < entry.elements.size()) {
    const ListElement element = entry.elements[entry.next_element];
    const MfcCommand part = element_command(entry.command, element, entry.next_lsa);
    Rule rule = broken_element_rule(part, target_of(part, part.size, false));
    if (rule == Rule::none) rule = broken_arena_rule(part);
    if (rule == Rule::none) rule = broken_bounds_rule(part, false);
    if (rule != Rule::none)
      report({part, entry.number, entry.site, false, now}, rule, now,
             "element " + std::to_string(entry.next_element) + " of " + describe(entry.command) + ": ");
    if (can_be_carried_out(rule)) depart(entry, part, now);
    counters_.dma_list_elements.add(1);
    if (part.size != 0) entry.next_lsa = (part.lsa + part.size + 15) & ~15u;
    ++entry.next_element;
    if ((element.notify_and_size & ListElement::kNotify) != 0) break;
  }
}

void Mfc::check_list_unchanged(const Entry& entry, Cycle now) {
  Entry again = entry;
  read_list(again);
  const auto same = [](const ListElement& a, const ListElement& b) {
    return a.notify_and_size == b.notify_and_size && a.ea_low == b.ea_low;
  };
  if (!std::equal(again.elements.begin(), again.elements.begin() + entry.next_element, entry.elements.begin(),
                  same))
    report(entry, Rule::list_changed, now);
}

bool Mfc::complete_part(Entry& entry, Cycle now) {
  check_list_unchanged(entry, now);
  // A notify bit in the last element has no effect, because no element is left.
  if (entry.next_element == entry.elements.size()) return true;
  entry.stalled = true;
  entry.due = kNever;
  entry.moved = true;
  // The event occurs when the channel's count rises to 1. If a status is still unread, a further stop only
  // adds its bit to the status.
  const bool rises = stalled_tags_ == 0;
  stalled_tags_ |= 1u << entry.command.tag;
  if (rises) problem_state_.raise_own(event::list_stall);
  return false;
}

std::uint32_t Mfc::take_list_stall_status(Cycle now) {
  const std::uint32_t tags = stalled_tags_;
  stalled_tags_ = 0;
  // The program now knows that the parts before the stops have been transferred.
  for (const Entry& entry : queue_)
    if (entry.stalled && (tags >> entry.command.tag & 1) != 0) observe_part(entry.number, now);
  return tags;
}

void Mfc::acknowledge_list_stall(std::uint32_t tag, CallSite site, Cycle now) {
  if (tag >= kMfcTags) {
    report_channel(Channel::wr_list_stall_ack, tag, Rule::list_stall_tag, site, now);
    return;
  }
  for (Entry& entry : queue_) {
    if (!entry.stalled || entry.command.tag != tag) continue;
    entry.stalled = false;
    // Read the rest of the list again, because programs may write it during the stop.
    const std::uint32_t done = entry.next_element;
    read_list(entry);
    entry.next_element = done;
    begin_part(entry, now);
  }
  start_ready(now);
}

} // namespace celltrace::cell_emu

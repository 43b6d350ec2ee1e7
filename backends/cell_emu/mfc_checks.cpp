// The MFC's checks of bounds: of allocations, of objects in main memory, of the arena and of local store.
// mfc_rules.hpp has the other rules.
#include "backends/cell_emu/mfc.hpp"
#include "backends/cell_emu/mfc_rules.hpp"
#include "celltrace/spe/spu.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>

namespace celltrace::cell_emu {
namespace {

std::string describe(const Allocations::Allocation& allocation) {
  std::string text =
      std::to_string(allocation.end - allocation.begin) + " bytes at LS 0x" + to_hex(allocation.begin);
  if (const std::string site = to_text(allocation.site); !site.empty()) text += ", made at " + site;
  return text;
}

/// Returns the number of bytes of local store that a command uses; for a list command, the bytes of the list.
std::uint32_t storage_bytes(const MfcCommand& command) {
  switch (kind_of(command.opcode)) {
  case CommandKind::get:
  case CommandKind::put:
  case CommandKind::send_signal:
    return command.size;
  case CommandKind::lock_line:
    return kLineBytes;
  case CommandKind::barrier:
  case CommandKind::cache_control:
  case CommandKind::unknown:
    break;
  }
  return 0;
}

} // namespace

bool Mfc::note_overrun(Diagnostic& diagnostic, CallSite site, Cycle now) {
  const auto at = bus_.map().local_stores().take_overrun(spe_);
  if (!at) return false;
  diagnostic = about({}, Rule::local_store_overrun, now);
  diagnostic.site = site;
  diagnostic.lsa = static_cast<std::uint32_t>(*at);
  const std::string where = *at < 0 ? std::to_string(-*at) + " bytes in front of LS 0"
                                    : "near LS 0x" + to_hex(static_cast<std::uint32_t>(*at));
  return context_.log.note(diagnostic, where + ": " + std::string(text_of(diagnostic.rule)));
}

void Mfc::begin_allocations(const std::uint8_t* from) {
  std::uint8_t* const local_store = bus_.map().local_store(spe_);
  allocations().begin(local_store, static_cast<std::uint32_t>(from - local_store), context_.config.red_zones);
}

void Mfc::allocated(const std::uint8_t* begin, std::uint32_t bytes, std::uint32_t alignment, CallSite site,
                    ArenaState& arena) {
  if (!allocations().known()) return;
  const auto lsa = static_cast<std::uint32_t>(begin - bus_.map().local_store(spe_));
  allocations().add(lsa, bytes, alignment, plain_arena_end_, site);
  fit_arena(arena);
}

void Mfc::release(const std::uint8_t* from, CallSite site, Cycle now, ArenaState& arena) {
  if (allocations().known()) check_stores(site, now);
  allocations().release(static_cast<std::uint32_t>(from - bus_.map().local_store(spe_)));
  fit_arena(arena);
}

void Mfc::fit_arena(ArenaState& arena) {
  arena_.end = std::min(plain_arena_end_ + allocations().shift(), kLocalStoreBytes);
  std::uint8_t* const local_store = bus_.map().local_store(spe_);
  arena.next = local_store + std::min(allocations().next(), arena_.end);
  arena.end = local_store + arena_.end;
}

bool Mfc::note_allocation_overrun(Diagnostic& diagnostic, CallSite site, Cycle now) {
  const auto overrun = allocations().take_overrun();
  if (!overrun) return false;
  diagnostic = about({}, Rule::allocation_overrun, now);
  diagnostic.site = site;
  diagnostic.lsa = overrun->lsa;
  diagnostic.other_site = overrun->allocation.site;
  return context_.log.note(diagnostic, "near LS 0x" + to_hex(overrun->lsa) + ": " +
                                           std::string(text_of(diagnostic.rule)) + " of " +
                                           describe(overrun->allocation));
}

/// Reports stores past the local store or past allocations since the last check.
void Mfc::check_stores(CallSite site, Cycle now) {
  Diagnostic overrun;
  if (!bus_.map().local_stores().is_edge_intact(spe_) && note_overrun(overrun, site, now) &&
      overrun.action == Action::stop)
    throw RuleViolation(overrun);
  if (note_allocation_overrun(overrun, site, now) && overrun.action == Action::stop)
    throw RuleViolation(overrun);
}

/// Returns the range of local store in which a command crosses the bounds of an allocation of the issuing
/// program or of another SPE's program; nothing if it crosses no bounds. A proxy command is not checked
/// against its own SPE's allocations.
std::optional<Mfc::LocalRange> Mfc::unallocated(const MfcCommand& command, bool proxy) const {
  const std::uint32_t size = storage_bytes(command);
  if (size == 0) return std::nullopt;
  const std::uint32_t lsa = is_list(command.opcode) ? static_cast<std::uint32_t>(command.ea) : command.lsa;
  if (!proxy && allocations().is_left_by(lsa, size)) return LocalRange{spe_, lsa};
  if (is_list(command.opcode)) return std::nullopt;
  const AddressMap::Place place = bus_.map().locate(command.ea, size);
  if (place.kind != EaKind::local_store || (place.spe == spe_ && !proxy)) return std::nullopt;
  const auto there = static_cast<std::uint32_t>(command.ea - bus_.map().addresses(place.spe).local_store);
  if (!context_.bounds.allocations[place.spe].is_left_by(there, size)) return std::nullopt;
  return LocalRange{place.spe, there};
}

/// Returns the object that the command touches and leaves. Lock-line commands are not checked, because they
/// move whole lines.
std::optional<MemoryObject> Mfc::left_object(const MfcCommand& command) const {
  const CommandKind kind = kind_of(command.opcode);
  if ((kind != CommandKind::get && kind != CommandKind::put) || is_list(command.opcode) || command.size == 0)
    return std::nullopt;
  return context_.bounds.objects.left_by(command.ea, command.size);
}

Rule Mfc::broken_bounds_rule(const MfcCommand& command, bool proxy) const {
  if (unallocated(command, proxy)) return Rule::allocation_bounds;
  return left_object(command) ? Rule::object_bounds : Rule::none;
}

std::string Mfc::bounds_of(Rule rule, const Entry& entry) const {
  if (rule == Rule::object_bounds) {
    const auto object = left_object(entry.command);
    if (!object) return {};
    char text[80];
    std::snprintf(text, sizeof text, ": %" PRIu64 " bytes at EA 0x%" PRIx64, object->bytes, object->ea);
    return (object->name.empty() ? "" : ", '" + object->name + "'") + std::string(text);
  }
  if (rule != Rule::allocation_bounds) return {};
  const auto range = unallocated(entry.command, entry.proxy);
  if (!range) return {};
  const auto before = context_.bounds.allocations[range->spe].before(range->lsa);
  const std::string whose = range->spe == spe_ ? "" : " of SPE " + std::to_string(range->spe);
  return before ? "; the last one before it" + whose + " is " + describe(*before) : "";
}

/// Checks that a get fills only the program's own part of local store.
Rule Mfc::broken_arena_rule(const MfcCommand& transfer) const {
  const bool outside = transfer.lsa < arena_.begin || transfer.lsa + transfer.size > arena_.end;
  const bool fills = kind_of(transfer.opcode) == CommandKind::get && transfer.size != 0;
  return fills && outside ? Rule::program_overwritten : Rule::none;
}

EaKind Mfc::target_of(const MfcCommand& command, std::uint32_t size, bool proxy) {
  const EaKind kind = bus_.map().locate(command.ea, size).kind;
  if (kind != EaKind::main_memory) return kind;
  const bool write = writes_storage(command.opcode);
  // host_memory_ belongs to the SPE's thread, but proxy commands are checked on the PPE's.
  const bool accessible = proxy ? accessible_memory(command.ea, size, write).has_value()
                                : host_memory_.is_accessible(command.ea, size, write);
  return accessible ? kind : EaKind::unmapped;
}

bool Mfc::check(const MfcCommand& command, std::uint64_t number, CallSite site, Cycle now, bool proxy) {
  Rule rule = broken_common_rule(command);
  if (rule == Rule::none && proxy) rule = broken_proxy_rule(command);
  const CommandKind kind = kind_of(command.opcode);
  if (rule == Rule::none) {
    if (is_list(command.opcode))
      rule = broken_list_rule(command);
    else if (kind == CommandKind::lock_line)
      rule = broken_lock_line_rule(command, target_of(command, kLineBytes, proxy));
    else if (kind == CommandKind::cache_control)
      rule = broken_cache_control_rule(command, target_of(command, command.size, proxy));
    else if (kind != CommandKind::barrier)
      rule = broken_transfer_rule(command, target_of(command, command.size, proxy));
  }
  if (rule == Rule::none && !is_list(command.opcode)) rule = broken_arena_rule(command);
  if (rule == Rule::none) rule = broken_bounds_rule(command, proxy);
  if (rule == Rule::none && (kind == CommandKind::get || kind == CommandKind::put) && command.size == 0)
    rule = Rule::zero_size;
  if (rule != Rule::none) report({command, number, site, proxy, now}, rule, now);
  return can_be_carried_out(rule);
}

} // namespace celltrace::cell_emu

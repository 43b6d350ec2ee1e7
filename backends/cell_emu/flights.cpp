#include "backends/cell_emu/flights.hpp"

namespace celltrace::cell_emu {
namespace {

constexpr bool meet(ea_t a, ea_t b, std::uint32_t a_bytes, std::uint32_t b_bytes) {
  return a < b ? b - a < a_bytes : a - b < b_bytes;
}

} // namespace

Overlap overlap_of(const Flight& a, const Flight& b) {
  const bool a_in = a.writes_local_store(), b_in = b.writes_local_store();
  const std::uint32_t m = a.bytes(), n = b.bytes();
  // A get writes its local side, a put its storage side.
  if ((a_in || b_in) && meet(a.local, b.local, m, n)) return {true, true};
  if (b.has_storage && (a_in || !b_in) && meet(a.local, b.transfer.ea, m, n)) return {true, true};
  if (a.has_storage && (!a_in || b_in) && meet(a.transfer.ea, b.local, m, n)) return {true, false};
  if (a.has_storage && b.has_storage && (!a_in || !b_in) && meet(a.transfer.ea, b.transfer.ea, m, n))
    return {true, false};
  return {};
}

void Flights::add(unsigned spe, const Flight& flight) {
  List& list = lists_[spe];
  const std::lock_guard lock(list.lock);
  list.flights.push_back(flight);
  if (!flight.writes_local_store()) outward_.fetch_add(1);
}

std::optional<Conflict> Flights::conflict_elsewhere(unsigned spe, const Flight& flight) const {
  if (flight.writes_local_store() && outward_.load() == 0) return std::nullopt;
  for (unsigned other = 0; other < spes_; ++other) {
    if (other == spe) continue;
    const List& list = lists_[other];
    const std::lock_guard lock(list.lock);
    for (const Flight& theirs : list.flights) {
      if (theirs.released) continue;
      const Overlap overlap = overlap_of(flight, theirs);
      if (overlap.any) return Conflict{other, theirs.command, theirs.transfer, theirs.site, overlap.local};
    }
  }
  return std::nullopt;
}

} // namespace celltrace::cell_emu

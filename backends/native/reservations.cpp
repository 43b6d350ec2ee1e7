#include "backends/native/reservations.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace celltrace::native {

namespace {

constexpr ea_t line_of(ea_t ea) {
  return ea & ~static_cast<ea_t>(kLineBytes - 1);
}

void* to_memory(ea_t ea) {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(ea));
}

} // namespace

Reservations::Reservations(std::vector<Channels*> spes) : spes_(std::move(spes)), reserved_(spes_.size()) {
}

bool Reservations::take(unsigned spe, ea_t line) noexcept {
  ea_t expected = line;
  if (line == kNone || !reserved_[spe].compare_exchange_strong(expected, kNone)) return false;
  held_.fetch_sub(1);
  return true;
}

void Reservations::release(unsigned spe) noexcept {
  take(spe, reserved_[spe].load());
}

void Reservations::take_from_others(unsigned spe, ea_t line) {
  if (held_.load() == 0) return;
  for (unsigned other = 0; other < spes_.size(); ++other)
    if (other != spe && take(other, line)) spes_[other]->raise(event::reservation_lost);
}

void Reservations::get_and_reserve(unsigned spe, void* ls, ea_t ea) {
  const ea_t line = line_of(ea);
  release(spe);
  const std::lock_guard lock(lock_of(line));
  held_.fetch_add(1);
  reserved_[spe].store(line);
  std::memmove(ls, to_memory(line), kLineBytes);
}

bool Reservations::put_conditional(unsigned spe, const void* ls, ea_t ea) {
  const ea_t line = line_of(ea);
  const std::lock_guard lock(lock_of(line));
  if (!take(spe, line)) return false;
  std::memmove(to_memory(line), ls, kLineBytes);
  take_from_others(spe, line);
  return true;
}

void Reservations::put_unconditional(unsigned spe, const void* ls, ea_t ea) {
  const ea_t line = line_of(ea);
  const std::lock_guard lock(lock_of(line));
  std::memmove(to_memory(line), ls, kLineBytes);
  take(spe, line);
  take_from_others(spe, line);
}

void Reservations::put(unsigned spe, const void* ls, ea_t ea, std::size_t size) {
  if (held_.load(std::memory_order_relaxed) == 0) {
    std::memmove(to_memory(ea), ls, size);
    return;
  }
  const auto* from = static_cast<const std::uint8_t*>(ls);
  while (size > 0) {
    const ea_t line = line_of(ea);
    const std::size_t part = std::min(size, static_cast<std::size_t>(line + kLineBytes - ea));
    {
      const std::lock_guard lock(lock_of(line));
      std::memmove(to_memory(ea), from, part);
      // Unlike a putlluc, a plain put of the SPE itself also raises the event.
      if (take(spe, line)) spes_[spe]->raise(event::reservation_lost);
      take_from_others(spe, line);
    }
    ea += part;
    from += part;
    size -= part;
  }
}

} // namespace celltrace::native

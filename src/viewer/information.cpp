#include "viewer/information.hpp"

#include "viewer/controls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace celltrace::viewer {

namespace {

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char line[200];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(line, sizeof line, format, values);
  va_end(values);
  return line;
}

double share(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

/// Returns a colour; the colours of any number of SPEs are far apart on the colour wheel.
Overlay::Colour colour_of(unsigned spe) {
  const double hue = std::fmod(spe * 0.618033988749895, 1.0) * 6;
  const auto channel = [hue](double shift) {
    const double at = std::fmod(hue + shift, 6.0);
    return static_cast<std::uint8_t>(255 * std::clamp(std::abs(at - 3) - 1, 0.0, 1.0));
  };
  return {channel(0), channel(4), channel(2), 90};
}

} // namespace

std::vector<std::string> information_on(const Frame& frame, const Situation& situation) {
  const RenderStatistics& s = frame.statistics;
  const double rays = share(static_cast<double>(s.total_rays()), s.render_seconds);
  std::vector<std::string> lines = {
      situation.scene + (situation.is_paused ? "  (paused)" : ""),
      s.spu + ", " + name_of(s.model) + text(", %zu SPEs", s.spes.size()),
      text("%d x %d%s%s", frame.image.width, frame.image.height, frame.is_antialiased ? ", antialiased" : "",
           frame.is_complete ? "" : ", growing"),
      (situation.is_still ? "still" : text("%.1f frames/s", situation.frames_per_second)) +
          text(", %.1f ms, %.2f million rays/s", s.render_seconds * 1e3, rays / 1e6),
      text("%llu objects, BVH %s", static_cast<unsigned long long>(s.objects), name_of(s.preparation)),
      text("imbalance %.1f %%, %llu exchanges", s.imbalance * 100,
           static_cast<unsigned long long>(s.balance_exchanges))};
  const std::uint64_t hits =
      s.list_cache.hits + s.object_cache.hits + s.material_cache.hits + s.light_cache.hits;
  const std::uint64_t misses =
      s.list_cache.misses + s.object_cache.misses + s.material_cache.misses + s.light_cache.misses;
  if (hits + misses != 0)
    lines.push_back(text("cache hits %.2f %%, DMA %.1f MB in, %.1f MB out",
                         100 * share(static_cast<double>(hits), static_cast<double>(hits + misses)),
                         static_cast<double>(s.dma_bytes_read) / 1e6,
                         static_cast<double>(s.dma_bytes_written) / 1e6));
  if (s.render_cycles != 0)
    lines.push_back(text("%.2f million virtual cycles", static_cast<double>(s.render_cycles) / 1e6));
  if (!s.diagnostics.empty()) lines.push_back(text("%zu rules broken", s.diagnostics.size()));
  lines.push_back("keys: " + situation.mode + ", view: " + situation.view + "; H for help");
  return lines;
}

std::vector<Overlay::Bar> load_of(const Frame& frame) {
  constexpr std::size_t kMost = 16;
  const auto& spes = frame.statistics.spes;
  double most = 0;
  for (const RenderStatistics::Spe& spe : spes)
    most = std::max(most, static_cast<double>(spe.busy_ticks));
  std::vector<Overlay::Bar> bars;
  for (std::size_t i = 0; i < std::min(spes.size(), kMost); ++i)
    bars.push_back({text("SPE %zu", i), share(spes[i].busy_ticks, most)});
  return bars;
}

std::vector<Overlay::Patch> strips_of(const Frame& frame) {
  std::vector<Overlay::Patch> patches;
  for (const WorkRecord& record : frame.work)
    patches.push_back({record.region, colour_of(record.spe)});
  return patches;
}

std::vector<Overlay::Patch> costs_of(const Frame& frame) {
  if (frame.work.empty()) return {};
  const auto [least, most] =
      std::minmax_element(frame.work.begin(), frame.work.end(), [](const WorkRecord& a, const WorkRecord& b) {
        return a.ticks_per_pixel < b.ticks_per_pixel;
      });
  const double low = std::log(least->ticks_per_pixel);
  const double range = std::max(std::log(most->ticks_per_pixel) - low, 1e-6);
  std::vector<Overlay::Patch> patches;
  for (const WorkRecord& record : frame.work) {
    const double heat = (std::log(record.ticks_per_pixel) - low) / range;
    const auto channel = [](double value) {
      return static_cast<std::uint8_t>(255 * std::clamp(value, 0.0, 1.0));
    };
    patches.push_back(
        {record.region,
         {channel(2 * heat - 0.5), channel(1 - std::abs(2 * heat - 1)), channel(1.5 - 2 * heat), 130}});
  }
  return patches;
}

std::vector<std::pair<std::string, std::string>> help_table() {
  std::vector<std::pair<std::string, std::string>> table;
  for (const Control& control : controls())
    table.emplace_back(control.name, control.help);
  table.emplace_back("Click", "say which object is there");
  table.emplace_back("Left drag", "go around the middle");
  table.emplace_back("Right drag", "look around; also Shift and left drag");
  table.emplace_back("Middle drag", "move");
  return table;
}

} // namespace celltrace::viewer

#include "render/statistics.hpp"

#include "celltrace/balance.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace celltrace {

using namespace kernel;

namespace {

void add_cache(RenderStatistics::Cache& cache, const ReportRecord& report, DataKind kind) {
  cache.hits += report.cache_hits[static_cast<int>(kind)];
  cache.misses += report.cache_misses[static_cast<int>(kind)];
}

double imbalance_of_rays(const std::vector<RenderStatistics::Spe>& spes) {
  std::vector<std::uint64_t> rays;
  for (const auto& spe : spes)
    rays.push_back(spe.rays);
  return imbalance<std::uint64_t>(rays);
}

nlohmann::ordered_json cache_json(const RenderStatistics::Cache& cache) {
  return {{"hits", cache.hits}, {"misses", cache.misses}, {"hit_rate", cache.hit_rate()}};
}

} // namespace

double RenderStatistics::Cache::hit_rate() const {
  return hits + misses == 0 ? 0 : static_cast<double>(hits) / static_cast<double>(hits + misses);
}

void collect(RenderStatistics& s, const Machine& machine, const FrameBlock& frame,
             std::span<const ReportRecord> reports) {
  s.backend = machine.backend();
  s.spu = machine.spu_key();
  s.width = static_cast<int>(frame.width);
  s.height = static_cast<int>(frame.height);
  s.objects = frame.object_count;
  std::copy(std::begin(frame.grid.cells), std::end(frame.grid.cells), s.grid_cells);
  s.grid_list_entries = frame.grid.list_count;
  unsigned index = 0;
  for (const ReportRecord& r : reports) {
    s.primary_rays += r.primary_rays;
    s.shadow_rays += r.shadow_rays;
    s.reflection_rays += r.reflection_rays;
    s.refraction_rays += r.refraction_rays;
    s.dropped_rays += r.dropped_rays;
    s.spilled_packets += r.spilled_nodes;
    s.sphere_tests += r.sphere_tests;
    s.ellipsoid_tests += r.ellipsoid_tests;
    s.triangle_tests += r.triangle_tests;
    s.voxels_visited += r.voxels_visited;
    add_cache(s.list_cache, r, DataKind::list);
    add_cache(s.object_cache, r, DataKind::object);
    add_cache(s.material_cache, r, DataKind::material);
    add_cache(s.light_cache, r, DataKind::light);
    s.balance_exchanges += r.exchanges;
    s.balance_rows_moved += r.rows_received;

    const SpeStatistics spe = machine.statistics(index++);
    s.dma_commands += spe.dma_commands;
    s.dma_list_elements += spe.dma_list_elements;
    s.dma_bytes_read += spe.dma_bytes_read;
    s.dma_bytes_written += spe.dma_bytes_written;
    s.signals += spe.signals_sent;
    s.mailbox_words += spe.mailbox_words_sent;
    s.spes.push_back({r.primary_rays + r.shadow_rays + r.reflection_rays + r.refraction_rays, r.rows,
                      r.exchanges, spe.local_store_peak});
  }
  s.imbalance = imbalance_of_rays(s.spes);
}

std::string to_json(const RenderStatistics& s) {
  nlohmann::ordered_json spes = nlohmann::ordered_json::array();
  for (const auto& spe : s.spes)
    spes.push_back({{"rays", spe.rays},
                    {"rows", spe.rows},
                    {"exchanges", spe.exchanges},
                    {"local_store_peak", spe.local_store_peak}});
  const nlohmann::ordered_json json = {
      {"backend", s.backend},
      {"spu", s.spu},
      {"width", s.width},
      {"height", s.height},
      {"objects", s.objects},
      {"seconds", {{"build", s.build_seconds}, {"prepare", s.prepare_seconds}, {"render", s.render_seconds}}},
      {"rays",
       {{"primary", s.primary_rays},
        {"shadow", s.shadow_rays},
        {"reflection", s.reflection_rays},
        {"refraction", s.refraction_rays},
        {"total", s.total_rays()},
        {"dropped", s.dropped_rays},
        {"spilled_packets", s.spilled_packets}}},
      {"packet_tests",
       {{"sphere", s.sphere_tests}, {"ellipsoid", s.ellipsoid_tests}, {"triangle", s.triangle_tests}}},
      {"grid",
       {{"cells", {s.grid_cells[0], s.grid_cells[1], s.grid_cells[2]}},
        {"list_entries", s.grid_list_entries},
        {"voxels_visited", s.voxels_visited}}},
      {"cache",
       {{"list", cache_json(s.list_cache)},
        {"object", cache_json(s.object_cache)},
        {"material", cache_json(s.material_cache)},
        {"light", cache_json(s.light_cache)}}},
      {"dma",
       {{"commands", s.dma_commands},
        {"list_elements", s.dma_list_elements},
        {"bytes_read", s.dma_bytes_read},
        {"bytes_written", s.dma_bytes_written}}},
      {"communication", {{"signals", s.signals}, {"mailbox_words", s.mailbox_words}}},
      {"balance",
       {{"exchanges", s.balance_exchanges},
        {"rows_moved", s.balance_rows_moved},
        {"imbalance", s.imbalance}}},
      {"spes", spes}};
  return json.dump(2);
}

} // namespace celltrace

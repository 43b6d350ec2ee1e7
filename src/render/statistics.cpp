#include "render/statistics.hpp"

#include "celltrace/balance.hpp"
#include "kernel/primitives/list.hpp"
#include "render/spe_json.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace celltrace {

using namespace kernel;

namespace {

void add_cache(RenderStatistics::Cache& cache, const ReportRecord& report, DataKind kind) {
  cache.hits += report.cache_hits[static_cast<int>(kind)];
  cache.misses += report.cache_misses[static_cast<int>(kind)];
}

/// Returns an SPE's share of the work in a frame: in lockstep its cycles without waiting, else its rays,
/// since cycles then depend on the host.
std::uint64_t load(const RenderStatistics::Spe& spe, Schedule schedule) {
  if (schedule != Schedule::lockstep) return spe.rays;
  // Stages of a pipeline report no busy ticks: they wait for rays, not for units of work.
  return spe.busy_ticks != 0 ? spe.busy_ticks : spe.cycles.total_cycle - spe.cycles.channel_stall_cycle;
}

double imbalance_of(const RenderStatistics& s) {
  std::vector<std::uint64_t> loads;
  for (const auto& spe : s.spes)
    loads.push_back(load(spe, s.schedule));
  return imbalance<std::uint64_t>(loads);
}

constexpr std::uint64_t SpeStatistics::*kTrafficCounts[] = {
    &SpeStatistics::dma_commands,      &SpeStatistics::dma_list_elements, &SpeStatistics::dma_bytes_read,
    &SpeStatistics::dma_bytes_written, &SpeStatistics::signals_sent,      &SpeStatistics::mailbox_words_sent,
    &SpeStatistics::module_fetches,    &SpeStatistics::module_bytes,      &SpeStatistics::module_cycles,
};

std::vector<SpeStatistics> count(const Machine& machine) {
  std::vector<SpeStatistics> spes;
  for (unsigned spe = 0; spe < machine.spe_count(); ++spe)
    spes.push_back(machine.statistics(spe));
  return spes;
}

void collect_accelerator(RenderStatistics& s, const FrameBlock& frame) {
  if (static_cast<AcceleratorKind>(frame.accelerator) == AcceleratorKind::bvh) {
    s.accelerator = Accelerator::bvh;
    s.bvh_nodes = frame.bvh.node_count;
    s.accelerator_list_entries = frame.object_count;
    s.accelerator_bytes = std::uint64_t{s.bvh_nodes} * sizeof(NodeRecord);
  } else {
    s.accelerator = Accelerator::grid;
    std::copy(std::begin(frame.grid.cells), std::end(frame.grid.cells), s.grid_cells);
    s.accelerator_list_entries = frame.grid.list_count;
    s.accelerator_bytes = std::uint64_t{frame.grid.row_of_cells} * frame.grid.cells[2] * sizeof(CellRecord);
  }
  s.accelerator_bytes += s.accelerator_list_entries * sizeof(std::uint32_t);
}

nlohmann::ordered_json cache_json(const RenderStatistics::Cache& cache) {
  return {{"hits", cache.hits}, {"misses", cache.misses}, {"hit_rate", cache.hit_rate()}};
}

nlohmann::ordered_json stages_json(const RenderStatistics::Stages& stages) {
  return {{"generators", stages.generators},
          {"shaders", stages.shaders},
          {"searchers", stages.searchers},
          {"testers", stages.testers},
          {"jobs", stages.jobs},
          {"searches", stages.searches},
          {"primary_hits", stages.primary_hits},
          {"primary_reprocessed", stages.primary_reprocessed},
          {"primary_hits_reprocessed", stages.primary_hits_reprocessed},
          {"returns", stages.returns}};
}

} // namespace

double RenderStatistics::Cache::hit_rate() const {
  return hits + misses == 0 ? 0 : static_cast<double>(hits) / static_cast<double>(hits + misses);
}

std::optional<double> RenderStatistics::block_psnr() const {
  if (!block_error) return std::nullopt;
  if (*block_error == 0) return std::numeric_limits<double>::infinity();
  constexpr double kPeak = 255;
  const double numbers = 3.0 * width * height;
  return 10 * std::log10(kPeak * kPeak * numbers / static_cast<double>(*block_error));
}

SpeMeter::SpeMeter(const Machine& machine) : machine_(machine), start_(count(machine)) {
}

std::vector<SpeStatistics> SpeMeter::read() const {
  std::vector<SpeStatistics> spes = count(machine_);
  for (std::size_t spe = 0; spe < spes.size(); ++spe) {
    for (const auto member : kTrafficCounts)
      spes[spe].*member -= start_[spe].*member;
    for (const auto& [name, member] : kSpuCycleCounts)
      spes[spe].cycles.*member -= start_[spe].cycles.*member;
  }
  return spes;
}

std::uint64_t elapsed_cycles(std::span<const SpeStatistics> spes) {
  std::uint64_t most = 0;
  for (const SpeStatistics& spe : spes)
    most = std::max(most, spe.cycles.total_cycle);
  return most;
}

void add(std::span<ReportRecord> sum, std::span<const ReportRecord> reports) {
  for (std::size_t spe = 0; spe < sum.size(); ++spe) {
    ReportRecord& all = sum[spe];
    const ReportRecord& one = reports[spe];
    all.primary_rays += one.primary_rays;
    all.shadow_rays += one.shadow_rays;
    all.reflection_rays += one.reflection_rays;
    all.refraction_rays += one.refraction_rays;
    for (std::uint32_t kind = 0; kind < kObjectKinds; ++kind)
      all.tests[kind] += one.tests[kind];
    all.accelerator_visits += one.accelerator_visits;
    for (std::uint32_t kind = 0; kind < kDataKinds; ++kind) {
      all.cache_hits[kind] += one.cache_hits[kind];
      all.cache_misses[kind] += one.cache_misses[kind];
    }
    all.dropped_rays += one.dropped_rays;
    all.packets += one.packets;
    all.exchanges += one.exchanges;
    all.units_received += one.units_received;
    all.busy_ticks += one.busy_ticks;
    all.spilled_nodes += one.spilled_nodes;
    all.pixel_bytes += one.pixel_bytes;
    all.block_error += one.block_error;
  }
}

void collect(RenderStatistics& s, const Machine& machine, const FrameBlock& frame,
             std::span<const ReportRecord> reports, std::span<const SpeStatistics> spes) {
  s.backend = machine.backend();
  s.spu = machine.spu_key();
  // The grid of antialiasing has one more point than pixels each way.
  const int more = frame.sampling.method != 0 ? 1 : 0;
  s.width = static_cast<int>(frame.width) - more;
  s.height = static_cast<int>(frame.height) - more;
  s.objects = frame.object_count;
  collect_accelerator(s, frame);
  std::size_t index = 0;
  std::uint64_t all_cycles = 0;
  std::uint64_t block_error = 0;
  for (const ReportRecord& r : reports) {
    s.primary_rays += r.primary_rays;
    s.shadow_rays += r.shadow_rays;
    s.reflection_rays += r.reflection_rays;
    s.refraction_rays += r.refraction_rays;
    s.dropped_rays += r.dropped_rays;
    s.spilled_packets += r.spilled_nodes;
    for (std::uint32_t kind = 0; kind < kObjectKinds; ++kind)
      s.packet_tests[name_of_kind(kind)] += r.tests[kind];
    s.accelerator_visits += r.accelerator_visits;
    add_cache(s.list_cache, r, DataKind::list);
    add_cache(s.object_cache, r, DataKind::object);
    add_cache(s.material_cache, r, DataKind::material);
    add_cache(s.light_cache, r, DataKind::light);
    s.balance_exchanges += r.exchanges;
    s.balance_units_moved += r.units_received;
    s.pixel_bytes += r.pixel_bytes;
    block_error += r.block_error;

    const SpeStatistics& spe = spes[index++];
    s.dma_commands += spe.dma_commands;
    s.dma_list_elements += spe.dma_list_elements;
    s.dma_bytes_read += spe.dma_bytes_read;
    s.dma_bytes_written += spe.dma_bytes_written;
    s.signals += spe.signals_sent;
    s.mailbox_words += spe.mailbox_words_sent;
    s.module_fetches += spe.module_fetches;
    s.module_bytes += spe.module_bytes;
    s.module_cycles += spe.module_cycles;
    all_cycles += spe.cycles.total_cycle;
    s.spes.push_back({r.primary_rays + r.shadow_rays + r.reflection_rays + r.refraction_rays, r.packets,
                      r.exchanges, r.busy_ticks, spe.local_store_peak, spe.cycles});
  }
  s.module_share =
      all_cycles == 0 ? 0 : static_cast<double>(s.module_cycles) / static_cast<double>(all_cycles);
  if (static_cast<FramePurpose>(frame.purpose) == FramePurpose::blocks) s.block_error = block_error;
  s.render_cycles = elapsed_cycles(spes);
  s.imbalance = imbalance_of(s);
}

void add_rows(RenderStatistics& sum, const RenderStatistics& rows) {
  const auto add_counts = [](auto& to, const auto& from, auto... counts) {
    ((to.*counts += from.*counts), ...);
  };
  using S = RenderStatistics;
  const auto add_cache_counts = [&](S::Cache& to, const S::Cache& from) {
    add_counts(to, from, &S::Cache::hits, &S::Cache::misses);
  };
  add_counts(sum, rows, &S::height, &S::primary_rays, &S::shadow_rays, &S::reflection_rays,
             &S::refraction_rays, &S::dropped_rays, &S::spilled_packets, &S::accelerator_visits,
             &S::dma_commands, &S::dma_list_elements, &S::dma_bytes_read, &S::dma_bytes_written,
             &S::pixel_bytes, &S::signals, &S::mailbox_words, &S::module_fetches, &S::module_bytes,
             &S::module_cycles, &S::balance_exchanges, &S::balance_units_moved, &S::prepare_cycles,
             &S::render_cycles, &S::prepare, &S::build_seconds, &S::prepare_seconds, &S::render_seconds);
  if (sum.block_error && rows.block_error) *sum.block_error += *rows.block_error;
  for (const auto& [shape, tests] : rows.packet_tests)
    sum.packet_tests[shape] += tests;
  add_cache_counts(sum.list_cache, rows.list_cache);
  add_cache_counts(sum.object_cache, rows.object_cache);
  add_cache_counts(sum.material_cache, rows.material_cache);
  add_cache_counts(sum.light_cache, rows.light_cache);
  std::uint64_t all_cycles = 0;
  for (std::size_t spe = 0; spe < sum.spes.size() && spe < rows.spes.size(); ++spe) {
    add_counts(sum.spes[spe], rows.spes[spe], &S::Spe::rays, &S::Spe::packets, &S::Spe::exchanges,
               &S::Spe::busy_ticks, &S::Spe::cycles);
    sum.spes[spe].local_store_peak =
        std::max(sum.spes[spe].local_store_peak, rows.spes[spe].local_store_peak);
    all_cycles += sum.spes[spe].cycles.total_cycle;
  }
  sum.module_share =
      all_cycles == 0 ? 0 : static_cast<double>(sum.module_cycles) / static_cast<double>(all_cycles);
  sum.imbalance = imbalance_of(sum);
  sum.limits.insert(rows.limits.begin(), rows.limits.end());
  sum.diagnostics.insert(sum.diagnostics.end(), rows.diagnostics.begin(), rows.diagnostics.end());
}

const char* name_of(RenderStatistics::Preparation preparation) {
  using Preparation = RenderStatistics::Preparation;
  switch (preparation) {
  case Preparation::built:
    return "new";
  case Preparation::refitted:
    return "refitted";
  case Preparation::updated:
    return "updated";
  case Preparation::kept:
    break;
  }
  return "kept";
}

const char* name_of(Model model) {
  switch (model) {
  case Model::shared:
    return "shared";
  case Model::pipeline:
    return "pipeline";
  case Model::pipeline_split:
    return "pipeline-split";
  case Model::offload:
    break;
  }
  return "offload";
}

std::string to_json(const RenderStatistics& s) {
  nlohmann::ordered_json spes = nlohmann::ordered_json::array();
  for (const auto& spe : s.spes)
    spes.push_back({{"rays", spe.rays},
                    {"packets", spe.packets},
                    {"exchanges", spe.exchanges},
                    {"busy_ticks", spe.busy_ticks},
                    {"local_store_peak", spe.local_store_peak},
                    {"cycles", cycles_json(spe.cycles)}});
  nlohmann::ordered_json limits = nlohmann::ordered_json::array();
  for (const PictureLimit limit : s.limits)
    limits.push_back({{"limit", name_of(limit)}, {"most", most_of(limit)}, {"text", text_of(limit)}});
  nlohmann::ordered_json diagnostics = nlohmann::ordered_json::array();
  for (const Diagnostic& diagnostic : s.diagnostics)
    diagnostics.push_back(diagnostic_json(diagnostic));
  const std::optional<double> block_psnr = s.block_psnr();
  const nlohmann::ordered_json json = {
      {"backend", name_of(s.backend)},
      {"model", name_of(s.model)},
      {"spu", s.spu},
      {"schedule", s.schedule == Schedule::lockstep ? "lockstep" : "free"},
      {"seed", s.seed},
      {"width", s.width},
      {"height", s.height},
      {"objects", s.objects},
      {"seconds", {{"build", s.build_seconds}, {"prepare", s.prepare_seconds}, {"render", s.render_seconds}}},
      {"cycles", {{"prepare", s.prepare_cycles}, {"render", s.render_cycles}}},
      {"rays",
       {{"primary", s.primary_rays},
        {"shadow", s.shadow_rays},
        {"reflection", s.reflection_rays},
        {"refraction", s.refraction_rays},
        {"total", s.total_rays()},
        {"dropped", s.dropped_rays},
        {"spilled_packets", s.spilled_packets}}},
      {"packet_tests", s.packet_tests},
      {"accelerator",
       {{"kind", s.accelerator == Accelerator::bvh ? "bvh" : "grid"},
        {"cells", {s.grid_cells[0], s.grid_cells[1], s.grid_cells[2]}},
        {"nodes", s.bvh_nodes},
        {"list_entries", s.accelerator_list_entries},
        {"bytes", s.accelerator_bytes},
        {"bytes_per_object",
         s.objects == 0 ? 0.0 : static_cast<double>(s.accelerator_bytes) / static_cast<double>(s.objects)},
        {"visits", s.accelerator_visits},
        {"preparation", name_of(s.preparation)},
        {"stale_lines", s.stale_lines}}},
      {"cache",
       {{"list", cache_json(s.list_cache)},
        {"object", cache_json(s.object_cache)},
        {"material", cache_json(s.material_cache)},
        {"light", cache_json(s.light_cache)}}},
      {"dma",
       {{"commands", s.dma_commands},
        {"list_elements", s.dma_list_elements},
        {"bytes_read", s.dma_bytes_read},
        {"bytes_written", s.dma_bytes_written},
        {"pixel_bytes", s.pixel_bytes}}},
      {"blocks",
       {{"psnr", block_psnr && std::isfinite(*block_psnr) ? nlohmann::ordered_json(*block_psnr) : nullptr}}},
      {"communication", {{"signals", s.signals}, {"mailbox_words", s.mailbox_words}}},
      {"modules",
       {{"fetches", s.module_fetches},
        {"bytes", s.module_bytes},
        {"cycles", s.module_cycles},
        {"share_of_cycles", s.module_share}}},
      {"balance",
       {{"exchanges", s.balance_exchanges},
        {"units_moved", s.balance_units_moved},
        {"imbalance", s.imbalance}}},
      {"stages", stages_json(s.stages)},
      {"spes", spes},
      {"limits", limits},
      {"diagnostics", diagnostics}};
  return json.dump(2);
}

} // namespace celltrace

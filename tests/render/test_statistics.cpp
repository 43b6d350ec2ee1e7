// Reports and counts become the statistics of a frame, and those become JSON.
#include "render/statistics.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace celltrace;

namespace {

RenderStatistics collected(Schedule schedule, const std::vector<SpeStatistics>& spes,
                           const std::vector<kernel::ReportRecord>& reports) {
  MachineConfig config;
  config.spes = static_cast<unsigned>(spes.size());
  const auto machine = make_machine(config);
  RenderStatistics statistics;
  statistics.schedule = schedule;
  collect(statistics, *machine, kernel::FrameBlock(), reports, spes);
  return statistics;
}

std::string statistics_document() {
  std::ifstream file(CELLTRACE_SOURCE_DIR "/docs/statistics.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_CASE("The imbalance is of rays, and in lockstep of the time in which SPEs did not wait for work") {
  std::vector<kernel::ReportRecord> reports(2);
  reports[0].primary_rays = 300;
  reports[1].shadow_rays = 100;
  reports[0].busy_ticks = 10;
  reports[1].busy_ticks = 90;
  std::vector<SpeStatistics> spes(2);
  spes[0].cycles.total_cycle = 1000;
  spes[0].cycles.channel_stall_cycle = 900;
  spes[1].cycles.total_cycle = 1100;
  spes[1].cycles.channel_stall_cycle = 200;

  const RenderStatistics free = collected(Schedule::free, spes, reports);
  CHECK(free.imbalance == Approx(0.5));
  CHECK(free.render_cycles == 1100);
  const RenderStatistics lockstep = collected(Schedule::lockstep, spes, reports);
  CHECK(lockstep.imbalance == Approx(0.8));
  CHECK(lockstep.spes[1].cycles.channel_stall_cycle == 200);
}

TEST_CASE("What an SPE sent and received is summed up") {
  std::vector<SpeStatistics> spes(2);
  for (SpeStatistics& spe : spes) {
    spe.dma_commands = 1;
    spe.dma_list_elements = 2;
    spe.dma_bytes_read = 3;
    spe.dma_bytes_written = 4;
    spe.signals_sent = 5;
    spe.mailbox_words_sent = 6;
    spe.local_store_peak = 7;
  }
  const RenderStatistics s = collected(Schedule::free, spes, std::vector<kernel::ReportRecord>(2));
  CHECK(s.dma_commands == 2);
  CHECK(s.dma_list_elements == 4);
  CHECK(s.dma_bytes_read == 6);
  CHECK(s.dma_bytes_written == 8);
  CHECK(s.signals == 10);
  CHECK(s.mailbox_words == 12);
  CHECK(s.spes[1].local_store_peak == 7);
}

TEST_CASE("Statistics as JSON name schedule, seed and cycles, and what was broken without addresses") {
  RenderStatistics s;
  s.schedule = Schedule::lockstep;
  s.seed = 0xFFFFFFFFFFFFFFFF;
  s.prepare_cycles = 5;
  s.render_cycles = 6;
  s.spes.resize(1);
  s.spes[0].cycles.total_cycle = 6;
  s.spes[0].cycles.branch_taken_miss = 2;
  Diagnostic broken;
  broken.rule = Rule::transfer_size;
  broken.spe = 3;
  broken.command = 17;
  broken.cycle = 1234;
  broken.ea = 0x7FFFABCD1230;
  broken.text = "SPE 3: get 20 bytes, LS 0x18080 <- EA 0x7fffabcd1230";
  broken.site = {"/where/it/was/built/stream.hpp", 33};
  s.diagnostics.push_back(broken);
  broken.spe = Diagnostic::kPpe;
  s.diagnostics.push_back(broken);

  const std::string text = to_json(s);
  CHECK(text.find("abcd") == std::string::npos);
  CHECK(text.find("built") == std::string::npos);
  const auto json = nlohmann::json::parse(text);
  CHECK(json["schedule"] == "lockstep");
  CHECK(json["seed"] == 0xFFFFFFFFFFFFFFFF);
  CHECK(json["cycles"] == nlohmann::json{{"prepare", 5}, {"render", 6}});
  CHECK(json["spes"][0]["cycles"]["total_cycle"] == 6);
  CHECK(json["spes"][0]["cycles"]["branch_taken_miss"] == 2);
  const auto& first = json["diagnostics"][0];
  CHECK(first["rule"] == name_of(Rule::transfer_size));
  CHECK(first["text"] == text_of(Rule::transfer_size));
  CHECK(first["by"] == "SPE 3");
  CHECK(first["command"] == 17);
  CHECK(first["cycle"] == 1234);
  CHECK(first["file"] == "stream.hpp");
  CHECK(first["line"] == 33);
  CHECK(json["diagnostics"][1]["by"] == "PPE");

  const std::string document = statistics_document();
  for (const auto& [key, value] : first.items()) {
    CAPTURE(key);
    CHECK(document.find("`" + key + "`") != std::string::npos);
  }
}

namespace {

/// A report in which every count is another number.
kernel::ReportRecord numbered(std::uint64_t first) {
  kernel::ReportRecord r{};
  for (std::uint64_t* const count : {&r.primary_rays, &r.shadow_rays, &r.reflection_rays, &r.refraction_rays,
                                     &r.accelerator_visits, &r.dropped_rays, &r.pixel_bytes, &r.block_error})
    *count = ++first;
  for (std::uint32_t* const count :
       {&r.packets, &r.exchanges, &r.units_received, &r.busy_ticks, &r.spilled_nodes})
    *count = static_cast<std::uint32_t>(++first);
  for (std::uint64_t& tests : r.tests)
    tests = ++first;
  for (int kind = 0; kind < 4; ++kind) {
    r.cache_hits[kind] = ++first;
    r.cache_misses[kind] = ++first;
  }
  return r;
}

} // namespace

TEST_CASE("What SPEs report is summed up, count by count") {
  const std::vector<kernel::ReportRecord> reports = {numbered(1000), numbered(5000)};
  MachineConfig config;
  config.spes = 2;
  const auto machine = make_machine(config);
  kernel::FrameBlock frame{};
  frame.width = 33;
  frame.height = 17;
  frame.object_count = 77;
  frame.purpose = static_cast<std::uint32_t>(kernel::FramePurpose::blocks);
  std::vector<SpeStatistics> spes(2);
  spes[0].module_fetches = 3;
  spes[1].module_fetches = 4;
  spes[0].module_bytes = 30;
  spes[1].module_bytes = 50;
  spes[0].module_cycles = 20;
  spes[1].module_cycles = 10;
  spes[0].cycles.total_cycle = 40;
  spes[1].cycles.total_cycle = 80;
  RenderStatistics s;
  collect(s, *machine, frame, reports, spes);
  const auto sum = [](std::uint64_t number) { return 6000 + 2 * number; };
  CHECK(s.width == 33);
  CHECK(s.height == 17);
  CHECK(s.objects == 77);
  CHECK(s.primary_rays == sum(1));
  CHECK(s.shadow_rays == sum(2));
  CHECK(s.reflection_rays == sum(3));
  CHECK(s.refraction_rays == sum(4));
  CHECK(s.accelerator_visits == sum(5));
  CHECK(s.dropped_rays == sum(6));
  CHECK(s.pixel_bytes == sum(7));
  CHECK(s.block_error == sum(8));
  CHECK(s.balance_exchanges == sum(10));
  CHECK(s.balance_units_moved == sum(11));
  CHECK(s.spilled_packets == sum(13));
  CHECK(s.packet_tests.at("sphere") == sum(14));
  std::uint64_t tests = 0;
  for (const auto& [name, count] : s.packet_tests)
    tests += count;
  std::uint64_t expected = 0;
  for (std::uint64_t kind = 0; kind < s.packet_tests.size(); ++kind)
    expected += sum(14 + kind);
  CHECK(tests == expected);
  const std::uint64_t cache = 14 + std::size(reports[0].tests);
  const RenderStatistics::Cache* const caches[] = {&s.list_cache, &s.object_cache, &s.material_cache,
                                                   &s.light_cache};
  for (std::uint64_t kind = 0; kind < 4; ++kind) {
    CHECK(caches[kind]->hits == sum(cache + 2 * kind));
    CHECK(caches[kind]->misses == sum(cache + 2 * kind + 1));
  }
  CHECK(s.module_fetches == 7);
  CHECK(s.module_bytes == 80);
  CHECK(s.module_cycles == 30);
  CHECK(s.module_share == 0.25);
  CHECK(s.render_cycles == 80);
  REQUIRE(s.spes.size() == 2);
  CHECK(s.spes[0].rays == 4010);
  CHECK(s.spes[1].packets == 5009);
  CHECK(s.spes[1].exchanges == 5010);
  CHECK(s.spes[1].busy_ticks == 5012);
  CHECK(s.spes[0].cycles.total_cycle == 40);

  // With antialiasing there is a point more than pixels each way.
  frame.sampling.method = static_cast<std::uint32_t>(kernel::SamplingMethod::adaptive);
  frame.purpose = 0;
  RenderStatistics sampled;
  collect(sampled, *machine, frame, reports, spes);
  CHECK(sampled.width == 32);
  CHECK(sampled.height == 16);
  CHECK_FALSE(sampled.block_error);

  // Of several frames, before they become statistics.
  std::vector<kernel::ReportRecord> two = {numbered(100), numbered(200)};
  add(two, reports);
  RenderStatistics more;
  collect(more, *machine, frame, two, spes);
  RenderStatistics alone;
  const std::vector<kernel::ReportRecord> hundreds = {numbered(100), numbered(200)};
  collect(alone, *machine, frame, hundreds, spes);
  CHECK(more.primary_rays == sampled.primary_rays + alone.primary_rays);
  CHECK(more.shadow_rays == sampled.shadow_rays + alone.shadow_rays);
  CHECK(more.reflection_rays == sampled.reflection_rays + alone.reflection_rays);
  CHECK(more.refraction_rays == sampled.refraction_rays + alone.refraction_rays);
  CHECK(more.accelerator_visits == sampled.accelerator_visits + alone.accelerator_visits);
  CHECK(more.dropped_rays == sampled.dropped_rays + alone.dropped_rays);
  CHECK(more.pixel_bytes == sampled.pixel_bytes + alone.pixel_bytes);
  CHECK(two[0].block_error == 100 + 1000 + 2 * 8);
  CHECK(more.spes[0].packets == 100 + 1000 + 2 * 9);
  CHECK(more.balance_exchanges == sampled.balance_exchanges + alone.balance_exchanges);
  CHECK(more.balance_units_moved == sampled.balance_units_moved + alone.balance_units_moved);
  CHECK(more.spes[1].busy_ticks == 200 + 5000 + 2 * 12);
  CHECK(more.spilled_packets == sampled.spilled_packets + alone.spilled_packets);
  for (const auto& [shape, count] : more.packet_tests)
    CHECK(count == sampled.packet_tests.at(shape) + alone.packet_tests.at(shape));
  CHECK(more.list_cache.hits == sampled.list_cache.hits + alone.list_cache.hits);
  CHECK(more.light_cache.misses == sampled.light_cache.misses + alone.light_cache.misses);
}

TEST_CASE("Statistics of accelerators") {
  MachineConfig config;
  config.spes = 1;
  const auto machine = make_machine(config);
  kernel::FrameBlock frame{};
  frame.object_count = 10;
  frame.accelerator = static_cast<std::uint32_t>(kernel::AcceleratorKind::bvh);
  frame.bvh.node_count = 5;
  RenderStatistics tree;
  collect(tree, *machine, frame, {}, {});
  CHECK(tree.accelerator == Accelerator::bvh);
  CHECK(tree.bvh_nodes == 5);
  CHECK(tree.accelerator_list_entries == 10);
  CHECK(tree.accelerator_bytes == 5 * sizeof(kernel::NodeRecord) + 40);
  CHECK(tree.grid_cells[0] == 0);
  frame.accelerator = static_cast<std::uint32_t>(kernel::AcceleratorKind::grid);
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    frame.grid.cells[axis] = 2 + axis;
  frame.grid.row_of_cells = 6;
  frame.grid.list_count = 9;
  RenderStatistics grid;
  collect(grid, *machine, frame, {}, {});
  CHECK(grid.accelerator == Accelerator::grid);
  CHECK(grid.bvh_nodes == 0);
  CHECK(grid.grid_cells[0] == 2);
  CHECK(grid.grid_cells[1] == 3);
  CHECK(grid.grid_cells[2] == 4);
  CHECK(grid.accelerator_list_entries == 9);
  CHECK(grid.accelerator_bytes == 6 * 4 * sizeof(kernel::CellRecord) + 36);
}

TEST_CASE("Pictures in blocks have a signal-to-noise ratio, caches a hit rate") {
  RenderStatistics s;
  CHECK_FALSE(s.block_psnr());
  s.width = 4;
  s.height = 3;
  s.block_error = 0;
  CHECK(std::isinf(*s.block_psnr()));
  s.block_error = 36 * 255 * 255 / 100;
  CHECK(*s.block_psnr() == Approx(20).epsilon(1e-6));
  CHECK(RenderStatistics::Cache{}.hit_rate() == 0);
  CHECK(RenderStatistics::Cache{3, 1}.hit_rate() == 0.75);
}

TEST_CASE("Statistics as JSON have each number at its key") {
  RenderStatistics s;
  std::uint64_t last = 0;
  for (std::uint64_t* const count : {&s.seed,
                                     &s.objects,
                                     &s.primary_rays,
                                     &s.shadow_rays,
                                     &s.reflection_rays,
                                     &s.refraction_rays,
                                     &s.dropped_rays,
                                     &s.spilled_packets,
                                     &s.accelerator_visits,
                                     &s.accelerator_list_entries,
                                     &s.accelerator_bytes,
                                     &s.stale_lines,
                                     &s.dma_commands,
                                     &s.dma_list_elements,
                                     &s.dma_bytes_read,
                                     &s.dma_bytes_written,
                                     &s.pixel_bytes,
                                     &s.signals,
                                     &s.mailbox_words,
                                     &s.module_fetches,
                                     &s.module_bytes,
                                     &s.module_cycles,
                                     &s.balance_exchanges,
                                     &s.balance_units_moved,
                                     &s.prepare_cycles,
                                     &s.render_cycles,
                                     &s.stages.jobs,
                                     &s.stages.searches,
                                     &s.stages.primary_hits,
                                     &s.stages.primary_reprocessed,
                                     &s.stages.primary_hits_reprocessed,
                                     &s.stages.returns})
    *count = ++last;
  for (std::uint32_t* const count :
       {&s.stages.generators, &s.stages.shaders, &s.stages.searchers, &s.stages.testers, &s.grid_cells[0],
        &s.grid_cells[1], &s.grid_cells[2], &s.bvh_nodes})
    *count = static_cast<std::uint32_t>(++last);
  for (RenderStatistics::Cache* const cache :
       {&s.list_cache, &s.object_cache, &s.material_cache, &s.light_cache}) {
    cache->hits = ++last;
    cache->misses = 3 * cache->hits;
  }
  s.width = 101;
  s.height = 102;
  s.build_seconds = 0.5;
  s.prepare_seconds = 0.25;
  s.render_seconds = 0.125;
  s.module_share = 0.75;
  s.imbalance = 1.5;
  s.backend = Backend::cell_emu;
  s.model = Model::pipeline_split;
  s.spu = "an SPU";
  s.accelerator = Accelerator::bvh;
  s.preparation = RenderStatistics::Preparation::refitted;
  s.packet_tests = {{"sphere", 7}};
  s.spes.resize(1);
  s.spes[0].rays = 201;
  s.spes[0].packets = 202;
  s.spes[0].exchanges = 203;
  s.spes[0].busy_ticks = 204;
  s.spes[0].local_store_peak = 205;
  using nlohmann::json;
  json found = json::parse(to_json(s));
  CHECK(found["spes"][0].erase("cycles") == 1);
  CHECK(found == json::parse(R"({
    "backend": "cell_emu", "model": "pipeline-split", "spu": "an SPU", "schedule": "free", "seed": 1,
    "width": 101, "height": 102, "objects": 2,
    "seconds": {"build": 0.5, "prepare": 0.25, "render": 0.125}, "cycles": {"prepare": 25, "render": 26},
    "rays": {"primary": 3, "shadow": 4, "reflection": 5, "refraction": 6, "total": 18, "dropped": 7,
             "spilled_packets": 8},
    "packet_tests": {"sphere": 7},
    "accelerator": {"kind": "bvh", "cells": [37, 38, 39], "nodes": 40, "list_entries": 10, "bytes": 11,
                    "bytes_per_object": 5.5, "visits": 9, "preparation": "refitted", "stale_lines": 12},
    "cache": {"list": {"hits": 41, "misses": 123, "hit_rate": 0.25},
              "object": {"hits": 42, "misses": 126, "hit_rate": 0.25},
              "material": {"hits": 43, "misses": 129, "hit_rate": 0.25},
              "light": {"hits": 44, "misses": 132, "hit_rate": 0.25}},
    "dma": {"commands": 13, "list_elements": 14, "bytes_read": 15, "bytes_written": 16, "pixel_bytes": 17},
    "blocks": {"psnr": null}, "communication": {"signals": 18, "mailbox_words": 19},
    "modules": {"fetches": 20, "bytes": 21, "cycles": 22, "share_of_cycles": 0.75},
    "balance": {"exchanges": 23, "units_moved": 24, "imbalance": 1.5},
    "stages": {"generators": 33, "shaders": 34, "searchers": 35, "testers": 36, "jobs": 27, "searches": 28,
               "primary_hits": 29, "primary_reprocessed": 30, "primary_hits_reprocessed": 31, "returns": 32},
    "spes": [{"rays": 201, "packets": 202, "exchanges": 203, "busy_ticks": 204, "local_store_peak": 205}],
    "limits": [], "diagnostics": []})"));
  s.accelerator = Accelerator::grid;
  s.objects = 0;
  s.block_error = 0;
  s.preparation = RenderStatistics::Preparation::updated;
  found = json::parse(to_json(s));
  CHECK(found["accelerator"]["kind"] == "grid");
  CHECK(found["accelerator"]["bytes_per_object"] == 0);
  CHECK(found["accelerator"]["preparation"] == "updated");
  CHECK(found["blocks"]["psnr"].is_null());
  s.block_error = 101 * 102 * 3 * 255 * 255 / 100;
  CHECK(json::parse(to_json(s))["blocks"]["psnr"].get<double>() == Approx(20).epsilon(1e-4));
  CHECK(std::string(name_of(RenderStatistics::Preparation::built)) == "new");
  CHECK(std::string(name_of(RenderStatistics::Preparation::kept)) == "kept");
  CHECK(std::string(name_of(Model::shared)) == "shared");
  CHECK(std::string(name_of(Model::pipeline)) == "pipeline");
  CHECK(std::string(name_of(Model::offload)) == "offload");
}

TEST_CASE("Statistics of rows are added count by count") {
  const auto counts = [](RenderStatistics& s) {
    return std::vector<std::uint64_t*>{&s.primary_rays,
                                       &s.shadow_rays,
                                       &s.reflection_rays,
                                       &s.refraction_rays,
                                       &s.dropped_rays,
                                       &s.spilled_packets,
                                       &s.accelerator_visits,
                                       &s.dma_commands,
                                       &s.dma_list_elements,
                                       &s.dma_bytes_read,
                                       &s.dma_bytes_written,
                                       &s.pixel_bytes,
                                       &s.signals,
                                       &s.mailbox_words,
                                       &s.module_fetches,
                                       &s.module_bytes,
                                       &s.module_cycles,
                                       &s.balance_exchanges,
                                       &s.balance_units_moved,
                                       &s.prepare_cycles,
                                       &s.render_cycles,
                                       &s.list_cache.hits,
                                       &s.list_cache.misses,
                                       &s.object_cache.hits,
                                       &s.object_cache.misses,
                                       &s.material_cache.hits,
                                       &s.material_cache.misses,
                                       &s.light_cache.hits,
                                       &s.light_cache.misses,
                                       &s.prepare.total_cycle};
  };
  RenderStatistics sum, rows;
  std::uint64_t last = 0;
  for (std::uint64_t* const count : counts(sum))
    *count = ++last;
  for (std::uint64_t* const count : counts(rows))
    *count = 1000 * ++last;
  for (RenderStatistics* const s : {&sum, &rows}) {
    s->width = 9;
    s->height = s == &sum ? 3 : 4;
    s->build_seconds = s == &sum ? 1 : 2;
    s->prepare_seconds = s == &sum ? 4 : 8;
    s->render_seconds = s == &sum ? 16 : 32;
    s->packet_tests = {{"box", s == &sum ? 5u : 6u}};
    s->spes.resize(2);
    s->spes[0] = {10, 20, 30, 40, s == &sum ? 70u : 60u, {}};
    s->spes[1] = {50, 1, 2, 3, s == &sum ? 70u : 80u, {}};
    s->spes[0].cycles.total_cycle = 25000;
    s->diagnostics.resize(1);
  }
  add_rows(sum, rows);
  const std::size_t all = counts(sum).size();
  for (std::size_t i = 0; i < all; ++i) {
    CAPTURE(i);
    CHECK(*counts(sum)[i] == i + 1 + 1000 * (all + i + 1));
  }
  CHECK(sum.width == 9);
  CHECK(sum.height == 7);
  CHECK(sum.build_seconds == 3);
  CHECK(sum.prepare_seconds == 12);
  CHECK(sum.render_seconds == 48);
  CHECK(sum.packet_tests.at("box") == 11);
  CHECK(sum.spes[0].rays == 20);
  CHECK(sum.spes[0].packets == 40);
  CHECK(sum.spes[0].exchanges == 60);
  CHECK(sum.spes[0].busy_ticks == 80);
  CHECK(sum.spes[0].local_store_peak == 70);
  CHECK(sum.spes[1].local_store_peak == 80);
  CHECK(sum.spes[0].cycles.total_cycle == 50000);
  CHECK(sum.module_share == static_cast<double>(sum.module_cycles) / 50000);
  CHECK(sum.imbalance == Approx(100 / 60.0 - 1));
  CHECK(sum.diagnostics.size() == 2);
  CHECK_FALSE(sum.block_error);
  sum.block_error = 3;
  rows.block_error = 4;
  add_rows(sum, rows);
  CHECK(sum.block_error == 7u);
}

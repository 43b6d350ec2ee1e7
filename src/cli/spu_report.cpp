#include "cli/spu_report.hpp"

#include "render/spe_json.hpp"

#include <cinttypes>
#include <cstdarg>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

using Count = std::uint64_t SpuCycles::*;

/// Where every cycle is in one of them.
constexpr std::pair<const char*, Count> kCycles[] = {
    {"single cycle", &SpuCycles::single_cycle},
    {"dual cycle", &SpuCycles::dual_cycle},
    {"nop cycle", &SpuCycles::nop_cycle},
    {"stall due to dependency", &SpuCycles::stall_due_to_dependency},
    {"stall due to branch miss", &SpuCycles::stall_due_to_branch_miss},
    {"stall due to prefetch miss", &SpuCycles::stall_due_to_prefetch_miss},
    {"stall due to hint target", &SpuCycles::stall_due_to_hint_target},
    {"stall due to fp resource", &SpuCycles::stall_due_to_fp_resource},
    {"stall due to ls contention", &SpuCycles::stall_due_to_ls_contention},
    {"channel stall cycle", &SpuCycles::channel_stall_cycle},
    {"stall due to injection", &SpuCycles::stall_due_to_injection},
};

struct Unit {
  const char* name;
  Count instructions;
  Count dependency; ///< null: nobody waits for its results
};
constexpr Unit kUnits[] = {
    {"fx2", &SpuCycles::fx2, &SpuCycles::dependency_fx2},
    {"fx3", &SpuCycles::fx3, &SpuCycles::dependency_fx3},
    {"fxb", &SpuCycles::fxb, &SpuCycles::dependency_fxb},
    {"fp6", &SpuCycles::fp6, &SpuCycles::dependency_fp6},
    {"fp7", &SpuCycles::fp7, &SpuCycles::dependency_fp7},
    {"fpd", &SpuCycles::fpd, &SpuCycles::dependency_fpd},
    {"ls", &SpuCycles::ls, &SpuCycles::dependency_ls},
    {"shuf", &SpuCycles::shuf, &SpuCycles::dependency_shuf},
    {"br", &SpuCycles::br, &SpuCycles::dependency_br},
    {"hbr", &SpuCycles::hbr, nullptr},
    {"spr", &SpuCycles::spr, &SpuCycles::dependency_spr},
    {"nop", &SpuCycles::nop, nullptr},
};

[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

SpeStatistics sum_of(const std::vector<SpeStatistics>& spes) {
  SpeStatistics sum;
  for (const SpeStatistics& spe : spes) {
    sum.dma_commands += spe.dma_commands;
    sum.dma_list_elements += spe.dma_list_elements;
    sum.dma_bytes_read += spe.dma_bytes_read;
    sum.dma_bytes_written += spe.dma_bytes_written;
    sum.signals_sent += spe.signals_sent;
    sum.mailbox_words_sent += spe.mailbox_words_sent;
    sum.cycles += spe.cycles;
  }
  return sum;
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// For all SPEs and for each of them.
nlohmann::ordered_json traffic_json(const SpeStatistics& spe) {
  return {{"dma",
           {{"commands", spe.dma_commands},
            {"list_elements", spe.dma_list_elements},
            {"bytes_read", spe.dma_bytes_read},
            {"bytes_written", spe.dma_bytes_written}}},
          {"communication", {{"signals", spe.signals_sent}, {"mailbox_words", spe.mailbox_words_sent}}},
          {"cycles", cycles_json(spe.cycles)}};
}

} // namespace

std::string spu_summary(const SimulatedRun& run, const TimingParameters& timing) {
  const SpeStatistics sum = sum_of(run.spes);
  const SpuCycles& cycles = sum.cycles;
  std::string text;
  append(text, "%zu SPE%s, %.1f us at %.3f GHz\n", run.spes.size(), run.spes.size() == 1 ? "" : "s",
         static_cast<double>(run.cycles) / timing.clock_hz * 1e6, timing.clock_hz / 1e9);
  append(text, "%-28s %14" PRIu64 "\n", "total instructions", cycles.instructions());
  append(text, "%-28s %14.2f\n", "cycles an instruction", ratio(cycles.total_cycle, cycles.instructions()));
  for (const auto& [name, count] : kCycles)
    append(text, "%-28s %14" PRIu64 " %6.1f %%\n", name, cycles.*count,
           100 * ratio(cycles.*count, cycles.total_cycle));
  append(text, "%-28s %14" PRIu64 "  100.0 %%\n", "total cycle", cycles.total_cycle);
  append(text, "%-28s %14s %14s\n", "by unit", "instructions", "waited for");
  for (const Unit& unit : kUnits) {
    append(text, "  %-26s %14" PRIu64, unit.name, cycles.*unit.instructions);
    if (unit.dependency != nullptr) append(text, " %14" PRIu64, cycles.*unit.dependency);
    text += '\n';
  }
  append(text, "%-28s %14" PRIu64 "\n", "branches taken", cycles.branch_taken);
  append(text, "%-28s %14" PRIu64 "\n", "branches not foreseen", cycles.branch_taken_miss);
  append(text, "%-28s %14" PRIu64 "\n", "hints that were right", cycles.hint_hit);
  append(text, "%-28s %14" PRIu64 " (%" PRIu64 " bytes read, %" PRIu64 " written)\n", "DMA commands",
         sum.dma_commands, sum.dma_bytes_read, sum.dma_bytes_written);
  return text;
}

std::string spu_statistics(const SimulatedRun& run, const MachineConfig& config, double seconds) {
  nlohmann::ordered_json json = {
      {"backend", config.backend},
      {"schedule", config.emulation.schedule == Schedule::lockstep ? "lockstep" : "free"},
      {"seed", config.emulation.seed},
      {"seconds", {{"run", seconds}}},
      {"elapsed_cycles", run.cycles}};
  json.update(traffic_json(sum_of(run.spes)));
  json["spes"] = nlohmann::ordered_json::array();
  for (std::size_t spe = 0; spe < run.spes.size(); ++spe) {
    nlohmann::ordered_json entry = {{"exit_code", run.exit_codes[spe]},
                                    {"error", run.errors[spe]},
                                    {"local_store_peak", run.spes[spe].local_store_peak}};
    entry.update(traffic_json(run.spes[spe]));
    json["spes"].push_back(std::move(entry));
  }
  json["diagnostics"] = nlohmann::ordered_json::array();
  for (const Diagnostic& diagnostic : run.diagnostics)
    json["diagnostics"].push_back(diagnostic_json(diagnostic));
  return json.dump(2) + "\n";
}

} // namespace celltrace::cli

#include "cli/spu_report.hpp"

#include "render/spe_json.hpp"

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

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

/// Returns the traffic of an SPE, or of all SPEs.
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

std::string spu_statistics(const SimulatedRun& run, const MachineConfig& config, double seconds) {
  nlohmann::ordered_json json = {
      {"backend", name_of(config.backend)},
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

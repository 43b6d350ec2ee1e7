#include "cli/emulation_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"

#include <charconv>
#include <cstdint>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

namespace {

/// The first of the options that was given; null if none was.
const char* first_given(const EmulationTexts& texts) {
  if (!texts.schedule.empty()) return "--schedule";
  if (!texts.seed.empty()) return "--seed";
  if (!texts.transfers.empty()) return "--transfers";
  if (texts.faults) return "--faults";
  if (!texts.timing.empty()) return "--timing";
  if (!texts.trace.empty()) return "--trace";
  if (!texts.cache_trace.empty()) return "--cache-trace";
  return nullptr;
}

Schedule schedule_of(const EmulationTexts& texts) {
  if (texts.schedule.empty()) return texts.trace.empty() ? Schedule::free : Schedule::lockstep;
  if (texts.schedule == "free" && !texts.trace.empty())
    throw InputError("--trace needs --schedule lockstep: only there do all SPEs share one virtual time");
  return texts.schedule == "lockstep" ? Schedule::lockstep : Schedule::free;
}

TransferTime transfers_of(const EmulationTexts& texts) {
  if (texts.transfers == "issue") return TransferTime::at_issue;
  if (texts.transfers == "random") return TransferTime::random;
  return TransferTime::at_wait;
}

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, seed);
  if (error != std::errc() || end != last)
    throw InputError("--seed: '" + text + "' is not a whole number from 0 to 2^64 - 1");
  return seed;
}

} // namespace

void add_emulation_options(CLI::App& command, EmulationTexts& texts) {
  add_choice(command, "--schedule", texts.schedule, {{"free", "lockstep"}, {}},
             "cell_emu: SPEs run as they like (default), or in turns that can be repeated");
  command
      .add_option("--seed", texts.seed,
                  "cell_emu: what random transfers and faults, and the turns of lockstep, are drawn from; "
                  "without it, lockstep goes by virtual time")
      ->type_name("N");
  add_choice(command, "--transfers", texts.transfers, {{"issue", "wait", "random"}, {}},
             "cell_emu: when the data of a DMA command move; default: wait");
  command.add_flag("--faults", texts.faults, "cell_emu: slow SPEs, pauses and delays at random");
  add_choice(command, "--timing", texts.timing, {{"cell", "ps3"}, {}},
             "cell_emu: the machine that is modelled, with 8 (default) or 6 SPEs");
  command.add_option("--trace", texts.trace, "cell_emu: write what happened as a Chrome trace, in lockstep")
      ->type_name("FILE.json");
  command
      .add_option("--cache-trace", texts.cache_trace,
                  "cell_emu: write what the software caches are asked for; see celltrace replay")
      ->type_name("FILE");
}

EmulationConfig emulation_config(const EmulationTexts& texts, const std::string& backend) {
  if (const char* given = first_given(texts); given && backend != "cell_emu" && backend != "cell_sim")
    throw InputError(std::string(given) + " needs --backend cell_emu");
  EmulationConfig config;
  config.schedule = schedule_of(texts);
  config.transfers = transfers_of(texts);
  if (texts.faults) config.faults = Faults::mixed();
  if (texts.timing == "ps3") config.timing = TimingParameters::playstation_3();
  if (!texts.seed.empty()) {
    config.seed = parse_seed(texts.seed);
    config.explore = config.schedule == Schedule::lockstep;
    if (!config.explore && !texts.faults && config.transfers != TransferTime::random)
      throw InputError(
          "--seed needs --schedule lockstep, --transfers random or --faults: nothing else is drawn");
  }
  return config;
}

} // namespace celltrace::cli

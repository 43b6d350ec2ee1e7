#include "cli/emulation_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"

#include <charconv>
#include <cstdint>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

namespace {

/// Returns the first of these options that was given; null if none was.
const char* first_given(const EmulationTexts& texts) {
  if (!texts.schedule.empty()) return "--schedule";
  if (!texts.seed.empty()) return "--seed";
  if (!texts.transfers.empty()) return "--transfers";
  if (texts.faults) return "--faults";
  if (!texts.timing.empty()) return "--timing";
  if (!texts.cycle_limit.empty()) return "--limit";
  if (!texts.seconds_limit.empty()) return "--seconds-limit";
  if (!texts.trace.empty()) return "--trace";
  if (!texts.cache_trace.empty()) return "--cache-trace";
  return nullptr;
}

Schedule schedule_of(const EmulationTexts& texts, Schedule default_schedule) {
  if (texts.schedule.empty()) return texts.trace.empty() ? default_schedule : Schedule::lockstep;
  if (texts.schedule == "free" && !texts.trace.empty())
    throw InputError("--trace needs --schedule lockstep: only there do all SPEs share one virtual time");
  return texts.schedule == "lockstep" ? Schedule::lockstep : Schedule::free;
}

TransferTime transfers_of(const EmulationTexts& texts) {
  if (texts.transfers == "issue") return TransferTime::at_issue;
  if (texts.transfers == "random") return TransferTime::random;
  return TransferTime::at_wait;
}

/// Parses a number; returns false if the text is anything else.
template <class Number> bool parse(const std::string& text, Number& number) {
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last;
}

std::uint64_t parse_whole(const char* option, const std::string& text) {
  std::uint64_t number = 0;
  if (!parse(text, number))
    throw InputError(std::string(option) + ": '" + text + "' is not a whole number from 0 to 2^64 - 1");
  return number;
}

double parse_seconds(const char* option, const std::string& text) {
  double seconds = 0;
  if (!parse(text, seconds) || !(seconds >= 0 && seconds <= 1e9))
    throw InputError(std::string(option) + ": '" + text + "' is not a number of seconds from 0 to 1e9");
  return seconds;
}

} // namespace

void add_emulation_options(CLI::App& command, EmulationTexts& texts, Schedule default_schedule) {
  const std::string defaults = default_schedule == Schedule::free ? "free" : "lockstep";
  add_choice(
      command, "--schedule", texts.schedule, {{"free", "lockstep"}, {}},
      "free: SPEs run in parallel; lockstep: SPEs take turns in an order that can be repeated; default: " +
          defaults);
  command
      .add_option("--seed", texts.seed,
                  "Seed of random transfers and faults, and of the turns of lockstep; without it, the SPE "
                  "that is behind in virtual time has the next turn")
      ->type_name("N");
  add_choice(command, "--transfers", texts.transfers, {{"issue", "wait", "random"}, {}},
             "When the data of a DMA command move: at its issue, at the wait for it, or at random; default: "
             "wait");
  command.add_flag("--faults", texts.faults, "Inject slow SPEs, pauses and delays at random");
  add_choice(command, "--timing", texts.timing, {{"cell", "ps3"}, {}},
             "The machine that is modelled, with 8 (default) or 6 SPEs");
  command
      .add_option("--limit", texts.cycle_limit,
                  "Virtual cycles after which a program is stopped, with an error that says where it was; 0: "
                  "no limit")
      ->type_name("CYCLES");
  command
      .add_option(
          "--seconds-limit", texts.seconds_limit,
          "Seconds of this computer after which a program is stopped, as by --limit; may be a fraction")
      ->type_name("SECONDS");
  command
      .add_option("--trace", texts.trace, "Write the events of the run as a Chrome trace; only in lockstep")
      ->type_name("FILE.json");
}

void add_cache_trace_option(CLI::App& command, EmulationTexts& texts) {
  command
      .add_option("--cache-trace", texts.cache_trace,
                  "Write all accesses to the software caches, for celltrace replay")
      ->type_name("FILE");
}

EmulationConfig emulation_config(const EmulationTexts& texts, Backend backend, Schedule default_schedule) {
  if (!texts.cache_trace.empty() && backend != Backend::cell_emu)
    throw InputError("--cache-trace needs --backend cell_emu: machine code records nothing");
  if (const char* given = first_given(texts); given && backend == Backend::native)
    throw InputError(std::string(given) + " needs --backend cell_emu or cell_sim");
  EmulationConfig config;
  config.schedule = schedule_of(texts, default_schedule);
  config.transfers = transfers_of(texts);
  if (texts.faults) config.faults = Faults::mixed();
  if (texts.timing == "ps3") config.timing = TimingParameters::playstation_3();
  if (!texts.cycle_limit.empty()) config.cycle_limit = parse_whole("--limit", texts.cycle_limit);
  if (!texts.seconds_limit.empty())
    config.seconds_limit = parse_seconds("--seconds-limit", texts.seconds_limit);
  if (texts.lenient) config.actions = lenient_actions();
  if (!texts.seed.empty()) {
    config.seed = parse_whole("--seed", texts.seed);
    config.explore = config.schedule == Schedule::lockstep;
    if (!config.explore && !texts.faults && config.transfers != TransferTime::random)
      throw InputError(
          "--seed needs --schedule lockstep, --transfers random or --faults: nothing else is drawn");
  }
  return config;
}

} // namespace celltrace::cli

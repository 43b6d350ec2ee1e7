#include "cli/machine_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>
#include <vector>

namespace celltrace::cli {

namespace {

template <class E> using Named = std::pair<const char*, E>;

constexpr Named<Balance> kBalances[] = {{"gde", Balance::gde},
                                        {"diffusion", Balance::diffusion},
                                        {"static", Balance::fixed},
                                        {"scatter", Balance::scatter},
                                        {"tiles", Balance::tiles}};
constexpr Named<Accelerator> kAccelerators[] = {
    {"auto", Accelerator::automatic}, {"grid", Accelerator::grid}, {"bvh", Accelerator::bvh}};
constexpr Model kModels[] = {Model::shared, Model::pipeline, Model::pipeline_split, Model::offload};
constexpr Named<CacheReplacement> kReplacements[] = {
    {"random", CacheReplacement::random}, {"fifo", CacheReplacement::fifo}, {"lru", CacheReplacement::lru}};

template <class E, std::size_t N> std::vector<std::string> names(const Named<E> (&table)[N]) {
  std::vector<std::string> list;
  for (const auto& [name, value] : table)
    list.emplace_back(name);
  return list;
}
template <class E, std::size_t N> std::vector<std::string> names(const E (&all)[N]) {
  std::vector<std::string> list;
  for (const E each : all)
    list.emplace_back(name_of(each));
  return list;
}

/// Returns the entry with this name; null if there is none.
template <class E, std::size_t N> const E* find(const Named<E> (&table)[N], const std::string& name) {
  const auto found = std::find_if(table, table + N, [&](const Named<E>& each) { return name == each.first; });
  return found == table + N ? nullptr : &found->second;
}

std::uint32_t parse_size(const std::string& digits, const std::string& text) {
  std::uint32_t value = 0;
  const char* const last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (error != std::errc() || end != last)
    throw InputError("--cache: '" + text + "' is neither WAYSxSETS[:random|fifo|lru] nor off");
  return value;
}

} // namespace

void add_machine_options(CLI::App& command, RenderOptions& options, MachineTexts& texts) {
  add_choice(command, "--backend", texts.backend, {names(kBackends), {"spu"}},
             "What renders: native: threads; cell_emu: an emulated Cell; cell_sim: a Cell whose SPUs execute "
             "machine code");
  command
      .add_option("--spes", options.spes,
                  "Number of SPEs; default: on native one per hardware thread, else that of --timing")
      ->check(CLI::Range(1u, 256u));
  add_choice(command, "--simd", texts.simd, {names(kSimdLevels), {}},
             "Instruction set that native uses; auto: the widest of this computer");
  command.add_option("--cache", texts.cache, "Software cache: WAYSxSETS[:random|fifo|lru], or off")
      ->type_name("CACHE")
      ->capture_default_str();
  add_choice(
      command, "--accelerator", texts.accelerator, {names(kAccelerators), {}},
      "How rays find objects: by a uniform grid or a BVH; auto: the BVH, for pipeline models the grid");
  add_choice(
      command, "--balance", texts.balance, {names(kBalances), {}},
      "How SPEs share a frame. gde: strips that exchange work; diffusion: strips that change between frames; "
      "static: fixed strips; scatter: bundles of packets in turn; tiles: tiles at random");
  add_choice(command, "--model", texts.model, {names(kModels), {}},
             "Programming model. shared: each SPE does all steps; else SPEs divide the steps");
  // The following options are for emulated machines only.
  CLI::Option_group& emulation = *command.add_option_group("cell_emu and cell_sim only");
  add_emulation_options(emulation, texts.emulation, Schedule::free);
  add_cache_trace_option(emulation, texts.emulation);
}

void finish_machine(RenderOptions& options, const MachineTexts& texts, Schedule default_schedule) {
  options.backend = backend_named(texts.backend);
  options.simd = simd_level_named(texts.simd);
  options.cache = parse_cache(texts.cache);
  // CLI11 has rejected all other names.
  options.balance = *find(kBalances, texts.balance);
  options.accelerator = *find(kAccelerators, texts.accelerator);
  options.model = *std::find_if(std::begin(kModels), std::end(kModels),
                                [&](Model model) { return texts.model == name_of(model); });
  options.emulation = emulation_config(texts.emulation, options.backend, default_schedule);
}

CacheConfig parse_cache(const std::string& text) {
  CacheConfig cache;
  if (text == "off") {
    cache.enabled = false;
    return cache;
  }
  const std::string sizes = text.substr(0, text.find(':'));
  const std::size_t by = std::min(sizes.find('x'), sizes.size());
  cache.ways = parse_size(sizes.substr(0, by), text);
  cache.sets = parse_size(sizes.substr(std::min(by + 1, sizes.size())), text);
  if (sizes.size() < text.size()) {
    const std::string policy = text.substr(sizes.size() + 1);
    const CacheReplacement* const replacement = find(kReplacements, policy);
    if (replacement == nullptr) throw InputError("--cache: '" + policy + "' is none of random, fifo, lru");
    cache.replacement = *replacement;
  }
  if (!cache.valid())
    throw InputError("--cache: '" + text +
                     "' is no cache: ways and sets have to be powers of two, and at most " +
                     std::to_string(CacheConfig::kMaxLines) + " lines");
  return cache;
}

} // namespace celltrace::cli

#include "backends/cell_emu/simulator/append.hpp"
#include "celltrace/simulator.hpp"

#include <cinttypes>

namespace celltrace {
namespace {

using Count = std::uint64_t SpuCycles::*;

/// Counters whose sum is the number of all cycles.
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
  Count dependency; ///< null: no instruction waits for results of this unit
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

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

std::string counters_text(const EmulatedRun& run, const TimingParameters& timing) {
  SpuCycles cycles;
  std::uint64_t commands = 0, bytes_read = 0, bytes_written = 0;
  for (const SpeStatistics& spe : run.spes) {
    cycles += spe.cycles;
    commands += spe.dma_commands;
    bytes_read += spe.dma_bytes_read;
    bytes_written += spe.dma_bytes_written;
  }
  std::string text;
  cell_emu::append(text, "%zu SPE%s, %.1f us at %.3f GHz\n", run.spes.size(), run.spes.size() == 1 ? "" : "s",
                   static_cast<double>(run.cycles) / timing.clock_hz * 1e6, timing.clock_hz / 1e9);
  cell_emu::append(text, "%-28s %14" PRIu64 "\n", "total instructions", cycles.instructions());
  cell_emu::append(text, "%-28s %14.2f\n", "cycles an instruction",
                   ratio(cycles.total_cycle, cycles.instructions()));
  for (const auto& [name, count] : kCycles)
    cell_emu::append(text, "%-28s %14" PRIu64 " %6.1f %%\n", name, cycles.*count,
                     100 * ratio(cycles.*count, cycles.total_cycle));
  cell_emu::append(text, "%-28s %14" PRIu64 "  100.0 %%\n", "total cycle", cycles.total_cycle);
  cell_emu::append(text, "%-28s %14s %14s\n", "by unit", "instructions", "waited for");
  for (const Unit& unit : kUnits) {
    cell_emu::append(text, "  %-26s %14" PRIu64, unit.name, cycles.*unit.instructions);
    if (unit.dependency != nullptr) cell_emu::append(text, " %14" PRIu64, cycles.*unit.dependency);
    text += '\n';
  }
  cell_emu::append(text, "%-28s %14" PRIu64 "\n", "branches taken", cycles.branch_taken);
  cell_emu::append(text, "%-28s %14" PRIu64 "\n", "branches not foreseen", cycles.branch_taken_miss);
  cell_emu::append(text, "%-28s %14" PRIu64 "\n", "hints that were right", cycles.hint_hit);
  cell_emu::append(text, "%-28s %14" PRIu64 " (%" PRIu64 " bytes read, %" PRIu64 " written)\n",
                   "DMA commands", commands, bytes_read, bytes_written);
  return text;
}

} // namespace celltrace

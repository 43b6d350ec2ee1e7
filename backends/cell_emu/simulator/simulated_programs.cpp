#include "backends/cell_emu/simulator/simulated_programs.hpp"

#include "celltrace/spe/byte_order.hpp"
#include "celltrace/spe/control_block.hpp"

#include <algorithm>
#include <bit>

namespace celltrace {

FieldList<&ControlBlock::argument, &ControlBlock::addresses, &ControlBlock::id, &ControlBlock::count,
          &ControlBlock::image>
fields_of(const ControlBlock&);

namespace cell_emu {
namespace {

constexpr std::size_t kMaxSpes = 256;

/// Argument speid of the first SPE's program. Any value but 0 would do.
constexpr std::uint64_t kFirstSpeId = 0x10000000;

/// Time since 1970 at which virtual time begins, for programs that ask for the time: a day in 2007.
constexpr std::chrono::seconds kFirstSecond{1167609600};

} // namespace

struct alignas(kLineBytes) SimulatedPrograms::Block {
  ControlBlock control;
  SpeAddresses addresses[kMaxSpes];
};

SimulatedPrograms::SimulatedPrograms(const MachineConfig& config, const AddressMap& map)
    : blocks_(std::make_unique<Block[]>(map.spes())), map_(map), arguments_(config.simulation.arguments),
      calls_(calls_config(config, map)) {
  for (unsigned spe = 0; spe < map.spes(); ++spe)
    for (unsigned other = 0; other < map.spes(); ++other) {
      blocks_[spe].addresses[other] = map.addresses(other);
      reorder(blocks_[spe].addresses[other], std::endian::big);
    }
}

SimulatedPrograms::~SimulatedPrograms() = default;

PpeCallsConfig SimulatedPrograms::calls_config(const MachineConfig& config, const AddressMap& map) {
  PpeCallsConfig calls;
  calls.standard_output = config.simulation.output;
  calls.standard_error = config.simulation.error_output;
  calls.standard_input = config.simulation.input;
  calls.more_input = config.simulation.more_input;
  calls.folders = config.simulation.allowed_folders;
  calls.effective_memory = [&map](std::uint64_t ea, std::uint64_t bytes) -> std::uint8_t* {
    if (bytes > kLocalStoreBytes) return nullptr;
    const AddressMap::Place place = map.locate(ea, static_cast<std::uint32_t>(bytes));
    return place.kind == EaKind::local_store ? reinterpret_cast<std::uint8_t*>(ea) : nullptr;
  };
  calls.clock = [this, hertz = config.emulation.timing.clock_hz] {
    const double seconds = static_cast<double>(time_of_call_.load()) / hertz;
    return kFirstSecond + std::chrono::microseconds(static_cast<std::int64_t>(seconds * 1e6));
  };
  return calls;
}

bool SimulatedPrograms::call(unsigned code, std::uint8_t* local_store, std::uint32_t npc, Cycle now) {
  time_of_call_ = now;
  return calls_.handle(code, local_store, npc);
}

std::shared_ptr<const SimulatedProgram> SimulatedPrograms::find(const SpeProgram& program) {
  std::span<const std::uint8_t> image = program.image(SimulatedSpu::kKey);
  const Convention convention = image.empty() ? Convention::stand_alone : Convention::kernel;
  if (image.empty()) image = program.image(SimulatedSpu::kElfKey);
  if (image.empty())
    throw SpeError("program \"" + program.name() +
                   "\" has no machine code for cell_sim: was it built without spu-elf-g++?");
  const auto same = [&](const auto& known) {
    const std::span<const std::uint8_t> its = known->elf().image();
    return known->convention() == convention &&
           std::equal(its.begin(), its.end(), image.begin(), image.end());
  };
  const auto found = std::find_if(programs_.begin(), programs_.end(), same);
  if (found != programs_.end()) return *found;
  programs_.push_back(std::make_shared<SimulatedProgram>(image, convention));
  return programs_.back();
}

StartRegisters SimulatedPrograms::arguments(const SimulatedProgram& program, unsigned spe, ea_t argument) {
  const ea_t local_store = map_.addresses(spe).local_store;
  if (program.convention() == Convention::stand_alone) {
    if (fetches_argv(program.elf())) return arguments_.for_fetching(local_store);
    const ea_t argp = arguments_.has_any() ? arguments_.ppe_argv() : argument;
    return StartRegisters::of(kFirstSpeId + spe, argp, local_store);
  }
  Block& block = blocks_[spe];
  block.control = {argument, to_ea(block.addresses), spe, map_.spes(), to_ea(program.elf().image().data())};
  reorder(block.control, std::endian::big);
  return StartRegisters::of(kFirstSpeId + spe, to_ea(&block.control), local_store);
}

} // namespace cell_emu
} // namespace celltrace

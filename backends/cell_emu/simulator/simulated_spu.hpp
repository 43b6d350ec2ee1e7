// SimulatedSpu: the SPU that executes machine code. It fetches, issues and executes instructions from its
// local store; SpuCore implements its channels and clock, as for host code.
#pragma once

#include "backends/cell_emu/isa/instruction.hpp"
#include "backends/cell_emu/simulator/early_loads.hpp"
#include "backends/cell_emu/simulator/issue_model.hpp"
#include "backends/cell_emu/simulator/program_arguments.hpp"
#include "backends/cell_emu/simulator/simulated_program.hpp"
#include "backends/cell_emu/spu_core.hpp"
#include "celltrace/spe/simulation.hpp"

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace celltrace::cell_emu {

/// The SPU during one run of a program on one SPE. Thread safety: belongs to the thread that runs the SPE.
class SimulatedSpu final : public SpuCore, private isa::Environment {
public:
  static constexpr const char* kKey = "cell_sim";
  /// The key of a stand-alone program's image.
  static constexpr const char* kElfKey = "elf";

  /// Executes a call that the PPE has to execute; see PpeCalls::handle(). Returns false if the code is no
  /// such call.
  using CallPpe = std::function<bool(unsigned code, std::uint8_t* local_store, std::uint32_t npc, Cycle now)>;

  /// Makes the SPU. The program must have been loaded. `profile` may be null.
  SimulatedSpu(Spe& spe, const SpuContext& context, const SimulatedProgram& program, CallPpe call_ppe,
               SpuProfile* profile);
  ~SimulatedSpu() override { mfc_.watch_flights(nullptr); }

  /// Executes the program from its entry on, until it throws: SpeExit at its end, or as SpuCore does.
  [[noreturn]] void run(const StartRegisters& registers);
  void finish();
  void abandon();

private:
  // --- Environment ---
  std::uint32_t read_channel(unsigned channel) override;
  void write_channel(unsigned channel, std::uint32_t value) override;
  std::uint32_t channel_count(unsigned channel) override;
  void stop(std::uint32_t code) override;
  void halt() override;
  void invalid_instruction(std::uint32_t word) override;
  bool has_event() override;
  void enable_interrupts(bool enabled) override;
  std::uint32_t srr0() override { return srr0_; }
  void watched_load(std::uint32_t lsa) override;
  void watched_store(std::uint32_t lsa, const isa::Quadword& value) override;

  template <bool profiled> void run_slice();
  // For the profile: record() counts the present instruction; record_cycles() counts all cycles since its
  // last call as the present instruction's.
  void record();
  void record_cycles();
  void flush_profile();
  const isa::Instruction& fetch(std::uint32_t pc);
  const isa::Instruction& decode_again(std::uint32_t pc, std::uint32_t word);
  /// Between two instructions: checks limits, takes interrupts, and lets other SPEs have their turns.
  void attend();
  void take_interrupt();
  void hint(const isa::Instruction& instruction, std::uint32_t pc);
  void look_for_early_use(const isa::Instruction& instruction);
  void check_stack();
  void call_ppe(std::uint32_t code);

  /// Advances the clock to the last issued instruction.
  void settle();
  /// Executes a channel access or a stop, during which virtual time may pass. Settles the clock before, and
  /// advances the issue model by the time that has passed.
  template <class Access> auto access(Access use);
  const CallSite& site_of(std::uint32_t pc);
  std::string place_of(std::uint32_t pc);
  [[noreturn]] void fail_at(std::uint32_t pc, Rule rule, const std::string& what);

  const SimulatedProgram& program_;
  const CallPpe call_ppe_;
  SpuProfile* const profile_;
  isa::State state_of_spu_;
  std::vector<isa::Instruction> decoded_; ///< index: word of local store
  std::vector<std::uint8_t> watch_;       ///< index: quadword of local store
  EarlyLoads early_loads_;
  IssueModel model_;
  std::uint32_t left_in_slice_ = 0; ///< instructions until attend()
  std::uint64_t dma_bytes_seen_ = 0;
  std::int32_t stack_left_ = -1; ///< free bytes of the stack by register 1; negative: unknown
  std::uint32_t lowest_stack_ = kLocalStoreBytes;
  std::unordered_map<std::uint32_t, CallSite> sites_;
  std::vector<SpuProfile::Word> words_; ///< counts for the profile
  struct {
    std::uint32_t pc = 0;
    bool issued = false; ///< issued and not yet recorded
    bool paired = false; ///< issued with the instruction before
  } executing_;
  Cycle profiled_until_ = 0;
  Cycle waited_ = 0; ///< cycles that the present instruction spent at a channel
};

} // namespace celltrace::cell_emu

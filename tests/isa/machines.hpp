// The interpreter and the reference behind one face, to be held against each other.
#pragma once

#include "isa/reference.hpp"

#include "backends/cell_emu/isa/instruction.hpp"
#include "backends/cell_emu/isa/state.hpp"

namespace celltrace::test {

/// Answers and records as the reference does. What is watched in the local store is recorded too.
class World final : public isa::Environment {
public:
  Answers answers;
  std::vector<Effect> effects;
  std::optional<std::uint32_t> loaded, stored; ///< addresses of watched quadwords
  Register stored_value;

  std::uint32_t read_channel(unsigned channel) override;
  void write_channel(unsigned channel, std::uint32_t value) override;
  std::uint32_t channel_count(unsigned channel) override;
  void stop(std::uint32_t code) override;
  void halt() override;
  void invalid_instruction(std::uint32_t word) override;
  bool has_event() override;
  void enable_interrupts(bool enabled) override;
  std::uint32_t srr0() override;
  void watched_load(std::uint32_t lsa) override;
  void watched_store(std::uint32_t lsa, const isa::Quadword& value) override;
};

class Machine {
public:
  virtual ~Machine() = default;

  virtual const char* name() const = 0;
  virtual Register gpr(unsigned number) const = 0;
  virtual void set_gpr(unsigned number, const Register& value) = 0;
  virtual Register fpscr() const = 0;
  virtual void set_fpscr(const Register& value) = 0;
  virtual std::uint8_t* local_store() = 0;
  virtual Answers& answers() = 0;

  virtual void execute(std::uint32_t pc, std::uint32_t word) = 0;
  /// Of the last instruction.
  virtual std::uint32_t next() const = 0;
  virtual const std::vector<Effect>& effects() const = 0;
};

class ReferenceMachine final : public Machine {
public:
  const char* name() const override { return "reference"; }
  Register gpr(unsigned number) const override { return reference.gpr[number]; }
  void set_gpr(unsigned number, const Register& value) override { reference.gpr[number] = value; }
  Register fpscr() const override { return reference.fpscr; }
  void set_fpscr(const Register& value) override { reference.fpscr = value; }
  std::uint8_t* local_store() override { return reference.local_store.data(); }
  Answers& answers() override { return reference.answers; }
  void execute(std::uint32_t pc, std::uint32_t word) override;
  std::uint32_t next() const override { return reference.next; }
  const std::vector<Effect>& effects() const override { return reference.effects; }

  Reference reference;
};

class InterpreterMachine final : public Machine {
public:
  InterpreterMachine();
  InterpreterMachine(const InterpreterMachine&) = delete;
  InterpreterMachine& operator=(const InterpreterMachine&) = delete;

  const char* name() const override { return "interpreter"; }
  Register gpr(unsigned number) const override;
  void set_gpr(unsigned number, const Register& value) override;
  Register fpscr() const override;
  void set_fpscr(const Register& value) override;
  std::uint8_t* local_store() override { return local_store_.data(); }
  Answers& answers() override { return world.answers; }
  void execute(std::uint32_t pc, std::uint32_t word) override;
  std::uint32_t next() const override { return state.next; }
  const std::vector<Effect>& effects() const override { return world.effects; }

  /// Of the quadword at the address; bits of isa::State.
  void watch(std::uint32_t address, std::uint8_t accesses) { watch_[address >> 4] = accesses; }

  isa::State state;
  World world;

private:
  std::vector<std::uint8_t> local_store_ = std::vector<std::uint8_t>(kLocalStoreSize);
  std::vector<std::uint8_t> watch_ = std::vector<std::uint8_t>(kLocalStoreSize / 16);
};

} // namespace celltrace::test

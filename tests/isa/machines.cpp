#include "isa/machines.hpp"

namespace celltrace::test {

namespace {

Register register_of(const isa::Quadword& quadword) {
  Register result;
  quadword.store(result.bytes.data());
  return result;
}

} // namespace

std::uint32_t World::read_channel(unsigned channel) {
  effects.push_back({Effect::read_channel, channel});
  return answers.channel_value;
}

void World::write_channel(unsigned channel, std::uint32_t value) {
  effects.push_back({Effect::write_channel, channel, value});
}

std::uint32_t World::channel_count(unsigned channel) {
  effects.push_back({Effect::count_channel, channel});
  return answers.channel_count;
}

void World::stop(std::uint32_t code) {
  effects.push_back({Effect::stop, code});
}

void World::halt() {
  effects.push_back({Effect::halt});
}

void World::invalid_instruction(std::uint32_t word) {
  effects.push_back({Effect::invalid, word});
}

bool World::has_event() {
  return answers.event;
}

void World::enable_interrupts(bool enabled) {
  effects.push_back({Effect::interrupts, 0, enabled});
}

std::uint32_t World::srr0() {
  return answers.srr0;
}

void World::watched_load(std::uint32_t lsa) {
  loaded = lsa;
}

void World::watched_store(std::uint32_t lsa, const isa::Quadword& value) {
  stored = lsa;
  stored_value = register_of(value);
}

void ReferenceMachine::execute(std::uint32_t pc, std::uint32_t word) {
  reference.pc = pc;
  reference.execute(word);
}

InterpreterMachine::InterpreterMachine() {
  state.local_store = local_store_.data();
  state.watch = watch_.data();
  state.environment = &world;
}

Register InterpreterMachine::gpr(unsigned number) const {
  return register_of(state.gpr[number]);
}

void InterpreterMachine::set_gpr(unsigned number, const Register& value) {
  state.gpr[number] = isa::Quadword::load(value.bytes.data());
}

Register InterpreterMachine::fpscr() const {
  return register_of(state.fpscr);
}

void InterpreterMachine::set_fpscr(const Register& value) {
  state.fpscr = isa::Quadword::load(value.bytes.data());
}

void InterpreterMachine::execute(std::uint32_t pc, std::uint32_t word) {
  world.effects.clear();
  world.loaded.reset();
  world.stored.reset();
  state.pc = pc;
  state.next = (pc + 4) & isa::kLocalStoreLimit;
  const isa::Instruction instruction = isa::decode(word);
  instruction.execute(state, instruction);
}

} // namespace celltrace::test

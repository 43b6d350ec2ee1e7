#include "sdk/simulated_instruction.hpp"

#include "backends/cell_emu/machine.hpp"

#include <catch2/catch.hpp>

#include <cstdio>
#include <random>

namespace celltrace::test {
namespace {

constexpr std::uint32_t kEdgeWords[] = {
    0x00000000, 0x80000000, 0x3F800000, 0xBF800000, 0x7FFFFFFF, 0xFFFFFFFF, 0x7F800000, 0xFF800000,
    0x00800000, 0x80800000, 0x007FFFFF, 0x807FFFFF, 0x00000001, 0x3F7FFFFF, 0x3F800001, 0x4EFFFFFF,
    0x4F000000, 0xCF000000, 0x4F7FFFFF, 0x4F800000, 0x33800000, 0x7F7FFFFF, 0x80000001, 0x00007FFF,
    0x0000FFFF, 0x00010000, 0x7FFF8000, 0x12345678, 0x00FF00FF, 0x01010101, 0xC0DEC0DE, 0x0000001F,
};
constexpr std::uint64_t kEdgeDoubles[] = {
    0x0000000000000000, 0x8000000000000000, 0x3FF0000000000000, 0xBFF0000000000000, 0x7FF0000000000000,
    0xFFF0000000000000, 0x7FF8000000000000, 0x7FF0000000000001, 0x0010000000000000, 0x000FFFFFFFFFFFFF,
    0x8000000000000001, 0x7FEFFFFFFFFFFFFF, 0x3FF0000000000001, 0x4340000000000000, 0x3CA0000000000000,
};

// Where what lies in local store.
constexpr std::uint32_t kTables = 0x1000, kTableBytes = 0x2000;
constexpr std::uint32_t kTableA = kTables, kTableB = kTableA + kTableBytes, kTableC = kTableB + kTableBytes,
                        kResults = kTableC + kTableBytes, kStatus = kResults + kTableBytes;

std::vector<Operands> make_operand_sets() {
  std::vector<Operands> sets;
  std::mt19937 random(20);
  const auto any = [&] { return static_cast<unsigned>(random()); };
  const auto edge = [&] { return kEdgeWords[random() % std::size(kEdgeWords)]; };
  const auto edge_double = [&] { return kEdgeDoubles[random() % std::size(kEdgeDoubles)]; };
  // Numbers near one, whose sums and products are not all out of range.
  const auto near_one = [&] { return 0x3F000000u + any() % 0x01800000u + (any() & 0x80000000u); };
  const auto near_double = [&] {
    return 0x3FE0000000000000u + (std::uint64_t{any()} << 21) + any() + (std::uint64_t{any() & 1u} << 63);
  };
  const auto of = [](auto word) {
    vec_uint4 words;
    for (unsigned i = 0; i < 4; ++i)
      words[i] = word();
    return qword(words);
  };
  const auto of_doubles = [](auto bits) { return qword(vec_ullong2{bits(), bits()}); };
  const auto small = [&] { return any() % 80 - 8; };
  const auto bytes = [&] { return any() & 0x1F1F1F1Fu; };
  for (unsigned i = 0; i < 60; ++i)
    sets.push_back({of(edge), of(edge), of(edge)});
  for (unsigned i = 0; i < 30; ++i) {
    sets.push_back({of(near_one), of(near_one), of(near_one)});
    sets.push_back({of_doubles(edge_double), of_doubles(edge_double), of_doubles(edge_double)});
    sets.push_back({of_doubles(near_double), of_doubles(near_double), of_doubles(near_double)});
    sets.push_back({of(any), of(any), of(any)});
    sets.push_back({of(any), of(small), of(bytes)});
  }
  return sets;
}

void append(Code& code, const qword& value) {
  const vec_uint4 words(value);
  for (unsigned i = 0; i < 4; ++i)
    code.word(words[i]);
}

qword at(const std::uint8_t* local_store) {
  return qword(sdk::Quadword::load(local_store));
}

} // namespace

const std::vector<Operands>& operand_sets() {
  static const std::vector<Operands> sets = make_operand_sets();
  return sets;
}

std::string text_of(const qword& value) {
  const vec_uint4 words(value);
  char text[36];
  std::snprintf(text, sizeof text, "%08x %08x %08x %08x", words[0], words[1], words[2], words[3]);
  return text;
}

SimulatedRegisters::SimulatedRegisters() {
  MachineConfig config;
  config.backend = "cell_sim";
  config.spes = 1;
  config.emulation.schedule = Schedule::lockstep;
  config.emulation.cycle_limit = 10'000'000;
  machine_ = cell_emu::make_machine(config);
}

Results SimulatedRegisters::execute(const Code& instructions) {
  const auto& sets = operand_sets();
  REQUIRE(16 * sets.size() <= kTableBytes);
  constexpr std::uint32_t kIndex = 2, kBases = 20, kEnd = 24, kDone = 25, kZero = 26, kRead = 27;
  Code code;
  code.add("il", {.rt = kZero}).add("fscrwr", {.ra = kZero}).add("il", {.rt = kIndex});
  const std::uint32_t bases[] = {kTableA, kTableB, kTableC, kResults};
  for (std::uint32_t i = 0; i < 4; ++i)
    code.add("ila", {.rt = kBases + i, .immediate = static_cast<std::int32_t>(bases[i])});
  code.add("ila", {.rt = kEnd, .immediate = static_cast<std::int32_t>(16 * sets.size())});
  const std::uint32_t loop = code.here();
  code.add("lqx", {.rt = kRa, .ra = kBases, .rb = kIndex});
  code.add("lqx", {.rt = kRb, .ra = kBases + 1, .rb = kIndex});
  code.add("lqx", {.rt = kRc, .ra = kBases + 2, .rb = kIndex});
  code.add("ori", {.rt = kRt, .ra = kRc});
  code.append(instructions);
  code.add("stqx", {.rt = kRt, .ra = kBases + 3, .rb = kIndex});
  code.add("ai", {.rt = kIndex, .ra = kIndex, .immediate = 16});
  code.add("ceq", {.rt = kDone, .ra = kIndex, .rb = kEnd});
  const auto back = (static_cast<std::int32_t>(loop) - static_cast<std::int32_t>(code.here())) / 4;
  code.add("brz", {.rt = kDone, .immediate = back});
  code.add("fscrrd", {.rt = kRead});
  code.add("stqa", {.rt = kRead, .immediate = static_cast<std::int32_t>(kStatus / 4)});
  code.exit();
  REQUIRE(code.here() <= kTables);
  for (const auto& [base, operand] :
       {std::pair{kTableA, &Operands::a}, {kTableB, &Operands::b}, {kTableC, &Operands::c}}) {
    code.fill_to(base);
    for (const Operands& each : sets)
      append(code, each.*operand);
  }
  code.fill_to(kStatus + 16);

  const Bytes elf = code.elf();
  SpeProgram program("instructions");
  program.add_image("elf", elf);
  machine_->start(0, program, 0);
  REQUIRE(machine_->wait(0).code == 0);
  const auto* const local_store =
      reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(machine_->addresses(0).local_store));
  Results results;
  for (std::uint32_t i = 0; i < sets.size(); ++i)
    results.rt.push_back(at(local_store + kResults + 16 * i));
  results.status = at(local_store + kStatus);
  return results;
}

} // namespace celltrace::test

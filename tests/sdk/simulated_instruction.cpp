#include "sdk/simulated_instruction.hpp"

#include "backends/cell_emu/machine.hpp"
#include "celltrace/spe/types.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <random>
#include <span>

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

// Where what lies in local store: code, the tables of operands, then for each code its results and the
// status.
constexpr std::uint32_t kTables = 0x2000, kTableBytes = 0xE00, kResults = kTables + 3 * kTableBytes,
                        kResultBytes = kTableBytes + 16;
constexpr std::size_t kCodesAtATime = 48;
static_assert(kResults + kCodesAtATime * kResultBytes <= kLocalStoreBytes);

constexpr std::uint32_t results_of(std::size_t code) {
  return kResults + static_cast<std::uint32_t>(code) * kResultBytes;
}

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

namespace {

// Registers besides those of operands.
constexpr std::uint32_t kIndex = 2, kBaseA = 20, kBaseB = 21, kBaseC = 22, kBaseResults = 23, kEnd = 24,
                        kDone = 25, kStatus = 27;

std::int32_t word_of(std::uint32_t value) {
  return static_cast<std::int32_t>(value);
}

/// A loop over the operand sets.
void append_loop(Code& code, const Code& instructions, std::uint32_t results) {
  code.add("il", {.rt = kIndex}).add("fscrwr", {.ra = kIndex});
  code.add("ila", {.rt = kBaseResults, .immediate = word_of(results)});
  const std::uint32_t loop = code.here();
  code.add("lqx", {.rt = kRa, .ra = kBaseA, .rb = kIndex});
  code.add("lqx", {.rt = kRb, .ra = kBaseB, .rb = kIndex});
  code.add("lqx", {.rt = kRc, .ra = kBaseC, .rb = kIndex});
  code.add("ori", {.rt = kRt, .ra = kRc});
  code.append(instructions);
  code.add("stqx", {.rt = kRt, .ra = kBaseResults, .rb = kIndex});
  code.add("ai", {.rt = kIndex, .ra = kIndex, .immediate = 16});
  code.add("ceq", {.rt = kDone, .ra = kIndex, .rb = kEnd});
  code.add("brz", {.rt = kDone, .immediate = (word_of(loop) - word_of(code.here())) / 4});
  code.add("fscrrd", {.rt = kStatus});
  code.add("ila", {.rt = kBaseResults, .immediate = word_of(results + kTableBytes)});
  code.add("stqd", {.rt = kStatus, .ra = kBaseResults});
}

Code program_of(std::span<const Code> codes) {
  const auto& sets = operand_sets();
  REQUIRE(16 * sets.size() <= kTableBytes);
  Code code;
  code.add("ila", {.rt = kBaseA, .immediate = word_of(kTables)});
  code.add("ila", {.rt = kBaseB, .immediate = word_of(kTables + kTableBytes)});
  code.add("ila", {.rt = kBaseC, .immediate = word_of(kTables + 2 * kTableBytes)});
  code.add("ila", {.rt = kEnd, .immediate = static_cast<std::int32_t>(16 * sets.size())});
  for (std::size_t i = 0; i < codes.size(); ++i)
    append_loop(code, codes[i], results_of(i));
  code.exit();
  REQUIRE(code.here() <= kTables);
  std::uint32_t table = kTables;
  for (const auto operand : {&Operands::a, &Operands::b, &Operands::c}) {
    code.fill_to(table);
    for (const Operands& each : sets)
      append(code, each.*operand);
    table += kTableBytes;
  }
  return code;
}

} // namespace

std::vector<Results> execute_simulated(const std::vector<Code>& codes) {
  MachineConfig config;
  config.backend = Backend::cell_sim;
  config.spes = 1;
  config.emulation.schedule = Schedule::lockstep;
  config.emulation.cycle_limit = 100'000'000;
  const auto machine = cell_emu::make_machine(config);
  std::vector<Results> all;
  for (std::size_t first = 0; first < codes.size(); first += kCodesAtATime) {
    const auto some = std::span(codes).subspan(first, std::min(kCodesAtATime, codes.size() - first));
    const Bytes elf = program_of(some).elf();
    SpeProgram program("instructions");
    program.add_image("elf", elf);
    machine->start(0, program, 0);
    REQUIRE(machine->wait(0).code == 0);
    const auto* const local_store =
        reinterpret_cast<const std::uint8_t*>(static_cast<std::uintptr_t>(machine->addresses(0).local_store));
    for (std::size_t i = 0; i < some.size(); ++i) {
      Results& results = all.emplace_back();
      for (std::uint32_t set = 0; set < operand_sets().size(); ++set)
        results.rt.push_back(at(local_store + results_of(i) + 16 * set));
      results.status = at(local_store + results_of(i) + kTableBytes);
    }
  }
  return all;
}

} // namespace celltrace::test

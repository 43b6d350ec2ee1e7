#include "backends/cell_emu/simulator/profile_report.hpp"

#include "backends/cell_emu/isa/instruction.hpp"
#include "backends/cell_emu/simulator/append.hpp"
#include "celltrace/simulator.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdlib>
#include <memory>

#include <cxxabi.h>
#include <nlohmann/json.hpp>

namespace celltrace::cell_emu {
namespace {

using Counts = SpuProfile::Word;

struct Count {
  const char* name;
  std::uint64_t Counts::*member;
};
constexpr Count kCounts[] = {{"hits", &Counts::hits}, {"cycles", &Counts::cycles}, {"dual", &Counts::dual}};
/// Cycles of each cause of delays.
constexpr Count kReasons[] = {
    {"dependency", &Counts::dependency},       {"branch_miss", &Counts::branch_miss},
    {"prefetch_miss", &Counts::prefetch_miss}, {"hint_target", &Counts::hint_target},
    {"fp_resource", &Counts::fp_resource},     {"channel", &Counts::channel}};

/// Largest distance in bytes between words without symbols that are reported as one function.
constexpr std::uint32_t kLargestGap = 128;

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Returns a C++ name as in its source.
std::string demangled(const char* name) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(abi::__cxa_demangle(name, nullptr, nullptr, &status),
                                                         &std::free);
  return status == 0 && text != nullptr ? text.get() : name;
}

std::string file_of(const CodePlace& place) {
  const std::string_view file(place.file);
  return std::string(file.substr(file.find_last_of('/') + 1)) + ":" + std::to_string(place.line);
}

/// Returns a disassembled instruction in columns, without the disassembler's remarks.
std::string instruction_text(const Counts& word, std::uint32_t lsa) {
  const std::string text = isa::disassemble(word.instruction, lsa);
  const std::size_t tab = text.find('\t');
  if (tab == std::string::npos) return text;
  std::string mnemonic = text.substr(0, tab);
  mnemonic.resize(std::max<std::size_t>(8, tab + 1), ' ');
  return mnemonic + text.substr(tab + 1, text.find('\t', tab + 1) - tab - 1);
}

std::string reasons_text(const Counts& word) {
  std::string text;
  for (const auto& [name, member] : kReasons) {
    if (word.*member == 0) continue;
    if (!text.empty()) text += ", ";
    text += std::string(name) + " " + std::to_string(word.*member);
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

nlohmann::ordered_json counts_json(const Counts& word) {
  nlohmann::ordered_json json;
  for (const auto& [name, member] : kCounts)
    json[name] = word.*member;
  for (const auto& [name, member] : kReasons)
    json[name] = word.*member;
  return json;
}

} // namespace

ProfileSum& ProfileSum::operator+=(const Counts& more) {
  for (const auto& [name, member] : kCounts)
    word.*member += more.*member;
  for (const auto& [name, member] : kReasons)
    word.*member += more.*member;
  return *this;
}

double ProfileSum::cycles_per_instruction() const {
  return word.hits == 0 ? 0 : static_cast<double>(word.cycles) / static_cast<double>(word.hits);
}

double ProfileSum::paired() const {
  return word.hits == 0 ? 0 : 2 * static_cast<double>(word.dual) / static_cast<double>(word.hits);
}

ProfileReport::ProfileReport(const SpuProfile& profile, const SpuElf& elf)
    : words_(profile.words()), places_(elf) {
  words_.resize(SpuProfile::kWords);
  sort_into_functions();
}

std::string ProfileReport::name_of(const FunctionSymbol* function, std::uint32_t lsa) const {
  if (function != nullptr) return demangled(function->name);
  std::string name;
  append(name, "LS 0x%05" PRIx32, lsa);
  return name;
}

void ProfileReport::sort_into_functions() {
  const FunctionSymbol* last = nullptr;
  for (std::uint32_t lsa = 0; lsa < 4 * SpuProfile::kWords; lsa += 4) {
    if (word_at(lsa).hits == 0) continue;
    const FunctionSymbol* const function = places_.symbols().function_at(lsa);
    const bool is_new = functions_.empty() || function != last ||
                        (function == nullptr && lsa - functions_.back().words.back() > kLargestGap);
    if (is_new)
      functions_.push_back({name_of(function, lsa), function != nullptr ? function->lsa : lsa, {}, {}});
    functions_.back().words.push_back(lsa);
    functions_.back().sum += word_at(lsa);
    total_ += word_at(lsa);
    last = function;
  }
  std::stable_sort(functions_.begin(), functions_.end(),
                   [](const auto& a, const auto& b) { return a.sum.word.cycles > b.sum.word.cycles; });
}

std::uint64_t ProfileReport::pairs_of(std::uint32_t lsa) const {
  return (lsa & 4) == 0 ? word_at(lsa + 4).dual : word_at(lsa).dual;
}

void ProfileReport::append_table(std::string& text) const {
  append(text,
         "%" PRIu64 " cycles, %" PRIu64
         " instructions, %.2f cycles an instruction, %.1f %% issued in pairs\n\n",
         total_.word.cycles, total_.word.hits, total_.cycles_per_instruction(), 100 * total_.paired());
  text += "                                                     cycles lost, % of the function's\n";
  text += "       cycles      %  instructions    CPI paired     dep   miss  fetch   hint     dp   wait  "
          "function\n";
  for (const ProfiledFunction& function : functions_) {
    const Counts& sum = function.sum.word;
    append(text, "%13" PRIu64 " %6.2f %13" PRIu64 " %6.2f %5.1f%% ", sum.cycles,
           percent(sum.cycles, total_.word.cycles), sum.hits, function.sum.cycles_per_instruction(),
           100 * function.sum.paired());
    for (const auto& [name, member] : kReasons)
      append(text, " %6.1f", percent(sum.*member, sum.cycles));
    text += "  " + function.name + "\n";
  }
  text += "\ndep: results that were not there; miss: branches that were not foreseen; fetch: instructions "
          "that were not\n"
          "there; hint: late hints; dp: double precision; wait: channels (DMA, mailboxes, ..., calls of the "
          "PPE)\n";
}

void ProfileReport::append_instruction(std::string& text, std::uint32_t lsa) const {
  const Counts& word = word_at(lsa);
  const std::uint64_t pairs = pairs_of(lsa);
  const char mark = pairs == 0 ? ' ' : 2 * pairs >= word.hits ? 'D' : 'd';
  const char pipe = isa::is_even(isa::decode(word.instruction).unit) ? '0' : '1';
  std::string line;
  append(line, "  %05" PRIx32 " %c%c %13" PRIu64 " %13" PRIu64 "  %-30s", lsa, pipe, mark, word.hits,
         word.cycles, instruction_text(word, lsa).c_str());
  const std::string reasons = reasons_text(word);
  if (!reasons.empty()) line += "  " + reasons;
  line.erase(line.find_last_not_of(' ') + 1);
  text += line + "\n";
}

void ProfileReport::append_listing(std::string& text, const ProfiledFunction& function) const {
  append(text, "\n%s: %" PRIu64 " cycles, %.2f %%\n", function.name.c_str(), function.sum.word.cycles,
         percent(function.sum.word.cycles, total_.word.cycles));
  text += "     LS pipe        hits        cycles  instruction\n";
  std::string last_place;
  std::uint32_t expected = function.words.front();
  for (const std::uint32_t lsa : function.words) {
    if (lsa != expected) append(text, "  ... not executed: %" PRIu32 "\n", (lsa - expected) / 4);
    expected = lsa + 4;
    const CodePlace place = places_.at(lsa);
    const std::string where = place.file == nullptr ? "" : file_of(place);
    if (where != last_place) text += where + "\n";
    last_place = where;
    append_instruction(text, lsa);
  }
}

std::string ProfileReport::text(double listed) const {
  std::string text;
  append_table(text);
  const double enough = listed * static_cast<double>(total_.word.cycles);
  std::uint64_t shown = 0;
  for (const ProfiledFunction& function : functions_) {
    if (static_cast<double>(shown) >= enough) break;
    append_listing(text, function);
    shown += function.sum.word.cycles;
  }
  return text;
}

std::string ProfileReport::json() const {
  nlohmann::ordered_json functions = nlohmann::ordered_json::array();
  for (const ProfiledFunction& function : functions_) {
    nlohmann::ordered_json instructions = nlohmann::ordered_json::array();
    for (const std::uint32_t lsa : function.words) {
      const CodePlace place = places_.at(lsa);
      nlohmann::ordered_json instruction = {{"address", lsa},
                                            {"text", isa::disassemble(word_at(lsa).instruction, lsa)},
                                            {"file", place.file == nullptr ? "" : place.file},
                                            {"line", place.line}};
      instruction.update(counts_json(word_at(lsa)));
      instructions.push_back(std::move(instruction));
    }
    nlohmann::ordered_json entry = {{"name", function.name}, {"address", function.lsa}};
    entry.update(counts_json(function.sum.word));
    entry["instructions"] = std::move(instructions);
    functions.push_back(std::move(entry));
  }
  nlohmann::ordered_json json = counts_json(total_.word);
  json["functions"] = std::move(functions);
  return json.dump(2);
}

} // namespace celltrace::cell_emu

namespace celltrace {

std::string profile_text(const SpuProfile& profile, std::span<const std::uint8_t> elf, double listed) {
  return cell_emu::ProfileReport(profile, cell_emu::SpuElf(elf)).text(listed);
}

std::string profile_json(const SpuProfile& profile, std::span<const std::uint8_t> elf) {
  return cell_emu::ProfileReport(profile, cell_emu::SpuElf(elf)).json();
}

} // namespace celltrace

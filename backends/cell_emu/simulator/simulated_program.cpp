#include "backends/cell_emu/simulator/simulated_program.hpp"

#include <cstdio>
#include <cstdlib>
#include <cxxabi.h>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace celltrace::cell_emu {
namespace {

/// Diagnostics outlive machines and programs: the strings that they point to are kept, each once.
const char* keep(std::string text) {
  static std::mutex mutex;
  static std::set<std::string> kept;
  const std::lock_guard lock(mutex);
  return kept.insert(std::move(text)).first->c_str();
}

/// A C++ function without its parameters and template arguments, which would fill a page.
std::string short_name(const char* symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> demangled(
      abi::__cxa_demangle(symbol, nullptr, nullptr, &status), std::free);
  if (status != 0) return symbol;
  std::string name;
  int depth = 0;
  for (const char* c = demangled.get(); *c != 0; ++c) {
    if (*c == '<') ++depth;
    if (*c == '(' && depth == 0) break;
    if (depth == 0) name += *c;
    if (*c == '>') --depth;
  }
  // What is left in front is the type that a template returns.
  const std::size_t space = name.rfind(' ');
  return space == std::string::npos ? name : name.substr(space + 1);
}

} // namespace

SimulatedProgram::SimulatedProgram(std::span<const std::uint8_t> image, Convention convention)
    : elf_(image), places_(elf_), convention_(convention),
      has_abi_stack_(places_.symbols().value_of("_start").has_value() &&
                     places_.symbols().value_of("_end").has_value()) {
}

CallSite SimulatedProgram::site(std::uint32_t address) const {
  const CodePlace place = places_.at(address);
  CallSite site;
  if (place.line != 0) {
    site.file = keep(place.file);
    site.line = place.line;
  }
  char offset[16];
  std::snprintf(offset, sizeof offset, "+0x%x", static_cast<unsigned>(place.offset));
  if (place.function != nullptr) site.function = keep(short_name(place.function) + offset);
  return site;
}

} // namespace celltrace::cell_emu

#include "backends/cell_emu/simulator/simulated_program.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cxxabi.h>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace celltrace::cell_emu {
namespace {

/// Returns a copy of a string that lives as long as the process, because diagnostics outlive machines and
/// programs. Equal strings share one copy.
const char* keep(std::string text) {
  static std::mutex mutex;
  static std::set<std::string> kept;
  const std::lock_guard lock(mutex);
  return kept.insert(std::move(text)).first->c_str();
}

/// Returns the name of a C++ function without its parameters and template arguments, which would fill a page.
std::string without_arguments(std::string_view whole) {
  constexpr std::size_t kLongestName = 1000; // limit for malformed files
  std::string name;
  int depth = 0;
  for (const char c : whole) {
    if (c == '<') ++depth;
    if (c == '(' && depth == 0) break;
    if (depth == 0 && name.size() < kLongestName) name += c;
    if (c == '>') --depth;
  }
  return name;
}

std::string short_name(const char* symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> demangled(
      abi::__cxa_demangle(symbol, nullptr, nullptr, &status), std::free);
  if (status != 0) return symbol;
  const std::string name = without_arguments(demangled.get());
  // Demangled templates have their return type in front of the name.
  const std::size_t space = name.rfind(' ');
  return space == std::string::npos ? name : name.substr(space + 1);
}

std::string_view base_name(std::string_view file) {
  return file.substr(file.find_last_of('/') + 1);
}

/// Returns true for the compiler's own headers. They only wrap intrinsics, so that mistakes are in their
/// callers.
bool is_of_compiler(std::string_view file) {
  for (const std::string_view name : {"spu_internals.h", "spu_intrinsics.h", "spu_mfcio.h"})
    if (base_name(file) == name) return true;
  return file.find("/lib/gcc/") != std::string_view::npos;
}

/// A source line that is being executed, and its function.
struct Frame {
  const char* file = nullptr;
  std::uint32_t line = 0;
  std::string function;
};

/// Returns the frame of an instruction, and the frames that it was inlined into, the innermost first.
std::vector<Frame> frames_at(const CodePlaces& places, std::uint32_t address) {
  const CodePlace place = places.at(address);
  std::vector<Frame> frames(1);
  frames[0].file = place.file;
  frames[0].line = place.line;
  for (const InlinedCall& call : places.inlined_calls().at(address)) {
    frames.back().function = without_arguments(call.callee);
    frames.push_back({call.file, call.line, {}});
  }
  if (place.function != nullptr) {
    char offset[16];
    std::snprintf(offset, sizeof offset, "+0x%x", static_cast<unsigned>(place.offset));
    frames.back().function = short_name(place.function) + offset;
  }
  return frames;
}

} // namespace

SimulatedProgram::SimulatedProgram(std::span<const std::uint8_t> image, Convention convention)
    : elf_(image), places_(elf_), convention_(convention),
      has_abi_stack_(places_.symbols().value_of("_start").has_value() &&
                     places_.symbols().value_of("_end").has_value()) {
}

CallSite SimulatedProgram::site(std::uint32_t address) const {
  const std::vector<Frame> frames = frames_at(places_, address);
  auto frame = std::ranges::find_if(
      frames, [](const Frame& each) { return each.line != 0 && !is_of_compiler(each.file); });
  if (frame == frames.end()) frame = frames.begin();
  CallSite site;
  if (frame->line != 0) {
    site.file = keep(frame->file);
    site.line = frame->line;
  }
  std::string function = frame->function;
  if (function.empty() && std::next(frame) != frames.end()) function += '?';
  // More callers would fill a page. The last caller, the function that was really called, is always named.
  constexpr std::ptrdiff_t kMostCallers = 8;
  for (++frame; frame != frames.end(); ++frame) {
    if (frames.end() - frame > 1 && frame - frames.begin() > kMostCallers) {
      function += ", ...";
      frame = std::prev(frames.end());
    }
    // Appended piece by piece, because GCC 12 warns of overlapping copies in sums of literals and
    // temporaries.
    function += ", inlined from ";
    if (frame->line != 0) {
      function += base_name(frame->file);
      function += ':';
      function += std::to_string(frame->line);
    }
    if (!frame->function.empty()) function.append(" in ").append(frame->function);
  }
  if (!function.empty()) site.function = keep(function);
  return site;
}

} // namespace celltrace::cell_emu

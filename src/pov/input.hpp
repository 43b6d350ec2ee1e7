// The stack of sources being read: files, macro bodies and loop bodies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pov/quantity.hpp"
#include "pov/scanner.hpp"
#include "pov/token.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// An #if or #switch whose #end has not been read yet.
struct Conditional {
  bool is_switch = false;
  Location where;
};

/// The counter of a #for; a #while has none.
struct Counter {
  NameId name = 0;
  std::shared_ptr<Slot> slot;
  double last = 0;
  double step = 1;
};

/// An array's element that was passed to a macro as a parameter: it gets the parameter's value when the macro
/// ends.
struct ElementReference {
  std::shared_ptr<Array> array;
  std::size_t index = 0;
  std::shared_ptr<Slot> slot; ///< slot of the parameter
  Value value;                ///< value at the call
};

/// A source being read: the scanner of a file, or a recorded range of tokens.
struct Frame {
  enum class Kind { file, macro, loop };
  Kind kind = Kind::file;
  Location opened_at; ///< place of the #include, call or loop
  std::unique_ptr<Scanner> scanner;
  std::filesystem::path folder; ///< folder of the file
  TokenRange range;
  std::size_t position = 0;
  NameId macro_name = 0;
  std::vector<ElementReference> references; ///< macros only
  std::optional<Counter> counter;
  std::uint64_t iterations = 0; ///< loops only: number of iterations so far
  std::vector<Conditional> conditionals;
  std::vector<Token> put_back; ///< tokens to be read before the rest, in reverse order
};

/// The stack of frames, with the tokens put back in front of each. Does not know what tokens mean.
class Input {
public:
  void push(Frame frame) { frames_.push_back(std::move(frame)); }
  void pop() { frames_.pop_back(); }
  Frame& top() { return frames_.back(); }
  const Frame& top() const { return frames_.back(); }
  const std::vector<Frame>& frames() const { return frames_; }
  std::size_t depth() const { return frames_.size(); }

  /// Reads a token; at the end of the top frame, always Kind::end.
  Token read();
  bool reads_file() const { return top().put_back.empty() && top().scanner != nullptr; }
  /// Returns whether the next token comes from a recording.
  bool reads_record() const { return top().put_back.empty() && top().scanner == nullptr; }
  /// Returns whether the top frame is a macro with nothing left to read.
  bool is_exhausted() const;
  /// Puts a token back in front of the top frame, from which it came.
  void unread(const Token& token) { top().put_back.push_back(token); }

private:
  std::vector<Frame> frames_;
};

} // namespace celltrace::pov

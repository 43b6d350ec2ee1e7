// The stack of things being read: files, macro bodies and loop bodies.
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

/// An #if or #switch whose #end is still to come.
struct Conditional {
  bool is_switch = false;
  Location where;
};

/// What a #for counts with; a #while has none.
struct Counter {
  NameId name = 0;
  std::shared_ptr<Slot> slot;
  double last = 0;
  double step = 1;
};

/// An array's element that a macro has as a parameter: it gets the parameter's value when the macro ends.
struct ElementReference {
  std::shared_ptr<Array> array;
  std::size_t index = 0;
  std::shared_ptr<Slot> slot; ///< of the parameter
  Value value;                ///< that it had at first
};

/// One thing being read: the scanner of a file, or a recorded range.
struct Frame {
  enum class Kind { file, macro, loop };
  Kind kind = Kind::file;
  Location opened_at; ///< the #include, call or loop
  std::unique_ptr<Scanner> scanner;
  std::filesystem::path folder; ///< of the file
  TokenRange range;
  std::size_t position = 0;
  NameId macro_name = 0;
  std::vector<ElementReference> references; ///< of a macro
  std::optional<Counter> counter;
  std::uint64_t iterations = 0; ///< of a loop, so far
  std::vector<Conditional> conditionals;
  std::vector<Token> put_back; ///< in front of the rest, the next one last
};

/// The frames and the tokens put back in front of theirs. Knows nothing of what the tokens mean.
class Input {
public:
  void push(Frame frame) { frames_.push_back(std::move(frame)); }
  void pop() { frames_.pop_back(); }
  Frame& top() { return frames_.back(); }
  const Frame& top() const { return frames_.back(); }
  const std::vector<Frame>& frames() const { return frames_; }
  std::size_t depth() const { return frames_.size(); }

  /// Kind::end, and no further, at the end of the top frame.
  Token read();
  /// Whether the next token comes from a file.
  bool reads_file() const { return top().put_back.empty() && top().scanner != nullptr; }
  /// Whether it comes from what has been recorded.
  bool reads_record() const { return top().put_back.empty() && top().scanner == nullptr; }
  /// Whether the top frame is a macro with nothing left to read.
  bool is_exhausted() const;
  /// In the top frame, from which it came.
  void unread(const Token& token) { top().put_back.push_back(token); }

private:
  std::vector<Frame> frames_;
};

} // namespace celltrace::pov

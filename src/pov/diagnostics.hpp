// How a fault of the scene is reported.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "celltrace/pov.hpp"
#include "pov/input.hpp"
#include "pov/names.hpp"
#include "pov/sources.hpp"
#include "pov/texture.hpp"

namespace celltrace::pov {

/// What a scene calls a file or the like, in quotes, as a message can show it: not too long, and in one line.
std::string quoted_name(std::string_view name);

/// Throws SceneError for a scene that cannot be read, or has nothing in it.
[[noreturn]] void refuse_scene(const std::string& name, const std::string& what, const ParseOptions& options);

class Diagnostics {
public:
  Diagnostics(const Sources& sources, const Names& names, const Input& input, const ParseOptions& options)
      : sources_(sources), names_(names), input_(input), options_(options) {}

  /// "file:line:column"
  std::string place(const Location& where) const;

  /// Throws SceneError: what was not supported so far, then the place, the text and how it was reached.
  /// `details`: further lines about the fault.
  [[noreturn]] void fail(const Location& where, const std::string& what,
                         const std::vector<std::string>& details = {}) const;

  /// Throws SceneError: `who`, such as "the loops run", passes a limit, counted in `unit`.
  [[noreturn]] void exceed(const Location& where, std::uint64_t ParseLimits::*limit, const std::string& who,
                           const std::string& unit) const;

  /// Says "place: warning: text", or another kind of message.
  void warn(const Location& where, const std::string& what) const {
    say(Finding::Severity::warning, where, what);
  }
  /// The same, but no more than one warning a place, however often loops and macros come there.
  void warn_once(const Location& where, const std::string& what);
  void note(const Location& where, const std::string& what) const {
    say(Finding::Severity::note, where, what);
  }

  /// Whether all is supported that something at `used_at` needs; nothing at all for null. What is not has to
  /// be left out: each feature is noted for the error at the end, or warned of in lenient reading, once.
  bool supports(const UnsupportedPtr& unsupported, const Location& used_at);
  /// Throws SceneError if anything was noted.
  void require_supported() const;

private:
  Finding finding(Finding::Severity severity, const Location& where, const std::string& what) const;
  void keep(const Finding& finding) const;
  void say(Finding::Severity severity, const Location& where, const std::string& what) const;
  void note_unsupported(const Unsupported& unsupported, const Location& used_at);
  [[noreturn]] void refuse() const;
  std::vector<std::string> stack() const;

  const Sources& sources_;
  const Names& names_;
  const Input& input_;
  const ParseOptions& options_;
  std::set<std::string> unsupported_;                ///< the features noted or warned of
  std::set<std::array<std::uint32_t, 3>> warned_at_; ///< by warn_once()
  mutable std::vector<Finding> findings_;            ///< so far, of a parser that may be const
  mutable std::size_t remarks_ = 0;                  ///< notes and warnings among them
  mutable std::size_t errors_ = 0;
};

} // namespace celltrace::pov

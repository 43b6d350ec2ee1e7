// Reports errors, warnings and notes about the scene.
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

/// Returns a name from a scene, such as a file's, in quotes, shortened and made a single line for a message.
std::string quoted_name(std::string_view name);

/// Throws SceneError for a scene that cannot be read, or is empty.
[[noreturn]] void refuse_scene(const std::string& name, const std::string& what, const ParseOptions& options);

class Diagnostics {
public:
  Diagnostics(const Sources& sources, const Names& names, const Input& input, const ParseOptions& options)
      : sources_(sources), names_(names), input_(input), options_(options) {}

  /// Returns "file:line:column".
  std::string place(const Location& where) const;

  /// Throws SceneError: the unsupported features so far, then the place, the text and the chain of files and
  /// macros that led there. `details` are further lines about the error.
  [[noreturn]] void fail(const Location& where, const std::string& what,
                         const std::vector<std::string>& details = {}) const;

  /// Throws SceneError: `who`, such as "the loops run", passes a limit, counted in `unit`.
  [[noreturn]] void exceed(const Location& where, std::uint64_t ParseLimits::*limit, const std::string& who,
                           const std::string& unit) const;

  /// Reports "place: warning: text", or another kind of message.
  void warn(const Location& where, const std::string& what) const {
    say(Finding::Severity::warning, where, what);
  }
  /// Warns, but only once for each place, however often loops and macros return there.
  void warn_once(const Location& where, const std::string& what);
  void note(const Location& where, const std::string& what) const {
    say(Finding::Severity::note, where, what);
  }

  /// Returns whether everything that something at `used_at` needs is supported; null needs nothing.
  /// Unsupported things have to be left out: each feature is noted once, for the error at the end, or warned
  /// of in lenient reading.
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
  std::set<std::string> unsupported_;                ///< features that have been noted or warned of
  std::set<std::array<std::uint32_t, 3>> warned_at_; ///< places of warn_once()
  mutable std::vector<Finding> findings_; ///< findings so far; mutable, because const functions add to them
  mutable std::size_t remarks_ = 0;       ///< number of notes and warnings among them
  mutable std::size_t errors_ = 0;
};

} // namespace celltrace::pov

// The exceptions that celltrace throws.
#pragma once

#include "celltrace/export.hpp"

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace celltrace {

/// Base of every exception that crosses the API. what() is one line, ready to print.
class CELLTRACE_EXPORT Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A picture, file or option that cannot be used.
class CELLTRACE_EXPORT InputError : public Error {
public:
  using Error::Error;
};

/// A note, warning or error about the text of a scene.
struct Finding {
  enum class Severity {
    note,
    warning, ///< a #warning of the scene's own, or a feature that was left out because it is not supported
    error    ///< a fault for which the scene is refused
  };
  Severity severity = Severity::error;
  std::string file;                   ///< name of the file in messages
  std::uint32_t line = 1, column = 1; ///< both from 1; both 0 if the file cannot be read
  std::string text;                   ///< the message
  /// The includes and macro calls that led to the place, innermost first.
  std::vector<std::string> reached_by;
  bool is_unsupported = false; ///< true for a feature that ParseOptions::lenient leaves out
};

/// The text of a scene is wrong or uses an unsupported feature. what() starts with "file:line:column: error:"
/// ("file: error:" if the file cannot be read) and may go on with the include stack and further errors, a
/// line each.
class CELLTRACE_EXPORT SceneError : public InputError {
public:
  /// At least one of `findings` is an error.
  SceneError(const std::string& what, std::vector<Finding> findings)
      : InputError(what), findings_(std::make_shared<const std::vector<Finding>>(std::move(findings))) {}

  /// Returns all findings of the run in the order of their discovery: the first thousand notes and warnings,
  /// each feature that is not supported, and the error that ended the run.
  const std::vector<Finding>& findings() const noexcept { return *findings_; }

private:
  std::shared_ptr<const std::vector<Finding>> findings_;
};

/// There is not enough memory for a scene or picture.
class CELLTRACE_EXPORT OutOfMemory : public Error {
public:
  OutOfMemory() : Error("there is not enough memory") {}
};

/// A kernel broke a rule of the machine it ran on, or stopped itself.
class CELLTRACE_EXPORT SpeError : public Error {
public:
  using Error::Error;
};

/// The work was cancelled by its caller.
class CELLTRACE_EXPORT Cancelled : public Error {
public:
  Cancelled() : Error("cancelled") {}
};

} // namespace celltrace

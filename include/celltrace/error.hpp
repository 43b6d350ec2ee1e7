// What celltrace throws.
#pragma once

#include "celltrace/export.hpp"

#include <stdexcept>
#include <string>

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

/// The text of a scene is wrong or uses what is not supported. what() starts with "file:line:column: error:"
/// and may continue with the include stack on further lines.
class CELLTRACE_EXPORT SceneError : public InputError {
public:
  using InputError::InputError;
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

// The built-in functions of the scene language.
#pragma once

#include <string>
#include <vector>

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// A function's name, and whether it returns a text. The index in the list is the function's number.
struct FunctionName {
  const char* name;
  bool returns_text;
};
std::vector<FunctionName> function_names();

/// Fails unless the function takes this many floats and nothing else, and returns a float.
void check_numeric_call(Session& session, int function, std::size_t arguments, const Location& where);
/// Returns the days since the beginning of the year 2000 (UTC).
double days_now();
/// Returns whether a function depends on nothing but its arguments, and changes nothing.
bool is_pure(int function);
/// Checks the arguments and calls the function with this number.
Quantity call_numeric(Session& session, int function, const std::vector<Value>& arguments,
                      const Location& where);
std::string call_text(Session& session, int function, const std::vector<Value>& arguments,
                      const Location& where);

} // namespace celltrace::pov

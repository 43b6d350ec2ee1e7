// The built-in functions of the scene language.
#pragma once

#include <string>
#include <vector>

#include "pov/session.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// A function's name and whether it gives a text; its number is its place in the list.
struct FunctionName {
  const char* name;
  bool gives_text;
};
std::vector<FunctionName> function_names();

/// Fails unless the function is one of floats only, of so many, that gives a float.
void check_numeric_call(Session& session, int function, std::size_t arguments, const Location& where);
/// Days since the year 2000 began (UTC).
double days_now();
/// Whether a function depends on nothing but its arguments, and changes nothing.
bool is_pure(int function);
/// Checks the arguments and calls function number `function`.
Quantity call_numeric(Session& session, int function, const std::vector<Value>& arguments,
                      const Location& where);
std::string call_text(Session& session, int function, const std::vector<Value>& arguments,
                      const Location& where);

} // namespace celltrace::pov

// Evaluates arithmetic in the bodies of macros and loops without the grammar: scenes that are programs spend
// most of their time on arithmetic.
#pragma once

#include <optional>

#include "pov/quantity.hpp"
#include "pov/token.hpp"

namespace celltrace::pov {

struct Session;

/// Recorded tokens that have not been read yet.
struct TokenSpan {
  const Token* begin;
  const Token* end;
};

// Each of these functions reads an expression at the front of `tokens`, moves `begin` behind it and returns
// its value, if the grammar could read the tokens in no other way: numbers and vectors, names and elements
// with such a value, components, operators, and functions of these. For anything else the function returns
// nothing and leaves `tokens` unchanged, so that the grammar reads it, and reports every error.

/// Reads a number, vector or colour that ends in front of ; , ) or ].
std::optional<Quantity> take_quantity(Session& session, TokenSpan& tokens);
/// Reads ( condition )
std::optional<Quantity> take_condition(Session& session, TokenSpan& tokens);
/// Reads a vector of up to four components, after its < up to and including its >.
std::optional<Quantity> take_vector(Session& session, TokenSpan& tokens);
/// Reads an argument of a shape, in front of a comma, a closing brace or a reserved word.
std::optional<Quantity> take_argument(Session& session, TokenSpan& tokens);
/// Reads such an argument behind a comma.
std::optional<Quantity> take_next_argument(Session& session, TokenSpan& tokens);

} // namespace celltrace::pov

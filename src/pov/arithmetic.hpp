// Arithmetic in what macros and loops repeat, evaluated without the grammar: scenes that are programs spend
// most of their time on it.
#pragma once

#include <optional>

#include "pov/quantity.hpp"
#include "pov/token.hpp"

namespace celltrace::pov {

struct Session;

/// Recorded tokens that are still to be read.
struct TokenSpan {
  const Token* begin;
  const Token* end;
};

// Each of these reads an expression at the front of `tokens` and moves `begin` behind it, if that is all the
// grammar could make of it: numbers and vectors, names and elements that have such a value, components,
// operators, and functions of these. Nothing else is understood: nothing is returned, `tokens` stay as they
// were, and it is left to the grammar, and with it every error.

/// A number, vector or colour that ends in front of ; , ) or ].
std::optional<Quantity> take_quantity(Session& session, TokenSpan& tokens);
/// ( condition )
std::optional<Quantity> take_condition(Session& session, TokenSpan& tokens);
/// What stands behind the < of a vector of up to four components, with its >.
std::optional<Quantity> take_vector(Session& session, TokenSpan& tokens);
/// An argument of a shape, in front of a comma, a closing brace or a reserved word.
std::optional<Quantity> take_argument(Session& session, TokenSpan& tokens);
/// The same behind a comma.
std::optional<Quantity> take_next_argument(Session& session, TokenSpan& tokens);

} // namespace celltrace::pov

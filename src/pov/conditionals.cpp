// TokenStream: #if, #switch and their branches.
#include <cmath>

#include "pov/session.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

namespace {

bool separates_branches(Directive kind) {
  return kind == Directive::else_ || kind == Directive::elseif || kind == Directive::case_ ||
         kind == Directive::range;
}

} // namespace

/// Skips tokens up to the #end that closes `depth` blocks, or to an #else or #case of this block.
Token TokenStream::skip_branch(unsigned depth) {
  for (;;) {
    const Token token = read();
    if (token.kind == Token::Kind::end) {
      const auto& open = session_.input.top().conditionals;
      session_.fail(open.empty() ? token.where : open.back().where, "#end is missing for what starts here");
    }
    if (token.kind != Token::Kind::directive) continue;
    const Directive kind = session_.names[token.name].directive;
    if (opens_block(kind))
      ++depth;
    else if (kind == Directive::end && depth-- == 0)
      return token;
    else if (separates_branches(kind) && depth == 0)
      return token;
  }
}

/// Reads a condition's value; `where` is the place of the directive.
double TokenStream::condition_value(Location where) {
  return session_.any_number(std::get<Quantity>(evaluate(Start::condition)), where);
}

bool TokenStream::condition(Location where) {
  return is_true(condition_value(where));
}

void TokenStream::obey_if(const Token& directive, bool holds) {
  session_.input.top().conditionals.push_back({false, directive.where});
  if (!holds) choose_else();
}

/// Skips branches of the innermost #if until one is to be read.
void TokenStream::choose_else() {
  for (;;) {
    const Token directive = skip_branch(0);
    const Directive kind = session_.names[directive.name].directive;
    if (kind == Directive::end) return session_.input.top().conditionals.pop_back();
    if (kind == Directive::else_) return;
    if (kind == Directive::elseif && condition(directive.where)) return;
  }
}

/// Handles an #else that ends the branch before it; in a #switch, that branch falls through.
void TokenStream::obey_else(const Token& directive, Directive kind) {
  auto& conditionals = session_.input.top().conditionals;
  if (conditionals.empty()) session_.fail(directive.where, "#else without #if");
  if (conditionals.back().is_switch && kind == Directive::else_) return;
  while (session_.names[skip_branch(0).name].directive != Directive::end) {
  }
  conditionals.pop_back();
}

void TokenStream::obey_switch(const Token& directive) {
  const double value = condition_value(directive.where);
  session_.input.top().conditionals.push_back({true, directive.where});
  for (;;) {
    const Token branch = skip_branch(0);
    const Directive kind = session_.names[branch.name].directive;
    if (kind == Directive::end) return session_.input.top().conditionals.pop_back();
    if (kind == Directive::else_) return;
    if (kind != Directive::elseif && case_holds(branch, value)) return;
  }
}

bool TokenStream::case_holds(const Token& directive, double value) {
  const Location& where = directive.where;
  if (session_.names[directive.name].directive == Directive::case_)
    return std::fabs(condition_value(where) - value) < kComparisonTolerance;
  expect('(', "after #range");
  const std::vector<double> bounds = read_numbers(where);
  if (bounds.size() != 2) session_.fail(where, "#range takes two numbers");
  return value >= bounds[0] - kComparisonTolerance && value <= bounds[1] + kComparisonTolerance;
}

/// Handles a #case at the end of a branch, which falls through.
void TokenStream::obey_case(const Token& directive) {
  const auto& conditionals = session_.input.top().conditionals;
  if (conditionals.empty() || !conditionals.back().is_switch)
    session_.fail(directive.where, "#case and #range belong into a #switch");
  case_holds(directive, 0);
}

void TokenStream::obey_end(const Token& directive) {
  auto& conditionals = session_.input.top().conditionals;
  if (conditionals.empty()) session_.fail(directive.where, "#end without anything to end");
  conditionals.pop_back();
}

void TokenStream::obey_break(const Token& directive) {
  auto& conditionals = session_.input.top().conditionals;
  for (std::size_t i = conditionals.size(); i-- > 0;) {
    if (!conditionals[i].is_switch) continue;
    auto depth = static_cast<unsigned>(conditionals.size() - 1 - i);
    conditionals.resize(i + 1);
    while (session_.names[skip_branch(depth).name].directive != Directive::end)
      depth = 0;
    conditionals.pop_back();
    return;
  }
  const Frame& frame = session_.input.top();
  if (frame.kind == Frame::Kind::file || session_.input.depth() <= levels_.back().base_depth)
    session_.fail(directive.where, "#break outside of a loop, #switch or macro");
  leave_frame();
}

} // namespace celltrace::pov

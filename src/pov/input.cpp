#include "pov/input.hpp"

namespace celltrace::pov {

Token Input::read() {
  if (!put_back_.empty()) {
    const Token token = put_back_.back();
    put_back_.pop_back();
    return token;
  }
  Frame& frame = frames_.back();
  if (frame.scanner) return frame.scanner->next();
  if (frame.position < frame.range.end) return (*frame.range.tokens)[frame.position++];
  Token end;
  end.where = frame.opened_at;
  return end;
}

bool Input::is_exhausted() const {
  const Frame& frame = frames_.back();
  return put_back_.empty() && frame.kind == Frame::Kind::macro && frame.position == frame.range.end;
}

} // namespace celltrace::pov

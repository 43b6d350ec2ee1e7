#include "pov/input.hpp"

namespace celltrace::pov {

Token Input::read() {
  Frame& frame = frames_.back();
  if (!frame.put_back.empty()) {
    const Token token = frame.put_back.back();
    frame.put_back.pop_back();
    return token;
  }
  if (frame.scanner) return frame.scanner->next();
  if (frame.position < frame.range.end) return (*frame.range.tokens)[frame.position++];
  Token end;
  end.where = frame.opened_at;
  return end;
}

bool Input::is_exhausted() const {
  const Frame& frame = frames_.back();
  return frame.put_back.empty() && frame.kind == Frame::Kind::macro && frame.position == frame.range.end;
}

} // namespace celltrace::pov

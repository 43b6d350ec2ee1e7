#include "pov/diagnostics.hpp"

#include "celltrace/error.hpp"

namespace celltrace::pov {

namespace {

constexpr int kMostStackLines = 8;

}

std::string Diagnostics::place(const Location& where) const {
  return sources_.name(where.file) + ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
}

void Diagnostics::fail(const Location& where, const std::string& what) const {
  throw SceneError(place(where) + ": error: " + what + stack());
}

void Diagnostics::require_supported(const UnsupportedPtr& unsupported, const Location& used_at) const {
  if (!unsupported) return;
  std::string message = place(unsupported->where) + ": error: " + unsupported->what + " is not supported yet";
  if (unsupported->where != used_at) message += "\n    used at " + place(used_at);
  throw SceneError(message + stack());
}

std::string Diagnostics::stack() const {
  std::string lines;
  int count = 0;
  const auto& frames = input_.frames();
  for (std::size_t i = frames.size(); i-- > 1;) {
    const Frame& frame = frames[i];
    if (frame.kind == Frame::Kind::loop || ++count > kMostStackLines) continue;
    if (frame.kind == Frame::Kind::file)
      lines += "\n    included from ";
    else
      lines += "\n    in macro '" + names_.text(frame.macro_name) + "' called from ";
    lines += sources_.name(frame.opened_at.file) + ':' + std::to_string(frame.opened_at.line);
  }
  if (count > kMostStackLines) lines += "\n    and " + std::to_string(count - kMostStackLines) + " more";
  return lines;
}

} // namespace celltrace::pov

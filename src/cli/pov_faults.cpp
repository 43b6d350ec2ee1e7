#include "cli/pov_faults.hpp"

#include "celltrace/error.hpp"

namespace celltrace::cli {

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 80;
  if (text.size() <= kMost) return "'" + std::string(text) + "'";
  return "'" + std::string(text.substr(0, kMost - 3)) + "...'";
}

void fail(const PovEntry& entry, const std::string& what) {
  throw InputError(shown(entry.text) + ' ' + what);
}

void fail_as_unknown(const PovEntry& entry) {
  fail(entry, entry.kind == PovEntry::Kind::setting ? "is no setting of POV-Ray that is known here"
                                                    : "is no switch of POV-Ray that is known here");
}

void fail_without(const PovEntry& entry, const std::string& what) {
  fail(entry,
       (entry.kind == PovEntry::Kind::setting ? "needs " : "must be followed, without a space, by ") + what);
}

const std::string& needed(const PovEntry& entry, const char* what) {
  if (entry.value.empty()) fail_without(entry, what);
  return entry.value;
}

} // namespace celltrace::cli

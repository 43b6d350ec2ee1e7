#include "cli/row_keeper.hpp"

#include <iostream>

namespace celltrace::cli {

void RowKeeper::save(const PartialPicture& picture, bool at_once) {
  constexpr std::chrono::seconds kInterval(10);
  const Clock::time_point now = Clock::now();
  if (picture.is_empty() || picture.is_complete() || (!at_once && now - last_ < kInterval)) return;
  keep([&](RowsFile& file) { picture.append_to(file); });
  last_ = Clock::now();
}

void RowKeeper::fail(const InputError& error) {
  has_failed_ = true;
  std::cerr << "celltrace: warning: " << error.what() << ": rows are not kept for a run that goes on\n";
}

} // namespace celltrace::cli

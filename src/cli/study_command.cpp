#include "cli/study_command.hpp"

#include <iostream>

#include <unistd.h>

namespace celltrace::cli {

int run_study_command(const StudyRequest& request) {
  const bool show = !request.quiet && isatty(STDERR_FILENO) != 0;
  const study::Study study = study::run_study(request.options, [&](const std::string& table, int jobs) {
    if (show) std::cerr << "\r\033[Kstudying " << table << ", " << jobs << " runs" << std::flush;
  });
  if (show) std::cerr << "\r\033[K";
  study::save(study, request.out);
  if (!request.quiet) std::cout << study::to_text(study) << std::flush;
  return 0;
}

} // namespace celltrace::cli

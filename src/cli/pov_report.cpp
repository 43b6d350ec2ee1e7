#include "cli/pov_report.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace celltrace::cli {

PovReportParts report_parts(const RenderRequest& request, bool is_terminal) {
  if (request.quiet || is_terminal) return {};
  const bool is_client = request.stands_in_for_povray;
  const bool verbose = request.verbose.value_or(is_client);
  return {verbose, is_client || verbose};
}

void PovReport::begin_frame(std::size_t index, std::size_t count) {
  if (parts_.steps) out_ << "Rendering frame " << index + 1 << " of " << count << std::endl;
}

void PovReport::begin_parsing() {
  if (parts_.steps) out_ << "==== [Parsing...] ====" << std::endl;
}

void PovReport::begin_rendering(const RenderOptions& options) {
  const PictureRegion region = options.region.value_or(PictureRegion{0, options.width, 0, options.height});
  pixels_ = static_cast<std::uint64_t>(region.right - region.left) *
            static_cast<std::uint64_t>(region.bottom - region.top);
  written_ = 0;
  next_ = {};
  if (parts_.steps) out_ << "==== [Rendering...] ====" << std::endl;
}

void PovReport::update(double fraction) {
  if (!parts_.progress || pixels_ == 0) return;
  const auto done = static_cast<std::uint64_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(pixels_));
  const Clock::time_point now = Clock::now();
  if (done == written_ || (done < pixels_ && now < next_)) return;
  next_ = now + std::chrono::milliseconds(100);
  written_ = done;
  out_ << "Rendered " << done << " of " << pixels_ << " pixels (" << 100 * done / pixels_ << "%)\r"
       << std::flush;
}

void PovReport::finish(double seconds) {
  if (written_ > 0) out_ << '\n';
  if (parts_.steps) out_ << "  Trace Time:       " << pov_time(seconds) << '\n';
  out_ << std::flush;
}

std::string pov_time(double seconds) {
  const auto whole = static_cast<long>(seconds);
  char text[80];
  std::snprintf(text, sizeof text, "%ld hours %2ld minutes %2ld seconds (%.3f seconds)", whole / 3600,
                whole / 60 % 60, whole % 60, seconds);
  return text;
}

} // namespace celltrace::cli

#include "cli/picture_job.hpp"

#include "celltrace/cache/trace.hpp"
#include "celltrace/error.hpp"
#include "celltrace/image.hpp"
#include "cli/interrupt.hpp"
#include "cli/poster.hpp"
#include "cli/row_keeper.hpp"

#include <cstdio>
#include <iostream>
#include <utility>

namespace celltrace::cli {

RunReports::RunReports(const RenderRequest& request)
    : events_(request.trace, true), cache_(request.cache_trace) {
  if (cache_.stream() != nullptr) cache_writer_ = std::make_unique<CacheTraceWriter>(*cache_.stream());
}
RunReports::~RunReports() = default;

void RunReports::attach(RenderOptions& options) {
  options.emulation.trace = events_.stream();
  if (cache_writer_) options.emulation.recorder = cache_writer_.get();
  options.diagnostic = [this](const Diagnostic& diagnostic) { diagnostics_.push_back(diagnostic); };
}

void RunReports::print_diagnostics(const std::string& error) {
  for (const Diagnostic& diagnostic : std::exchange(diagnostics_, {}))
    if (error.find(diagnostic.text) == std::string::npos)
      std::cerr << "celltrace: warning: " << diagnostic.text << '\n';
}

void RunReports::finish() {
  cache_writer_.reset();
  events_.finish();
  cache_.finish();
}

namespace {

template <class... Picture>
void write(const RenderRequest& request, const std::filesystem::path& path, const Picture&... picture) {
  if (path != kStandardOutput) return save_image(path, picture..., request.file);
  try {
    write_image(stdout, request.format, picture..., request.file);
  } catch (const InputError& error) {
    throw InputError(std::string("standard output ") + error.what());
  }
}

} // namespace

void save_picture(const RenderRequest& request, const std::filesystem::path& path,
                  const PartialPicture& picture, RenderStatistics& statistics) {
  if (request.options.blocks) {
    write(request, path, picture.blocks());
  } else if (request.format == ImageFormat::dds) {
    const EncodedPicture encoded = encode_blocks(picture.image());
    write(request, path, encoded.blocks);
    statistics.block_error = encoded.error;
  } else if (request.options.colours) {
    const ExrOptions exr = {request.bits == 32, request.options.first_hits ? &picture.first_hits() : nullptr};
    write(request, path, picture.colours(), exr);
  } else {
    write(request, path, picture.image());
  }
}

namespace {

PictureOutcome render_whole(Renderer& renderer, const RenderRequest& request,
                            const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                            const Progress& progress, const std::function<void(const Image&)>& use_image) {
  PartialPicture picture(request.options);
  picture.take(kept);
  RowKeeper keeper(kept);
  RenderResult result = render_remaining(renderer, request.options, picture, costs, progress,
                                         [&] { keeper.save(picture, interrupted()); });
  if (use_image && result.complete) use_image(picture.image());
  if (!path.empty()) save_picture(request, path, picture, result.statistics);
  return {std::move(result.statistics), result.complete, picture.missing_rows()};
}

} // namespace

PictureOutcome render_picture(Renderer& renderer, const RenderRequest& request,
                              const std::filesystem::path& path, RowsFile& kept, const RowCosts& costs,
                              const Progress& progress, const std::function<void(const Image&)>& use_image) {
  if (rows_at_once(request) != 0) return render_poster(renderer, request, path, kept, costs, progress);
  return render_whole(renderer, request, path, kept, costs, progress, use_image);
}

void print_warnings(const RenderStatistics& statistics) {
  if (statistics.dropped_rays != 0)
    std::cerr
        << "celltrace: warning: " << statistics.dropped_rays
        << " rays were dropped, as so many at a time or inside of so many objects have no room: what they "
           "would have seen is missing\n";
  for (const PictureLimit limit : statistics.limits)
    std::cerr << "celltrace: warning: " << text_of(limit) << '\n';
}

std::string summary_of(const RenderStatistics& s, double parse_seconds) {
  const double build_seconds = s.build_seconds + s.prepare_seconds;
  const double rate = s.render_seconds > 0 ? static_cast<double>(s.total_rays()) / s.render_seconds : 0;
  char text[256];
  std::snprintf(text, sizeof text,
                "%s, %zu SPEs; parse %.2f s, build %.2f s, render %.2f s; %.2f million rays/s", s.spu.c_str(),
                s.spes.size(), parse_seconds, build_seconds, s.render_seconds, rate / 1e6);
  std::string summary = text;
  if (s.render_cycles != 0) {
    std::snprintf(text, sizeof text, "; %.2f million virtual cycles",
                  static_cast<double>(s.render_cycles) / 1e6);
    summary += text;
  }
  return summary;
}

} // namespace celltrace::cli

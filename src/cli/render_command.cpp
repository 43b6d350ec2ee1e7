#include "cli/render_command.hpp"

#include "celltrace/cache/trace.hpp"
#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_files.hpp"
#include "cli/progress_line.hpp"

#include <charconv>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

using Clock = std::chrono::steady_clock;

ParseOptions parse_options(const RenderRequest& request) {
  ParseOptions options;
  options.library_paths = request.library_paths;
  options.readable_folders = request.readable_folders;
  options.writable_folders = request.writable_folders;
  options.limits = request.limits;
  options.width = request.options.width;
  options.height = request.options.height;
  options.lenient = request.lenient;
  options.clock = request.clock;
  options.quality = request.options.quality;
  for (const auto& [name, text] : request.declares) {
    double number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    if (error == std::errc() && end == last)
      options.declares.emplace_back(name, number);
    else
      options.declares.emplace_back(name, text);
  }
  return options;
}

/// None if the user interrupted it.
std::optional<Scene> parse_with_progress(const RenderRequest& request) {
  ProgressLine line(std::cerr, !request.quiet && stderr_is_terminal(), "reading ",
                    std::chrono::milliseconds(500));
  ParseOptions options = parse_options(request);
  options.message = [&](std::string_view text) {
    if (request.quiet) return;
    line.wipe();
    std::cerr << text;
  };
  options.progress = [&line](std::uint64_t bytes, std::uint64_t total) {
    if (total > 0) line.update(static_cast<double>(bytes) / static_cast<double>(total));
    return !interrupted();
  };
  try {
    return parse_file(request.scene, options);
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

/// Prints what an emulated machine finds wrong. `error` is what is printed as the error anyway.
void print_diagnostics(const std::vector<Diagnostic>& diagnostics, const std::string& error = {}) {
  for (const Diagnostic& diagnostic : diagnostics)
    if (error.find(diagnostic.text) == std::string::npos)
      std::cerr << "celltrace: warning: " << diagnostic.text << '\n';
}

/// Where the traces go; null: nowhere.
struct TraceStreams {
  std::ostream* events;
  std::ostream* cache;
};

RenderResult render_with_progress(const Scene& scene, const RenderRequest& request, TraceStreams traces) {
  RenderOptions options = request.options;
  options.emulation.trace = traces.events;
  std::optional<CacheTraceWriter> cache_trace;
  if (traces.cache != nullptr) options.emulation.recorder = &cache_trace.emplace(*traces.cache);
  std::vector<Diagnostic> diagnostics;
  options.diagnostic = [&](const Diagnostic& diagnostic) { diagnostics.push_back(diagnostic); };
  try {
    RenderResult result = [&] {
      const bool visible = !request.quiet && stderr_is_terminal();
      ProgressLine building(std::cerr, visible, "building ", std::chrono::milliseconds(500));
      options.build_progress = [&building](double fraction) {
        building.update(fraction);
        if (fraction >= 1) building.wipe();
        return !interrupted();
      };
      ProgressLine line(std::cerr, visible);
      return render(scene, options, [&line](double fraction) {
        line.update(fraction);
        return !interrupted();
      });
    }();
    print_diagnostics(diagnostics);
    return result;
  } catch (const std::exception& error) {
    print_diagnostics(diagnostics, error.what());
    throw;
  }
}

void write_statistics(const std::string& where, const RenderStatistics& statistics, double parse_seconds) {
  auto json = nlohmann::ordered_json::parse(to_json(statistics));
  json["seconds"]["parse"] = parse_seconds;
  write_report(where, json.dump(2) + "\n");
}

void print_summary(const RenderRequest& request, const RenderResult& result, double parse_seconds) {
  const RenderStatistics& s = result.statistics;
  const double build_seconds = s.build_seconds + s.prepare_seconds;
  const double rate = s.render_seconds > 0 ? static_cast<double>(s.total_rays()) / s.render_seconds : 0;
  std::fprintf(stderr,
               "%s: %s%dx%d, %s, %zu SPEs; parse %.2f s, build %.2f s, render %.2f s; %.2f million rays/s",
               request.output.empty() ? "no picture" : request.output.c_str(),
               result.complete ? "" : "interrupted, partial, ", s.width, s.height, s.spu.c_str(),
               s.spes.size(), parse_seconds, build_seconds, s.render_seconds, rate / 1e6);
  if (s.render_cycles != 0)
    std::fprintf(stderr, "; %.2f million virtual cycles", static_cast<double>(s.render_cycles) / 1e6);
  std::fputc('\n', stderr);
}

} // namespace

int run_render(const RenderRequest& request) {
  if (!request.output.empty()) check_image_path(request.output);
  catch_interrupts();
  const Clock::time_point start = Clock::now();
  const std::optional<Scene> scene = parse_with_progress(request);
  const std::chrono::duration<double> parsing = Clock::now() - start;

  if (!scene || interrupted()) {
    std::cerr << "interrupted before the first pixel\n";
    return 2;
  }
  OutputFile trace(request.trace, true);
  OutputFile cache_trace(request.cache_trace);
  const RenderResult result = render_with_progress(*scene, request, {trace.stream(), cache_trace.stream()});
  if (!request.output.empty()) {
    if (request.bits == 16)
      save_image(request.output, to_deep_image(result.colours));
    else
      save_image(request.output, result.image);
  }
  trace.finish();
  cache_trace.finish();
  if (!request.stats.empty()) write_statistics(request.stats, result.statistics, parsing.count());
  if (!request.quiet) print_summary(request, result, parsing.count());
  return result.complete ? 0 : 2;
}

} // namespace celltrace::cli

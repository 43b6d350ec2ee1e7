#include "cli/render_command.hpp"

#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress_line.hpp"

#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

namespace celltrace::cli {

namespace {

using Clock = std::chrono::steady_clock;

ParseOptions parse_options(const RenderRequest& request) {
  ParseOptions options;
  options.library_paths = request.library_paths;
  options.width = request.options.width;
  options.height = request.options.height;
  for (const auto& [name, text] : request.declares) {
    double number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    if (error == std::errc() && end == last)
      options.declares.emplace_back(name, number);
    else
      options.declares.emplace_back(name, text);
  }
  options.message = [quiet = request.quiet](std::string_view text) {
    if (!quiet) std::cerr << text;
  };
  return options;
}

RenderResult render_with_progress(const Scene& scene, const RenderRequest& request) {
  ProgressLine line(std::cerr, !request.quiet && stderr_is_terminal());
  return render(scene, request.options, [&line](double fraction) {
    line.update(fraction);
    return !interrupted();
  });
}

void write_statistics(const std::string& where, const RenderStatistics& statistics, double parse_seconds) {
  auto json = nlohmann::ordered_json::parse(to_json(statistics));
  json["seconds"]["parse"] = parse_seconds;
  const std::string text = json.dump(2) + "\n";
  if (where == "-") {
    std::cout << text << std::flush;
    return;
  }
  std::ofstream file(where);
  if (!(file << text << std::flush)) throw InputError(where + ": cannot be written");
}

void print_summary(const RenderRequest& request, const RenderResult& result, double parse_seconds) {
  const RenderStatistics& s = result.statistics;
  const double build_seconds = s.build_seconds + s.prepare_seconds;
  const double rate = s.render_seconds > 0 ? static_cast<double>(s.total_rays()) / s.render_seconds : 0;
  std::fprintf(stderr,
               "%s: %s%dx%d, %s, %zu SPEs; parse %.2f s, build %.2f s, render %.2f s; %.2f million rays/s\n",
               request.output.c_str(), result.complete ? "" : "interrupted, partial, ", s.width, s.height,
               s.spu.c_str(), s.spes.size(), parse_seconds, build_seconds, s.render_seconds, rate / 1e6);
}

} // namespace

int run_render(const RenderRequest& request) {
  check_image_path(request.output);
  catch_interrupts();
  const Clock::time_point start = Clock::now();
  const Scene scene = parse_file(request.scene, parse_options(request));
  const std::chrono::duration<double> parsing = Clock::now() - start;

  if (interrupted()) {
    std::cerr << "interrupted before the first pixel\n";
    return 2;
  }
  const RenderResult result = render_with_progress(scene, request);
  save_image(request.output, result.image);
  if (!request.stats.empty()) write_statistics(request.stats, result.statistics, parsing.count());
  if (!request.quiet) print_summary(request, result, parsing.count());
  return result.complete ? 0 : 2;
}

} // namespace celltrace::cli

#include "model_comparison.hpp"

#include "celltrace_side.hpp"
#include "embree_side.hpp"
#include "runner.hpp"

#include <cmath>
#include <map>
#include <memory>

namespace celltrace::compare {

namespace {

constexpr std::size_t kManyPrimitives = 1'000'000;
constexpr std::size_t kJudgedMovingTriangles = 100'000;

using Quality = EmbreeConfig::Quality;

std::string embree_name(int packet) {
  return packet == 1 ? "Embree, single rays" : "Embree, packets of " + std::to_string(packet);
}

/// One model with one number of threads.
class ModelComparison {
public:
  ModelComparison(const Model& model, ModelKind kind, unsigned threads, const Settings& settings,
                  Report& report)
      : model_(model), kind_(kind), threads_(threads), settings_(settings), report_(report),
        celltrace_(settings.size, threads) {
    celltrace_.take(model);
  }

  void rays() {
    if (!wanted("rays")) return;
    celltrace_.build_and_trace();
    std::vector<std::unique_ptr<Side>> others;
    std::vector<Subject> subjects = {{"celltrace", [&] { return megarays_a_second(celltrace_); }}};
    if (embree_version())
      for (const int packet : {widest_embree_packet(), 1}) {
        others.push_back(make_embree_side(settings_.size, threads_, {packet, Quality::high}));
        Side& side = *others.back();
        side.take(model_);
        side.build_and_trace();
        subjects.push_back({embree_name(packet), [&] { return megarays_a_second(side); }});
      }
    const std::vector<Samples> samples = alternate(subjects, settings_.runs, "Mray/s");
    add("rays", "", samples[0]);
    for (std::size_t other = 1; other < samples.size(); ++other)
      add("rays", samples[other].name, ratio(samples[0], samples[other], Values::speeds),
          bar_for_scanned(other == 1 ? 1.0 : 2.0), {samples[0], samples[other]});
    if (!others.empty() && threads_ == 1) agreement(*others[0]);
  }

  void first_frame() {
    if (!wanted("first frame")) return;
    std::vector<double> build;
    celltrace_.build_and_trace();
    const auto ours = [&] {
      const Frame frame = celltrace_.build_and_trace();
      build.push_back(static_cast<double>(model_.primitives()) / 1e6 / frame.build.wall);
      return settings_(frame.build + frame.trace);
    };
    frames(
        "first frame", Quality::medium, {"celltrace", ours}, [](Side&) {}, std::nullopt);
    const bool judged = model_.triangles.size() >= kManyPrimitives && threads_ == 1;
    add("build", "", {"celltrace", "million primitives/s", build}, judged ? at_least(10) : std::nullopt);
    const double bytes = static_cast<double>(celltrace_.accelerator_bytes());
    add("accelerator", "",
        {"celltrace", "bytes/primitive", {bytes / static_cast<double>(model_.primitives())}},
        judged ? std::optional<Bar>({Bar::Sense::at_most, 64}) : std::nullopt);
  }

  void rebuilt() {
    if (!wanted("rebuilt every frame") || model_.primitives() > 2 * kManyPrimitives) return;
    const std::vector<Model> steps = {moved(model_, 1), moved(model_, 2)};
    // Everybody alternates between the steps, so that no vertex stays where it was.
    const auto next = [&steps](Side& side, std::size_t& step) { side.take(steps[step++ % 2]); };
    std::size_t our_step = 0, their_step = 0;
    const auto ours = [&] {
      next(celltrace_, our_step);
      const Frame frame = celltrace_.build_and_trace();
      return settings_(frame.build + frame.trace);
    };
    ours();
    frames(
        "rebuilt every frame", Quality::low, {"celltrace", ours}, [&](Side& side) { next(side, their_step); },
        bar_for_scanned(2));
    celltrace_.take(model_);
  }

  void refitted() {
    if (!wanted("refitted every frame") || model_.primitives() > 2 * kManyPrimitives) return;
    const std::vector<Model> steps = {moved(model_, 1), moved(model_, 2)};
    std::size_t our_step = 0, their_step = 0;
    const auto ours = [&] {
      celltrace_.take(steps[our_step++ % 2]);
      const Frame frame = celltrace_.refit_and_trace();
      return settings_(frame.build + frame.trace);
    };
    ours();
    const bool judged =
        kind_ == ModelKind::generated && model_.triangles.size() / 1000 == kJudgedMovingTriangles / 1000;
    frames(
        "refitted every frame", Quality::refit, {"celltrace", ours},
        [&](Side& side) { side.take(steps[their_step++ % 2]); }, judged ? at_least(2.5) : std::nullopt);
    celltrace_.take(model_);
  }

  /// Rays of the caller's own: primary ones, which streams trace as fast as pictures, and such that go
  /// anywhere.
  void ray_queries() {
    if (threads_ != 1 || !wanted("ray queries")) return;
    CelltraceQueries stream(model_, CelltraceQueries::Kind::stream),
        single(model_, CelltraceQueries::Kind::single);
    const std::vector<Ray> primary = primary_rays(model_, settings_.size);
    std::vector<float> distances(primary.size());
    stream.closest_hits(primary, distances);
    const std::vector<Ray> scattered = scattered_rays(primary, distances);
    celltrace_.build_and_trace();

    std::vector<Subject> subjects = {
        {"celltrace, pictures", [&] { return megarays_a_second(celltrace_); }},
        {"celltrace, streams", [&] { return megarays_a_second(stream, primary); }},
        {"celltrace, single rays", [&] { return megarays_a_second(single, primary); }}};
    std::unique_ptr<QuerySide> embree;
    if (embree_version()) {
      embree = make_embree_queries(model_);
      subjects.push_back({embree_name(1), [&] { return megarays_a_second(*embree, primary); }});
    }
    if (!scattered.empty()) {
      subjects.push_back({"celltrace, scattered", [&] { return megarays_a_second(single, scattered); }});
      if (embree)
        subjects.push_back({"Embree, scattered", [&] { return megarays_a_second(*embree, scattered); }});
    }
    const std::vector<Samples> samples = alternate(subjects, settings_.runs, "Mray/s");
    const auto compare = [&](std::size_t ours, std::size_t theirs, double bar) {
      add("ray queries", samples[theirs].name, ratio(samples[ours], samples[theirs], Values::speeds),
          at_least(bar), {samples[ours], samples[theirs]});
    };
    compare(1, 0, 0.9);
    if (!embree) return;
    compare(2, 3, 0.7);
    if (!scattered.empty()) compare(4, 5, 0.7);
  }

  /// How much faster celltrace is with these threads than with one.
  void speedup() {
    if (threads_ == 1 || settings_.processor_clock || !wanted("more threads")) return;
    CelltraceSide alone(settings_.size, 1);
    alone.take(model_);
    alone.build_and_trace();
    celltrace_.build_and_trace();
    const std::vector<Samples> samples =
        alternate({{"celltrace", [&] { return megarays_a_second(celltrace_); }},
                   {"one thread", [&] { return megarays_a_second(alone); }}},
                  settings_.runs, "Mray/s");
    add("more threads", "celltrace, one thread", ratio(samples[0], samples[1], Values::speeds),
        threads_ == 2 ? bar_for_scanned(1.8) : std::nullopt, samples);
  }

private:
  bool wanted(const std::string& measure) const { return settings_.wanted(measure, model_.name); }

  static std::optional<Bar> at_least(double value) { return Bar{Bar::Sense::at_least, value}; }
  std::optional<Bar> bar_for_scanned(double value) const {
    return kind_ == ModelKind::scanned ? at_least(value) : std::nullopt;
  }

  double megarays_a_second(Side& side) const {
    double seconds = 0, wall = 0;
    std::uint64_t rays = 0;
    while (wall < settings_.sample_seconds) {
      const Frame frame = side.trace();
      seconds += settings_(frame.trace);
      wall += frame.trace.wall;
      rays += frame.rays();
    }
    return static_cast<double>(rays) / 1e6 / seconds;
  }

  double megarays_a_second(QuerySide& side, std::span<const Ray> rays) const {
    std::vector<float> distances(rays.size());
    Seconds took;
    std::size_t asked = 0;
    while (took.wall < settings_.sample_seconds) {
      const Stopwatch stopwatch;
      side.closest_hits(rays, distances);
      took = took + stopwatch.elapsed();
      asked += rays.size();
    }
    return static_cast<double>(asked) / 1e6 / settings_(took);
  }

  /// Building and tracing, with Embree's packets on the other side. `prepare` is not measured.
  template <class Prepare>
  void frames(const std::string& measure, Quality quality, const Subject& ours, Prepare prepare,
              const std::optional<Bar>& bar) {
    std::vector<Subject> subjects = {ours};
    std::unique_ptr<Side> embree;
    if (embree_version()) {
      const int packet = widest_embree_packet();
      embree = make_embree_side(settings_.size, threads_, {packet, quality});
      embree->take(model_);
      const auto run = [&] {
        prepare(*embree);
        const Frame frame = embree->build_and_trace();
        return settings_(frame.build + frame.trace);
      };
      run();
      subjects.push_back({embree_name(packet), run});
    }
    const std::vector<Samples> samples = alternate(subjects, settings_.runs, "s");
    add(measure, "", samples[0]);
    if (embree) add(measure, samples[1].name, ratio(samples[0], samples[1], Values::times), bar, samples);
  }

  /// The same work must have been done on both sides.
  void agreement(Side& embree) {
    const auto ours = static_cast<double>(covered_pixels(celltrace_.picture()));
    const auto theirs = static_cast<double>(covered_pixels(embree.picture()));
    add("difference in coverage", "Embree", {"difference", "%", {100 * std::abs(ours / theirs - 1)}},
        Bar{Bar::Sense::at_most, 0.1}, {{"celltrace", "pixels", {ours}}, {"Embree", "pixels", {theirs}}});
    const double psnr = compare_images(celltrace_.picture(), embree.picture()).psnr;
    add("PSNR", "Embree", {"PSNR", "dB", {std::min(psnr, 99.0)}});
  }

  void add(const std::string& measure, const std::string& against, const Samples& result,
           const std::optional<Bar>& bar = std::nullopt, const std::vector<Samples>& from = {}) {
    report_.figures.push_back(
        {measure, against, model_.name, model_.primitives(), threads_, result, bar, from});
  }

  const Model& model_;
  ModelKind kind_;
  unsigned threads_;
  const Settings& settings_;
  Report& report_;
  CelltraceSide celltrace_;
};

} // namespace

void compare_model(const Model& model, ModelKind kind, const Settings& settings, Report& report) {
  for (const unsigned threads : settings.threads) {
    ModelComparison comparison(model, kind, threads, settings, report);
    comparison.rays();
    comparison.first_frame();
    comparison.rebuilt();
    comparison.refitted();
    comparison.ray_queries();
    comparison.speedup();
  }
}

void add_growth(Report& report) {
  // By the model's family, the part of its name before the number.
  std::map<std::string, Figure> smallest;
  std::vector<Figure> growth;
  for (const Figure& figure : report.figures) {
    if (figure.measure != "rays" || !figure.against.empty() || figure.threads != 1) continue;
    if (figure.primitives < kManyPrimitives) continue;
    const std::string family = figure.scene.substr(0, figure.scene.find('-'));
    const auto [base, first] = smallest.try_emplace(family, figure);
    if (first) continue;
    const double times =
        static_cast<double>(figure.primitives) / static_cast<double>(base->second.primitives);
    const double slower = range_of(base->second.result.values).median / range_of(figure.result.values).median;
    growth.push_back({"growth of the time per ray",
                      "",
                      base->second.scene + " to " + figure.scene,
                      figure.primitives,
                      1,
                      {"celltrace", "times the time", {slower}},
                      Bar{Bar::Sense::at_most, std::cbrt(times)},
                      {}});
  }
  report.figures.insert(report.figures.end(), growth.begin(), growth.end());
}

} // namespace celltrace::compare

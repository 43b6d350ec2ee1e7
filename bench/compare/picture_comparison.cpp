#include "picture_comparison.hpp"

#include "celltrace/error.hpp"
#include "celltrace/image.hpp"
#include "picture_side.hpp"
#include "process.hpp"
#include "runner.hpp"

#include <algorithm>

namespace celltrace::compare {

namespace {

/// Scenes of the first tier that take POV-Ray long enough to compare its trace time.
bool trace_time_is_judged(const std::string& name) {
  constexpr const char* kNames[] = {"bunny", "crystal", "jncraton_dish", "jncraton_rock"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

class PictureComparison {
public:
  PictureComparison(const std::filesystem::path& scene, unsigned threads, const Settings& settings,
                    Report& report)
      : name_(scene.stem().string()), settings_(settings),
        report_(report), ours_{scene, folder_.path() / "celltrace.png", settings.width, settings.height,
                               threads},
        theirs_{scene, folder_.path() / "povray.png", settings.width, settings.height, threads},
        file_(ours_) {}

  /// POV-Ray runs once a round, for both of its times.
  void run() {
    const std::vector<Samples> samples =
        alternate({{"celltrace", [&] { return settings_(run_celltrace(ours_)); }},
                   {"POV-Ray", [&] { return settings_(run_povray()); }},
                   {"celltrace", [&] { return settings_(file_.trace()); }}},
                  settings_.runs, "s");
    add("trace time", samples[2], {"POV-Ray", "s", povray_trace_},
        trace_time_is_judged(name_) ? std::optional<Bar>(kTenTimes) : std::nullopt);
    add("whole process", samples[0], samples[1], kTenTimes);
    const double psnr = compare_images(load_image(ours_.picture), load_image(theirs_.picture)).psnr;
    report_.figures.push_back({"PSNR",
                               "POV-Ray",
                               name_,
                               0,
                               ours_.threads,
                               {"PSNR", "dB", {std::min(psnr, 99.0)}},
                               std::nullopt,
                               {}});
  }

private:
  static constexpr Bar kTenTimes = {Bar::Sense::at_least, 10};

  Seconds run_povray() {
    const PictureTimes times = render_with_povray(theirs_);
    povray_trace_.push_back(settings_(times.trace));
    return times.process;
  }

  void add(const std::string& measure, const Samples& ours, const Samples& theirs,
           const std::optional<Bar>& bar) {
    report_.figures.push_back({measure,
                               theirs.name,
                               name_,
                               0,
                               ours_.threads,
                               ratio(ours, theirs, Values::times),
                               ours_.threads == 1 ? bar : std::nullopt,
                               {ours, theirs}});
  }

  std::string name_;
  const Settings& settings_;
  Report& report_;
  TemporaryFolder folder_;
  PictureRequest ours_, theirs_;
  SceneFile file_;
  std::vector<double> povray_trace_;
};

} // namespace

void compare_picture(const std::filesystem::path& scene, const Settings& settings, Report& report) {
  try {
    for (const unsigned threads : settings.threads)
      PictureComparison(scene, threads, settings, report).run();
  } catch (const Error& error) {
    const std::string text = error.what();
    const std::string file = scene.filename().string();
    report.notes.push_back(file + ": " + text.substr(0, text.find('\n')));
  }
}

} // namespace celltrace::compare

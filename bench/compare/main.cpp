// celltrace_compare: celltrace beside Embree and POV-Ray, in turn, on the same scenes. See
// docs/benchmarks.md.
#include "celltrace/error.hpp"
#include "celltrace/spe/machine.hpp"
#include "embree_side.hpp"
#include "generated.hpp"
#include "model_comparison.hpp"
#include "picture_comparison.hpp"
#include "povray_side.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace celltrace::compare {

namespace {

namespace fs = std::filesystem;

/// Files of a folder and of those in it, by name.
std::vector<fs::path> files(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> found;
  if (folder.empty() || !fs::is_directory(folder)) return found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) found.push_back(fs::absolute(entry.path()));
  std::sort(found.begin(), found.end());
  return found;
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

bool any_wanted(const Settings& settings, const std::string& scene,
                std::initializer_list<const char*> measures) {
  return std::any_of(measures.begin(), measures.end(),
                     [&](const char* measure) { return settings.wanted(measure, scene); });
}

void compare(const Model& model, ModelKind kind, const Settings& settings, Report& report) {
  if (!any_wanted(settings, model.name,
                  {"rays", "first frame", "rebuilt every frame", "refitted every frame", "ray queries",
                   "more threads"}))
    return;
  std::cerr << "celltrace_compare: " << model.name << ", " << model.primitives() << " primitives\n";
  compare_model(model, kind, settings, report);
}

void compare_models(const Settings& settings, Report& report) {
  const std::vector<fs::path> soups = files(settings.models, ".bin");
  if (soups.empty()) report.notes.push_back("models: none in '" + settings.models.string() + "'");
  for (const fs::path& path : soups)
    compare(load_model(path), ModelKind::scanned, settings, report);
  for (const std::size_t count : settings.primitives)
    for (const auto make : {hills, random_triangles, sphere_flake})
      compare(make(count), ModelKind::generated, settings, report);
  add_growth(report);
}

void compare_pictures(const Settings& settings, Report& report) {
  if (!povray_version()) return;
  const std::vector<fs::path> scenes = files(settings.scenes, ".pov");
  if (scenes.empty()) report.notes.push_back("scenes: none in '" + settings.scenes.string() + "'");
  for (const fs::path& path : scenes) {
    if (!any_wanted(settings, path.stem().string(), {"trace time", "whole process"})) continue;
    std::cerr << "celltrace_compare: " << path.filename().string() << '\n';
    compare_picture(path, settings, report);
  }
}

Report run(const Settings& settings) {
  Report report;
  report.conditions = {{"processor", processor()},
                       {"clock", settings.processor_clock ? "processor" : "wall"},
                       {"rounds", std::to_string(settings.runs)}};
  for (const auto& [name, version] : {std::pair("Embree", embree_version()), {"POV-Ray", povray_version()}}) {
    report.conditions.emplace_back(name, version.value_or("none"));
    if (!version) report.notes.push_back(std::string(name) + ": not installed");
  }
  compare_models(settings, report);
  compare_pictures(settings, report);
  return report;
}

void write(const Report& report, const fs::path& folder) {
  fs::create_directories(folder);
  const auto open = [&](const char* name) {
    std::ofstream file(folder / name);
    if (!file) throw InputError("cannot write '" + (folder / name).string() + "'");
    return file;
  };
  std::ofstream table = open("compare.txt"), json = open("compare.json"), plot = open("compare.svg");
  write_table(table, report);
  write_json(json, report);
  write_plot(plot, report);
}

/// Two minutes on an idle computer.
void hurry(Settings& settings) {
  settings.runs = 3;
  settings.threads = {1};
  settings.width = 640;
  settings.height = 480;
  settings.primitives = {1'000, 100'000};
  settings.sample_seconds = 0.1;
}

fs::path beside_sources(const char* name) {
  const fs::path folder = fs::path(CELLTRACE_SOURCE_DIR).parent_path() / "shared" / name;
  return fs::is_directory(folder) ? folder : fs::path();
}

int measure(int argc, char** argv) {
  Settings settings;
  settings.models = beside_sources("models");
  settings.scenes = beside_sources("scenes");
  if (std::find(argv, argv + argc, std::string_view("--quick")) != argv + argc) {
    hurry(settings);
    if (!settings.scenes.empty()) settings.scenes /= "first";
  }
  bool quick = false;
  std::string only, clock = "wall";
  fs::path out = ".";

  CLI::App app("celltrace beside Embree and POV-Ray on the same scenes");
  app.add_flag("--quick", quick, "Fewer and smaller scenes, 3 rounds, one thread");
  app.add_option("--runs", settings.runs, "Rounds, in which all take their turns")
      ->check(CLI::Range(1, 1000));
  app.add_option("--threads", settings.threads, "Numbers of threads")->delimiter(',');
  app.add_option("--size", settings.size, "Pixels a side of models' pictures")->check(CLI::Range(16, 8192));
  app.add_option("--primitives", settings.primitives, "Sizes of generated models; 0: none")->delimiter(',');
  app.add_option("--models", settings.models, "Folder of triangle soups (.bin), or none");
  app.add_option("--scenes", settings.scenes, "Folder of POV-Ray scenes, or none");
  app.add_option("--only", only, "Regular expression, found in measure/scene, such as 'rays/(bunny|head)$'");
  app.add_option("--clock", clock, "What times are compared: wall, or processor on a busy computer")
      ->check(CLI::IsMember({"wall", "processor"}));
  app.add_option("--out", out, "Folder for compare.txt, compare.json and compare.svg");
  CLI11_PARSE(app, argc, argv);
  std::erase(settings.primitives, std::size_t{0});
  settings.processor_clock = clock == "processor";
  try {
    settings.only = std::regex(only);
    const Report report = run(settings);
    write_table(std::cout, report);
    write(report, out);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "celltrace_compare: " << error.what() << '\n';
    return 1;
  }
}

} // namespace

} // namespace celltrace::compare

int main(int argc, char** argv) {
  return celltrace::compare::measure(argc, argv);
}

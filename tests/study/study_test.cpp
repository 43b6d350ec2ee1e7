// The study: its scenes, its tables and what becomes of them in files.
#include "study/chart.hpp"
#include "study/experiment.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <unistd.h>

using namespace celltrace;
using namespace celltrace::study;

namespace {

namespace fs = std::filesystem;

/// A folder that is gone at the end.
class Folder {
public:
  Folder() : path_(fs::temp_directory_path() / ("celltrace-study-" + std::to_string(getpid()))) {}
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }
  std::string read(const std::string& name) const {
    std::ifstream file(path_ / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

private:
  fs::path path_;
};

Table small_table() {
  Table table{"small", "A title", "It said so.", "It is so.", {{"name"}, {"half, %", 1}}, {}, {}};
  table.rows = {{"a, \"b\"", 0.25}, {"c", Value()}};
  table.chart = {Chart::Kind::lines, "x & y", "z", true, false, {}, {{"<one>", {{1, 2}, {4, 3}}}}};
  return table;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

} // namespace

TEST_CASE("The study's scenes are valid, and of the sizes that their words say") {
  const std::vector<StudyScene> scenes = make_scenes();
  REQUIRE(scenes.size() == 7);
  const auto objects = [](const Scene& scene) {
    std::size_t n = 0;
    for (const Object& object : scene.objects) {
      const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
      n += mesh != nullptr ? (*mesh)->triangles.size() : 1;
    }
    return n;
  };
  const std::size_t sizes[] = {10, 900, 400, 1496, 7383, 10082, 100352};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    INFO(scenes[i].name);
    CHECK_NOTHROW(validate(scenes[i].scene));
    CHECK(objects(scenes[i].scene) == sizes[i]);
    CHECK_FALSE(scenes[i].what.empty());
  }
}

TEST_CASE("A claim takes the best scene, or the worst where it has to hold everywhere") {
  const std::vector<ClaimValue> values = {{"a", "1", 2}, {"b", "2", 5}, {"c", "3", 3}};
  const Claim somewhere = make_claim(values, Holds::somewhere, 4, false, 0);
  CHECK(somewhere.scene == "b");
  CHECK(somewhere.reached());
  CHECK(somewhere.missed == std::vector<std::string>{"a", "c"});
  const Claim everywhere = make_claim(values, Holds::everywhere, 2.5, false, 0);
  CHECK(everywhere.scene == "a");
  CHECK_FALSE(everywhere.reached());
  const Claim ceiling = make_claim(values, Holds::everywhere, 5, true, 0);
  CHECK(ceiling.scene == "b");
  CHECK(ceiling.reached());
  CHECK(ceiling.missed.empty());
}

TEST_CASE("A study becomes text, JSON, CSV and SVG") {
  Study study;
  study.tables.push_back(small_table());
  study.claims["gde_over_static"] = make_claim({{"corner", "--spes 8", 2.5}}, Holds::somewhere, 2, false, 2);
  const std::string text = to_text(study);
  CHECK_THAT(text, Catch::Contains("A title\n=======") && Catch::Contains("The thesis: It said so.") &&
                       Catch::Contains("Here: It is so.") && Catch::Contains("gde_over_static"));
  const Folder folder;
  save(study, folder.path());
  CHECK(folder.read("small.csv") == "name,\"half, %\"\r\n\"a, \"\"b\"\"\",0.2\r\nc,\r\n");
  const auto json = nlohmann::json::parse(folder.read("study.json"));
  CHECK(json["claims"]["gde_over_static"]["value"] == 2.5);
  CHECK(json["claims"]["gde_over_static"]["scene"] == "corner");
  CHECK(json["claims"]["gde_over_static"]["parameters"] == "--spes 8");
  CHECK(json["claims"]["gde_over_static"]["reached"] == true);
  CHECK(json["tables"][0]["rows"][0][1] == 0.25);
  CHECK(json["tables"][0]["rows"][1][1].is_null());
  const std::string svg = folder.read("small.svg");
  CHECK_THAT(svg, Catch::StartsWith("<svg") && Catch::EndsWith("</svg>\n") && Catch::Contains("x &amp; y") &&
                      Catch::Contains("&lt;one&gt;"));
  CHECK(count(svg, "<circle") == 2);
  CHECK(folder.read("study.txt") == text);
}

TEST_CASE("Counted cycles are near those of machine code") {
  if (!has_machine_code()) {
    WARN("skipped: this build has no machine code for cell_sim");
    return;
  }
  const std::vector<StudyScene> scenes = make_scenes();
  std::vector<Job> jobs;
  for (const std::size_t scene : {0, 1, 2, 3})
    for (const Accelerator accelerator : {Accelerator::bvh, Accelerator::grid}) {
      Job job{&scenes[scene].scene, {}, 2};
      job.options.width = 64;
      job.options.height = 48;
      job.options.spes = 2;
      job.options.accelerator = accelerator;
      jobs.push_back(job);
    }
  const Runner runner(Backend::cell_emu, 0, [] {});
  const std::vector<Outcome> counted = runner.run(jobs), executed = runner.run(jobs, Backend::cell_sim);
  double sum = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    INFO(scenes[i / 2].name << (i % 2 == 0 ? " on a BVH" : " on a grid"));
    const double ratio = static_cast<double>(counted[i].last().render_cycles) /
                         static_cast<double>(executed[i].last().render_cycles);
    CHECK(std::abs(ratio - 1) < 0.15);
    sum += ratio;
  }
  CHECK(std::abs(sum / static_cast<double>(jobs.size()) - 1) < 0.05);
}

TEST_CASE("A folder that cannot be made is an error") {
  Study study;
  CHECK_THROWS_AS(save(study, "/dev/null/folder"), InputError);
}

TEST_CASE("Bars have a group for each label, also on a logarithmic axis") {
  Chart chart{Chart::Kind::bars,
              "scene",
              "times",
              false,
              true,
              {"a", "b"},
              {{"one", {{0, 0.5}, {1, 8}}}, {"two", {{0, 2}}}}};
  const std::string svg = draw("Bars", chart);
  CHECK(count(svg, "<rect") == 1 + 2 + 3); // the ground, the legend, the bars
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("height='-") == std::string::npos);
}

TEST_CASE("Jobs that run side by side give what they give alone, and an error of one is everybody's") {
  const std::vector<StudyScene> scenes = make_scenes();
  std::vector<Job> jobs;
  for (const unsigned spes : {1u, 2u, 3u}) {
    Job job{&scenes[0].scene, {}, 2};
    job.options.width = 48;
    job.options.height = 36;
    job.options.spes = spes;
    jobs.push_back(job);
  }
  int heard = 0;
  const std::vector<Outcome> together = Runner(Backend::cell_emu, 3, [&] { ++heard; }).run(jobs);
  const std::vector<Outcome> one_by_one = Runner(Backend::cell_emu, 1, [] {}).run(jobs);
  CHECK(heard == 3);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    CHECK(together[i].last().render_cycles == one_by_one[i].last().render_cycles);
    CHECK(together[i].picture == together[0].picture);
  }
  jobs[1].options.width = 0;
  CHECK_THROWS_AS(Runner(Backend::cell_emu, 2, [] {}).run(jobs), InputError);
}

TEST_CASE("Packets in SIMD lanes take fewer cycles a ray than rays one by one") {
  const Study study = run_study({true, 1, "simd"}, {});
  REQUIRE(study.tables.size() == 1);
  REQUIRE(study.tables[0].rows.size() == 2);
  for (const std::vector<Value>& row : study.tables[0].rows)
    CHECK(std::get<double>(row[3]) > 2);
  CHECK_THROWS_AS(run_study({true, 1, "nothing"}, {}), InputError);
}

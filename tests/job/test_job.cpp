// A job from its start to its end.
#include "celltrace/job.hpp"

#include <catch2/catch.hpp>

#include "job/scenes.hpp"

#include <atomic>
#include <fstream>
#include <future>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace celltrace;
using test::small_options;

TEST_CASE("a job's picture is that of parsing and rendering one after the other") {
  ParseOptions parse;
  parse.width = 64;
  parse.height = 48;
  const Scene scene = parse_string(test::kScene, parse);
  const Image expected = render(scene, small_options().render).image;
  SECTION("of a text") {
    RenderJob job(SceneText{test::kScene}, small_options());
    CHECK(job.take().image == expected);
    REQUIRE(job.scene());
    CHECK(job.scene()->objects.size() == scene.objects.size());
    CHECK_THROWS_AS(job.take(), InputError);
  }
  SECTION("of a scene") {
    RenderJob job(scene, small_options());
    CHECK(job.take().image == expected);
  }
  SECTION("of a scene that others look at, too") {
    const auto shared = std::make_shared<const Scene>(scene);
    RenderJob one(shared, small_options()), other(shared, small_options());
    CHECK(one.take().image == expected);
    CHECK(other.take().image == expected);
  }
}

TEST_CASE("one progress goes over reading, building and rendering") {
  std::vector<JobProgress> heard;
  JobOptions options = small_options();
  options.progress = [&](const JobProgress& progress) { heard.push_back(progress); };
  RenderJob job(SceneText{test::kScene}, options);
  job.take();
  const JobProgress end = job.progress();
  CHECK(end.phase == JobPhase::over);
  CHECK(end.fraction == 1);
  REQUIRE(!heard.empty());
  CHECK(heard.front().phase == JobPhase::reading);
  CHECK(heard.back().phase == JobPhase::rendering);
  CHECK(heard.back().fraction == 1);
  bool builds = false;
  for (std::size_t i = 1; i < heard.size(); ++i) {
    builds |= heard[i].phase == JobPhase::building;
    CHECK(heard[i].phase >= heard[i - 1].phase);
    CHECK(heard[i].fraction >= heard[i - 1].fraction);
    if (heard[i].phase == heard[i - 1].phase) CHECK(heard[i].phase_fraction >= heard[i - 1].phase_fraction);
  }
  CHECK(builds);
}

TEST_CASE("a job that fails says so where it is waited for") {
  SECTION("a scene with faults, all of them as data") {
    RenderJob job(SceneText{"#warning \"dear\"\novus { }\njulia_fractal { <0,0,0,0> }\noops", "a.pov"},
                  small_options());
    try {
      job.take();
      FAIL("it was accepted");
    } catch (const SceneError& error) {
      const auto& findings = error.findings();
      REQUIRE(findings.size() == 4);
      CHECK(findings[0].severity == Finding::Severity::warning);
      CHECK(findings[0].text == "dear");
      CHECK(findings[1].line == 2);
      CHECK(findings[2].line == 3);
      CHECK(findings[3].file == "a.pov");
      CHECK(findings[3].line == 4);
      CHECK(findings[3].column == 1);
      CHECK(findings[3].text == "'oops' is not declared");
    }
    CHECK(job.findings().size() == 4);
    CHECK(!job.scene());
  }
  SECTION("a file that is not there") {
    RenderJob job("no/such/scene.pov", small_options());
    CHECK_THROWS_AS(job.take(), SceneError);
  }
  SECTION("no scene") {
    RenderJob job(std::shared_ptr<const Scene>(), small_options());
    CHECK_THROWS_AS(job.take(), InputError);
  }
  SECTION("options out of range") {
    JobOptions options = small_options();
    options.render.width = 0;
    RenderJob job(SceneText{test::kScene}, options);
    CHECK_THROWS_AS(job.take(), InputError);
  }
  SECTION("what a function of the application's throws") {
    JobOptions options = small_options();
    options.progress = [](const JobProgress& progress) {
      if (progress.phase == JobPhase::rendering) throw std::domain_error("enough");
    };
    RenderJob job(SceneText{test::kScene}, options);
    CHECK_THROWS_AS(job.take(), std::domain_error);
  }
}

TEST_CASE("a job says once that it is over, to who may take its picture there and then") {
  std::promise<Image> taken;
  std::atomic<int> calls = 0;
  JobOptions options = small_options();
  options.finished = [&](RenderJob& job) {
    ++calls;
    CHECK(job.is_over());
    taken.set_value(job.take().image);
  };
  RenderJob job(SceneText{test::kScene}, options);
  const Image image = taken.get_future().get();
  CHECK(image.width == 64);
  job.wait();
  CHECK_THROWS_AS(job.take(), InputError);
  CHECK(calls == 1);
}

TEST_CASE("a job can be dropped by its own functions") {
  std::promise<void> dropped;
  std::unique_ptr<RenderJob> job;
  std::mutex is_there;
  JobOptions options = small_options();
  options.finished = [&](RenderJob&) {
    {
      const std::lock_guard lock(is_there);
      job.reset();
    }
    dropped.set_value();
  };
  {
    const std::lock_guard lock(is_there);
    job = std::make_unique<RenderJob>(SceneText{test::kScene}, options);
  }
  dropped.get_future().get();
  CHECK(!job);
}

TEST_CASE("a job runs where its host says") {
  std::vector<std::function<void()>> queue;
  JobOptions options = small_options();
  options.executor = [&](std::function<void()> work) { queue.push_back(std::move(work)); };
  SECTION("later") {
    RenderJob job(SceneText{test::kScene}, options);
    CHECK(job.progress().phase == JobPhase::waiting);
    CHECK(!job.wait_for(std::chrono::milliseconds(1)));
    queue.front()();
    CHECK(job.is_over());
    CHECK(job.take().complete);
  }
  SECTION("not any more, once it is cancelled") {
    int calls = 0;
    options.finished = [&](RenderJob&) { ++calls; };
    RenderJob job(SceneText{test::kScene}, options);
    job.cancel();
    CHECK(job.is_over());
    CHECK(calls == 1);
    queue.front()();
    CHECK_THROWS_AS(job.take(), Cancelled);
    CHECK(calls == 1);
  }
  SECTION("not at all: that cancels it") {
    RenderJob job(SceneText{test::kScene}, options);
    queue.clear();
    CHECK(job.is_over());
    CHECK_THROWS_AS(job.take(), Cancelled);
  }
  SECTION("at once") {
    options.executor = [](const std::function<void()>& work) { work(); };
    RenderJob job(SceneText{test::kScene}, options);
    CHECK(job.is_over());
    CHECK(job.take().complete);
  }
}

TEST_CASE("a job's scene can be in memory altogether") {
  JobOptions options = small_options();
  std::vector<std::string> asked;
  options.parse.file = [&](const std::string& name) -> std::optional<std::string> {
    asked.push_back(name);
    if (name == "parts/ball.inc") return "#declare Ball = sphere { 0, 1 pigment { rgb x } }";
    return std::nullopt;
  };
  RenderJob job(SceneText{"#include \"parts\\ball.inc\" object { Ball } camera { location -5 * z }"},
                options);
  CHECK(job.take().complete);
  CHECK(asked == std::vector<std::string>{"parts/ball.inc"});
}

TEST_CASE("the program of docs/embedding.md is the example") {
  const auto text_of_file = [](const std::string& path) {
    std::ifstream file(CELLTRACE_SOURCE_DIR "/" + path);
    REQUIRE(file);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string program = "```cpp\n" + text_of_file("examples/render_job/render_job.cpp") + "```\n";
  CHECK(text_of_file("docs/embedding.md").find(program) != std::string::npos);
}

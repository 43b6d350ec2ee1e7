#include "calibration.hpp"

#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/recorder.hpp"
#include "celltrace/spe/spu.hpp"
#include "study/runs.hpp"
#include "study/scenes.hpp"

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <sstream>

namespace celltrace::calibration {

namespace {

Charges charges_of(const ScalarWork& work) {
  return {double(work.fixed),    double(work.floating), double(work.memory), double(work.shuffle),
          double(work.branches), double(work.shift),    double(work.waits),  double(work.misses)};
}

/// Counts what kinds of work are done.
class WorkCounter : public SpeRecorder {
public:
  struct Kind {
    ScalarWork work;
    std::uint64_t times = 0;
  };

  void record(unsigned, const void*, std::uint32_t) override {}
  void computed(unsigned, const ScalarWork& work) override {
    const std::lock_guard lock(mutex_);
    Kind& kind = kinds_[work.name == nullptr ? "" : work.name];
    kind.work = work;
    ++kind.times;
  }
  std::map<std::string, Kind> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(kinds_, {});
  }

private:
  std::mutex mutex_;
  std::map<std::string, Kind> kinds_;
};

SpuCycles cycles_in(const RenderStatistics& statistics) {
  SpuCycles cycles = statistics.prepare;
  for (const RenderStatistics::Spe& spe : statistics.spes)
    cycles += spe.cycles;
  return cycles;
}

std::map<std::string, double> by_name(const SpuCycles& cycles) {
  std::map<std::string, double> counts;
  for (const auto& [name, count] : kSpuCycleCounts)
    counts[name] = static_cast<double>(cycles.*count);
  return counts;
}

struct Job {
  std::string name;
  const Scene* scene;
  RenderOptions options;
};

void add_work(const std::map<std::string, WorkCounter::Kind>& kinds, Frame& frame,
              std::map<std::string, Charges>& charges) {
  for (const auto& [name, kind] : kinds) {
    const Charges each = charges_of(kind.work);
    charges[name] = each;
    frame.times[name] = double(kind.times);
    for (std::size_t unit = 0; unit < kUnitCount; ++unit)
      frame.facade[unit] -= double(kind.times) * each[unit];
    frame.latency -= double(kind.times) * each[waits];
  }
}

/// The first frame, with an accelerator that is built and a cache that is empty, and the second.
std::vector<Frame> render_both(const Job& job, std::map<std::string, Charges>& charges) {
  WorkCounter counter;
  RenderOptions options = job.options;
  options.emulation.schedule = Schedule::lockstep;
  options.backend = Backend::cell_sim;
  Renderer simulating(options);
  options.backend = Backend::cell_emu;
  options.emulation.recorder = &counter;
  Renderer emulating(options);
  std::vector<Frame> frames;
  for (int i = 0; i < 2; ++i) {
    const auto next = [&](Renderer& renderer) {
      return i == 0 ? renderer.render(*job.scene) : renderer.render(job.scene->camera);
    };
    Frame frame;
    frame.name = job.name + (i == 0 ? " 1" : " 2");
    frame.simulated = by_name(cycles_in(next(simulating).statistics));
    const SpuCycles emulated = cycles_in(next(emulating).statistics);
    frame.emulated = by_name(emulated);
    frame.facade = {double(emulated.fx2),  double(emulated.fp6), double(emulated.ls),
                    double(emulated.shuf), double(emulated.br),  double(emulated.fx3)};
    frame.other = double(emulated.fp7) + double(emulated.fxb);
    frame.latency = double(emulated.stall_due_to_dependency);
    add_work(counter.take(), frame, charges);
    frame.latency /= options.emulation.timing.exposed_latency;
    frames.push_back(frame);
  }
  return frames;
}

std::string file_name(std::string path) {
  return std::filesystem::path(path).stem().string();
}

} // namespace

void measure(const std::vector<std::string>& paths, unsigned threads, std::ostream& out) {
  std::vector<study::StudyScene> scenes = study::make_scenes();
  for (const std::string& path : paths)
    scenes.push_back({file_name(path), "", parse_file(path)});
  std::vector<Job> jobs;
  const auto add = [&](const study::StudyScene& scene, const std::string& what, int width, auto change) {
    Job job{scene.name + what, &scene.scene, {}};
    job.options.width = width;
    job.options.height = width * 3 / 4;
    job.options.spes = 1;
    change(job.options);
    jobs.push_back(job);
  };
  for (const study::StudyScene& scene : scenes) {
    add(scene, "", 128, [](RenderOptions&) {});
    add(scene, "/grid", 96, [](RenderOptions& o) { o.accelerator = Accelerator::grid; });
    add(scene, "/grid-tiny", 8, [](RenderOptions& o) { o.accelerator = Accelerator::grid; });
    add(scene, "/off", 64, [](RenderOptions& o) { o.cache.enabled = false; });
    add(scene, "/lru", 64, [](RenderOptions& o) { o.cache.replacement = CacheReplacement::lru; });
    add(scene, "/grid-off", 48, [](RenderOptions& o) {
      o.accelerator = Accelerator::grid;
      o.cache.enabled = false;
    });
    for (const auto& model : {std::pair("/pipeline", Model::pipeline),
                              {"/split", Model::pipeline_split},
                              {"/offload", Model::offload}})
      add(scene, model.first, 64, [&](RenderOptions& o) {
        o.model = model.second;
        o.accelerator = Accelerator::grid;
        o.spes = 4;
      });
  }
  std::mutex mutex;
  std::size_t done = 0;
  const study::Runner runner(Backend::cell_sim, threads,
                             [&] { std::cerr << '\r' << ++done << " of " << jobs.size() << std::flush; });
  runner.each(jobs.size(), [&](std::size_t i) {
    Measurements both;
    both.frames = render_both(jobs[i], both.charges);
    const std::lock_guard lock(mutex);
    write(out, both);
    out.flush();
  });
  std::cerr << '\n';
}

namespace {

void write_charges(std::ostream& out, const char* key, const std::string& name, const Charges& charges) {
  out << key << ' ' << std::quoted(name);
  for (const double charge : charges)
    out << ' ' << charge;
  out << '\n';
}
Charges read_charges(std::istream& in) {
  Charges charges;
  for (double& charge : charges)
    in >> charge;
  return charges;
}

} // namespace

void write(std::ostream& out, const Measurements& measurements) {
  out << std::setprecision(12);
  for (const auto& [name, charges] : measurements.charges)
    write_charges(out, "charges", name, charges);
  for (const Frame& frame : measurements.frames) {
    out << "frame " << std::quoted(frame.name) << '\n';
    for (const auto& [name, count] : frame.simulated)
      out << "simulated " << std::quoted(name) << ' ' << count << '\n';
    for (const auto& [name, count] : frame.emulated)
      out << "emulated " << std::quoted(name) << ' ' << count << '\n';
    for (const auto& [name, count] : frame.times)
      out << "times " << std::quoted(name) << ' ' << count << '\n';
    write_charges(out, "facade", "", frame.facade);
    out << "other \"\" " << frame.other << "\nlatency \"\" " << frame.latency << '\n';
  }
}

Measurements read(std::istream& in) {
  Measurements measurements;
  std::string key, name;
  while (in >> key >> std::quoted(name)) {
    if (key == "charges") {
      measurements.charges[name] = read_charges(in);
      continue;
    }
    if (key == "frame") {
      measurements.frames.push_back({});
      measurements.frames.back().name = name;
      continue;
    }
    Frame& frame = measurements.frames.back();
    if (key == "facade")
      frame.facade = read_charges(in);
    else if (key == "other")
      in >> frame.other;
    else if (key == "latency")
      in >> frame.latency;
    else
      in >> (key == "simulated" ? frame.simulated : key == "emulated" ? frame.emulated : frame.times)[name];
  }
  return measurements;
}

} // namespace celltrace::calibration

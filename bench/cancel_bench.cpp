// How long a job takes to end after it was cancelled, by what it did at that moment: a scene of two million
// triangles, as text and built in code, cancelled at times drawn at random.
// Besides, what processors have worked meanwhile for the job, in all threads: on a computer with other work
// to do, what is above that is waiting for a processor.
//
//   bench_cancel [TIMES] [SIDE] [BACKEND]
//
// TIMES for each kind of scene, 300 by default; SIDE is that of the mesh's square, 1000 by default.
#include "celltrace/job.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace celltrace;
using Clock = std::chrono::steady_clock;

namespace {

double height_at(int x, int z, int side) {
  return 0.05 * std::sin(40.0 * x / side) * std::cos(31.0 * z / side);
}

Scene hills(int side) {
  auto mesh = std::make_shared<Mesh>();
  const auto at = [side](int x, int z) { return static_cast<Index>(z * (side + 1) + x); };
  for (int z = 0; z <= side; ++z)
    for (int x = 0; x <= side; ++x)
      mesh->vertices.push_back(Vec3f(Vec3(double(x) / side - 0.5, height_at(x, z, side), double(z) / side)));
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      mesh->triangles.push_back({{at(x, z), at(x + 1, z), at(x, z + 1)}});
      mesh->triangles.push_back({{at(x + 1, z), at(x + 1, z + 1), at(x, z + 1)}});
    }
  Scene scene;
  scene.camera.location = {0, 0.4, -0.8};
  scene.camera.direction = {0, -0.3, 1};
  Light light;
  light.location = {3, 5, -3};
  scene.lights.push_back(light);
  Object object;
  object.shape = std::shared_ptr<const Mesh>(mesh);
  object.material = scene.add(Material());
  object.interior = scene.add(Interior());
  scene.objects.push_back(object);
  return scene;
}

/// The same in the scene language.
std::string text_of(const Scene& scene) {
  const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(scene.objects.front().shape);
  std::string text = "camera { location <0, 0.4, -0.8> direction <0, -0.3, 1> }\n"
                     "light_source { <3, 5, -3>, 1 }\nmesh2 { vertex_vectors { ";
  char line[128];
  text += std::to_string(mesh.vertices.size());
  for (const Vec3f& v : mesh.vertices) {
    std::snprintf(line, sizeof line, ",\n<%.6f, %.6f, %.6f>", double(v.x), double(v.y), double(v.z));
    text += line;
  }
  text += "\n}\nface_indices { " + std::to_string(mesh.triangles.size());
  for (const Mesh::Triangle& t : mesh.triangles) {
    std::snprintf(line, sizeof line, ",\n<%u, %u, %u>", t.vertex[0], t.vertex[1], t.vertex[2]);
    text += line;
  }
  return text + "\n}\npigment { rgb 0.8 } }\n";
}

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Of all threads.
double processor_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void print_distribution(std::vector<double>& all) {
  std::sort(all.begin(), all.end());
  const auto at = [&](double share) { return all[static_cast<std::size_t>(share * double(all.size() - 1))]; };
  std::printf("median %.2f, 99 %% %.2f, most %.2f", at(0.5), at(0.99), all.back());
}

const char* name_of(JobPhase phase) {
  static constexpr const char* kNames[] = {"waiting", "reading", "building", "rendering", "over"};
  return kNames[static_cast<int>(phase)];
}

void measure(const char* what, const JobScene& scene, const JobOptions& options, int times) {
  std::map<JobPhase, double> begins; // of a job that is left alone
  JobOptions watched = options;
  const auto begin = Clock::now();
  std::map<JobPhase, std::pair<double, double>> silences; // the longest, and before which fraction
  double heard = 0;
  watched.progress = [&](const JobProgress& progress) {
    const double now = milliseconds_since(begin);
    begins.try_emplace(progress.phase, now);
    auto& silence = silences[progress.phase];
    silence = std::max(silence, {now - heard, progress.phase_fraction});
    heard = now;
  };
  RenderJob whole(scene, watched);
  whole.wait();
  const double total = milliseconds_since(begin);
  std::printf("%s: %.0f ms", what, total);
  for (const auto& [phase, at] : begins)
    std::printf(", %s from %.0f ms", name_of(phase), at);
  std::printf("\n");
  for (const auto& [phase, silence] : silences)
    std::printf("  %-10s silent for %.1f ms at most, up to %.2f of it\n", name_of(phase), silence.first,
                silence.second);
  whole.take();

  std::mt19937 random(1);
  std::map<JobPhase, std::vector<double>> taken, worked;
  for (int i = 0; i < times; ++i) {
    RenderJob job(scene, options);
    const double wait = std::uniform_real_distribution<>(0, total)(random);
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(wait));
    const JobPhase phase = job.progress().phase;
    const auto cancelled = Clock::now();
    const double processor = processor_milliseconds();
    job.cancel();
    job.wait();
    if (phase == JobPhase::over) continue;
    taken[phase].push_back(milliseconds_since(cancelled));
    worked[phase].push_back(processor_milliseconds() - processor);
  }
  for (auto& [phase, all] : taken) {
    std::printf("  %-10s %4zu times, ms until it ended: ", name_of(phase), all.size());
    print_distribution(all);
    std::printf("; of processors: ");
    print_distribution(worked[phase]);
    std::printf("\n");
  }
}

} // namespace

int main(int argc, char** argv) {
  const int times = argc > 1 ? std::atoi(argv[1]) : 300;
  const int side = argc > 2 ? std::atoi(argv[2]) : 1000;
  JobOptions options;
  if (argc > 3) options.render.backend = backend_named(argv[3]);
  options.render.antialiasing = Antialiasing(); // so that rendering takes a while, too
  const auto scene = std::make_shared<const Scene>(hills(side));
  const SceneText text = {text_of(*scene), "hills.pov"};
  measure("text", text, options, times);
  measure("scene", scene, options, times);
  return 0;
}

// A torus built in code, rendered by two SPEs with progress, and cancelled when it takes too long:
// own_geometry OUT.png [SECONDS]
#include <celltrace/render.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace {

using celltrace::Index;
using celltrace::Vec3f;

/// A torus around the y axis with smooth normals; `around` and `across` are numbers of vertices.
std::shared_ptr<const celltrace::Mesh> make_torus(float radius, float thickness, Index around, Index across) {
  const float turn = 6.2831853f;
  auto mesh = std::make_shared<celltrace::Mesh>();
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const float u = turn * static_cast<float>(i) / static_cast<float>(around);
      const float v = turn * static_cast<float>(j) / static_cast<float>(across);
      const Vec3f normal(std::cos(v) * std::cos(u), std::sin(v), std::cos(v) * std::sin(u));
      mesh->normals.push_back(normal);
      mesh->vertices.push_back(radius * Vec3f(std::cos(u), 0, std::sin(u)) + thickness * normal);

      const Index here = i * across + j, beside = i * across + (j + 1) % across;
      const Index next = (i + 1) % around * across + j,
                  next_beside = (i + 1) % around * across + (j + 1) % across;
      mesh->triangles.push_back({{here, next, next_beside}, {here, next, next_beside}});
      mesh->triangles.push_back({{here, next_beside, beside}, {here, next_beside, beside}});
    }
  return mesh;
}

celltrace::Scene make_scene() {
  celltrace::Scene scene;
  scene.camera.location = {0, 2.5, -4};
  scene.camera.direction = {0, -0.53, 0.85};
  scene.camera.up = {0, 0.85, 0.53};
  scene.background = {0.2, 0.25, 0.35};
  scene.lights.push_back({{5, 8, -6}});

  celltrace::Material copper;
  copper.pigment.rgb = {0.8, 0.4, 0.2};
  copper.finish.specular = 0.6;
  copper.finish.roughness = 0.02;

  celltrace::Object torus;
  torus.shape = make_torus(1.2f, 0.45f, 96, 48);
  torus.transform = celltrace::Transform::rotate({-20, 0, 15});
  torus.material = scene.add(copper);
  torus.interior = scene.add(celltrace::Interior{});
  scene.objects.push_back(torus);
  return scene;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: %s OUT.png [SECONDS]\n", argv[0]);
    return 1;
  }
  const std::chrono::duration<double> limit(argc == 3 ? std::atof(argv[2]) : 60.0);
  const auto start = std::chrono::steady_clock::now();
  try {
    celltrace::RenderOptions options;
    options.width = 800;
    options.height = 600;
    options.spes = 2;
    const celltrace::RenderResult result = celltrace::render(make_scene(), options, [&](double fraction) {
      std::fprintf(stderr, "\r%3.0f %%", 100 * fraction);
      return std::chrono::steady_clock::now() - start < limit; // false cancels
    });
    std::fprintf(stderr, result.complete ? "\n" : "\nout of time: the picture is partial\n");
    celltrace::save_image(argv[1], result.image);
  } catch (const celltrace::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

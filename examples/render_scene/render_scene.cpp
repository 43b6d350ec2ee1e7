// A POV-Ray scene into a picture: render_scene SCENE.pov OUT.png
#include <celltrace/pov.hpp>
#include <celltrace/render.hpp>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s SCENE.pov OUT.png\n", argv[0]);
    return 1;
  }
  try {
    const celltrace::Scene scene = celltrace::parse_file(argv[1]);
    const celltrace::RenderResult result = celltrace::render(scene);
    celltrace::save_image(argv[2], result.image);
  } catch (const celltrace::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

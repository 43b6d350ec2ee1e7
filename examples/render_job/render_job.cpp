// A scene in memory, rendered in the background into a picture in memory.
#include <celltrace/image.hpp>
#include <celltrace/job.hpp>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

int main() {
  celltrace::JobOptions options;
  options.render.width = 320;
  options.render.height = 240;
  options.parse.file = [](const std::string& name) -> std::optional<std::string> {
    if (name == "ball.inc") return "#declare Ball = sphere { 0, 1 pigment { rgb <1, 0.5, 0> } }";
    return std::nullopt; // look for it in the file system
  };
  options.parse.finding = [](const celltrace::Finding& finding) {
    std::fprintf(stderr, "%s\n", celltrace::to_text(finding).c_str());
  };
  celltrace::SceneText scene;
  scene.text = "#include \"ball.inc\" object { Ball }"
               "camera { location <0, 1, -4> look_at 0 } light_source { <3, 4, -5>, 1 }";
  celltrace::RenderJob job(scene, options);
  while (!job.wait_for(std::chrono::milliseconds(100)))
    std::printf("%.0f %%\n", 100 * job.progress().fraction); // job.cancel() would end it soon
  try {
    const celltrace::RenderResult result = job.take();
    const std::vector<std::uint8_t> png = celltrace::encode_image(result.image, celltrace::ImageFormat::png);
    std::printf("%zu bytes of PNG\n", png.size());
  } catch (const celltrace::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

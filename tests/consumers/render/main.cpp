// Parses and renders, and catches what a library throws.
#include <celltrace/image.hpp>
#include <celltrace/pov.hpp>
#include <celltrace/render.hpp>
#include <celltrace/version.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>

int main() {
  if (std::strcmp(celltrace::version(), CELLTRACE_VERSION_STRING) != 0) return 1;
  const celltrace::Scene scene = celltrace::parse_string("camera { location <0, 0, -5> look_at 0 }"
                                                         "light_source { <0, 0, -10> rgb 1 }"
                                                         "sphere { 0, 1 pigment { rgb <1, 0, 0> } }");
  celltrace::RenderOptions options;
  options.width = 33;
  options.height = 33;
  for (const celltrace::Backend backend : {celltrace::Backend::native, celltrace::Backend::cell_emu}) {
    options.backend = backend;
    options.spes = 2;
    const celltrace::RenderResult result = celltrace::render(scene, options);
    const std::uint8_t* const middle = result.image.pixel(16, 16);
    std::printf("%s: %d rays, middle %d %d %d\n", result.statistics.spu.c_str(),
                static_cast<int>(result.statistics.primary_rays), middle[0], middle[1], middle[2]);
    if (middle[0] < 100 || middle[1] != 0 || !result.complete) return 2;
  }
  // Pictures are made of a template that the library instantiates.
  if (celltrace::to_image(celltrace::ColourImage(4, 3)).rgba.size() != celltrace::Image(4, 3).rgba.size())
    return 4;
  try {
    celltrace::parse_string("sphere { oops }");
  } catch (const celltrace::SceneError& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
  return 3;
}

// A plugin that has celltrace in it.
#include <celltrace/pov.hpp>
#include <celltrace/render.hpp>

extern "C" __attribute__((visibility("default"))) int red_of_sphere(const char* backend);

extern "C" int red_of_sphere(const char* backend) {
  const celltrace::Scene scene = celltrace::parse_string("camera { location <0, 0, -5> look_at 0 }"
                                                         "light_source { <0, 0, -10> rgb 1 }"
                                                         "sphere { 0, 1 pigment { rgb <1, 0, 0> } }");
  celltrace::RenderOptions options;
  options.width = options.height = 33;
  options.backend = backend;
  options.spes = 2;
  return celltrace::render(scene, options).image.pixel(16, 16)[0];
}

// A plugin that has celltrace in it.
#include <celltrace/pov.hpp>
#include <celltrace/render.hpp>
#include <celltrace/spe/spu_intrinsics.hpp>

extern "C" __attribute__((visibility("default"))) int red_of_sphere(const char* backend);

extern "C" int red_of_sphere(const char* backend) {
  const celltrace::Scene scene = celltrace::parse_string("camera { location <0, 0, -5> look_at 0 }"
                                                         "light_source { <0, 0, -10> rgb 1 }"
                                                         "sphere { 0, 1 pigment { rgb <1, 0, 0> } }");
  celltrace::RenderOptions options;
  options.width = options.height = 33;
  options.backend = celltrace::backend_named(backend);
  options.spes = 2;
  const int red = celltrace::render(scene, options).image.pixel(16, 16)[0];
  // An intrinsic, for it brings more objects of the library's, whose thread-local ones have to fit as well.
  return spu_extract(spu_add(spu_splats(red), spu_splats(0)), 0);
}

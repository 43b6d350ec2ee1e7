// Faces of one CSG's parts that lie in one plane, or nearly.
#include "celltrace/image.hpp"
#include "celltrace/pov.hpp"
#include "celltrace/render.hpp"

#include <string>

#include <catch2/catch.hpp>

using namespace celltrace;

TEST_CASE("Of faces in one plane that look the same way a merge shows one") {
  const std::string placed =
      GENERATE("", "rotate <20, 30, 0>", "translate <0.3, 0.2, 0.1>", "scale 0.7 rotate 33*y");
  INFO(placed);
  const auto seen = [&](const std::string& solid) {
    RenderOptions options;
    options.width = 80;
    options.height = 60;
    return render(parse_string("#version 3.7; global_settings { assumed_gamma 1 }\n"
                               "camera { location <2, 5, -6> look_at 0 angle 45 }\n"
                               "light_source { <5, 8, -6>, 1 }\n" +
                               solid + " pigment { rgb <0.5, 0.7, 1> } " + placed + " }"),
                  options)
        .image;
  };
  const Image whole = seen("box { -1, 1");
  const std::string left = "box { <-1, -1, -1>, <0.3, 1, 1> } ", right = "box { <-0.3, -1, -1>, <1, 1, 1> } ";
  CHECK(compare_images(seen("merge { " + left + right), whole).psnr > 50);
  CHECK(compare_images(seen("merge { " + right + left), whole).psnr > 50);
  CHECK(compare_images(seen("merge { " + left + "merge { " + right + "box { <-0.5, -1, -1>, <0.5, 1, 1> } }"),
                       whole)
            .psnr > 50);
}

TEST_CASE("What lies on a plate that is hardly thick is inside of it") {
  const auto seen = [](const std::string& thickness) {
    RenderOptions options;
    options.width = 160;
    options.height = 120;
    return render(
               parse_string("camera { location <70, 30, -62> look_at <82, 30, 0> angle 25 }\n"
                            "intersection {\n"
                            "  intersection { sphere { <7.5, 30, 0>, 16 } box { <0, 20, 0>, <30, 50, " +
                            thickness +
                            "> } pigment { rgb z } finish { ambient 1 diffuse 0 } translate -0.00002*z }\n"
                            "  union { #for (I, 0, 9) box { 0, <0.5, 26.5, -0.00002> pigment { rgb x + y } "
                            "finish { ambient 1 diffuse 0 } rotate I*36*z translate <7.5, 30, 0> } #end }\n"
                            "  translate 75*x\n"
                            "}"),
               options)
        .image;
  };
  CHECK(compare_images(seen("0.00000015"), seen("0.1")).psnr > 50);
}

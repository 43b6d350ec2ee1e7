#include "image/y4m.hpp"

#include "files.hpp"
#include "image/file.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;

TEST_CASE("a film in Y4M is a header and planes of luma and chroma") {
  const TemporaryFolder folder;
  Image image(4, 1);
  const std::uint8_t colours[4][3] = {{0, 0, 0}, {255, 255, 255}, {255, 0, 0}, {0, 0, 255}};
  for (int x = 0; x < 4; ++x)
    std::copy_n(colours[x], 3, image.pixel(x, 0));
  {
    image::OutputFile file(folder / "a.y4m");
    image::write_y4m_header(file.get(), 4, 1, 30000, 1001);
    image::write_y4m_frame(file.get(), image);
    image::write_y4m_frame(file.get(), image);
    file.commit();
  }
  // ITU-R BT.601's values for black, white, red and blue.
  const std::string frame = "FRAME\n"
                            "\x10\xEB\x51\x29"
                            "\x80\x80\x5A\xF0"
                            "\x80\x80\xF0\x6E";
  CHECK(read_bytes(folder / "a.y4m") ==
        "YUV4MPEG2 W4 H1 F30000:1001 Ip A1:1 C444 XCOLORRANGE=LIMITED\n" + frame + frame);
}

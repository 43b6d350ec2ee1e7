// Writes JPEG by libjpeg: baseline, colours not subsampled, as POV-Ray does. libjpeg leaves by longjmp
// when it fails; functions here that call setjmp therefore have no locals with a destructor.
#include "image/format_table.hpp"
#include "image/jpeg_error.hpp"
#include "image/rows.hpp"

#include <string>
#include <vector>

namespace celltrace::image {

namespace {

bool begin(jpeg_compress_struct& info, JpegFailure& failure, std::FILE* file, const RowFormat& format) {
  if (setjmp(failure.leave)) return false;
  jpeg_create_compress(&info);
  jpeg_stdio_dest(&info, file);
  info.image_width = static_cast<JDIMENSION>(format.width);
  info.image_height = static_cast<JDIMENSION>(format.height);
  info.input_components = format.channels;
  info.in_color_space = format.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, format.jpeg_quality, TRUE);
  info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&info, TRUE);
  return true;
}

bool write_row(jpeg_compress_struct& info, JpegFailure& failure, std::uint8_t* row) {
  if (setjmp(failure.leave)) return false;
  jpeg_write_scanlines(&info, &row, 1);
  return true;
}

bool finish_picture(jpeg_compress_struct& info, JpegFailure& failure) {
  if (setjmp(failure.leave)) return false;
  jpeg_finish_compress(&info);
  return true;
}

/// libjpeg's state, freed on destruction.
struct JpegCompressor {
  JpegFailure failure;
  jpeg_compress_struct info = {};

  JpegCompressor() { info.err = failure.begin(); }
  JpegCompressor(const JpegCompressor&) = delete;
  JpegCompressor& operator=(const JpegCompressor&) = delete;
  ~JpegCompressor() { jpeg_destroy_compress(&info); }
};

class JpegRows : public EncodedRows {
public:
  JpegRows(std::FILE* file, const RowFormat& format)
      : EncodedRows(file, format), row_(static_cast<std::size_t>(format.channels) * width()) {
    check(begin(jpeg_.info, jpeg_.failure, file, format));
  }

private:
  void check(bool is_done) const {
    if (!is_done) throw InputError(std::string("cannot be written: ") + jpeg_.failure.text);
  }

  void put(const std::uint8_t* rgba, int count) override {
    for (int y = 0; y < count; ++y) {
      std::uint8_t* target = row_.data();
      for (std::size_t x = 0; x < width(); ++x, rgba += 4)
        for (int channel = 0; channel < format().channels; ++channel)
          *target++ = rgba[channel];
      check(write_row(jpeg_.info, jpeg_.failure, row_.data()));
    }
  }
  void end() override { check(finish_picture(jpeg_.info, jpeg_.failure)); }

  JpegCompressor jpeg_;
  std::vector<std::uint8_t> row_;
};

} // namespace

const bool kHasJpeg = true;

std::unique_ptr<RowWriter> open_jpeg(std::FILE* file, const RowFormat& format) {
  return std::make_unique<JpegRows>(file, format);
}

} // namespace celltrace::image

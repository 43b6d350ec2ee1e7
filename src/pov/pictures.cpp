#include "pov/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "pov/item_tables.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

constexpr double kVersionOfSourceGamma = 3.7;

double linear_of_srgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The way from the values of a file to the scene's working space.
struct Decoding {
  enum class From { values, srgb, power } from = From::values;
  double power = 1;       ///< makes values linear
  double to_working = 1;  ///< exponent from linear to the working space
  bool is_eight_bit = false; ///< results are rounded to 8 bits, as POV-Ray does for grey pictures

  double operator()(double v) const {
    if (from == From::values) return v;
    double decoded = from == From::srgb ? linear_of_srgb(v) : std::pow(v, power);
    if (to_working != 1) decoded = std::pow(decoded, to_working);
    return is_eight_bit ? std::round(decoded * 255) / 255 : decoded;
  }
};

/// Returns how POV-Ray decodes the colours of an image_map.
Decoding decoding_of(const Session& session, const WrittenPicture& written, const image::SourceImage& image) {
  using From = Decoding::From;
  Decoding decoding;
  const bool is_old = session.builder.is_before(kVersionOfSourceGamma);
  const bool has_working_space = session.builder.gamma_is_given() || !is_old;
  if (has_working_space) decoding.to_working = 1 / session.builder.working_gamma();
  decoding.is_eight_bit = image.is_grey && image.bits == 8 && image.format == image::SourceFormat::png;
  if (written.has_gamma) {
    decoding.from = written.gamma ? From::power : From::srgb;
    decoding.power = written.gamma.value_or(1);
    return decoding;
  }
  if (!has_working_space) return decoding;
  if (image.gamma && !image.is_srgb) {
    decoding.from = From::power;
    decoding.power = *image.gamma;
    return decoding;
  }
  const bool has_encoding = image.format != image::SourceFormat::ppm;
  if (image.is_srgb || (!is_old && has_encoding)) decoding.from = From::srgb;
  return decoding;
}

/// Returns the colours of a picture in the scene's working space.
std::shared_ptr<const Picture> colours_of(Session& session, const WrittenPicture& written,
                                          const image::SourceImage& image) {
  Decoding decoding;
  if (written.use == PictureUse::image_map || written.has_gamma) decoding = decoding_of(session, written, image);
  const bool is_wide = image.bits > 8;
  std::vector<double> decoded(is_wide ? 65536 : 256);
  for (std::size_t i = 0; i < decoded.size(); ++i)
    decoded[i] = decoding(static_cast<double>(i) / static_cast<double>(decoded.size() - 1));
  auto picture = std::make_shared<Picture>();
  picture->width = image.width;
  picture->height = image.height;
  picture->scale = std::max(1.0, decoded.back());
  std::vector<double> transmit_of(static_cast<std::size_t>(std::max(image.palette_size, 1)), 0.0);
  for (const auto& [index, value] : written.transmit_of)
    transmit_of[static_cast<std::size_t>(index)] = value;
  const auto word = [](double share) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * 65535));
  };
  const std::size_t pixels = image.rgba.size() / 4;
  session.picture_memory.take(pixels * sizeof picture->texels[0]);
  picture->texels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint16_t* const from = image.rgba.data() + 4 * i;
    const double alpha = from[3] / 65535.0;
    const double divisor = picture->scale * (written.is_premultiplied && alpha > 0 ? alpha : 1);
    for (std::size_t channel = 0; channel < 3; ++channel)
      picture->texels[i][channel] = word(decoded[is_wide ? from[channel] : from[channel] / 257] / divisor);
    const double of_index = image.index.empty() ? 0 : transmit_of[image.index[i]];
    picture->texels[i][3] = word(1 - alpha + of_index);
  }
  return picture;
}

void set_map_type(Session& session, WrittenPicture& picture, double number, const Location& where) {
  const double type = std::trunc(number);
  if (type != 0 && type != 1 && type != 2 && type != 5)
    session.fail(where, "the map_type of a picture is 0, 1, 2 or 5");
  picture.map.mapping = static_cast<int>(type);
}

void set_interpolation(Session& session, WrittenPicture& picture, double number, const Location& where) {
  const double kind = std::trunc(number);
  if (kind != 0 && kind != 2 && kind != 3 && kind != 4)
    session.fail(where, "the interpolation of a picture is 0, 2, 3 or 4");
  picture.map.interpolation = static_cast<int>(kind);
}

void set_pair(WrittenPicture& picture, double (pattern::PictureMap::*pair)[2], const Quantity& value) {
  const Vec3 v = value.vec3();
  (picture.map.*pair)[0] = v.x;
  (picture.map.*pair)[1] = v.y;
}

void ignore_word(WrittenPicture&, const ItemValues&) {
}

using Form = ItemForm;

const ItemRow<WrittenPicture> kPictureItems[] = {
    // A file's bytes decide its format, not these words.
    {"bmp", Form::word, ignore_word},
    {"exr", Form::word, ignore_word},
    {"gif", Form::word, ignore_word},
    {"hdr", Form::word, ignore_word},
    {"iff", Form::word, ignore_word},
    {"jpeg", Form::word, ignore_word},
    {"pgm", Form::word, ignore_word},
    {"png", Form::word, ignore_word},
    {"ppm", Form::word, ignore_word},
    {"sys", Form::word, ignore_word},
    {"tga", Form::word, ignore_word},
    {"tiff", Form::word, ignore_word},
    {"once", Form::option, [](WrittenPicture& picture, const ItemValues& values) { picture.map.once = values.flag(); }},
    {"premultiplied", Form::option, store<&ItemValues::flag, &WrittenPicture::is_premultiplied>},
    {"use_alpha", Form::word,
     [](WrittenPicture& picture, const ItemValues&) { picture.uses_transmittance = true; }},
    {"use_color", Form::word, ignore_word},
    {"use_colour", Form::word, ignore_word},
    {"use_index", Form::word, ignore_word},
    {"map_type", Form::value,
     [](WrittenPicture& picture, const ItemValues& values) {
       set_map_type(values.session(), picture, values.number(), values.where());
     }},
    {"interpolate", Form::value,
     [](WrittenPicture& picture, const ItemValues& values) {
       set_interpolation(values.session(), picture, values.number(), values.where());
     }},
    {"repeat", Form::value,
     [](WrittenPicture& picture, const ItemValues& values) {
       set_pair(picture, &pattern::PictureMap::repeat, values.quantity());
     }},
    {"offset", Form::value,
     [](WrittenPicture& picture, const ItemValues& values) {
       set_pair(picture, &pattern::PictureMap::offset, values.quantity());
     }},
};

} // namespace

std::vector<ItemWord> picture_items() {
  return words_of(kPictureItems);
}

void apply(Session& session, WrittenPicture& picture, const Item& item) {
  apply(kPictureItems, session, picture, item);
}

bool is_filter(int channel) {
  return Channel(channel) == Channel::filter;
}

void set_of_index(Session& session, WrittenPicture& picture, bool is_filter, double index, double value,
                  const Location& where) {
  if (!(index >= 0 && index < 256)) session.fail(where, "the index of a colour in a palette is 0 to 255");
  if (is_filter)
    mark(picture.unsupported, make_unsupported("the filter of a single colour of a palette", where));
  else
    picture.transmit_of.emplace_back(static_cast<int>(index), value);
}

void set_of_all(WrittenPicture& picture, bool is_filter, double value) {
  (is_filter ? picture.map.filter : picture.map.transmit) = value;
}

void set_gamma(Session& session, WrittenPicture& picture, double gamma, const Location& where) {
  if (!(gamma > 0)) session.fail(where, "the gamma of a picture is above 0");
  picture.has_gamma = true;
  picture.gamma = gamma;
}

std::shared_ptr<const image::SourceImage> read_picture(Session& session, const WrittenPicture& written) {
  if (!written.file) session.fail(written.where, "a picture needs the name of its file");
  std::shared_ptr<const image::SourceImage>& known = session.pictures[*written.file];
  if (known) return known;
  const std::string bytes = session.tokens.read_picture(*written.file, written.where);
  try {
    known = std::make_shared<const image::SourceImage>(
        image::read_source_image(bytes, [&](std::size_t count) { session.picture_memory.take(count); }));
  } catch (const InputError& error) {
    session.fail(written.where, "picture '" + *written.file + "' " + error.what());
  }
  return known;
}

PatternChange picture_pattern(Session& session, const WrittenPicture& written, const Location&) {
  const PictureUse use = written.use;
  const auto image = read_picture(session, written);
  for (const auto& [index, value] : written.transmit_of)
    if (index >= image->palette_size)
      session.fail(written.where, "picture '" + *written.file + "' has no palette with a colour " + std::to_string(index));
  pattern::PictureMap map = written.map;
  map.picture = colours_of(session, written, *image);
  const bool reads_alpha = written.uses_transmittance && image->has_alpha;
  return [=, unsupported = written.unsupported](Session&, PatternDefinition& pattern) {
    if (use == PictureUse::image_map)
      choose(pattern, pattern::ImageMap{map});
    else
      choose(pattern, pattern::ImageGrey{map, reads_alpha});
    mark(pattern.unsupported, unsupported);
  };
}

} // namespace celltrace::pov

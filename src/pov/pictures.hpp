// Pictures of a scene's textures and height fields: what is written of them, and their colours as the scene
// takes them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "celltrace/texture.hpp"
#include "image/source_image.hpp"
#include "pov/location.hpp"
#include "pov/pattern_changes.hpp"
#include "pov/unsupported.hpp"

namespace celltrace::pov {

struct Session;

/// The kinds of patterns that are pictures.
enum class PictureUse { image_map, image_pattern };

/// A picture and how it is spread, as written.
struct WrittenPicture {
  PictureUse use = PictureUse::image_map;
  std::optional<std::string> file;
  Location where;
  pattern::PictureMap map;
  bool has_gamma = false;
  std::optional<double> gamma; ///< exponent that makes values linear, if has_gamma; null: sRGB
  bool is_premultiplied = false;
  bool uses_transmittance = false; ///< `use_alpha`
  /// Transmittance of single colours of the palette: index and value.
  std::vector<std::pair<int, double>> transmit_of;
  UnsupportedPtr unsupported;
};

/// Returns whether a channel of colours is the filter, and not the transmittance.
bool is_filter(int channel);

/// Adds an option with an index: the filter or the transmittance of one colour of the palette.
void set_of_index(Session& session, WrittenPicture& picture, bool is_filter, double index, double value,
                  const Location& where);
/// Sets `filter all` or `transmit all`.
void set_of_all(WrittenPicture& picture, bool is_filter, double value);
/// Sets the exponent of the picture's values.
void set_gamma(Session& session, WrittenPicture& picture, double gamma, const Location& where);

/// Returns the file of a picture, decoded; each file is decoded once. Fails if there is no file or it cannot be
/// read.
std::shared_ptr<const image::SourceImage> read_picture(Session& session, const WrittenPicture& written);

/// Returns the change that makes a pattern a picture.
PatternChange picture_pattern(Session& session, const WrittenPicture& written, const Location& where);

} // namespace celltrace::pov

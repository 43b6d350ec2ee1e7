// Pictures of lines, boxes, dots and words as SVG, for charts.
#pragma once

#include <sstream>
#include <string>

namespace celltrace::image {

/// A picture. Coordinates are pixels from the upper left corner; colours and anchors ("start", "middle",
/// "end") are SVG's names for them. Words are escaped.
class Svg {
public:
  /// Makes a white picture with a sans-serif font.
  Svg(double width, double height, int font_size);

  void line(double x1, double y1, double x2, double y2, const char* colour, double width);
  void box(double x, double y, double width, double height, const char* colour);
  void dot(double x, double y, double radius, const char* colour);
  void text(double x, double y, const char* anchor, const std::string& words);
  /// Writes words in bold.
  void title(double x, double y, const std::string& words);
  /// Writes words from the bottom up, with their middle at the point.
  void rising_text(double x, double y, const std::string& words);

  /// Returns the document. Nothing can be added afterwards.
  std::string finish();

private:
  void write_text(double x, double y, const char* anchor, const std::string& more, const std::string& words);

  std::ostringstream out_;
};

} // namespace celltrace::image

#include "image/svg.hpp"

namespace celltrace::image {

Svg::Svg(double width, double height, int font_size) {
  out_.setf(std::ios::fixed);
  out_.precision(1);
  out_ << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << height
       << "' viewBox='0 0 " << width << ' ' << height << "' font-family='sans-serif' font-size='" << font_size
       << "'>\n"
       << "<rect width='100%' height='100%' fill='white'/>\n";
}

void Svg::line(double x1, double y1, double x2, double y2, const char* colour, double width) {
  out_ << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2 << "' stroke='" << colour
       << "' stroke-width='" << width << "'/>\n";
}

void Svg::box(double x, double y, double width, double height, const char* colour) {
  out_ << "<rect x='" << x << "' y='" << y << "' width='" << width << "' height='" << height << "' fill='"
       << colour << "'/>\n";
}

void Svg::dot(double x, double y, double radius, const char* colour) {
  out_ << "<circle cx='" << x << "' cy='" << y << "' r='" << radius << "' fill='" << colour << "'/>\n";
}

void Svg::text(double x, double y, const char* anchor, const std::string& words) {
  write_text(x, y, anchor, "", words);
}

void Svg::title(double x, double y, const std::string& words) {
  write_text(x, y, "start", " font-weight='bold'", words);
}

void Svg::rising_text(double x, double y, const std::string& words) {
  write_text(x, y, "middle", " transform='rotate(-90 " + std::to_string(x) + ' ' + std::to_string(y) + ")'",
             words);
}

void Svg::write_text(double x, double y, const char* anchor, const std::string& more,
                     const std::string& words) {
  out_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << '\'' << more << '>';
  for (const char each : words) {
    if (each == '&')
      out_ << "&amp;";
    else if (each == '<')
      out_ << "&lt;";
    else if (each == '>')
      out_ << "&gt;";
    else
      out_ << each;
  }
  out_ << "</text>\n";
}

std::string Svg::finish() {
  out_ << "</svg>\n";
  return out_.str();
}

} // namespace celltrace::image

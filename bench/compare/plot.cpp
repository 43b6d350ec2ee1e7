#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace celltrace::compare {

namespace {

constexpr int kWidth = 1000;
constexpr int kLabelWidth = 420;
constexpr int kRowHeight = 18;
constexpr int kMargin = 40;

/// From 0.01 to 1000 times as fast; what lies beyond is drawn at the edge.
double position(double ratio) {
  const double decades = std::clamp(std::log10(std::max(ratio, 1e-9)), -2.0, 3.0) + 2;
  return kLabelWidth + decades / 5 * (kWidth - kLabelWidth - kMargin);
}

bool is_ratio(const Figure& figure) {
  return figure.result.unit == "x";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char each : text)
    result += each == '&' ? "&amp;" : each == '<' ? "&lt;" : each == '>' ? "&gt;" : std::string(1, each);
  return result;
}

void line(std::ostream& out, double x1, double y1, double x2, double y2, const char* colour, double width) {
  out << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2 << "' stroke='" << colour
      << "' stroke-width='" << width << "'/>\n";
}

void text(std::ostream& out, double x, double y, const char* anchor, const std::string& words) {
  out << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "'>" << escaped(words)
      << "</text>\n";
}

void draw_axis(std::ostream& out, int height) {
  for (const double ratio : {0.01, 0.1, 1.0, 10.0, 100.0, 1000.0}) {
    const double x = position(ratio);
    line(out, x, kMargin, x, height - kMargin, ratio == 1.0 ? "black" : "lightgrey", 1);
    std::string label = std::to_string(ratio);
    label.erase(label.find_last_not_of("0.") + 1);
    text(out, x, kMargin - 8, "middle", ratio >= 1 ? std::to_string(static_cast<int>(ratio)) : label);
  }
}

void draw(std::ostream& out, const Figure& figure, double y) {
  const Range range = range_of(figure.result.values);
  text(out, kLabelWidth - 8, y + 4, "end",
       figure.scene + ", " + figure.measure + " / " + figure.against + ", " + std::to_string(figure.threads) +
           " thr.");
  const char* const colour = !figure.bar ? "steelblue" : figure.reached() ? "seagreen" : "firebrick";
  line(out, position(range.low), y, position(range.high), y, colour, 3);
  out << "<circle cx='" << position(range.median) << "' cy='" << y << "' r='5' fill='" << colour << "'/>\n";
  if (figure.bar)
    line(out, position(figure.bar->value), y - 7, position(figure.bar->value), y + 7, "black", 2);
}

} // namespace

void write_plot(std::ostream& out, const Report& report) {
  const auto rows = std::count_if(report.figures.begin(), report.figures.end(), is_ratio);
  const int height = 2 * kMargin + kRowHeight * static_cast<int>(rows);
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kWidth << "' height='" << height
      << "' font-family='sans-serif' font-size='11'>\n<rect width='100%' height='100%' fill='white'/>\n"
      << std::fixed << std::setprecision(1);
  text(out, kWidth / 2, 14, "middle",
       "celltrace, times as fast: median and range; the black mark is what is to be reached");
  draw_axis(out, height);
  double y = kMargin + kRowHeight / 2.0;
  for (const Figure& figure : report.figures) {
    if (!is_ratio(figure)) continue;
    draw(out, figure, y);
    y += kRowHeight;
  }
  out << "</svg>\n";
}

} // namespace celltrace::compare

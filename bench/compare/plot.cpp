#include "image/svg.hpp"
#include "report.hpp"

#include <algorithm>
#include <cmath>

namespace celltrace::compare {

namespace {

using image::Svg;

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

void draw_axis(Svg& svg, int height) {
  for (const double ratio : {0.01, 0.1, 1.0, 10.0, 100.0, 1000.0}) {
    const double x = position(ratio);
    svg.line(x, kMargin, x, height - kMargin, ratio == 1.0 ? "black" : "lightgrey", 1);
    std::string label = std::to_string(ratio);
    label.erase(label.find_last_not_of("0.") + 1);
    svg.text(x, kMargin - 8, "middle", ratio >= 1 ? std::to_string(static_cast<int>(ratio)) : label);
  }
}

void draw(Svg& svg, const Figure& figure, double y) {
  const Range range = range_of(figure.result.values);
  svg.text(kLabelWidth - 8, y + 4, "end",
           figure.scene + ", " + figure.measure + " / " + figure.against + ", " +
               std::to_string(figure.threads) + " thr.");
  const char* const colour = !figure.bar ? "steelblue" : figure.reached() ? "seagreen" : "firebrick";
  svg.line(position(range.low), y, position(range.high), y, colour, 3);
  svg.dot(position(range.median), y, 5, colour);
  if (figure.bar)
    svg.line(position(figure.bar->value), y - 7, position(figure.bar->value), y + 7, "black", 2);
}

} // namespace

void write_plot(std::ostream& out, const Report& report) {
  const auto rows = std::count_if(report.figures.begin(), report.figures.end(), is_ratio);
  const int height = 2 * kMargin + kRowHeight * static_cast<int>(rows);
  Svg svg(kWidth, height, 11);
  svg.text(kWidth / 2, 14, "middle",
           "celltrace, times as fast: median and range; the black mark is what is to be reached");
  draw_axis(svg, height);
  double y = kMargin + kRowHeight / 2.0;
  for (const Figure& figure : report.figures) {
    if (!is_ratio(figure)) continue;
    draw(svg, figure, y);
    y += kRowHeight;
  }
  out << svg.finish();
}

} // namespace celltrace::compare

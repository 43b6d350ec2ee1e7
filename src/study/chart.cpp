#include "study/chart.hpp"

#include "image/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace celltrace::study {

namespace {

using image::Svg;

constexpr double kWidth = 900, kHeight = 520;
constexpr double kLeft = 80, kRight = 190, kTop = 50, kBottom = 60; ///< margins
/// Colours that people with colour blindness can tell apart (Okabe and Ito).
constexpr const char* kColours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                    "#E69F00", "#56B4E9", "#000000", "#999933"};

const char* colour(std::size_t series) {
  return kColours[series % std::size(kColours)];
}

/// Maps values to positions on one axis.
class Axis {
public:
  Axis(double low, double high, double from, double to, bool logarithmic)
      : from_(from), to_(to), logarithmic_(logarithmic) {
    if (logarithmic_) {
      low_ = low > 0 ? low : 1;
      high_ = std::max(high, low_ * 1.01);
    } else {
      low_ = std::min(low, 0.0);
      high_ = high > low_ ? high : low_ + 1;
      step_ = nice((high_ - low_) / 5);
      high_ = std::ceil(high_ / step_ - 1e-9) * step_;
    }
  }

  double operator()(double value) const {
    const double part = logarithmic_ ? std::log(std::max(value, low_ * 1e-9) / low_) / std::log(high_ / low_)
                                     : (value - low_) / (high_ - low_);
    return from_ + std::clamp(part, 0.0, 1.0) * (to_ - from_);
  }
  double base() const { return (*this)(logarithmic_ ? low_ : 0.0); }

  std::vector<double> ticks() const {
    std::vector<double> values;
    if (!logarithmic_) {
      for (double value = low_; value <= high_ + step_ * 1e-6; value += step_)
        values.push_back(value);
      return values;
    }
    const double factor = high_ / low_ > 100 ? 10 : 2;
    double value = factor == 10 ? std::pow(10.0, std::floor(std::log10(low_)))
                                : std::pow(2.0, std::floor(std::log2(low_)));
    for (; value <= high_ * 1.001; value *= factor)
      if (value >= low_ * 0.999) values.push_back(value);
    return values;
  }

private:
  /// Returns 1, 2 or 5 times a power of ten, at least `value`.
  static double nice(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
      if (step * power >= value * 0.999) return step * power;
    return 10 * power;
  }

  double low_, high_, from_, to_, step_ = 1;
  bool logarithmic_;
};

std::string label(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

struct Range {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

void draw_frame(Svg& svg, const std::string& title, const Chart& chart, const Axis& y) {
  svg.title(kLeft, 28, title);
  for (const double value : y.ticks()) {
    svg.line(kLeft, y(value), kWidth - kRight, y(value), "#dddddd", 1);
    svg.text(kLeft - 8, y(value) + 4, "end", label(value));
  }
  svg.line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom, "black", 1);
  svg.text((kLeft + kWidth - kRight) / 2, kHeight - 15, "middle", chart.x);
  svg.rising_text(20, (kTop + kHeight - kBottom) / 2, chart.y);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const double at = kTop + 20 * static_cast<double>(i);
    svg.box(kWidth - kRight + 15, at - 9, 12, 12, colour(i));
    svg.text(kWidth - kRight + 33, at + 2, "start", chart.series[i].name);
  }
}

void draw_lines(Svg& svg, const Chart& chart, const Axis& y, const Range& range) {
  const Axis x(range.low, range.high, kLeft + 10, kWidth - kRight - 10, chart.logarithmic_x);
  for (const double value : x.ticks()) {
    svg.line(x(value), kHeight - kBottom, x(value), kHeight - kBottom + 5, "black", 1);
    svg.text(x(value), kHeight - kBottom + 20, "middle", label(value));
  }
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const auto& points = chart.series[i].points;
    for (std::size_t p = 0; p < points.size(); ++p) {
      svg.dot(x(points[p].first), y(points[p].second), 4, colour(i));
      if (p > 0)
        svg.line(x(points[p - 1].first), y(points[p - 1].second), x(points[p].first), y(points[p].second),
                 colour(i), 2);
    }
  }
}

void draw_bars(Svg& svg, const Chart& chart, const Axis& y) {
  const double group =
      (kWidth - kRight - kLeft) / static_cast<double>(std::max<std::size_t>(chart.labels.size(), 1));
  const double width = group * 0.8 / static_cast<double>(chart.series.size());
  for (std::size_t i = 0; i < chart.labels.size(); ++i)
    svg.text(kLeft + group * (static_cast<double>(i) + 0.5), kHeight - kBottom + 20, "middle",
             chart.labels[i]);
  for (std::size_t i = 0; i < chart.series.size(); ++i)
    for (const auto& [index, height] : chart.series[i].points) {
      const double left = kLeft + group * (index + 0.1) + width * static_cast<double>(i);
      svg.box(left, y(height), width * 0.92, std::max(y.base() - y(height), 0.0), colour(i));
    }
}

} // namespace

std::string draw(const std::string& title, const Chart& chart) {
  Range x, y;
  for (const Chart::Series& series : chart.series)
    for (const auto& [px, py] : series.points) {
      x.add(px);
      y.add(py);
    }
  if (x.low > x.high) {
    x = {0, 1};
    y = {0, 1};
  }
  // Bars stand on 1 if heights are factors.
  const double floor =
      chart.kind == Chart::Kind::bars && chart.logarithmic_y ? std::min(y.low * 0.8, 1.0) : y.low;
  const Axis vertical(floor, y.high, kHeight - kBottom, kTop, chart.logarithmic_y);
  Svg svg(kWidth, kHeight, 13);
  draw_frame(svg, title, chart, vertical);
  if (chart.kind == Chart::Kind::lines)
    draw_lines(svg, chart, vertical, x);
  else
    draw_bars(svg, chart, vertical);
  return svg.finish();
}

} // namespace celltrace::study

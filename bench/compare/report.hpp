// What was measured: figures with their samples, as a table, JSON and a plot.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace celltrace::compare {

struct Range {
  double median = 0, low = 0, high = 0;
};
/// Throws std::invalid_argument if there are no values.
Range range_of(std::vector<double> values);

/// One value a round, in the order they were taken.
struct Samples {
  std::string name; ///< "celltrace", "Embree, packets of 16"
  std::string unit;
  std::vector<double> values;
};

/// What is to be reached.
struct Bar {
  enum class Sense { at_least, at_most } sense = Sense::at_least;
  double value = 0;
};

/// A measured quantity of a scene.
struct Figure {
  std::string measure; ///< "rays", "rebuilt every frame"
  std::string against; ///< whom celltrace is compared with; empty for a quantity of its own
  std::string scene;
  std::size_t primitives = 0; ///< 0: not known
  unsigned threads = 1;
  Samples result; ///< times as fast as the other, or what `unit` says
  std::optional<Bar> bar;
  std::vector<Samples> from; ///< what the result was computed from

  /// Whether the median reaches the bar; true without one.
  bool reached() const;
};

struct Report {
  std::vector<std::pair<std::string, std::string>> conditions; ///< programs' versions, options, computer
  std::vector<std::string> notes;                              ///< what was left out, and why
  std::vector<Figure> figures;
};

/// Lines for people.
void write_table(std::ostream& out, const Report& report);
/// Everything, samples included.
void write_json(std::ostream& out, const Report& report);
/// Ratios with their ranges on a logarithmic axis and the bars to reach, as SVG.
void write_plot(std::ostream& out, const Report& report);

} // namespace celltrace::compare

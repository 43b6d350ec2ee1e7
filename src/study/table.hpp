// What a study finds: tables of names and numbers, each with the picture that shows it best.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace celltrace::study {

/// Nothing, words, or a number.
using Value = std::variant<std::monostate, std::string, double>;

struct Column {
  std::string name; ///< with the unit, if there is one
  int decimals = 0; ///< of its numbers
};

/// Curves, or bars with a group for each label. Coordinates are positive where an axis is logarithmic.
struct Chart {
  enum class Kind { lines, bars };
  struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points; ///< of bars: (index of the label, height)
  };

  Kind kind = Kind::lines;
  std::string x, y; ///< what the axes show
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<std::string> labels; ///< of bars' groups
  std::vector<Series> series;
};

struct Table {
  std::string id; ///< also the name of its files
  std::string title;
  std::string thesis; ///< what the thesis found
  std::string here;   ///< what is found here, in words
  std::vector<Column> columns;
  std::vector<std::vector<Value>> rows; ///< each as long as `columns`
  Chart chart;                          ///< without series: none
};

} // namespace celltrace::study

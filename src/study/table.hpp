// Results of a study: tables of names and numbers, each with a chart.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace celltrace::study {

/// A cell of a table: nothing, words, or a number.
using Value = std::variant<std::monostate, std::string, double>;

struct Column {
  std::string name; ///< name, with the unit if there is one
  int decimals = 0; ///< decimals of the column's numbers
};

/// Curves, or bars with a group for each label. Coordinates are positive if an axis is logarithmic.
struct Chart {
  enum class Kind { lines, bars };
  struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points; ///< for bars: (index of the label, height)
  };

  Kind kind = Kind::lines;
  std::string x, y; ///< titles of the axes
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<std::string> labels; ///< labels of the groups of bars
  std::vector<Series> series;
};

struct Table {
  std::string id; ///< also the name of its files
  std::string title;
  std::string thesis; ///< result of the thesis
  std::string here;   ///< result of this study, in words
  std::vector<Column> columns;
  std::vector<std::vector<Value>> rows; ///< each as long as `columns`
  Chart chart;                          ///< no chart if it has no series
};

} // namespace celltrace::study

#include "report.hpp"

#include <algorithm>
#include <stdexcept>

namespace celltrace::compare {

Range range_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("no values");
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
  return {median, values.front(), values.back()};
}

bool Figure::reached() const {
  if (!bar) return true;
  const double median = range_of(result.values).median;
  return bar->sense == Bar::Sense::at_least ? median >= bar->value : median <= bar->value;
}

} // namespace celltrace::compare

#include "report.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace celltrace::compare {

namespace {

std::string number(double value) {
  std::ostringstream text;
  // Three significant digits, but no exponent.
  if (value >= 10) text << std::fixed;
  text << std::setprecision(value >= 100 ? 0 : value >= 10 ? 1 : 3) << value;
  return text.str();
}

std::string bar_text(const Figure& figure) {
  if (!figure.bar) return "";
  const bool least = figure.bar->sense == Bar::Sense::at_least;
  return std::string(least ? ">= " : "<= ") + number(figure.bar->value) +
         (figure.reached() ? "  reached" : "  MISSED");
}

std::string title(const Figure& figure) {
  const std::string against = figure.against.empty() ? "" : " against " + figure.against;
  return figure.measure + against + ", " + std::to_string(figure.threads) +
         (figure.threads == 1 ? " thread" : " threads");
}

void write_figure(std::ostream& out, const Figure& figure) {
  const Range range = range_of(figure.result.values);
  out << "  " << std::left << std::setw(28) << figure.scene << std::right << std::setw(9)
      << number(range.median) << "  (" << number(range.low) << " .. " << number(range.high) << ") "
      << figure.result.unit;
  for (const Samples& samples : figure.from)
    out << ", " << samples.name << " " << number(range_of(samples.values).median) << " " << samples.unit;
  const std::string bar = bar_text(figure);
  out << (bar.empty() ? "" : "    ") << bar << '\n';
}

} // namespace

void write_table(std::ostream& out, const Report& report) {
  for (const auto& [name, value] : report.conditions)
    out << name << ": " << value << '\n';
  std::vector<std::string> titles;
  for (const Figure& figure : report.figures)
    if (std::string text = title(figure); std::find(titles.begin(), titles.end(), text) == titles.end())
      titles.push_back(std::move(text));
  for (const std::string& each : titles) {
    out << '\n' << each << '\n';
    for (const Figure& figure : report.figures)
      if (title(figure) == each) write_figure(out, figure);
  }
  if (!report.notes.empty()) out << "\nLeft out:\n";
  for (const std::string& note : report.notes)
    out << "  " << note << '\n';
}

} // namespace celltrace::compare

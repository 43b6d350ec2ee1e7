#include "calibration.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace celltrace::calibration {

namespace {

constexpr const char* kSimulatedUnits[kUnitCount] = {"fx2", "fp6", "ls", "shuf", "br", "fx3"};

double sum(const std::map<std::string, double>& counts, std::initializer_list<const char*> names) {
  double all = 0;
  for (const char* name : names)
    all += counts.at(name);
  return all;
}

double instructions(const std::map<std::string, double>& counts) {
  return sum(counts, {"fx2", "fx3", "fxb", "fp6", "fp7", "fpd", "ls", "shuf", "br", "hbr", "spr"});
}
double busy(const std::map<std::string, double>& counts) {
  return counts.at("total_cycle") - counts.at("channel_stall_cycle");
}

/// Ridge regression with unknowns that are not negative, by coordinate descent.
class Regression {
public:
  explicit Regression(std::size_t unknowns)
      : n_(unknowns), matrix_(unknowns * unknowns), right_(unknowns), solution_(unknowns) {}

  void add(const std::vector<double>& row, double value, double weight) {
    for (std::size_t i = 0; i < n_; ++i) {
      if (row[i] == 0) continue;
      right_[i] += weight * row[i] * value;
      for (std::size_t j = 0; j < n_; ++j)
        matrix_[i * n_ + j] += weight * row[i] * row[j];
    }
  }
  void expect(std::size_t unknown, double value, double weight) {
    matrix_[unknown * n_ + unknown] += weight;
    right_[unknown] += weight * value;
    solution_[unknown] = value;
  }
  const std::vector<double>& solve() {
    for (int sweep = 0; sweep < 20000; ++sweep)
      for (std::size_t i = 0; i < n_; ++i) {
        double rest = right_[i];
        for (std::size_t j = 0; j < n_; ++j)
          if (j != i) rest -= matrix_[i * n_ + j] * solution_[j];
        solution_[i] = std::max(0.0, rest / matrix_[i * n_ + i]);
      }
    return solution_;
  }

private:
  std::size_t n_;
  std::vector<double> matrix_, right_, solution_;
};

} // namespace

Fit fit(const Measurements& m, double trust, std::ostream& out) {
  std::vector<std::string> kinds;
  for (const auto& [name, charges] : m.charges)
    kinds.push_back(name);
  Fit result;
  for (std::size_t unit = 0; unit < kUnitCount; ++unit) {
    Regression regression(kinds.size());
    for (const Frame& frame : m.frames) {
      std::vector<double> row;
      for (const std::string& kind : kinds) {
        const auto found = frame.times.find(kind);
        row.push_back(found == frame.times.end() ? 0 : found->second);
      }
      const double scale = 1 / instructions(frame.simulated);
      regression.add(row, frame.simulated.at(kSimulatedUnits[unit]) - frame.facade[unit], scale * scale);
    }
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const double before = m.charges.at(kinds[i])[unit];
      regression.expect(i, before, trust * 1e-3 / ((before + 4) * (before + 4)));
    }
    const std::vector<double>& charges = regression.solve();
    for (std::size_t i = 0; i < kinds.size(); ++i)
      result.charges[kinds[i]][unit] = std::round(charges[i]);
  }
  out << std::fixed;
  for (const std::string& kind : kinds) {
    out << std::setw(16) << kind << std::setprecision(0);
    for (std::size_t unit = 0; unit < kUnitCount; ++unit)
      out << std::setw(8) << m.charges.at(kind)[unit] << " ->" << std::setw(4) << result.charges[kind][unit];
    out << '\n';
  }
  out << "frame: instructions now/sim, fitted/sim; by unit fitted-sim in % of instructions; parts of busy\n";
  for (const Frame& frame : m.frames) {
    const auto& s = frame.simulated;
    const double all = instructions(s);
    Charges fitted = frame.facade;
    for (const auto& [kind, times] : frame.times)
      for (std::size_t unit = 0; unit < kUnitCount; ++unit)
        fitted[unit] += times * result.charges[kind][unit];
    double total = frame.other;
    for (const double each : fitted)
      total += each;
    const double real = all - s.at("hbr") - s.at("spr");
    out << std::setw(24) << frame.name << std::setprecision(1) << std::setw(8) << all / 1e6
        << std::setprecision(3) << std::setw(7) << instructions(frame.emulated) / real << std::setw(7)
        << total / real << " |" << std::setprecision(1);
    for (std::size_t unit = 0; unit < kUnitCount; ++unit)
      out << std::setw(6) << 100 * (fitted[unit] - s.at(kSimulatedUnits[unit])) / all;
    out << std::setw(6) << 100 * (frame.other - sum(s, {"fxb", "fp7"})) / all;
    const double cycles = busy(s);
    out << " | emu " << std::setprecision(3) << busy(frame.emulated) / cycles << std::setprecision(1);
    for (const char* name :
         {"dual_cycle", "nop_cycle", "stall_due_to_dependency", "stall_due_to_branch_miss",
          "stall_due_to_prefetch_miss", "stall_due_to_hint_target", "stall_due_to_ls_contention"})
      out << std::setw(6) << 100 * s.at(name) / cycles;
    out << "  hbr " << 100 * s.at("hbr") / all << " miss/br " << s.at("branch_taken_miss") / s.at("br")
        << '\n';
  }
  return result;
}

} // namespace celltrace::calibration

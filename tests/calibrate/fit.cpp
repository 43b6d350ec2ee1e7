#include "calibration.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace celltrace::calibration {

namespace {

constexpr const char* kSimulated[] = {
    "fx2", "fp6", "ls", "shuf", "br", "fx3", "stall_due_to_dependency", "stall_due_to_branch_miss"};

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

/// What the statistical model says of a frame, before its parameters come in.
struct Drivers {
  double even = 0, odd = 0; ///< instructions by pipe
  double branches = 0, moves = 0;
  double waits = 0, misses = 0; ///< of scalar work, in cycles
};
Drivers drivers_of(const Frame& frame, const std::map<std::string, Charges>& charges) {
  Charges all = frame.facade;
  Drivers d;
  for (const auto& [kind, times] : frame.times) {
    const Charges& each = charges.at(kind);
    for (std::size_t unit = 0; unit < all.size(); ++unit)
      all[unit] += times * each[unit];
    d.moves += times * std::max(0.0, each[memory] - each[shuffle]);
    d.branches += times * each[branches];
  }
  d.even = all[fixed] + all[floating] + all[shift] + frame.other;
  d.odd = all[memory] + all[shuffle] + all[branches];
  d.waits = all[waits];
  d.misses = all[misses];
  return d;
}

TimingParameters fit_timing(const std::vector<Frame>& frames, const std::map<std::string, Charges>& charges,
                            double exposed_latency, std::ostream& out) {
  TimingParameters timing;
  timing.exposed_latency = exposed_latency;
  // Each parameter by its own stalls, every frame as important as another.
  const auto ratio = [&](auto driver, std::initializer_list<const char*> stalls) {
    double of = 0, all = 0;
    for (const Frame& frame : frames) {
      of += sum(frame.simulated, stalls) / busy(frame.simulated);
      all += driver(drivers_of(frame, charges)) / busy(frame.simulated);
    }
    return of / all;
  };
  const auto branches = [](const Drivers& d) { return d.branches; };
  timing.hints = ratio(branches, {"hbr"});
  timing.late_hint = ratio(branches, {"stall_due_to_hint_target"});
  timing.no_ops = ratio(branches, {"nop_cycle"});
  timing.late_fetch = ratio([](const Drivers& d) { return d.moves; }, {"stall_due_to_prefetch_miss"});
  timing.paired_issue = ratio(
      [&](const Drivers& d) { return std::min(d.even, d.odd + timing.hints * d.branches); }, {"dual_cycle"});
  out << std::setprecision(3) << "exposed_latency " << timing.exposed_latency << "\npaired_issue "
      << timing.paired_issue << "\nhints " << timing.hints << "\nlate_hint " << timing.late_hint
      << "\nno_ops " << timing.no_ops << "\nlate_fetch " << timing.late_fetch
      << "\n\ncycles, fitted / simulated; parts fitted - simulated, %: issue dependency "
      << "branch_miss fetch\n";
  double mean = 0, least = 9, most = 0;
  for (const Frame& frame : frames) {
    const Drivers d = drivers_of(frame, charges);
    const double odd = d.odd + timing.hints * d.branches;
    const double issue = d.even + odd - timing.paired_issue * std::min(d.even, odd) +
                         (timing.no_ops + timing.late_hint) * d.branches;
    const double dependency = timing.exposed_latency * frame.latency + d.waits;
    const double miss = d.misses;
    const double fetch = timing.late_fetch * d.moves;
    const double real = busy(frame.simulated);
    const double all = (issue + dependency + miss + fetch) / real;
    mean += all / double(frames.size());
    least = std::min(least, all);
    most = std::max(most, all);
    const auto part = [&](double fitted, std::initializer_list<const char*> names) {
      out << std::setw(7) << 100 * (fitted - sum(frame.simulated, names)) / real;
    };
    out << std::setw(24) << frame.name << std::setprecision(3) << std::setw(7) << all << std::setprecision(1);
    part(issue, {"single_cycle", "dual_cycle", "nop_cycle", "stall_due_to_hint_target"});
    part(dependency, {"stall_due_to_dependency"});
    part(miss, {"stall_due_to_branch_miss"});
    part(fetch, {"stall_due_to_prefetch_miss"});
    out << '\n';
  }
  out << std::setprecision(3) << "mean " << mean << ", least " << least << ", most " << most << '\n';
  return timing;
}

} // namespace

Fit fit(const Measurements& m, double trust, std::ostream& out) {
  std::vector<std::string> kinds;
  for (const auto& [name, charges] : m.charges)
    kinds.push_back(name);
  Fit result;
  double exposed_latency = 0;
  for (std::size_t unit = 0; unit < Charges().size(); ++unit) {
    // The last unknown is the part of the facade's latency that counts.
    Regression regression(kinds.size() + 1);
    for (const Frame& frame : m.frames) {
      std::vector<double> row;
      for (const std::string& kind : kinds) {
        const auto found = frame.times.find(kind);
        row.push_back(found == frame.times.end() ? 0 : found->second);
      }
      row.push_back(unit == waits ? frame.latency : 0);
      // Instructions as a part of all of them, stalls of all cycles.
      const double scale = 1 / (unit < kUnitCount ? instructions(frame.simulated) : busy(frame.simulated));
      regression.add(row, frame.simulated.at(kSimulated[unit]) - frame.facade[unit], scale * scale);
    }
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const double before = m.charges.at(kinds[i])[unit];
      regression.expect(i, before, trust * 1e-3 / ((before + 20) * (before + 20)));
    }
    regression.expect(kinds.size(), TimingParameters().exposed_latency, trust * 1e-3);
    const std::vector<double>& charges = regression.solve();
    for (std::size_t i = 0; i < kinds.size(); ++i)
      result.charges[kinds[i]][unit] = std::round(charges[i]);
    if (unit == waits) exposed_latency = charges.back();
  }
  out << std::fixed;
  for (const std::string& kind : kinds) {
    out << std::setw(16) << kind << std::setprecision(0);
    for (std::size_t unit = 0; unit < Charges().size(); ++unit)
      out << std::setw(6) << m.charges.at(kind)[unit] << " ->" << std::setw(4) << result.charges[kind][unit];
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
      out << std::setw(6) << 100 * (fitted[unit] - s.at(kSimulated[unit])) / all;
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
  result.timing = fit_timing(m.frames, result.charges, exposed_latency, out);
  return result;
}

} // namespace celltrace::calibration

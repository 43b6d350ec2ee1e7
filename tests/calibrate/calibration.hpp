// What the charges of compute() are calibrated from: frames that cell_emu and cell_sim have rendered.
#pragma once

#include "celltrace/spe/timing.hpp"

#include <array>
#include <cstddef>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace celltrace::calibration {

/// The units that ScalarWork charges, in its order.
enum Unit { fixed, floating, memory, shuffle, branches, shift };
constexpr std::size_t kUnitCount = shift + 1;
/// Instructions by unit, then cycles of waiting and of missed branches.
using Charges = std::array<double, kUnitCount + 2>;
enum Stall { waits = kUnitCount, misses };

/// A frame on both backends. Sums over all SPEs.
struct Frame {
  std::string name;
  std::map<std::string, double> simulated; ///< by the names of kSpuCycleCounts
  std::map<std::string, double> emulated;  ///< the same
  Charges facade{};                        ///< of the SIMD facade; its stalls are 0
  double other = 0;                        ///< of these, units that compute() does not charge
  double latency = 0;                      ///< beyond the issue of the facade's instructions, in cycles
  std::map<std::string, double> times;     ///< how often each kind of work was done
};

struct Measurements {
  std::vector<Frame> frames;
  std::map<std::string, Charges> charges; ///< as they were when the frames were made
};

/// One `key name value...` a line; what write() writes, read() reads.
void write(std::ostream& out, const Measurements& measurements);
Measurements read(std::istream& in);

/// Renders the study's scenes and `scenes` on both backends, and writes what it measures as it goes. Takes
/// its time.
void measure(const std::vector<std::string>& scenes, unsigned threads, std::ostream& out);

/// What explains the simulated instructions best, with the charges as they are in doubt.
struct Fit {
  std::map<std::string, Charges> charges;
  TimingParameters timing; ///< its statistical parameters
};
Fit fit(const Measurements& measurements, double trust, std::ostream& report);

} // namespace celltrace::calibration

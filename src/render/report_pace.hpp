// Decides how often SPEs report their progress.
#pragma once

#include <algorithm>
#include <cstdint>

namespace celltrace {

/// Chooses the number of progress messages. Each message wakes the PPE's thread, which takes some 20 us of an
/// SPE's time: 64 messages take a tenth of a frame of 10 ms. Passes that have taken long get more messages.
class ReportPace {
public:
  /// Returns the number of units of work between two messages.
  std::uint32_t units_per_word(std::uint32_t units) const { return units / words(units) + 1; }
  /// Records how long the last pass took.
  void learn(std::uint32_t units, double seconds) { seconds_a_unit_ = units == 0 ? 0 : seconds / units; }

private:
  std::uint32_t words(std::uint32_t units) const {
    if (seconds_a_unit_ < 0) return kFirstWords;
    const double wanted = seconds_a_unit_ * units / kSecondsBetweenWords;
    return static_cast<std::uint32_t>(std::clamp<double>(wanted, kLeastWords, kMostWords));
  }

  static constexpr double kSecondsBetweenWords = 0.02;
  static constexpr std::uint32_t kLeastWords = 8, kFirstWords = 16, kMostWords = 64;
  double seconds_a_unit_ = -1; ///< below 0 if unknown
};

} // namespace celltrace

// Measures how fast load balancing converges on a system graph, also if no formula is known for the graph.
//
// The convergence factor is the share of the deviation from balance that a sweep, or a step of diffusion,
// leaves in the long run: the spectral radius of the sweep's matrix on loads that sum to zero. It is computed
// by Gelfand's formula, the limit of |M^k|^(1/k), with k = 2^24 by repeated squaring, which also works if
// eigenvalues are complex or coincide. Takes n^3 operations, so it is meant for graphs of at most some
// hundred nodes.
#pragma once

#include "celltrace/balance/dimension_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace celltrace {

namespace detail {

/// A square matrix, row by row.
class SquareMatrix {
public:
  explicit SquareMatrix(std::size_t size) : size_(size), values_(size * size) {}

  std::span<double> row(std::size_t index) { return {values_.data() + index * size_, size_}; }
  SquareMatrix squared() const {
    SquareMatrix square(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < size_; ++k) {
        const double factor = values_[i * size_ + k];
        for (std::size_t j = 0; j < size_; ++j)
          square.values_[i * size_ + j] += factor * values_[k * size_ + j];
      }
    }
    return square;
  }
  /// Divides all values by the largest magnitude unless this magnitude is 0. Returns the magnitude.
  double normalise() {
    double largest = 0;
    for (const double value : values_)
      largest = std::max(largest, std::abs(value));
    if (largest == 0) return 0;
    for (double& value : values_)
      value /= largest;
    return largest;
  }

private:
  std::size_t size_;
  std::vector<double> values_;
};

/// Returns the spectral radius of `balance(loads)`, which must be linear and keep the sum.
template <class Balance> double spectral_radius(std::uint32_t nodes, Balance balance) {
  // Deviations below this are rounding errors.
  constexpr double kNothing = 1e-14;
  SquareMatrix power(nodes);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    const std::span<double> loads = power.row(node);
    loads[node] = 1;
    balance(loads);
    for (double& load : loads)
      load -= 1.0 / nodes;
  }
  double log_norm = 0;
  double exponent = 1;
  for (int doubling = 0; doubling < 24; ++doubling) {
    const double norm = power.normalise();
    if (norm < kNothing) return 0;
    log_norm += std::log(norm) / exponent;
    power = power.squared();
    exponent *= 2;
  }
  return std::exp(log_norm);
}

} // namespace detail

/// Returns the share of a deviation, 0..1, that a sweep of GDE with `lambda` leaves. Throws as gde_sweep()
/// does.
inline double convergence_factor(const SystemGraph& graph, double lambda) {
  return celltrace::detail::spectral_radius(
      graph.nodes, [&](std::span<double> loads) { gde_sweep(graph, loads, lambda); });
}
/// Returns the share of a deviation, 0..1, that a step of diffusion with `alpha` leaves. Throws as
/// diffusion_step() does.
inline double diffusion_convergence_factor(const SystemGraph& graph, double alpha) {
  return celltrace::detail::spectral_radius(
      graph.nodes, [&](std::span<double> loads) { diffusion_step(graph, loads, alpha); });
}

/// Returns the lambda with the smallest convergence factor, found by a search to about 1e-4, on any graph:
/// for graphs without a formula.
inline double best_exchange_parameter(const SystemGraph& graph) {
  double best = 0.5;
  double smallest = convergence_factor(graph, best);
  for (double step = 1.0 / 16; step > 1e-4; step /= 4) {
    const double centre = best;
    for (int i = -7; i <= 7; ++i) {
      const double lambda = centre + i * step;
      if (lambda <= 0 || lambda >= 1) continue;
      const double factor = convergence_factor(graph, lambda);
      if (factor < smallest) {
        smallest = factor;
        best = lambda;
      }
    }
  }
  return best;
}

/// Returns the number of sweeps of GDE until the imbalance is at most `tolerance`; nothing if `most` sweeps
/// are not enough.
inline std::optional<std::uint32_t> sweeps_to_balance(const SystemGraph& graph, std::vector<double> loads,
                                                      double lambda, double tolerance,
                                                      std::uint32_t most = 100'000) {
  for (std::uint32_t sweeps = 0; sweeps <= most; ++sweeps) {
    if (imbalance<double>(loads) <= tolerance) return sweeps;
    gde_sweep(graph, loads, lambda);
  }
  return std::nullopt;
}
/// Returns the number of steps of diffusion until the imbalance is at most `tolerance`; nothing if `most`
/// steps are not enough.
inline std::optional<std::uint32_t> steps_to_balance(const SystemGraph& graph, std::vector<double> loads,
                                                     double alpha, double tolerance,
                                                     std::uint32_t most = 100'000) {
  for (std::uint32_t steps = 0; steps <= most; ++steps) {
    if (imbalance<double>(loads) <= tolerance) return steps;
    diffusion_step(graph, loads, alpha);
  }
  return std::nullopt;
}

} // namespace celltrace

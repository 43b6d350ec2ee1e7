// The exchange parameter lambda of generalized dimension exchange: formulas for the speed of convergence, and
// for the best lambda.
//
// Sources: C.-Z. Xu and F. C. M. Lau, "Analysis of the generalized dimension exchange method for dynamic load
// balancing", J. Parallel and Distributed Computing 16 (1992), and "The generalized dimension exchange method
// for load balancing in k-ary n-cubes and variants", same journal 24 (1995).
//
// The convergence factor, 0..1, is the share of the deviation from balance that a sweep leaves in the long
// run. In the eigenvectors of a chain or of an even ring, the two halves of a sweep turn into 2x2 matrices,
// one for each frequency theta, so that the eigenvalues of a sweep are the roots of
//   x^2 - 2 ((1 - lambda)^2 + lambda^2 cos theta) x + (1 - 2 lambda)^2 = 0.
// The slowest frequency decides. With the best parameter its roots coincide, and the factor is 2 lambda - 1.
// Pure functions. They throw std::invalid_argument for graphs without nodes or without a closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>

namespace celltrace {

namespace detail {

/// Returns the magnitude of the larger root of the equation above, for one frequency.
inline double slowest_factor(double theta, double lambda) {
  const double half_sum = (1 - lambda) * (1 - lambda) + lambda * lambda * std::cos(theta);
  const double product = (1 - 2 * lambda) * (1 - 2 * lambda);
  const double discriminant = half_sum * half_sum - product;
  return discriminant <= 0 ? std::sqrt(product) : std::abs(half_sum) + std::sqrt(discriminant);
}

inline void require_chain(std::uint32_t nodes) {
  if (nodes == 0) throw std::invalid_argument("a chain without nodes");
}
inline void require_even_ring(std::uint32_t nodes) {
  if (nodes == 0 || nodes % 2 == 1) throw std::invalid_argument("the optimal parameter needs an even ring");
}

/// Returns `of_side` of the longest side, because the axes of a box are balanced independently. Calls
/// `of_side` for all sides, so that it checks them.
template <class OfSide> double of_longest(std::span<const std::uint32_t> sides, OfSide of_side) {
  if (sides.empty()) return 0.5;
  for (const std::uint32_t side : sides)
    (void)of_side(side);
  return of_side(*std::max_element(sides.begin(), sides.end()));
}

} // namespace detail

/// Returns the convergence factor of a chain of n >= 1 nodes; `lambda` in 0..1.
inline double chain_convergence_factor(std::uint32_t nodes, double lambda) {
  celltrace::detail::require_chain(nodes);
  if (nodes == 1) return 0;
  return nodes == 2 ? std::abs(1 - 2 * lambda)
                    : celltrace::detail::slowest_factor(2 * std::numbers::pi / nodes, lambda);
}
/// Returns the convergence factor of a ring with an even number of nodes; 2 nodes are a chain.
inline double ring_convergence_factor(std::uint32_t nodes, double lambda) {
  celltrace::detail::require_even_ring(nodes);
  return nodes == 2 ? std::abs(1 - 2 * lambda)
                    : celltrace::detail::slowest_factor(4 * std::numbers::pi / nodes, lambda);
}
/// Return the convergence factor of a mesh or torus: the largest factor of its axes. The sides of a torus
/// must be even.
inline double mesh_convergence_factor(std::span<const std::uint32_t> sides, double lambda) {
  double slowest = 0;
  for (const std::uint32_t side : sides)
    slowest = std::max(slowest, chain_convergence_factor(side, lambda));
  return slowest;
}
inline double torus_convergence_factor(std::span<const std::uint32_t> sides, double lambda) {
  double slowest = 0;
  for (const std::uint32_t side : sides)
    slowest = std::max(slowest, ring_convergence_factor(side, lambda));
  return slowest;
}

/// Returns the lambda with which GDE converges fastest on a chain of n >= 1 nodes: 1 / (1 + sin(pi / n)).
inline double optimal_chain_parameter(std::uint32_t nodes) {
  celltrace::detail::require_chain(nodes);
  return nodes == 1 ? 0.5 : 1 / (1 + std::sin(std::numbers::pi / nodes));
}
/// Returns the best lambda on a ring with an even number of nodes: 1 / (1 + sin(2 pi / n)). For odd rings and
/// other graphs use best_exchange_parameter().
inline double optimal_ring_parameter(std::uint32_t nodes) {
  celltrace::detail::require_even_ring(nodes);
  return nodes == 2 ? 0.5 : 1 / (1 + std::sin(2 * std::numbers::pi / nodes));
}
/// Return the best lambda on a mesh or torus, which its longest side decides. The sides of a torus must be
/// even.
inline double optimal_mesh_parameter(std::span<const std::uint32_t> sides) {
  return celltrace::detail::of_longest(sides, optimal_chain_parameter);
}
inline double optimal_torus_parameter(std::span<const std::uint32_t> sides) {
  return celltrace::detail::of_longest(sides, optimal_ring_parameter);
}
/// Returns 1/2, with which one sweep balances a hypercube exactly.
inline double optimal_hypercube_parameter() {
  return 0.5;
}

/// Returns an exchange parameter in units of 2^-16 as StripNode takes it: 0..1 becomes 0..65535.
inline std::uint32_t fixed_point_parameter(double lambda) {
  return static_cast<std::uint32_t>(std::clamp(std::lround(lambda * 65536), 0L, 65535L));
}

} // namespace celltrace

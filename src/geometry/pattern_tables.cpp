#include "geometry/pattern_tables.hpp"

#include "kernel/textures/noise_tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <glm/geometric.hpp>

namespace celltrace {

using namespace kernel;

namespace {

/// POV-Ray's linear congruential generator.
class ShortRandom {
public:
  explicit ShortRandom(std::uint32_t seed) : state_(seed) {}
  /// Returns a random number of 15 bits.
  std::uint32_t operator()() {
    state_ = state_ * 1812433253u + 12345u;
    return state_ >> 16 & 0x7FFF;
  }

private:
  std::uint32_t state_;
};

GradientTables make_gradient_tables() {
  GradientTables tables;
  ShortRandom random(1);
  for (Vec3& gradient : tables.gradient) {
    double square;
    do {
      for (int axis = 0; axis < 3; ++axis)
        gradient[axis] = (static_cast<double>(random() % 4096) - 2048) / 2048;
      square = glm::dot(gradient, gradient);
    } while (square > 1 || square == 0);
    gradient /= std::sqrt(square);
  }
  // The table is not quite a permutation: POV-Ray adds a 0, swaps every second number, and then drops the
  // last number.
  std::array<std::uint32_t, kGradients + 1> next{};
  for (std::uint32_t i = 0; i < kGradients; ++i)
    next[i] = i;
  for (std::uint32_t i = kGradients; i != 0; i -= 2)
    std::swap(next[i], next[random() % kGradients]);
  std::copy_n(next.begin(), kGradients, tables.next.begin());
  return tables;
}

/// Returns the vector of noise at the lattice point (x, 0, 0), times two.
void lattice_noise(std::uint32_t x, double (&v)[3]) {
  const auto number = [](std::uint32_t from, std::uint32_t coordinate) {
    return noise::kHash.entry[(from ^ (coordinate + 10000)) & (noise::kPeriod - 1)];
  };
  const std::uint32_t m = number(noise::kHash.entry[(x + 10000) & (noise::kPeriod - 1)], 0);
  const std::uint32_t start = number(m, 0) & 255;
  for (std::uint32_t i = 0; i < 3; ++i)
    v[i] = noise::kLattice[start + 4 * i];
}

} // namespace

std::vector<FeatureRecord> make_features() {
  std::mt19937 random; // with its standard seed
  std::vector<float> numbers(kFeatures + 2);
  for (float& number : numbers)
    number = static_cast<float>(std::ldexp(static_cast<double>(random()), -32));
  std::vector<FeatureRecord> features(kFeatures);
  for (std::uint32_t i = 0; i < kFeatures; ++i)
    features[i] = {{numbers[i], numbers[i + 1], numbers[i + 2]}, noise::kHash.entry[i]};
  return features;
}

const GradientTables& gradient_tables() {
  static const GradientTables tables = make_gradient_tables();
  return tables;
}

std::vector<GradientRecord> make_gradients() {
  const GradientTables& tables = gradient_tables();
  std::vector<GradientRecord> gradients(kGradients);
  for (std::uint32_t i = 0; i < kGradients; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      gradients[i].gradient[axis] = static_cast<float>(tables.gradient[i][axis] * kGradientStrength);
    gradients[i].next = tables.next[i];
  }
  return gradients;
}

std::vector<WaveRecord> make_waves(int count) {
  constexpr int kDrawsBefore = 7168;
  ShortRandom random(1);
  for (int i = 0; i < kDrawsBefore; ++i)
    random();
  std::vector<WaveRecord> waves(static_cast<std::size_t>(count));
  for (std::uint32_t i = 0; i < waves.size(); ++i) {
    double v[3];
    lattice_noise(i, v);
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int axis = 0; axis < 3; ++axis)
      waves[i].source[axis] = static_cast<float>(v[axis] / length);
    waves[i].frequency = static_cast<float>(random() * 0.000030518509476 + 0.01);
  }
  return waves;
}

} // namespace celltrace

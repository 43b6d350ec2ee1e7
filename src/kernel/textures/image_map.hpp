// Patterns that are pictures: their colours, or their grey. Kernel dialect.
#pragma once

#include "kernel/angles.hpp"
#include "kernel/parts.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/pattern_points.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "kernel/textures/pigment_lanes.hpp"

namespace celltrace::kernel {

/// Reads pictures at points of a pattern's space.
template <class Spu> class PictureReader {
public:
  using S = typename Spu::rare_simd;
  using F = typename S::F;
  using M = typename S::M;

  PictureReader(SceneAccess<Spu>& scene, uint32_t picture) : scene_(scene), picture_(*scene.picture(picture)) {}

  const PictureRecord& picture() const { return picture_; }

  /// Returns the colours and the transmittance at points; `outside` receives the points that are not on the
  /// one copy of the picture, whose results are meaningless.
  PigmentLanes<S> at(const V3<S>& p, M& outside) {
    F across, down;
    place(p, across, down, outside);
    alignas(64) float x[S::kLanes], y[S::kLanes], red[S::kLanes], green[S::kLanes], blue[S::kLanes],
        transmit[S::kLanes];
    across.store(x);
    down.store(y);
    for (uint32_t lane = 0; lane < S::kLanes; ++lane) {
      Texel sum = read(x[lane], y[lane]);
      red[lane] = sum.value[0];
      green[lane] = sum.value[1];
      blue[lane] = sum.value[2];
      transmit[lane] = sum.value[3];
    }
    const F share(1.0f / 65535.0f), colours(picture_.scale / 65535.0f);
    return {{F::load(red) * colours, F::load(green) * colours, F::load(blue) * colours},
            F(picture_.filter),
            F::load(transmit) * share + F(picture_.transmit)};
  }

private:
  struct Texel {
    float value[4];
  };

  /// Sets the column and the row from the top, in texels, of points.
  [[gnu::always_inline]] void place(const V3<S>& p, F& across, F& down, M& outside) {
    const F zero(0.0f), one(1.0f);
    F u = p.x, v = p.y;
    outside = M::none();
    const bool is_once = picture_.once != 0;
    if (picture_.mapping == 0) {
      if (is_once) outside = (u < zero) | (u >= one) | (v < zero) | (v >= one);
    } else {
      // Angles about the y axis, 0 to 1 turn.
      const F turns = turns_inline<S>(p.z, p.x);
      u = S::select(turns < zero, turns + one, turns);
      const F away = S::sqrt(p.x * p.x + p.z * p.z);
      if (picture_.mapping == 1) {
        v = F(0.5f) + F(2.0f) * turns_inline<S>(p.y, away);
      } else if (picture_.mapping == 2) {
        if (is_once) outside = (v < zero) | (v >= one);
      } else {
        const F around = turns_inline<S>(p.y, one - away); // about the ring, from its inside
        v = S::select(around > zero, one - around, -around);
      }
    }
    u = u * F(picture_.repeat[0]) - F(picture_.offset[0]);
    v = v * F(picture_.repeat[1]) - F(picture_.offset[1]);
    if (is_once) outside = outside | (u < zero) | (u >= one) | (v < zero) | (v >= one);
    across = (u - S::floor(u)) * F(static_cast<float>(picture_.width));
    down = (-v - S::floor(-v)) * F(static_cast<float>(picture_.height));
  }

  /// Returns the index that stands for one beyond the picture's sides.
  static int32_t within(int32_t i, int32_t count, bool is_once) {
    if (i >= 0 && i < count) return i;
    if (is_once) return i < 0 ? 0 : count - 1;
    const int32_t wrapped = i < 0 ? i + count : i - count;
    return wrapped < 0 || wrapped >= count ? 0 : wrapped; // small pictures
  }
  void add(int32_t column, int32_t row, float weight, Texel& sum) {
    constexpr uint32_t kSide = TexelTileRecord::kSide;
    const bool is_once = picture_.once != 0;
    const auto x = static_cast<uint32_t>(within(column, static_cast<int32_t>(picture_.width), is_once));
    const auto y = static_cast<uint32_t>(within(row, static_cast<int32_t>(picture_.height), is_once));
    const uint32_t tile = y / kSide * picture_.tile_columns + x / kSide;
    const TexelTileRecord& texels =
        *scene_.texel_tile(picture_.tiles + tile * static_cast<uint32_t>(sizeof(TexelTileRecord)));
    const uint32_t at = 2 * (y % kSide * kSide + x % kSide);
    for (uint32_t word = 0; word < 2; ++word) {
      const uint32_t both = texels.word[at + word];
      sum.value[2 * word] += weight * static_cast<float>(both >> 16);
      sum.value[2 * word + 1] += weight * static_cast<float>(both & 0xFFFF);
    }
  }
  /// Sets the weights of four texels around a place for bicubic interpolation.
  static void cubic_weights(float p, float (&weight)[4]) {
    const float q = 1.0f - p;
    weight[0] = -0.5f * p * q * q;
    weight[1] = 0.5f * q * (q * (3.0f * p + 1.0f) + 1.0f);
    weight[2] = 0.5f * p * (p * (3.0f * q + 1.0f) + 1.0f);
    weight[3] = -0.5f * q * p * p;
  }
  Texel read(float x, float y) {
    Texel sum = {{0.0f, 0.0f, 0.0f, 0.0f}};
    // Lanes without a point may have any number here.
    if (!(x >= 0.0f && x <= static_cast<float>(picture_.width))) x = 0.0f;
    if (!(y >= 0.0f && y <= static_cast<float>(picture_.height))) y = 0.0f;
    if (picture_.interpolation == 0) {
      add(static_cast<int32_t>(x), static_cast<int32_t>(y), 1.0f, sum);
      return sum;
    }
    // Texels have their values at their middles.
    const auto column = static_cast<int32_t>(x + 0.5f) - 1, row = static_cast<int32_t>(y + 0.5f) - 1;
    const float p = x - 0.5f - static_cast<float>(column), q = y - 0.5f - static_cast<float>(row);
    if (picture_.interpolation == 3) {
      float across[4], down[4];
      cubic_weights(p, across);
      cubic_weights(q, down);
      for (int32_t i = 0; i < 4; ++i)
        for (int32_t k = 0; k < 4; ++k)
          add(column - 1 + k, row - 1 + i, across[k] * down[i], sum);
      return sum;
    }
    float weight[4] = {(1.0f - p) * (1.0f - q), p * (1.0f - q), (1.0f - p) * q, p * q};
    if (picture_.interpolation == 4) {
      float total = 0.0f;
      for (uint32_t i = 0; i < 4; ++i) {
        const float dx = (i & 1) != 0 ? 1.0f - p : p, dy = (i & 2) != 0 ? 1.0f - q : q;
        weight[i] = 1.0f / larger(dx * dx + dy * dy, 1e-12f);
        total += weight[i];
      }
      for (float& w : weight)
        w /= total;
    }
    for (int32_t i = 0; i < 4; ++i)
      add(column + (i & 1), row + (i >> 1), weight[i], sum);
    return sum;
  }

  SceneAccess<Spu>& scene_;
  PictureRecord picture_;
};

/// A pigment that is a picture; the table is a PictureRecord. Points off the one copy are clear.
struct ImageMapPattern : ColourPattern {
  static constexpr const char* kName = "image_map";

  template <class Spu>
  [[gnu::always_inline]] static PigmentLanes<typename Spu::rare_simd>
  colour(SceneAccess<Spu>& scene, const PatternPoints<typename Spu::rare_simd>& points, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using F = typename S::F;
    const F zero(0.0f), one(1.0f);
    typename S::M outside;
    const PigmentLanes<S> found = PictureReader<Spu>(scene, r.table).at(points.at, outside);
    return select<S>(outside, PigmentLanes<S>{{one, one, one}, zero, one}, found);
  }
};

/// A pattern whose value is the grey of a picture, or its transmittance; the table is a PictureRecord. The
/// value is 0 off the one copy.
struct ImagePattern : RarePattern {
  static constexpr const char* kName = "image_pattern";

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    typename S::M outside;
    PictureReader<Spu> reader(scene, r.table);
    const PigmentLanes<S> found = reader.at(p, outside);
    const auto value = reader.picture().reads_transmit != 0 ? found.transmit : grey<S>(found.rgb);
    return S::select(outside, typename S::F(0.0f), value);
  }
};

} // namespace celltrace::kernel

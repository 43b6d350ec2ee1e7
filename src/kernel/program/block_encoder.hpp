// BC1 encoder: 4x4 pixels in 8 bytes, which are two colours and the position of each pixel between them
// (BlockImage in image.hpp describes the format). Kernel dialect.
//
// The first end colours are those of the pixels at the ends of the block's principal axis. Then the pixels'
// positions and, by least squares, the end colours are improved in turn. All numbers are whole, and floats
// are below 2^24, so that nothing rounds: the same pixels become the same block on every machine.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/packet.hpp"
#include "records/sampling.hpp"

namespace celltrace::kernel {

struct EncodedBlock {
  uint8_t bytes[8];
  uint32_t error; ///< squared differences of the pixels that count, summed over red, green and blue
};

namespace block {

/// The end colours, of 5, 6 and 5 bits, and the positions of the pixels between them.
template <class S> struct Fit {
  uint32_t ends[2];
  typename S::F thirds; ///< by pixel: thirds of the way from the first end to the second one, 0 to 3
  uint32_t error;
};

/// Returns the sum of sixteen whole numbers, which must be below 2^24.
template <class S> CELLTRACE_ONE_COPY float sum_of(const typename S::F& numbers) {
  using F4 = typename S::F4;
  alignas(64) float lane[kSimdLanes];
  numbers.store(lane);
  const F4 quads = (F4::load(lane) + F4::load(lane + 4)) + (F4::load(lane + 8) + F4::load(lane + 12));
  quads.store(lane);
  return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

inline float whole(float number) {
  return static_cast<float>(static_cast<int32_t>(number));
}

/// Halves or doubles numbers until the greatest is between `below` / 2 and `below`, and truncates them.
inline void scale_to(float below, float greatest, float* numbers, uint32_t count) {
  float scale = 1.0f;
  for (; greatest * scale >= below; scale *= 0.5f) {
  }
  for (; greatest * scale * 2.0f < below; scale *= 2.0f) {
  }
  for (uint32_t i = 0; i < count; ++i)
    numbers[i] = whole(numbers[i] * scale);
}

/// Finds the direction in which pixels differ most, by the power method; components are whole numbers below
/// 1024. The result is 0 if all pixels have one colour.
template <class S> CELLTRACE_ONE_COPY void find_axis(const V3<S>& pixels, float (&axis)[3]) {
  using F = typename S::F;
  constexpr uint32_t kIterations = 8;
  const auto mean_of = [](const F& channel) { return F(whole(sum_of<S>(channel) * 0.0625f + 0.5f)); };
  const V3<S> d = {pixels.x - mean_of(pixels.x), pixels.y - mean_of(pixels.y), pixels.z - mean_of(pixels.z)};
  // elements xx, xy, xz, yy, yz, zz
  float spread[6] = {sum_of<S>(d.x * d.x), sum_of<S>(d.x * d.y), sum_of<S>(d.x * d.z),
                     sum_of<S>(d.y * d.y), sum_of<S>(d.y * d.z), sum_of<S>(d.z * d.z)};
  const float greatest = larger(spread[0], larger(spread[3], spread[5]));
  axis[0] = axis[1] = axis[2] = 0.0f;
  if (greatest == 0.0f) return;
  scale_to(4096.0f, greatest, spread, 6);
  const float rows[3][3] = {{spread[0], spread[1], spread[2]},
                            {spread[1], spread[3], spread[4]},
                            {spread[2], spread[4], spread[5]}};
  const uint32_t first = spread[0] >= spread[3] && spread[0] >= spread[5] ? 0
                         : spread[3] >= spread[5]                         ? 1
                                                                          : 2;
  for (uint32_t i = 0; i < 3; ++i)
    axis[i] = rows[first][i];
  for (uint32_t step = 0; step < kIterations; ++step) {
    const float size = larger(magnitude(axis[0]), larger(magnitude(axis[1]), magnitude(axis[2])));
    if (size == 0.0f) return;
    scale_to(1024.0f, size, axis, 3);
    if (step + 1 == kIterations) return;
    float next[3];
    for (uint32_t i = 0; i < 3; ++i)
      next[i] = rows[i][0] * axis[0] + rows[i][1] * axis[1] + rows[i][2] * axis[2];
    for (uint32_t i = 0; i < 3; ++i)
      axis[i] = next[i];
  }
}

/// Round a channel of 8 bits to 5 or 6 bits.
inline uint32_t to_five(uint32_t channel) {
  return (channel * 249 + 1014) >> 11;
}
inline uint32_t to_six(uint32_t channel) {
  return (channel * 253 + 505) >> 10;
}
inline uint32_t make_end(uint32_t red, uint32_t green, uint32_t blue) {
  return red << 11 | green << 5 | blue;
}
/// Returns the channels of an end as 8 bits.
inline void channels_of(uint32_t end, uint32_t (&channel)[3]) {
  const uint32_t red = end >> 11, green = end >> 5 & 63, blue = end & 31;
  channel[0] = red << 3 | red >> 2;
  channel[1] = green << 2 | green >> 4;
  channel[2] = blue << 3 | blue >> 2;
}

/// Finds the best positions of the pixels between two ends. The pixels in `lanes` count.
template <class S>
CELLTRACE_ONE_COPY void fit(const V3<S>& pixels, uint32_t lanes, uint32_t end_a, uint32_t end_b,
                            Fit<S>& result) {
  using F = typename S::F;
  // The greater end is the first: otherwise there would be three colours only.
  result.ends[0] = end_a > end_b ? end_a : end_b;
  result.ends[1] = end_a > end_b ? end_b : end_a;
  uint32_t first[3], second[3];
  channels_of(result.ends[0], first);
  channels_of(result.ends[1], second);
  F least(16777216.0f);
  result.thirds = F(0.0f);
  for (uint32_t thirds = 0; thirds <= 3; ++thirds) {
    const auto channel = [&](uint32_t i) {
      const uint32_t sum = first[i] * (3 - thirds) + second[i] * thirds;
      return F(static_cast<float>((sum * 21846) >> 16)); // divided by three
    };
    const V3<S> off = {pixels.x - channel(0), pixels.y - channel(1), pixels.z - channel(2)};
    const F distance = dot<S>(off, off);
    const auto nearer = distance < least;
    least = S::select(nearer, distance, least);
    result.thirds = S::select(nearer, F(static_cast<float>(thirds)), result.thirds);
  }
  result.error = static_cast<uint32_t>(
      static_cast<int32_t>(sum_of<S>(S::select(S::M::from_bits(lanes), least, F(0.0f)))));
}

/// Returns the number of the step, of `most` equal steps from 0 to 255, that is nearest to number / whole; 0
/// if the number is negative.
inline uint32_t steps_of(int32_t number, int32_t whole, uint32_t most) {
  if (number <= 0) return 0;
  if (number >= 255 * whole) return most;
  const uint32_t unit = 2u * 255u * static_cast<uint32_t>(whole);
  const uint32_t all = 2u * static_cast<uint32_t>(number) * most + unit / 2;
  uint32_t steps = 0;
  for (uint32_t bit = 32; bit != 0; bit >>= 1)
    if (steps + bit <= most && (steps + bit) * unit <= all) steps += bit;
  return steps;
}

/// Finds the ends that suit the pixels' positions best, by least squares. Returns false if the positions do
/// not determine the ends.
template <class S>
CELLTRACE_ONE_COPY bool improve_ends(const V3<S>& pixels, const typename S::F& thirds, uint32_t (&ends)[2]) {
  using F = typename S::F;
  const F rest = F(3.0f) - thirds;
  const auto whole_sum = [](const F& numbers) { return static_cast<int32_t>(sum_of<S>(numbers)); };
  const int32_t a = whole_sum(rest * rest), b = whole_sum(rest * thirds), c = whole_sum(thirds * thirds);
  const int32_t determinant = a * c - b * b;
  if (determinant == 0) return false;
  uint32_t channel[2][3];
  const F* const of_pixels[3] = {&pixels.x, &pixels.y, &pixels.z};
  for (uint32_t i = 0; i < 3; ++i) {
    const int32_t x = whole_sum(rest * *of_pixels[i]), y = whole_sum(thirds * *of_pixels[i]);
    const uint32_t most = i == 1 ? 63 : 31;
    channel[0][i] = steps_of(3 * (c * x - b * y), determinant, most);
    channel[1][i] = steps_of(3 * (a * y - b * x), determinant, most);
  }
  for (uint32_t i = 0; i < 2; ++i)
    ends[i] = make_end(channel[i][0], channel[i][1], channel[i][2]);
  return true;
}

/// Returns the channels of pixels with bytes R, G, B, A.
template <class S> V3<S> channels_of_pixels(const uint32_t* pixels) {
  using I = typename S::I;
  const I all = I::load(reinterpret_cast<const int32_t*>(pixels));
  const I mask = I::splat(0xFF);
  if constexpr (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
    return {S::to_float(S::template shift_right<24>(all) & mask),
            S::to_float(S::template shift_right<16>(all) & mask),
            S::to_float(S::template shift_right<8>(all) & mask)};
  else
    return {S::to_float(all & mask), S::to_float(S::template shift_right<8>(all) & mask),
            S::to_float(S::template shift_right<16>(all) & mask)};
}

} // namespace block

/// Encodes a packet of pixels with bytes R, G, B, A as a block. The pixels in `lanes`, at least one, count;
/// other pixels must have colours of these pixels.
template <class S>
CELLTRACE_ONE_COPY void encode_block(const WordLanes& pixels, uint32_t lanes, EncodedBlock& encoded) {
  using F = typename S::F;
  constexpr uint32_t kImprovements = 3;
  const V3<S> colours = block::channels_of_pixels<S>(pixels.lane);
  float axis[3];
  block::find_axis<S>(colours, axis);
  const F along = colours.x * F(axis[0]) + colours.y * F(axis[1]) + colours.z * F(axis[2]);
  float least, greatest;
  S::extremes(along, least, greatest);
  VectorLanes stored;
  stored.store<S>(colours);
  const auto end_at = [&](float place) {
    const auto lane = static_cast<uint32_t>(__builtin_ctz((along == F(place)).bits()));
    const auto channel = [&](const FloatLanes& of) {
      return static_cast<uint32_t>(static_cast<int32_t>(of.lane[lane]));
    };
    return block::make_end(block::to_five(channel(stored.x)), block::to_six(channel(stored.y)),
                           block::to_five(channel(stored.z)));
  };
  block::Fit<S> best, other;
  const uint32_t end_a = end_at(least), end_b = end_at(greatest);
  block::fit<S>(colours, lanes, end_a, end_b, best);
  uint32_t ends[2];
  for (uint32_t i = 0; i < kImprovements && block::improve_ends<S>(colours, best.thirds, ends); ++i) {
    block::fit<S>(colours, lanes, ends[0], ends[1], other);
    if (other.error >= best.error) break;
    best = other;
  }

  alignas(64) float thirds[kSimdLanes];
  best.thirds.store(thirds);
  // Codes 0 to 3 stand for 0, 3, 1 and 2 thirds.
  uint32_t codes = 0;
  for (uint32_t i = 0; i < kSimdLanes; ++i) {
    const auto third = static_cast<uint32_t>(static_cast<int32_t>(thirds[i]));
    const uint32_t code = third == 0 ? 0 : third == 3 ? 1 : third + 1;
    codes |= code << 2 * i;
  }
  for (uint32_t i = 0; i < 2; ++i) {
    encoded.bytes[2 * i] = static_cast<uint8_t>(best.ends[i]);
    encoded.bytes[2 * i + 1] = static_cast<uint8_t>(best.ends[i] >> 8);
  }
  for (uint32_t i = 0; i < 4; ++i)
    encoded.bytes[4 + i] = static_cast<uint8_t>(codes >> 8 * i);
  encoded.error = best.error;
}

/// Copies border pixels to the lanes beyond the edges of a picture of `width` x `height` pixels, for the
/// packet at (x, y). Returns the lanes in the picture.
inline uint32_t extend_pixels(uint32_t x, uint32_t y, uint32_t width, uint32_t height, WordLanes& pixels) {
  uint32_t lanes = 0;
  for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
    const uint32_t column = lane % kPacketEdge, row = lane / kPacketEdge;
    if (x + column < width && y + row < height) {
      lanes |= 1u << lane;
      continue;
    }
    const uint32_t last_column = width - 1 - x, last_row = height - 1 - y;
    pixels.lane[lane] = pixels.lane[(row < last_row ? row : last_row) * kPacketEdge +
                                    (column < last_column ? column : last_column)];
  }
  return lanes;
}

} // namespace celltrace::kernel

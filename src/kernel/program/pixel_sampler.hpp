// Common parts of POV-Ray's antialiasing methods: pixels that differ from their neighbours, or whose corners
// differ, are sampled by more rays. Kernel dialect.
//
// A picture takes two frames. In the first the points of a grid are traced as pixels are, and their colours
// kept in main memory. In the second a unit of work is a run of blocks of kSampledEdge x kSampledEdge pixels.
// Samples of any pixels of a block are traced together, as many as a bundle has room for.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/program/pixel_writer.hpp"
#include "records/frame.hpp"
#include "records/light_feature.hpp"

namespace celltrace::kernel {

/// A packet of samples: x and y are first positions in pixels from the middle of the picture; then x, y and z
/// are colours.
struct SampleLanes : VectorLanes {
  FloatLanes transparency; ///< with light_feature::alpha; 0 while the packet is not being traced

  const FloatLanes& operator[](uint32_t axis) const {
    return axis == 3 ? transparency : VectorLanes::operator[](axis);
  }
};

/// The samples of a bundle.
template <class Spu> struct SampleBundle {
  SampleLanes at[kBundlePackets<Spu>];
  uint32_t lanes[kBundlePackets<Spu>]; ///< lanes with a sample
};

/// A square of a pixel whose corners have known colours, in the order upper left, upper right, lower left,
/// lower right.
template <uint32_t kChannels> struct alignas(16) SampleSquare {
  float corner[4][kChannels];
  float x, y;     ///< upper left corner, in points of the grid
  uint32_t pixel; ///< number of the pixel among those that are being summed up
  uint32_t level; ///< 0: the whole pixel
};
static_assert(sizeof(SampleSquare<3>) == 64 && sizeof(SampleSquare<4>) == 80, "whole quadwords");

constexpr uint32_t kSamplesOfSquare = 5;

/// Returns the number of squares that are divided together, which grows with the number of packets in a
/// bundle, `edge` * `edge`.
constexpr uint32_t squares_at_once(uint32_t edge) {
  return edge * edge * kSimdLanes / kSamplesOfSquare;
}
/// Returns the number of rows of a block that the adaptive method processes together.
constexpr uint32_t sampled_rows(uint32_t edge) {
  return edge > tuning::kBundleEdgeInLocalStore ? kSampledEdge : 1;
}
/// Returns a bound of the number of waiting squares: all squares of the first level, and on each level five
/// for each square that is divided together with others.
constexpr uint32_t max_squares(uint32_t edge) {
  return sampled_rows(edge) * kSampledEdge + 5 * squares_at_once(edge) * kMaxSamplingDepth;
}

/// Channels of a row of a block's points, one point more than the row has pixels, from the block's left edge
/// on. The three channels that are encoded follow each other, in whole vectors.
template <uint32_t kChannels> struct alignas(64) PointRow {
  static constexpr uint32_t kPackets = kSampledEdge / kPacketEdge + 1, kPoints = kPackets * kPacketEdge;
  static constexpr uint32_t kEncoded = (3 * kPoints + kSimdLanes - 1) / kSimdLanes * kSimdLanes;
  float numbers[kEncoded + (kChannels - 3) * kPoints];

  static constexpr uint32_t first_of(uint32_t axis) { return axis == 3 ? kEncoded : axis * kPoints; }
  float* channel(uint32_t axis) { return numbers + first_of(axis); }
  const float* channel(uint32_t axis) const { return numbers + first_of(axis); }
};
/// Returns the bytes that an SPE needs in main memory: for squares, or for the colours and encoded colours of
/// a block's pixels and its encoded points.
constexpr uint32_t sample_store_bytes(uint32_t edge, bool alpha) {
  constexpr uint32_t kPixels = kSampledEdge * kSampledEdge;
  const size_t row = alpha ? sizeof(PointRow<4>) : sizeof(PointRow<3>);
  const size_t square = alpha ? sizeof(SampleSquare<4>) : sizeof(SampleSquare<3>);
  const size_t colours = 2 * kPixels * sizeof(ColourRecord) + (kSampledEdge + 1) * row;
  const size_t squares = max_squares(edge) * square;
  return static_cast<uint32_t>(((squares > colours ? squares : colours) + 127) / 128 * 128);
}

/// Returns true if the transparency of pixels is wanted.
constexpr bool wants_alpha(const FrameBlock& frame) {
  return (frame.light_features & light_feature::alpha) != 0;
}

/// Services of samplers for a block: takes the points of the grid, encodes colours for comparison, makes
/// samples, and writes pixels. A sampler does everything but tracing, by one method; it is code of a module,
/// which processes lanes part by part. Colours have three channels or, with light_feature::alpha, four:
/// the last is the transparency, which is compared without encoding.
template <class Spu, SamplingMethod kMethod, uint32_t kChannels>
class PixelSampler : public Strategy<Spu>::template Transfers<Spu, PixelSampler<Spu, kMethod, kChannels>> {
  /// Moves data between main memory and local store:
  ///
  ///   fetch(ls, ea, bytes)
  ///   send(ls, ea, bytes)         the source may be changed after arrive()
  ///   send_object(object, ea)
  ///   found_at(ea, room, bytes)   returns an object in main memory, in place or as a copy in `room`
  ///   arrive()                    waits until everything has been sent
  using Transfers = typename Strategy<Spu>::template Transfers<Spu, PixelSampler>;

public:
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename R::F;

  static constexpr const CodeModule& module() {
    if constexpr (kMethod == SamplingMethod::fixed)
      return kHasAlpha ? modules::kAlphaSampling : modules::kSampling;
    else
      return kHasAlpha ? modules::kAlphaSquares : modules::kSquares;
  }

  /// Begins a frame. Its code is not part of the module.
  [[gnu::always_inline]] void begin_frame() {
    in_progress_ = false;
    store_ = frame_.sample_store + spu_.id() * sample_store_bytes(kBundleEdge<Spu>, kHasAlpha);
    for (SampleLanes& packet : samples_.at)
      packet.transparency = FloatLanes();
  }

protected:
  static constexpr bool kHasAlpha = kChannels == 4;
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  using Transfers::arrive, Transfers::fetch, Transfers::found_at, Transfers::send, Transfers::send_object;

  using Colour = ColourRecord;
  using Points = PointRow<kChannels>;
  static constexpr auto kColourBytes = static_cast<uint32_t>(sizeof(Colour));

  static constexpr uint32_t kSamples = kPackets * kSimdLanes;

  struct Places {
    float x[kSamples], y[kSamples];
  };
  /// Memory that is not kept from call to call. Samples are numbered through all packets.
  struct Scratch {
    union {
      alignas(64) Places requested;                   ///< positions of samples
      alignas(64) float sampled[kChannels][kSamples]; ///< colours of the last call's samples
    };
    SampleLanes packets[Points::kPackets];
    Points points[2], encoded[2];             ///< two rows, in turn
    alignas(64) uint32_t words[kSampledEdge]; ///< pixels to be written
    alignas(64) Colour colours[kSampledEdge];
  };

  PixelSampler(Spu& spu, const FrameBlock& frame, SampleBundle<Spu>& samples, Scratch& scratch)
      : Transfers(spu), spu_(spu), frame_(frame), samples_(samples), scratch_(scratch) {}

  /// Returns true if the frame traces the grid; stores its points at the bundle's (column, row).
  [[gnu::always_inline]] bool takes_points(uint32_t column, uint32_t row) {
    spu_.run_in_module(module());
    if (static_cast<FramePurpose>(frame_.purpose) != FramePurpose::grid) return false;
    store_points(column, row);
    return true;
  }

  void go_to_block(uint32_t column, uint32_t row) {
    column_ = column;
    row_ = row;
    width_ = smaller_of(frame_.width - 1 - column * kSampledEdge, kSampledEdge);
    height_ = smaller_of(frame_.height - 1 - row * kSampledEdge, kSampledEdge);
  }
  /// Returns the bits of the pixels in a row that are in the picture.
  uint32_t row_mask() const { return width_ == kSampledEdge ? ~0u : (1u << width_) - 1; }

  /// Returns the block's first line, counted from the first line of the surface.
  uint32_t first_line() const { return row_ * kSampledEdge - frame_.surface_row * kPacketEdge; }

  // --- the grid ---

  ea_t packet_of_points(uint32_t column, uint32_t row) const {
    return frame_.grid_points +
           ((row - frame_.surface_row) * frame_.packet_columns + column) * kGridPacketBytes;
  }

  void store_points(uint32_t column, uint32_t row) {
    static_assert(sizeof(SampleLanes) == kGridPacketBytes, "as in main memory");
    const uint32_t left = frame_.packet_columns - column * kEdge;
    const uint32_t packets = left < kEdge ? left : kEdge;
    for (uint32_t y = 0; y < kEdge && row * kEdge + y < frame_.packet_rows; ++y)
      send(&samples_.at[y * kEdge], packet_of_points(column * kEdge, row * kEdge + y),
           packets * kGridPacketBytes);
    arrive();
    if constexpr (kHasAlpha)
      for (SampleLanes& packet : samples_.at)
        packet.transparency = FloatLanes();
  }

  /// Returns the packets with a row of the grid's points at the block, beginning with the one to the block's
  /// upper left. Without direct memory the packets stay until others are fetched.
  CELLTRACE_ONE_COPY const SampleLanes* packets_of_row(uint32_t row) {
    const ea_t first =
        packet_of_points(column_ * kSampledEdge / kPacketEdge, (row_ * kSampledEdge + row) / kPacketEdge);
    return found_at(first, scratch_.packets, packets_of_block() * kGridPacketBytes);
  }
  /// Returns the number of packets across the block.
  uint32_t packets_of_block() const {
    return smaller_of(frame_.packet_columns - column_ * kSampledEdge / kPacketEdge, Points::kPackets);
  }
  /// Extracts the points of a row from its packets.
  CELLTRACE_ONE_COPY void take_points(const SampleLanes* from, uint32_t row, Points& points) const {
    const uint32_t packets = packets_of_block();
    const uint32_t first = row % kPacketEdge * kPacketEdge;
    for (uint32_t axis = 0; axis < kChannels; ++axis) {
      float* const channel = points.channel(axis);
      for (uint32_t packet = 0; packet < packets; ++packet)
        S::F4::load(from[packet][axis].lane + first).store(channel + packet * kPacketEdge);
      for (uint32_t x = packets * kPacketEdge; x < Points::kPoints; ++x)
        channel[x] = 0.0f;
    }
    for (uint32_t i = 3 * Points::kPoints; i < Points::kEncoded; ++i)
      points.numbers[i] = 0.0f;
  }

  /// Encodes numbers for comparison, in whole vectors of sixteen. The encoding is approximate: few pixels are
  /// that close to the threshold.
  CELLTRACE_ONE_COPY void encode(const float* numbers, uint32_t count, float* encoded) const {
    for (uint32_t i = 0; i < count; i += R::kLanes)
      coarse_pow<R>(F::load(numbers + i), F(frame_.sampling.inverse_gamma)).store(encoded + i);
  }
  void encode_points(const Points& points, Points& encoded) const {
    encode(points.numbers, Points::kEncoded, encoded.numbers);
    if constexpr (kHasAlpha)
      __builtin_memcpy(encoded.channel(3), points.channel(3), Points::kPoints * sizeof(float));
  }
  /// Returns points of a row, beginning at any point.
  template <class Row> static V3<R> points_from(const Row& row, uint32_t first) {
    return {channel_from(row, 0, first), channel_from(row, 1, first), channel_from(row, 2, first)};
  }
  template <class Row> static F channel_from(const Row& row, uint32_t axis, uint32_t first) {
    return F::load_unaligned(row.channel(axis) + first);
  }
  /// Returns the points of a block's row that differ from those of another row, each row beginning at any
  /// point.
  template <class Row>
  CELLTRACE_ONE_COPY uint32_t differing(const Points& a, uint32_t first_a, const Row& b,
                                        uint32_t first_b) const {
    uint32_t bits = 0;
    for (uint32_t x = 0; x < kSampledEdge; x += R::kLanes) {
      const V3<R> difference = points_from(a, first_a + x) - points_from(b, first_b + x);
      F sum = absolute_sum<R>(difference);
      if constexpr (kHasAlpha) {
        const F transparency = channel_from(a, 3, first_a + x);
        sum = sum + R::abs(transparency - channel_from(b, 3, first_b + x));
      }
      bits |= (sum >= F(frame_.sampling.threshold)).bits() << x;
    }
    return bits;
  }
  static uint32_t smaller_of(uint32_t a, uint32_t b) { return a < b ? a : b; }

  /// Returns Wellons' hash lowbias32. Hashes of positions jitter samples in the same way in every run.
  static uint32_t hash(uint32_t x) {
    x = (x ^ x >> 16) * 0x7FEB352Du;
    x = (x ^ x >> 15) * 0x846CA68Bu;
    return x ^ x >> 16;
  }
  static void jitter(float& x, float& y, float amount) {
    uint32_t bits[2];
    __builtin_memcpy(&bits[0], &x, sizeof x);
    __builtin_memcpy(&bits[1], &y, sizeof y);
    const uint32_t random = hash(bits[0] + hash(bits[1]));
    constexpr float kUnit = 1.0f / 65536;
    x += (static_cast<float>(static_cast<int32_t>(random & 0xFFFF)) * kUnit - 0.5f) * amount;
    y += (static_cast<float>(static_cast<int32_t>(random >> 16)) * kUnit - 0.5f) * amount;
  }
  /// Makes a sample, at a position in points of the grid.
  void request(uint32_t number, float x, float y) {
    scratch_.requested.x[number] = x;
    scratch_.requested.y[number] = y;
  }
  /// Puts samples into lanes. Unused lanes get the position of the last sample.
  CELLTRACE_ONE_COPY void end_requests(uint32_t count) {
    const uint32_t whole = (count + kSimdLanes - 1) / kSimdLanes * kSimdLanes;
    for (uint32_t i = count; i < whole; ++i)
      request(i, scratch_.requested.x[count - 1], scratch_.requested.y[count - 1]);
    for (uint32_t packet = 0; packet < kPackets; ++packet) {
      const uint32_t first = packet * kSimdLanes;
      const uint32_t lanes = count <= first ? 0 : smaller_of(count - first, kSimdLanes);
      samples_.lanes[packet] = (1u << lanes) - 1;
      if constexpr (kHasAlpha) samples_.at[packet].transparency = FloatLanes();
      if (lanes != 0) place_samples(first, samples_.at[packet]);
    }
  }
  /// Stores jittered positions, relative to the middle of the picture. All lanes are treated alike, so that
  /// compilers vectorise the loop.
  CELLTRACE_ONE_COPY void place_samples(uint32_t first, SampleLanes& packet) const {
    const float amount = frame_.sampling.jitter;
    const float middle_x = frame_.camera.middle_x, middle_y = frame_.camera.middle_y;
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      float x = scratch_.requested.x[first + lane], y = scratch_.requested.y[first + lane];
      jitter(x, y, amount);
      packet.x.lane[lane] = x - middle_x;
      packet.y.lane[lane] = y - middle_y;
    }
  }
  /// Takes `count` samples out of their lanes.
  CELLTRACE_ONE_COPY void take_channels(uint32_t count) {
    using W = typename S::F;
    for (uint32_t first = 0; first < count; first += kSimdLanes)
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        W::load(samples_.at[first / kSimdLanes][axis].lane).store(scratch_.sampled[axis] + first);
  }

  /// Encodes a row of colours as pixels.
  CELLTRACE_ONE_COPY void encode_pixels_of(const float (*colours)[kSampledEdge], uint32_t* words) const {
    using W = typename S::F;
    for (uint32_t i = 0; i < kSampledEdge; i += kSimdLanes)
      encode_pixels<Spu>(frame_, {W::load(colours[0] + i), W::load(colours[1] + i), W::load(colours[2] + i)})
          .store(reinterpret_cast<int32_t*>(words + i));
  }

  /// Gathers colours from channels that lie `stride` numbers apart.
  CELLTRACE_ONE_COPY void gather_colours(const float* channels, uint32_t stride, uint32_t count) {
    for (uint32_t x = 0; x < count; ++x)
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        scratch_.colours[x].channel[axis] = channels[axis * stride + x];
  }
  bool wants_colours() const { return frame_.sampling.colours_pitch != 0; }
  /// Puts colours where the host takes them; x and y count from the block's first point.
  CELLTRACE_ONE_COPY void put_colours(const Colour* colours, uint32_t count, uint32_t x, uint32_t y) {
    const ea_t to = frame_.surface + frame_.surface_rows * kPacketEdge * frame_.surface_pitch +
                    (first_line() + y) * frame_.sampling.colours_pitch +
                    (column_ * kSampledEdge + x) * kColourBytes;
    send(colours, to, count * kColourBytes);
  }

  Spu& spu_;
  const FrameBlock& frame_;
  SampleBundle<Spu>& samples_;
  Scratch& scratch_;
  ea_t store_ = 0; ///< the SPE's own store in main memory
  bool in_progress_ = false;
  uint32_t column_ = 0, row_ = 0;   ///< position of the block
  uint32_t width_ = 0, height_ = 0; ///< size of the block's part in the picture, in pixels
  uint32_t requested_ = 0;          ///< number of samples, or of squares
};

} // namespace celltrace::kernel

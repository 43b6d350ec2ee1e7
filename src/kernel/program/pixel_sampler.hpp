// Antialiasing by POV-Ray's methods: pixels that differ from their neighbours, or whose corners differ, are
// sampled by more rays (the second after Whitted 1980). Kernel dialect.
//
// A picture takes two frames. In the first the points of a grid are traced as pixels are, and their colours
// kept in main memory. In the second a unit of work is a run of blocks of kSampledEdge x kSampledEdge pixels.
// Samples of any pixels of a block are traced together, as many as a bundle has room for.
//
// Of the fixed method each comparison is with what a neighbour has become by then, pixel after pixel. All
// pixels that seem to need samples get them at once; then the comparisons are made again with what is known,
// until no pixel is missing.
#pragma once

#include "kernel/modules.hpp"
#include "kernel/program/pixel_writer.hpp"

namespace celltrace::kernel {

/// A packet of samples. x and y: where they are, in pixels from the middle of the picture; then their
/// colours.
struct SampleLanes : VectorLanes {
  FloatLanes clear; ///< with light_way::alpha; 0 while a packet is not being traced

  const FloatLanes& operator[](uint32_t axis) const {
    return axis == 3 ? clear : VectorLanes::operator[](axis);
  }
};

/// The samples of a bundle.
template <class Spu> struct SampleBundle {
  SampleLanes at[kBundlePackets<Spu>];
  uint32_t lanes[kBundlePackets<Spu>]; ///< that are some
};

/// A square of a pixel, of which the colours at the corners are known: upper left, upper right, lower left,
/// lower right.
template <uint32_t kChannels> struct alignas(16) SampleSquare {
  float corner[4][kChannels];
  float x, y;     ///< upper left, in points of the grid
  uint32_t pixel; ///< number among those whose colours are being summed up
  uint32_t level; ///< 0: the whole pixel
};
static_assert(sizeof(SampleSquare<3>) == 64 && sizeof(SampleSquare<4>) == 80, "whole quadwords");

constexpr uint32_t kSamplesOfSquare = 5;

/// Squares that are divided together. The more packets a bundle has, of `edge` x `edge`, the more room there
/// is.
constexpr uint32_t squares_at_once(uint32_t edge) {
  return edge * edge * kSimdLanes / kSamplesOfSquare;
}
/// Rows of pixels of a block that are worked off together by the adaptive method.
constexpr uint32_t sampled_rows(uint32_t edge) {
  return edge > tuning::kBundleEdgeInLocalStore ? kSampledEdge : 1;
}
/// Squares that wait to be divided: those of the first level, and of each other one less than what a bundle
/// leaves and what it adds.
constexpr uint32_t max_squares(uint32_t edge) {
  return sampled_rows(edge) * kSampledEdge + 5 * squares_at_once(edge) * kMaxSamplingDepth;
}
/// Points of a row of a block, one more than pixels, with some room.
constexpr uint32_t kStoredPoints = kSampledEdge + 8;
/// What an SPE needs in main memory: squares; or of the pixels of a block their colours and what these are
/// compared by, and of its points the latter.
constexpr uint32_t sample_store_bytes(uint32_t edge, bool alpha) {
  constexpr uint32_t kPixels = kSampledEdge * kSampledEdge, kPoints = (kSampledEdge + 1) * kStoredPoints;
  constexpr auto kColours = (2 * kPixels + kPoints) * static_cast<uint32_t>(sizeof(ColourRecord));
  static_assert(kColours % 128 == 0);
  const size_t square = alpha ? sizeof(SampleSquare<4>) : sizeof(SampleSquare<3>);
  const uint32_t squares = (max_squares(edge) * static_cast<uint32_t>(square) + 127) / 128 * 128;
  return squares > kColours ? squares : kColours;
}

/// Whether frames have how clear pixels are.
constexpr bool wants_alpha(const FrameBlock& frame) {
  return (frame.light_ways & light_way::alpha) != 0;
}

/// All but tracing, by one method: code of a module, which works on lanes part by part. Colours have three
/// channels or, with light_way::alpha, four: the last one is how clear they are, which is compared as it is.
template <class Spu, SamplingMethod kMethod, uint32_t kChannels> class PixelSampler {
public:
  using S = typename Spu::simd;
  using R = typename Spu::rare_simd;
  using F = typename R::F;

  /// `scratch`: room for kScratchBytes that belongs to the sampler while advance() runs.
  PixelSampler(Spu& spu, const FrameBlock& frame, SampleBundle<Spu>& samples, uint8_t* scratch)
      : spu_(spu), frame_(frame), samples_(samples), work_(*spu.template allocate<Work>()),
        scratch_(*reinterpret_cast<Scratch*>(scratch)) {}

  static constexpr const CodeModule& module() {
    if constexpr (kMethod == SamplingMethod::fixed)
      return kHasAlpha ? modules::kAlphaSampling : modules::kSampling;
    else
      return kHasAlpha ? modules::kAlphaSquares : modules::kSquares;
  }

  /// Is none of the module's code.
  [[gnu::always_inline]] void begin_frame() {
    under_way_ = false;
    store_ = frame_.sample_store + spu_.id() * sample_store_bytes(kBundleEdge<Spu>, kHasAlpha);
    for (SampleLanes& packet : samples_.at)
      packet.clear = FloatLanes();
  }

  /// Takes the colours of the bundle or block at (column, row); those of samples were asked for by the call
  /// before. True: the block needs those that `samples` now has, too.
  [[gnu::noinline]] bool advance(uint32_t column, uint32_t row) {
    spu_.run_in_module(module());
    if (static_cast<FramePurpose>(frame_.purpose) == FramePurpose::grid) {
      store_points(column, row);
      return false;
    }
    if constexpr (kMethod == SamplingMethod::fixed) {
      if (under_way_)
        take_samples();
      else
        begin_block(column, row);
      under_way_ = ask_for_pixels();
    } else {
      if (under_way_)
        divide_squares();
      else
        begin_block(column, row);
      under_way_ = ask_for_squares();
    }
    return under_way_;
  }

private:
  static constexpr bool kHasAlpha = kChannels == 4;
  static constexpr uint32_t kEdge = kBundleEdge<Spu>;
  static constexpr uint32_t kPackets = kBundlePackets<Spu>;
  static constexpr uint32_t kSquares = squares_at_once(kEdge);
  static constexpr uint32_t kRows = sampled_rows(kEdge);
  static constexpr uint32_t kTag = 7;
  /// Packets that a row of points of a block is in: one more of them than pixels.
  static constexpr uint32_t kRowPackets = kSampledEdge / kPacketEdge + 1;
  static constexpr uint32_t kRowPoints = kSampledEdge + kSimdLanes; ///< and some more, for whole vectors

  using Colour = ColourRecord;
  using Square = SampleSquare<kChannels>;
  /// The channels of a row of points, of which the first is that at the block's left edge.
  struct alignas(64) PointRow {
    float channel[kChannels][kRowPoints];
  };
  /// Goes over the samples of pixels that are asked for.
  struct Cursor {
    uint32_t row = 0, pixels = 0;  ///< bits of the row that are still to come, the lowest first
    uint32_t across = 0, down = 0; ///< the sample
  };
  /// A bit for each pixel of the block, by row.
  struct BlockMask {
    uint32_t row[kSampledEdge];
  };

  /// What is kept from call to call.
  union alignas(128) Work {
    struct {
      BlockMask left, above; ///< differ from the pixel's left or upper neighbour, before any is sampled
      BlockMask sampled;     ///< as far as is known, is sampled
      BlockMask known;       ///< has a colour in the store
    } fixed;
    struct {
      alignas(64) float sums[kRows][kChannels][kSampledEdge];
    } adaptive;
  };

  /// The nine points of a square that is divided, in whole vectors.
  static constexpr uint32_t kEncoded = (9 * kChannels + kSimdLanes - 1) / kSimdLanes * kSimdLanes;
  static_assert(R::kLanes <= kSampledEdge, "means are kept where colours of a row are");

  /// What is not.
  struct Scratch {
    SampleLanes packets[kRowPackets];
    PointRow points[2], encoded[2]; ///< of two rows, by turns
    Square squares[kSquares];       ///< that are being divided
    alignas(64) float encoding[kEncoded > 3 * R::kLanes ? kEncoded : 3 * R::kLanes];
    uint32_t places[R::kLanes];                  ///< of means that are being encoded
    alignas(64) float channels[3][kSampledEdge]; ///< of pixels to be written
    alignas(64) uint32_t words[kSampledEdge];    ///< these
    Colour colours[kStoredPoints];
    alignas(16) uint32_t leaving[kSampledEdge][4];
  };

public:
  static constexpr uint32_t kScratchBytes = sizeof(Scratch);

private:
  // Most of what moves is small: where memory is direct, a transfer would take longer than the copy.

  [[gnu::noinline]] void fetch(void* ls, ea_t ea, uint32_t bytes) {
    if constexpr (kReadsInPlace<Spu>) {
      __builtin_memcpy(ls, reinterpret_cast<const void*>(static_cast<uintptr_t>(ea)), bytes);
    } else {
      spu_.get(ls, ea, bytes, kTag);
      spu_.wait_all(1u << kTag);
    }
  }
  /// What is sent may be changed after arrive().
  [[gnu::noinline]] void send(const void* ls, ea_t ea, uint32_t bytes) {
    if constexpr (kReadsInPlace<Spu>)
      __builtin_memcpy(reinterpret_cast<void*>(static_cast<uintptr_t>(ea)), ls, bytes);
    else
      spu_.put(ls, ea, bytes, kTag);
  }
  void arrive() {
    if constexpr (!kReadsInPlace<Spu>) spu_.wait_all(1u << kTag);
  }

  // --- the grid ---

  ea_t packet_of_points(uint32_t column, uint32_t row) const {
    return frame_.grid_points + (row * frame_.packet_columns + column) * kGridPacketBytes;
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
        packet.clear = FloatLanes();
  }

  /// Row `row` of the grid's points at the block, of which the first is that to its upper left.
  [[gnu::noinline]] void fetch_points(uint32_t row, PointRow& points) {
    const uint32_t first = column_ * kSampledEdge / kPacketEdge;
    const uint32_t left = frame_.packet_columns - first;
    const uint32_t packets = left < kRowPackets ? left : kRowPackets;
    const uint32_t line = row_ * kSampledEdge + row;
    fetch(scratch_.packets, packet_of_points(first, line / kPacketEdge), packets * kGridPacketBytes);
    for (uint32_t packet = 0; packet < packets; ++packet)
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        S::F4::load(scratch_.packets[packet][axis].lane + line % kPacketEdge * kPacketEdge)
            .store(points.channel[axis] + packet * kPacketEdge);
    for (uint32_t axis = 0; axis < kChannels; ++axis)
      for (uint32_t x = packets * kPacketEdge; x < kRowPoints; ++x)
        points.channel[axis][x] = 0.0f;
  }

  /// Numbers become what colours are compared by; whole vectors of sixteen.
  [[gnu::noinline]] void encode(float* values, uint32_t count) const {
    for (uint32_t i = 0; i < count; i += R::kLanes)
      pow<R>(F::load(values + i), F(frame_.sampling.inverse_gamma)).store(values + i);
  }
  [[gnu::noinline]] void encode_points(const PointRow& points, PointRow& encoded) const {
    encoded = points;
    encode(encoded.channel[0], 3 * kRowPoints);
  }
  /// Points of a row, from any one on.
  static V3<R> points_from(const PointRow& row, uint32_t first) {
    alignas(64) float lane[3][R::kLanes];
    for (uint32_t axis = 0; axis < 3; ++axis)
      for (uint32_t i = 0; i < R::kLanes; ++i)
        lane[axis][i] = row.channel[axis][first + i];
    return {F::load(lane[0]), F::load(lane[1]), F::load(lane[2])};
  }
  /// Where the points of a block's row differ from those of another, each counted from any one on.
  [[gnu::noinline]] uint32_t differing(const PointRow& a, uint32_t first_a, const PointRow& b,
                                       uint32_t first_b) const {
    uint32_t bits = 0;
    for (uint32_t x = 0; x < kSampledEdge; x += R::kLanes) {
      const V3<R> difference = points_from(a, first_a + x) - points_from(b, first_b + x);
      F sum = absolute_sum<R>(difference);
      if constexpr (kHasAlpha) {
        const F clear = channel_from(a, 3, first_a + x);
        sum = sum + R::abs(clear - channel_from(b, 3, first_b + x));
      }
      bits |= (sum >= F(frame_.sampling.threshold)).bits() << x;
    }
    return bits;
  }
  static F channel_from(const PointRow& row, uint32_t channel, uint32_t first) {
    alignas(64) float lane[R::kLanes];
    for (uint32_t i = 0; i < R::kLanes; ++i)
      lane[i] = row.channel[channel][first + i];
    return F::load(lane);
  }

  static uint32_t smaller_of(uint32_t a, uint32_t b) { return a < b ? a : b; }

  [[gnu::noinline]] void begin_block(uint32_t column, uint32_t row) {
    column_ = column;
    row_ = row;
    width_ = smaller_of(frame_.width - 1 - column * kSampledEdge, kSampledEdge);
    height_ = smaller_of(frame_.height - 1 - row * kSampledEdge, kSampledEdge);
    if constexpr (kMethod == SamplingMethod::fixed) {
      compare_pixels();
      compare_again();
    } else {
      next_row_ = 0;
      rows_ = 0;
      waiting_ = 0;
    }
  }
  /// Bits of the pixels of a row that are in the picture.
  uint32_t row_mask() const { return width_ == kSampledEdge ? ~0u : (1u << width_) - 1; }

  /// Where a sample is moved to, in pixels: of a hash of its place, so that it is the same in every run.
  /// Wellons' lowbias32.
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
  /// Puts a sample, in points of the grid, into the next lane.
  void ask(uint32_t number, float x, float y) {
    SampleLanes& packet = samples_.at[number / kSimdLanes];
    packet.x.lane[number % kSimdLanes] = x;
    packet.y.lane[number % kSimdLanes] = y;
  }
  /// After the last sample. Lanes that are none get its place.
  [[gnu::noinline]] void end_asking(uint32_t count) {
    for (uint32_t packet = 0; packet < kPackets; ++packet) {
      const uint32_t first = packet * kSimdLanes;
      const uint32_t lanes = count <= first ? 0 : smaller_of(count - first, kSimdLanes);
      samples_.lanes[packet] = (1u << lanes) - 1;
      if constexpr (kHasAlpha) samples_.at[packet].clear = FloatLanes();
      if (lanes == 0) continue;
      float(&x)[kSimdLanes] = samples_.at[packet].x.lane;
      float(&y)[kSimdLanes] = samples_.at[packet].y.lane;
      for (uint32_t lane = lanes; lane < kSimdLanes; ++lane) {
        x[lane] = x[lanes - 1];
        y[lane] = y[lanes - 1];
      }
      move_samples(x, y);
    }
  }
  /// Jittered, and from the middle of the picture. All lanes alike, so that compilers take them together.
  [[gnu::noinline]] void move_samples(float (&x)[kSimdLanes], float (&y)[kSimdLanes]) const {
    const float amount = frame_.sampling.jitter;
    const float middle_x = frame_.camera.middle_x, middle_y = frame_.camera.middle_y;
    for (uint32_t lane = 0; lane < kSimdLanes; ++lane) {
      jitter(x[lane], y[lane], amount);
      x[lane] -= middle_x;
      y[lane] -= middle_y;
    }
  }
  float channel(uint32_t sample, uint32_t axis) const {
    return samples_.at[sample / kSimdLanes][axis].lane[sample % kSimdLanes];
  }

  /// Pixels of colours, as many as two packets.
  [[gnu::noinline]] void encode_pixels_of(const float (*colours)[kSampledEdge], uint32_t* words) const {
    using W = typename S::F;
    for (uint32_t i = 0; i < kSampledEdge; i += kSimdLanes)
      encode_pixels<Spu>(frame_, {W::load(colours[0] + i), W::load(colours[1] + i), W::load(colours[2] + i)})
          .store(reinterpret_cast<int32_t*>(words + i));
  }

  /// Of channels that lie `stride` numbers apart.
  [[gnu::noinline]] void gather_colours(const float* channels, uint32_t stride, uint32_t count) {
    for (uint32_t x = 0; x < count; ++x)
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        scratch_.colours[x].channel[axis] = channels[axis * stride + x];
  }
  /// Puts some of the colours where they are wanted: x and y count from the block's first point on.
  [[gnu::noinline]] void put_colours(uint32_t first, uint32_t count, uint32_t x, uint32_t y) {
    if (frame_.sampling.colours_pitch == 0) return;
    const ea_t to = frame_.surface + frame_.packet_rows * kPacketEdge * frame_.surface_pitch +
                    (row_ * kSampledEdge + y) * frame_.sampling.colours_pitch +
                    (column_ * kSampledEdge + x) * kColourBytes;
    send(scratch_.colours + first, to, count * kColourBytes);
  }

  // --- the fixed method ---

  /// The neighbours that pixels differ from, before any of them is sampled.
  [[gnu::noinline]] void compare_pixels() {
    auto& masks = work_.fixed;
    fetch_points(0, scratch_.points[0]);
    encode_points(scratch_.points[0], scratch_.encoded[0]);
    store_encoded(0, scratch_.encoded[0]);
    for (uint32_t y = 0; y < height_; ++y) {
      const PointRow& above = scratch_.encoded[y % 2];
      PointRow& own = scratch_.encoded[(y + 1) % 2];
      fetch_points(y + 1, scratch_.points[0]);
      encode_points(scratch_.points[0], own);
      store_encoded(y + 1, own);
      masks.left.row[y] = differing(own, 1, own, 0) & row_mask();
      masks.above.row[y] = differing(own, 1, above, 1) & row_mask();
      masks.known.row[y] = 0;
    }
  }

  /// Keeps what a row of points is compared by.
  [[gnu::noinline]] void store_encoded(uint32_t y, const PointRow& encoded) {
    gather_colours(encoded.channel[0], kRowPoints, width_ + 1);
    send(scratch_.colours, encoded_point(0, y), (width_ + 1) * kColourBytes);
    arrive();
  }

  /// Compares all pixels in POV-Ray's order, each with what the ones before it have become. Of pixels that
  /// are to be sampled and are not yet, the colour counts that they have.
  [[gnu::noinline]] void compare_again() {
    auto& masks = work_.fixed;
    uint32_t none = 0;
    for (uint32_t y = 0; y < height_; ++y) {
      masks.sampled.row[y] = 0;
      uint32_t* const over = y == 0 ? &none : &masks.sampled.row[y - 1];
      uint32_t& own = masks.sampled.row[y];
      const uint32_t left = masks.left.row[y], above = masks.above.row[y];
      uint32_t candidates = left | above | *over;
      while (candidates != 0) {
        const uint32_t x = static_cast<uint32_t>(__builtin_ctz(candidates));
        const uint32_t bit = 1u << x;
        candidates &= ~bit;
        const uint32_t before = bit >> 1;
        bool differs_left = (left & bit) != 0, differs_above = (above & bit) != 0;
        if (((own & masks.known.row[y] & before) | (*over & (y == 0 ? 0 : masks.known.row[y - 1]) & bit)) !=
            0) {
          const uint32_t differs =
              kHasRoomForCode<Spu> ? differences_of(x, y) : differences_out_of_line(x, y);
          differs_left = (differs & 1) != 0;
          differs_above = (differs & 2) != 0;
        }
        if (differs_left) own |= before;
        if (differs_above && y != 0) *over |= bit;
        if (!differs_left && !differs_above) continue;
        own |= bit;
        candidates |= bit << 1 & row_mask();
      }
    }
    cursor_ = begin_cursor();
    taken_ = cursor_;
  }

  static constexpr auto kColourBytes = static_cast<uint32_t>(sizeof(Colour));
  // The store: colours of pixels, what they are compared by, and what points are compared by.
  ea_t stored_colour(uint32_t x, uint32_t y) const { return store_ + (y * kSampledEdge + x) * kColourBytes; }
  ea_t encoded_colour(uint32_t x, uint32_t y) const { return stored_colour(x, kSampledEdge + y); }
  ea_t encoded_point(uint32_t x, uint32_t y) const {
    return stored_colour(0, 2 * kSampledEdge) + (y * kStoredPoints + x) * kColourBytes;
  }
  /// The colour of a point, x and y from the block's first one on.
  [[gnu::noinline]] void fetch_point(uint32_t x, uint32_t y, Colour& colour) {
    const uint32_t column = column_ * kSampledEdge + x;
    const uint32_t line = row_ * kSampledEdge + y;
    const ea_t packet = packet_of_points(column / kPacketEdge, line / kPacketEdge);
    const uint32_t lane = line % kPacketEdge * kPacketEdge + column % kPacketEdge;
    const auto take_from = [&](const SampleLanes& points) {
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        colour.channel[axis] = points[axis].lane[lane];
    };
    if constexpr (kReadsInPlace<Spu>) {
      take_from(*reinterpret_cast<const SampleLanes*>(static_cast<uintptr_t>(packet)));
    } else {
      fetch(scratch_.packets, packet, kGridPacketBytes);
      take_from(scratch_.packets[0]);
    }
  }
  /// Where it lies if memory is direct, otherwise in `room`.
  [[gnu::always_inline]] const Colour& colour_at(ea_t ea, [[maybe_unused]] Colour& room) {
    if constexpr (kReadsInPlace<Spu>) {
      return *reinterpret_cast<const Colour*>(static_cast<uintptr_t>(ea));
    } else {
      fetch(&room, ea, kColourBytes);
      return room;
    }
  }
  /// Where that is what a point is compared by, which may be a pixel of the block: of those that are sampled,
  /// what they have become.
  [[gnu::always_inline]] ea_t compared_by(uint32_t x, uint32_t y) const {
    const auto& masks = work_.fixed;
    const bool is_pixel = x != 0 && y != 0;
    const bool is_known =
        is_pixel && (masks.sampled.row[y - 1] & masks.known.row[y - 1] & 1u << (x - 1)) != 0;
    return is_known ? encoded_colour(x - 1, y - 1) : encoded_point(x, y);
  }
  /// Whether a pixel differs from its neighbours as they are now: bit 0 from the left one, bit 1 from the
  /// upper one.
  [[gnu::always_inline]] uint32_t differences_of(uint32_t x, uint32_t y) {
    Colour* const room = scratch_.colours;
    const Colour& own = colour_at(encoded_point(x + 1, y + 1), room[0]);
    const Colour& left = colour_at(compared_by(x, y + 1), room[1]);
    const Colour& above = colour_at(compared_by(x + 1, y), room[2]);
    const float threshold = frame_.sampling.threshold;
    return (distance(own.channel, left.channel) >= threshold ? 1u : 0u) |
           (distance(own.channel, above.channel) >= threshold ? 2u : 0u);
  }
  [[gnu::noinline]] uint32_t differences_out_of_line(uint32_t x, uint32_t y) { return differences_of(x, y); }
  [[gnu::always_inline]] static float distance_inline(const float* a, const float* b) {
    const float sum = magnitude(a[0] - b[0]) + magnitude(a[1] - b[1]) + magnitude(a[2] - b[2]);
    if constexpr (kHasAlpha)
      return sum + magnitude(a[3] - b[3]);
    else
      return sum;
  }
  [[gnu::noinline]] static float distance_out_of_line(const float* a, const float* b) {
    return distance_inline(a, b);
  }
  static float distance(const float* a, const float* b) {
    if constexpr (kHasRoomForCode<Spu>)
      return distance_inline(a, b);
    else
      return distance_out_of_line(a, b);
  }

  /// The pixels of a row that still need samples.
  uint32_t wanted(uint32_t y) const { return work_.fixed.sampled.row[y] & ~work_.fixed.known.row[y]; }
  Cursor begin_cursor() const {
    Cursor cursor;
    cursor.pixels = wanted(0);
    return cursor;
  }
  /// Goes to the next pixel that needs samples if it is at none. False: there is no other.
  bool find_pixel(Cursor& cursor) const {
    while (cursor.pixels == 0) {
      if (++cursor.row >= height_) {
        cursor.row = height_ - 1;
        return false;
      }
      cursor.pixels = wanted(cursor.row);
    }
    return true;
  }

  /// Makes as many samples as there is room for. False: the block is done.
  [[gnu::noinline]] bool ask_for_pixels() {
    const uint32_t depth = frame_.sampling.depth;
    const float step = 1.0f / static_cast<float>(depth);
    uint32_t count = 0;
    for (;;) {
      Cursor cursor = cursor_;
      while (count < kPackets * kSimdLanes && find_pixel(cursor)) {
        const uint32_t column = column_ * kSampledEdge + static_cast<uint32_t>(__builtin_ctz(cursor.pixels));
        const float x = static_cast<float>(column) + 0.5f;
        const float y = static_cast<float>(row_ * kSampledEdge + cursor.row) + 0.5f;
        do
          ask(count++, x + (static_cast<float>(cursor.across) + 0.5f) * step,
              y + (static_cast<float>(cursor.down) + 0.5f) * step);
        while (!next_sample(cursor) && count < kPackets * kSimdLanes);
      }
      cursor_ = cursor;
      if (count != 0) {
        end_asking(count);
        asked_ = count;
        return true;
      }
      bool any = false;
      for (uint32_t y = 0; y < height_; ++y) {
        any = any || wanted(y) != 0;
        work_.fixed.known.row[y] |= work_.fixed.sampled.row[y];
      }
      if (!any) break;
      compare_again();
    }
    write_sampled();
    return false;
  }
  /// True: it was the last one of its pixel.
  bool next_sample(Cursor& cursor) const {
    const uint32_t depth = frame_.sampling.depth;
    if (++cursor.across < depth) return false;
    cursor.across = 0;
    if (++cursor.down < depth) return false;
    cursor.down = 0;
    cursor.pixels &= cursor.pixels - 1;
    return true;
  }

  [[gnu::noinline]] void take_samples() {
    const uint32_t depth = frame_.sampling.depth;
    const float share = 1.0f / static_cast<float>(depth * depth + 1);
    Cursor taken = taken_;
    uint32_t means = 0;
    for (uint32_t i = 0; i < asked_;) {
      find_pixel(taken);
      const uint32_t x = static_cast<uint32_t>(__builtin_ctz(taken.pixels));
      const uint32_t y = taken.row;
      // The middle of the pixel counts as one sample more.
      if ((taken.across | taken.down) == 0) fetch_point(x + 1, y + 1, sum_);
      Colour sum = sum_;
      bool complete;
      do {
        for (uint32_t axis = 0; axis < kChannels; ++axis)
          sum.channel[axis] += channel(i, axis);
        complete = next_sample(taken);
      } while (++i < asked_ && !complete);
      sum_ = sum;
      if (!complete) break;
      for (float& value : sum.channel)
        value *= share;
      store_mean(means++, x, y, sum);
      if (means < R::kLanes) continue;
      encode_means(means);
      means = 0;
    }
    taken_ = taken;
    if (means != 0) encode_means(means);
  }
  /// A pixel is known.
  void store_mean(uint32_t number, uint32_t x, uint32_t y, const Colour& mean) {
    scratch_.colours[number] = mean;
    scratch_.places[number] = y * kSampledEdge + x;
    for (uint32_t axis = 0; axis < 3; ++axis)
      scratch_.encoding[3 * number + axis] = mean.channel[axis];
    send(&scratch_.colours[number], stored_colour(x, y), kColourBytes);
  }
  /// What so many means are compared by.
  [[gnu::noinline]] void encode_means(uint32_t count) {
    arrive();
    for (uint32_t i = 3 * count; i < 3 * R::kLanes; ++i)
      scratch_.encoding[i] = 0.0f;
    encode(scratch_.encoding, 3 * R::kLanes);
    for (uint32_t number = 0; number < count; ++number) {
      Colour& mean = scratch_.colours[number];
      for (uint32_t axis = 0; axis < 3; ++axis)
        mean.channel[axis] = scratch_.encoding[3 * number + axis];
      send(&mean, encoded_colour(scratch_.places[number], 0), kColourBytes);
    }
    arrive();
  }

  /// Pixels that are sampled replace those of the grid in the picture.
  [[gnu::noinline]] void write_sampled() {
    for (uint32_t y = 0; y < height_; ++y) {
      const uint32_t sampled = work_.fixed.sampled.row[y];
      if (sampled == 0) continue;
      fetch(scratch_.colours, stored_colour(0, y), kSampledEdge * kColourBytes);
      for (uint32_t x = 0; x < kSampledEdge; ++x)
        for (uint32_t axis = 0; axis < 3; ++axis)
          scratch_.channels[axis][x] = (sampled >> x & 1) != 0 ? scratch_.colours[x].channel[axis] : 0.0f;
      encode_pixels_of(scratch_.channels, scratch_.words);
      const ea_t row = frame_.surface + (row_ * kSampledEdge + y + 1) * frame_.surface_pitch +
                       (column_ * kSampledEdge + 1) * static_cast<uint32_t>(sizeof(uint32_t));
      for_each_lane(sampled, [&](uint32_t x) {
        // A word has the same place in its quadword on both sides of a transfer.
        uint32_t* const word = &scratch_.leaving[x][(x + 1) % 4];
        *word = scratch_.words[x];
        send(word, row + x * static_cast<uint32_t>(sizeof(uint32_t)), sizeof(uint32_t));
        put_colours(x, 1, x + 1, y + 1);
      });
      arrive();
    }
  }

  // --- the adaptive method ---

  ea_t stored_square(uint32_t number) const {
    return store_ + number * static_cast<uint32_t>(sizeof(Square));
  }

  /// Makes the samples of as many squares as there is room for, the last ones first. False: the block is
  /// done.
  [[gnu::noinline]] bool ask_for_squares() {
    while (waiting_ == 0) {
      if (rows_ != 0) write_rows();
      if (next_row_ == height_) return false;
      compare_corners();
    }
    asked_ = smaller_of(waiting_, kSquares);
    waiting_ -= asked_;
    fetch_squares();
    for (uint32_t i = 0; i < asked_; ++i) {
      const Square& square = scratch_.squares[i];
      const float size = edge_of(square), half = 0.5f * size;
      const uint32_t first = i * kSamplesOfSquare;
      ask(first, square.x + half, square.y);
      ask(first + 1, square.x, square.y + half);
      ask(first + 2, square.x + half, square.y + half);
      ask(first + 3, square.x + size, square.y + half);
      ask(first + 4, square.x + half, square.y + size);
    }
    end_asking(asked_ * kSamplesOfSquare);
    return true;
  }
  /// Those that are being divided: behind the waiting ones.
  void fetch_squares() {
    fetch(scratch_.squares, stored_square(waiting_), asked_ * static_cast<uint32_t>(sizeof(Square)));
  }
  static float edge_of(const Square& square) { return 1.0f / static_cast<float>(1u << square.level); }

  /// The next rows of pixels: those whose corners are alike are done, of the others the squares wait.
  [[gnu::noinline]] void compare_corners() {
    first_row_ = next_row_;
    rows_ = smaller_of(height_ - next_row_, kRows);
    next_row_ += rows_;
    fetch_points(first_row_, scratch_.points[0]);
    encode_points(scratch_.points[0], scratch_.encoded[0]);
    for (uint32_t y = 0; y < rows_; ++y) {
      const uint32_t upper = y % 2, lower = 1 - upper;
      fetch_points(first_row_ + y + 1, scratch_.points[lower]);
      encode_points(scratch_.points[lower], scratch_.encoded[lower]);
      uint32_t divided =
          frame_.sampling.depth > 1
              ? differing_corners(scratch_.encoded[upper], scratch_.encoded[lower]) & row_mask()
              : 0;
      sum_corners(scratch_.points[upper], scratch_.points[lower], divided, work_.adaptive.sums[y]);
      for_each_lane(divided, [&](uint32_t x) { divide_pixel(x, y, upper); });
    }
  }
  uint32_t differing_corners(const PointRow& upper, const PointRow& lower) const {
    return differing(upper, 0, upper, 1) | differing(upper, 0, lower, 0) | differing(upper, 0, lower, 1) |
           differing(upper, 1, lower, 0) | differing(upper, 1, lower, 1) | differing(lower, 0, lower, 1);
  }
  /// The means of the corners of pixels, or 0 where they are divided.
  static void sum_corners(const PointRow& upper, const PointRow& lower, uint32_t divided,
                          float (&sums)[kChannels][kSampledEdge]) {
    const V3<R> zero = {F(0.0f), F(0.0f), F(0.0f)};
    for (uint32_t x = 0; x < kSampledEdge; x += R::kLanes) {
      V3<R> sum = zero;
      for (uint32_t corner = 0; corner < 4; ++corner)
        sum = sum + points_from(corner < 2 ? upper : lower, x + corner % 2);
      const V3<R> mean =
          select<R>(R::M::from_bits(divided >> x & ((1u << R::kLanes) - 1)), zero, sum * F(0.25f));
      mean.x.store(sums[0] + x);
      mean.y.store(sums[1] + x);
      mean.z.store(sums[2] + x);
      if constexpr (kHasAlpha) {
        F clear(0.0f);
        for (uint32_t corner = 0; corner < 4; ++corner)
          clear = clear + channel_from(corner < 2 ? upper : lower, 3, x + corner % 2);
        R::select(R::M::from_bits(divided >> x & ((1u << R::kLanes) - 1)), F(0.0f), clear * F(0.25f))
            .store(sums[3] + x);
      }
    }
  }
  void divide_pixel(uint32_t x, uint32_t y, uint32_t upper) {
    Square& square = scratch_.squares[0];
    for (uint32_t corner = 0; corner < 4; ++corner)
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        square.corner[corner][axis] =
            scratch_.points[corner < 2 ? upper : 1 - upper].channel[axis][x + corner % 2];
    square.x = static_cast<float>(column_ * kSampledEdge + x);
    square.y = static_cast<float>(row_ * kSampledEdge + first_row_ + y);
    square.pixel = y * kSampledEdge + x;
    square.level = 0;
    push(square);
  }
  /// `square` lies in local store.
  [[gnu::noinline]] void push(const Square& square) {
    send(&square, stored_square(waiting_++), sizeof square);
    arrive();
  }

  /// Makes four of each square that was asked for: those whose corners are alike are done, the others wait.
  [[gnu::noinline]] void divide_squares() {
    fetch_squares();
    for (uint32_t i = 0; i < asked_; ++i)
      divide(scratch_.squares[i], i * kSamplesOfSquare);
  }
  [[gnu::noinline]] void divide(Square& square, uint32_t first) {
    // Nine points, row by row: corners are known, what is between them are samples.
    float points[9][kChannels];
    for (uint32_t axis = 0; axis < kChannels; ++axis)
      for (uint32_t i = 0; i < 9; ++i)
        points[i][axis] = i % 2 == 0 && i != 4 ? square.corner[i / 6 * 2 + i % 3 / 2][axis]
                                               : channel(first + i / 2 + (i > 4 ? 1 : 0), axis);
    float* const encoded = scratch_.encoding;
    __builtin_memcpy(encoded, points, sizeof points);
    for (uint32_t i = 9 * kChannels; i < kEncoded; ++i)
      encoded[i] = 0.0f;
    encode(encoded, kEncoded);
    if constexpr (kHasAlpha)
      for (uint32_t i = 0; i < 9; ++i)
        encoded[i * kChannels + 3] = points[i][3];

    const uint32_t level = square.level + 1;
    const float half = 0.5f * edge_of(square);
    const float share = 1.0f / static_cast<float>(4u << 2 * level);
    const uint32_t pixel = square.pixel;
    const float x = square.x, y = square.y;
    for (uint32_t child = 0; child < 4; ++child) {
      const uint32_t upper_left = child % 2 + child / 2 * 3;
      const uint32_t corners[4] = {upper_left, upper_left + 1, upper_left + 3, upper_left + 4};
      if (level + 1 < frame_.sampling.depth && differ(encoded, corners)) {
        for (uint32_t corner = 0; corner < 4; ++corner)
          for (uint32_t axis = 0; axis < kChannels; ++axis)
            square.corner[corner][axis] = points[corners[corner]][axis];
        square.x = x + static_cast<float>(child % 2) * half;
        square.y = y + static_cast<float>(child / 2) * half;
        square.level = level;
        push(square);
        continue;
      }
      float(*const sums)[kSampledEdge] = work_.adaptive.sums[pixel / kSampledEdge];
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        sums[axis][pixel % kSampledEdge] += share * (points[corners[0]][axis] + points[corners[1]][axis] +
                                                     points[corners[2]][axis] + points[corners[3]][axis]);
    }
  }
  bool differ(const float* encoded, const uint32_t (&corners)[4]) const {
    for (uint32_t i = 1; i < 4; ++i)
      for (uint32_t j = 0; j < i; ++j)
        if (distance(encoded + kChannels * corners[i], encoded + kChannels * corners[j]) >=
            frame_.sampling.threshold)
          return true;
    return false;
  }

  /// Pixels take the place of the corners in the picture.
  [[gnu::noinline]] void write_rows() {
    for (uint32_t y = 0; y < rows_; ++y) {
      encode_pixels_of(work_.adaptive.sums[y], scratch_.words);
      const ea_t to = frame_.surface + (row_ * kSampledEdge + first_row_ + y) * frame_.surface_pitch +
                      column_ * kSampledEdge * static_cast<uint32_t>(sizeof(uint32_t));
      send(scratch_.words, to, (width_ + 3) / 4 * 16);
      gather_colours(work_.adaptive.sums[y][0], kSampledEdge, width_);
      put_colours(0, width_, 0, first_row_ + y);
      arrive();
    }
    rows_ = 0;
  }

  Spu& spu_;
  const FrameBlock& frame_;
  SampleBundle<Spu>& samples_;
  Work& work_;
  Scratch& scratch_;
  ea_t store_ = 0;
  bool under_way_ = false;
  uint32_t column_ = 0, row_ = 0;     ///< of the block
  uint32_t width_ = 0, height_ = 0;   ///< pixels of it that are in the picture
  uint32_t asked_ = 0;                ///< samples, or squares
  Cursor cursor_, taken_;             ///< fixed: the next sample to be asked for, and to be taken
  Colour sum_ = {};                   ///< of the samples of a pixel that are there
  uint32_t first_row_ = 0, rows_ = 0; ///< adaptive: the rows that are being summed up
  uint32_t next_row_ = 0;
  uint32_t waiting_ = 0; ///< squares in the store
};

} // namespace celltrace::kernel

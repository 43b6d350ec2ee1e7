// Antialiasing by the fixed method: pixels that differ from a neighbour are sampled by a grid of rays. Kernel
// dialect.
//
// As in POV-Ray, a pixel is compared with the current colour of its neighbour, which may have been sampled
// before. All pixels that seem to need samples get them at once; then the comparisons are repeated with the
// known colours, until no pixel is missing.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kChannels>
class FixedSampler : public PixelSampler<Spu, SamplingMethod::fixed, kChannels> {
  using Base = PixelSampler<Spu, SamplingMethod::fixed, kChannels>;
  using Base::arrive, Base::requested_, Base::channel_from, Base::column_, Base::differing, Base::encode,
      Base::encode_pixels_of, Base::encode_points, Base::end_requests, Base::first_line, Base::found_at,
      Base::frame_, Base::go_to_block, Base::height_, Base::kColourBytes, Base::kSamples,
      Base::packet_of_points, Base::packets_of_row, Base::put_colours, Base::row_, Base::row_mask,
      Base::scratch_, Base::send_object, Base::smaller_of, Base::store_, Base::take_channels,
      Base::take_points, Base::takes_points, Base::in_progress_, Base::wants_colours, Base::width_;
  using typename Base::Colour, typename Base::F, typename Base::Points, typename Base::R;
  using W = typename Base::S::F;

  static constexpr uint32_t kMostSamples = kMaxSamplingDepth * kMaxSamplingDepth; ///< samples of a pixel

  /// The means of a row of pixels, laid out as a row of points: the mean of a pixel is at the place of its
  /// point.
  struct MeanRow {
    alignas(64) float numbers[kChannels][kSimdLanes + kSampledEdge];

    const float* channel(uint32_t axis) const { return numbers[axis] + kSimdLanes - 1; }
  };
  struct Place {
    uint32_t x, y;
  };
  /// Positions of a pixel's samples, from its upper left corner.
  struct PixelGrid {
    float across[kMostSamples], down[kMostSamples];
  };
  struct Scratch : Base::Scratch {
    alignas(64) float encoding[3 * R::kLanes]; ///< means that are being encoded
    Colour means_of[R::kLanes];
    Place places[R::kLanes]; ///< positions of the means
    union {
      MeanRow means;  ///< while pixels are compared
      PixelGrid grid; ///< while samples are asked for
    };
    alignas(64) float channels[3][kSampledEdge]; ///< channels of pixels to be written
    alignas(16) uint32_t leaving[kSampledEdge][4];
  };

  Scratch& scratch() const { return static_cast<Scratch&>(scratch_); }

public:
  static constexpr uint32_t kScratchBytes = sizeof(Scratch);

  /// Allocates memory. `scratch` has room for kScratchBytes and belongs to the sampler while advance() runs.
  FixedSampler(Spu& spu, const FrameBlock& frame, SampleBundle<Spu>& samples, uint8_t* scratch)
      : Base(spu, frame, samples, *reinterpret_cast<Scratch*>(scratch)),
        masks_(*spu.template allocate<Masks>()) {}

  /// Takes the colours of the grid points of the bundle, or of the last call's samples in the block, at
  /// (column, row). True: the block needs the samples that `samples` now has.
  CELLTRACE_ONE_COPY bool advance(uint32_t column, uint32_t row) {
    if (takes_points(column, row)) return false;
    if (in_progress_)
      take_samples();
    else
      begin_block(column, row);
    in_progress_ = request_pixels();
    return in_progress_;
  }

private:
  /// A cursor over the samples of pixels, tile by tile of 8x4, so that rays that are traced together are near
  /// each other.
  struct Cursor {
    uint32_t tile = 0;   ///< index in the block, by row
    uint32_t pixels = 0; ///< remaining pixels of the tile, by row; the lowest is next
    uint32_t sample = 0; ///< index in the pixel, row by row

    // Position of the next pixel in the block.
    uint32_t x() const { return tile % 4 * 8 + first() % 8; }
    uint32_t y() const { return tile / 4 * 4 + first() / 8; }

  private:
    uint32_t first() const { return static_cast<uint32_t>(__builtin_ctz(pixels)); }
  };
  static constexpr uint32_t kTiles = kSampledEdge * kSampledEdge / 32;
  /// A bit for each pixel of the block, by row.
  struct BlockMask {
    uint32_t row[kSampledEdge];
  };
  struct alignas(128) Masks {
    BlockMask left, above; ///< pixels that differ from the left or upper neighbour before any is sampled
    BlockMask sampled;     ///< pixels that have to be sampled, as far as is known
    BlockMask known;       ///< pixels whose colours are in the store
  };

  CELLTRACE_ONE_COPY void begin_block(uint32_t column, uint32_t row) {
    go_to_block(column, row);
    compare_pixels();
    compare_again();
  }

  /// Finds the neighbours that pixels differ from, before any of them is sampled.
  CELLTRACE_ONE_COPY void compare_pixels() {
    const F step = most_step();
    const SampleLanes* packets = nullptr;
    encoded_ = 0;
    for (uint32_t line = 0; line <= height_; ++line) {
      if (line % kPacketEdge == 0) packets = packets_of_row(line);
      const Points& own = scratch().points[line % 2];
      take_points(packets, line, scratch().points[line % 2]);
      if (line != 0) {
        const uint32_t y = line - 1;
        uint32_t left = 0, above = 0;
        if (!is_smooth(own, scratch().points[y % 2], step)) {
          const bool is_encoded = y != 0 && (encoded_ >> (y - 1) & 1) != 0;
          if (!is_encoded) encode_row(y);
          encode_row(line);
          const Points &encoded = scratch().encoded[line % 2], &over = scratch().encoded[y % 2];
          left = differing(encoded, 1, encoded, 0) & row_mask();
          above = differing(encoded, 1, over, 1) & row_mask();
        }
        masks_.left.row[y] = left;
        masks_.above.row[y] = above;
        masks_.known.row[y] = 0;
      }
      arrive();
    }
  }
  /// Returns the largest difference in each channel between two points that count as equal: |a^g - b^g| is at
  /// most |a - b|^g for g up to 1. Negative: it is not known.
  F most_step() const {
    constexpr float kLeastThreshold = 0.05f; // for smaller thresholds errors of encode() would matter
    const SamplingRecord& sampling = frame_.sampling;
    if (Base::kHasAlpha || sampling.inverse_gamma > 1.0f || sampling.threshold < kLeastThreshold)
      return F(-1.0f);
    return coarse_pow<R>(F(0.3f * sampling.threshold), F(1.0f / sampling.inverse_gamma));
  }
  /// Returns true if no point of a row can differ from the point to its left or above it.
  CELLTRACE_ONE_COPY bool is_smooth(const Points& own, const Points& over, const F& step) const {
    F most(0.0f);
    for (uint32_t x = 0; x < kSampledEdge; x += R::kLanes)
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const F point = channel_from(own, axis, 1 + x);
        most = R::max(most, R::max(R::abs(point - channel_from(own, axis, x)),
                                   R::abs(point - channel_from(over, axis, 1 + x))));
      }
    return ((most <= step).bits() | ~0u << R::kLanes) == ~0u;
  }
  /// Encodes and stores the points of a row, which take_points() has taken, for comparison.
  CELLTRACE_ONE_COPY void encode_row(uint32_t line) {
    Points& encoded = scratch().encoded[line % 2];
    encode_points(scratch().points[line % 2], encoded);
    send_object(encoded, encoded_row(line));
    if (line != 0) encoded_ |= 1u << (line - 1);
  }

  /// Compares all pixels with the current colours of the pixels before them, in POV-Ray's order: from the top
  /// row down, and each row from the left. A pixel that is still to be sampled counts with its present
  /// colour.
  CELLTRACE_ONE_COPY void compare_again() {
    uint32_t over = 0, known_over = 0; // bits of the row above
    for (uint32_t y = 0; y < height_; ++y) {
      const uint32_t left = masks_.left.row[y], above = masks_.above.row[y];
      const uint32_t known = masks_.known.row[y];
      // The comparisons are repeated where a neighbour is sampled and its colour known.
      uint32_t left_known = 0, above_known = 0;
      if ((known | known_over) != 0) compare_with_means(y, left_known, above_known);
      const uint32_t differs_above = chosen(over & known_over, above_known, above);
      // A pixel whose left neighbour is sampled is compared with the neighbour's new colour.
      const uint32_t differs =
          known == 0 ? left | differs_above
                     : in_a_row(left | differs_above, chosen(known << 1, left_known, left) | differs_above);
      const uint32_t differs_left = chosen((differs & known) << 1, left_known, left);
      if (y != 0) masks_.sampled.row[y - 1] = over | differs_above;
      over = differs | differs_left >> 1;
      known_over = known;
    }
    masks_.sampled.row[height_ - 1] = over;
    cursor_ = begin_cursor();
    taken_ = cursor_;
  }

  /// Returns the bits of `a` where `which` is set, otherwise those of `b`.
  static uint32_t chosen(uint32_t which, uint32_t a, uint32_t b) { return (a & which) | (b & ~which); }
  /// Returns the bits of a row each of which depends on the previous bit: a bit is that of `after_0` or
  /// `after_1`, and the lowest bit follows a 0. A prefix computation: each step doubles the number of bits
  /// over which the dependence is composed.
  static uint32_t in_a_row(uint32_t after_0, uint32_t after_1) {
    for (uint32_t bits = 1; bits < kSampledEdge; bits *= 2) {
      const uint32_t composed = chosen(after_0 << bits, after_1, after_0);
      after_1 = chosen(after_1 << bits, after_1, after_0);
      after_0 = composed;
    }
    return after_0;
  }

  /// Finds the pixels of a row that differ from the mean of their left or upper neighbour, where this mean is
  /// known.
  CELLTRACE_ONE_COPY void compare_with_means(uint32_t y, uint32_t& left, uint32_t& above) {
    if ((encoded_ >> y & 1) == 0) {
      take_points(packets_of_row(y + 1), y + 1, scratch().points[(y + 1) % 2]);
      encode_row(y + 1);
      arrive();
    }
    const Points& own = *found_at(encoded_row(y + 1), &scratch().encoded[0]);
    MeanRow& means = scratch().means; // may be the means of the row above, if these were read for it
    if (y != 0 && masks_.known.row[y - 1] != 0) above = differing(own, 1, means, 1);
    if (masks_.known.row[y] == 0) return;
    read_means(y, means);
    left = differing(own, 1, means, 0) & row_mask();
  }
  CELLTRACE_ONE_COPY void read_means(uint32_t y, MeanRow& means) {
    const Colour* const row = found_at(encoded_colour(0, y), scratch().colours, kSampledEdge * kColourBytes);
    for (uint32_t x = 0; x < kSampledEdge; x += kSimdLanes) {
      W channels[4];
      load_colours(row + x, channels);
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        channels[axis].store(means.numbers[axis] + kSimdLanes + x);
    }
  }
  /// Loads the channels of sixteen neighbours from the store.
  static void load_colours(const Colour* colours, W (&channels)[4]) {
    for (uint32_t i = 0; i < 4; ++i)
      channels[i] = W::load(colours[4 * i].channel);
    Base::S::transpose_quads(channels[0], channels[1], channels[2], channels[3]);
  }

  // The store has colours of pixels, followed by encoded colours of pixels and encoded points.
  ea_t stored_colour(uint32_t x, uint32_t y) const {
    return store_ + (y * kSampledEdge + place_in_row(x)) * kColourBytes;
  }
  /// Returns the place of a pixel's colour in its row. The colours of four neighbours lie in four vectors,
  /// which load_colours() transposes.
  static uint32_t place_in_row(uint32_t x) { return (x & ~15u) | (x & 3) << 2 | (x >> 2 & 3); }
  ea_t encoded_colour(uint32_t x, uint32_t y) const { return stored_colour(x, kSampledEdge + y); }
  ea_t encoded_row(uint32_t y) const {
    return stored_colour(0, 2 * kSampledEdge) + y * static_cast<uint32_t>(sizeof(Points));
  }
  /// Fetches the colour of a point; x and y count from the block's first point.
  CELLTRACE_ONE_COPY void fetch_point(uint32_t x, uint32_t y, Colour& colour) {
    const uint32_t column = column_ * kSampledEdge + x;
    const uint32_t line = row_ * kSampledEdge + y;
    const ea_t packet = packet_of_points(column / kPacketEdge, line / kPacketEdge);
    const uint32_t lane = line % kPacketEdge * kPacketEdge + column % kPacketEdge;
    const SampleLanes& points = *found_at(packet, scratch().packets);
    for (uint32_t axis = 0; axis < kChannels; ++axis)
      colour.channel[axis] = points[axis].lane[lane];
  }

  /// Returns the pixels of a row that still need samples.
  uint32_t wanted(uint32_t y) const { return masks_.sampled.row[y] & ~masks_.known.row[y]; }
  CELLTRACE_ONE_COPY uint32_t wanted_of_tile(uint32_t tile) const {
    uint32_t pixels = 0;
    for (uint32_t line = 0; line < 4; ++line) {
      const uint32_t y = tile / 4 * 4 + line;
      if (y < height_) pixels |= (wanted(y) >> tile % 4 * 8 & 0xFF) << 8 * line;
    }
    return pixels;
  }
  Cursor begin_cursor() const {
    Cursor cursor;
    cursor.pixels = wanted_of_tile(0);
    return cursor;
  }
  /// Moves the cursor to the next pixel that needs samples, unless it is at such a pixel. Returns false if
  /// there is none.
  bool find_pixel(Cursor& cursor) const {
    while (cursor.pixels == 0) {
      if (cursor.tile == kTiles - 1) return false;
      cursor.pixels = wanted_of_tile(++cursor.tile);
    }
    return true;
  }

  uint32_t samples_of_pixel() const { return frame_.sampling.depth * frame_.sampling.depth; }
  CELLTRACE_ONE_COPY void find_samples_of_pixel(PixelGrid& grid) const {
    const uint32_t depth = frame_.sampling.depth;
    const float step = 1.0f / static_cast<float>(depth);
    for (uint32_t i = 0, down = 0; down < depth; ++down)
      for (uint32_t across = 0; across < depth; ++across, ++i) {
        grid.across[i] = (static_cast<float>(across) + 0.5f) * step;
        grid.down[i] = (static_cast<float>(down) + 0.5f) * step;
      }
  }
  /// Makes as many samples as there is room for. Returns false if the block is complete.
  CELLTRACE_ONE_COPY bool request_pixels() {
    for (;;) {
      const uint32_t count = request_samples();
      if (count != 0) {
        end_requests(count);
        requested_ = count;
        return true;
      }
      bool any = false;
      for (uint32_t y = 0; y < height_; ++y) {
        any = any || wanted(y) != 0;
        masks_.known.row[y] |= masks_.sampled.row[y];
      }
      if (!any) break;
      compare_again();
    }
    write_sampled();
    return false;
  }
  /// Makes samples of pixels, one pixel after another. Returns the number of samples.
  CELLTRACE_ONE_COPY uint32_t request_samples() {
    PixelGrid& grid = scratch().grid;
    find_samples_of_pixel(grid);
    float *const to_x = scratch().requested.x, *const to_y = scratch().requested.y;
    const uint32_t samples = samples_of_pixel();
    uint32_t count = 0;
    while (count < kSamples && find_pixel(cursor_)) {
      const float x = static_cast<float>(column_ * kSampledEdge + cursor_.x()) + 0.5f;
      const float y = static_cast<float>(row_ * kSampledEdge + cursor_.y()) + 0.5f;
      const uint32_t first = cursor_.sample, some = smaller_of(samples - first, kSamples - count);
      for (uint32_t i = 0; i < some; ++i) {
        to_x[count + i] = x + grid.across[first + i];
        to_y[count + i] = y + grid.down[first + i];
      }
      count += some;
      go_on(cursor_, some);
    }
    return count;
  }
  /// Advances past samples of the cursor's pixel. Returns true if the pixel's last sample was among them.
  bool go_on(Cursor& cursor, uint32_t samples) const {
    cursor.sample += samples;
    if (cursor.sample != samples_of_pixel()) return false;
    cursor.sample = 0;
    cursor.pixels &= cursor.pixels - 1;
    return true;
  }

  CELLTRACE_ONE_COPY void take_samples() {
    const uint32_t samples = samples_of_pixel();
    const float share = 1.0f / static_cast<float>(samples + 1);
    uint32_t means = 0;
    take_channels(requested_);
    for (uint32_t i = 0; i < requested_;) {
      find_pixel(taken_);
      const uint32_t x = taken_.x(), y = taken_.y();
      // The middle of the pixel counts as one more sample.
      if (taken_.sample == 0) fetch_point(x + 1, y + 1, sum_);
      const uint32_t some = smaller_of(samples - taken_.sample, requested_ - i);
      Colour sum = sum_;
      for (uint32_t sample = i; sample < i + some; ++sample)
        for (uint32_t axis = 0; axis < kChannels; ++axis)
          sum.channel[axis] += scratch().sampled[axis][sample];
      sum_ = sum;
      i += some;
      if (!go_on(taken_, some)) break;
      for (float& value : sum.channel)
        value *= share;
      store_mean(means++, x, y, sum);
      if (means < R::kLanes) continue;
      encode_means(means);
      means = 0;
    }
    if (means != 0) encode_means(means);
  }
  /// Stores the mean of a pixel.
  void store_mean(uint32_t number, uint32_t x, uint32_t y, const Colour& mean) {
    scratch().means_of[number] = mean;
    scratch().places[number] = {x, y};
    for (uint32_t axis = 0; axis < 3; ++axis)
      scratch().encoding[3 * number + axis] = mean.channel[axis];
    send_object(scratch().means_of[number], stored_colour(x, y));
  }
  /// Encodes `count` means for comparison.
  CELLTRACE_ONE_COPY void encode_means(uint32_t count) {
    arrive();
    for (uint32_t i = 3 * count; i < 3 * R::kLanes; ++i)
      scratch().encoding[i] = 0.0f;
    encode(scratch().encoding, 3 * R::kLanes, scratch().encoding);
    for (uint32_t number = 0; number < count; ++number) {
      Colour& mean = scratch().means_of[number];
      for (uint32_t axis = 0; axis < 3; ++axis)
        mean.channel[axis] = scratch().encoding[3 * number + axis];
      const Place place = scratch().places[number];
      send_object(mean, encoded_colour(place.x, place.y));
    }
    arrive();
  }

  /// Writes sampled pixels over the grid points in the picture.
  CELLTRACE_ONE_COPY void write_sampled() {
    for (uint32_t y = 0; y < height_; ++y) {
      const uint32_t sampled = masks_.sampled.row[y];
      if (sampled == 0) continue;
      const Colour* const colours =
          found_at(stored_colour(0, y), scratch().colours, kSampledEdge * kColourBytes);
      for (uint32_t x = 0; x < kSampledEdge; x += kSimdLanes) {
        W channels[4];
        load_colours(colours + x, channels);
        // The other pixels have no colour.
        const auto take = Base::S::M::from_bits(sampled >> x & 0xFFFF);
        for (uint32_t axis = 0; axis < 3; ++axis)
          Base::S::select(take, channels[axis], W(0.0f)).store(scratch().channels[axis] + x);
      }
      encode_pixels_of(scratch().channels, scratch().words);
      const ea_t row = frame_.surface + (first_line() + y + 1) * frame_.surface_pitch +
                       (column_ * kSampledEdge + 1) * static_cast<uint32_t>(sizeof(uint32_t));
      for_each_lane(sampled, [&](uint32_t x) {
        // A transfer needs the word at the same place in its quadword on both sides.
        uint32_t& word = scratch().leaving[x][(x + 1) % 4];
        word = scratch().words[x];
        send_object(word, row + x * static_cast<uint32_t>(sizeof(uint32_t)));
        if (wants_colours()) put_colours(colours + place_in_row(x), 1, x + 1, y + 1);
      });
      arrive();
    }
  }

  Masks& masks_;
  Cursor cursor_, taken_; ///< next sample to make, and to take
  Colour sum_ = {};       ///< sum of the samples of a pixel so far
  uint32_t encoded_ = 0;  ///< rows of pixels whose encoded points are in the store
};

} // namespace celltrace::kernel

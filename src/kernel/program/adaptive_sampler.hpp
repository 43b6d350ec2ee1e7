// Antialiasing by the adaptive method: pixels whose corners differ are divided into squares, again and again
// while their corners differ (after Whitted 1980). Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/program/pixel_sampler.hpp"
#include "records/frame.hpp"
#include "records/sampling.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kChannels>
class AdaptiveSampler : public PixelSampler<Spu, SamplingMethod::adaptive, kChannels> {
  using Base = PixelSampler<Spu, SamplingMethod::adaptive, kChannels>;
  using Base::arrive, Base::request, Base::requested_, Base::channel_from, Base::column_, Base::differing,
      Base::encode, Base::encode_pixels_of, Base::encode_points, Base::end_requests, Base::fetch,
      Base::first_line, Base::frame_, Base::gather_colours, Base::go_to_block, Base::height_, Base::kEdge,
      Base::kHasAlpha, Base::packets_of_row, Base::points_from, Base::put_colours, Base::row_, Base::row_mask,
      Base::scratch_, Base::send, Base::smaller_of, Base::store_, Base::take_channels, Base::take_points,
      Base::takes_points, Base::in_progress_, Base::wants_colours, Base::width_;
  using typename Base::F, typename Base::Points, typename Base::R;

  using Square = SampleSquare<kChannels>;
  static constexpr uint32_t kSquares = squares_at_once(kEdge);
  static constexpr uint32_t kRows = sampled_rows(kEdge);

  /// Size of the nine points of a divided square, in whole vectors.
  static constexpr uint32_t kEncoded = (9 * kChannels + kSimdLanes - 1) / kSimdLanes * kSimdLanes;
  struct Scratch : Base::Scratch {
    Square squares[kSquares]; ///< squares that are being divided
    alignas(64) float encoding[kEncoded];
  };

  Scratch& scratch() const { return static_cast<Scratch&>(scratch_); }

public:
  static constexpr uint32_t kScratchBytes = sizeof(Scratch);

  /// Allocates memory; see FixedSampler.
  AdaptiveSampler(Spu& spu, const FrameBlock& frame, SampleBundle<Spu>& samples, uint8_t* scratch)
      : Base(spu, frame, samples, *reinterpret_cast<Scratch*>(scratch)),
        sums_(*spu.template allocate<Sums>()) {}

  /// Takes colours and makes samples; see FixedSampler::advance().
  CELLTRACE_ONE_COPY bool advance(uint32_t column, uint32_t row) {
    if (takes_points(column, row)) return false;
    if (in_progress_)
      divide_squares();
    else
      begin_block(column, row);
    in_progress_ = request_squares();
    return in_progress_;
  }

private:
  /// Sums of the colours of pixels, by row and channel.
  struct alignas(128) Sums {
    alignas(64) float row[kRows][kChannels][kSampledEdge];
  };

  CELLTRACE_ONE_COPY void begin_block(uint32_t column, uint32_t row) {
    go_to_block(column, row);
    next_row_ = 0;
    rows_ = 0;
    waiting_ = 0;
  }

  ea_t stored_square(uint32_t number) const {
    return store_ + number * static_cast<uint32_t>(sizeof(Square));
  }

  /// Makes the samples of as many squares as there is room for, the last ones first. Returns false if the
  /// block is complete.
  CELLTRACE_ONE_COPY bool request_squares() {
    while (waiting_ == 0) {
      if (rows_ != 0) write_rows();
      if (next_row_ == height_) return false;
      compare_corners();
    }
    requested_ = smaller_of(waiting_, kSquares);
    waiting_ -= requested_;
    fetch_squares();
    for (uint32_t i = 0; i < requested_; ++i) {
      const Square& square = scratch().squares[i];
      const float size = edge_of(square), half = 0.5f * size;
      const uint32_t first = i * kSamplesOfSquare;
      request(first, square.x + half, square.y);
      request(first + 1, square.x, square.y + half);
      request(first + 2, square.x + half, square.y + half);
      request(first + 3, square.x + size, square.y + half);
      request(first + 4, square.x + half, square.y + size);
    }
    end_requests(requested_ * kSamplesOfSquare);
    return true;
  }
  /// Fetches the squares that are being divided, which follow the waiting ones.
  void fetch_squares() {
    fetch(scratch().squares, stored_square(waiting_), requested_ * static_cast<uint32_t>(sizeof(Square)));
  }
  static float edge_of(const Square& square) { return 1.0f / static_cast<float>(1u << square.level); }

  /// Compares the corners of the pixels in the next rows: pixels with equal corners are complete, the squares
  /// of other pixels wait.
  CELLTRACE_ONE_COPY void compare_corners() {
    first_row_ = next_row_;
    rows_ = smaller_of(height_ - next_row_, kRows);
    next_row_ += rows_;
    const SampleLanes* packets = packets_of_row(first_row_);
    take_points(packets, first_row_, scratch().points[0]);
    encode_points(scratch().points[0], scratch().encoded[0]);
    for (uint32_t y = 0; y < rows_; ++y) {
      const uint32_t upper = y % 2, lower = 1 - upper, row = first_row_ + y + 1;
      if (row % kPacketEdge == 0) packets = packets_of_row(row);
      take_points(packets, row, scratch().points[lower]);
      encode_points(scratch().points[lower], scratch().encoded[lower]);
      uint32_t divided =
          frame_.sampling.depth > 1
              ? differing_corners(scratch().encoded[upper], scratch().encoded[lower]) & row_mask()
              : 0;
      sum_corners(scratch().points[upper], scratch().points[lower], divided, sums_.row[y]);
      for_each_lane(divided, [&](uint32_t x) { divide_pixel(x, y, upper); });
    }
  }
  uint32_t differing_corners(const Points& upper, const Points& lower) const {
    return differing(upper, 0, upper, 1) | differing(upper, 0, lower, 0) | differing(upper, 0, lower, 1) |
           differing(upper, 1, lower, 0) | differing(upper, 1, lower, 1) | differing(lower, 0, lower, 1);
  }
  /// Stores the means of the corners of pixels, or 0 for divided pixels.
  static void sum_corners(const Points& upper, const Points& lower, uint32_t divided,
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
        F transparency(0.0f);
        for (uint32_t corner = 0; corner < 4; ++corner)
          transparency = transparency + channel_from(corner < 2 ? upper : lower, 3, x + corner % 2);
        R::select(R::M::from_bits(divided >> x & ((1u << R::kLanes) - 1)), F(0.0f), transparency * F(0.25f))
            .store(sums[3] + x);
      }
    }
  }
  void divide_pixel(uint32_t x, uint32_t y, uint32_t upper) {
    Square& square = scratch().squares[0];
    for (uint32_t corner = 0; corner < 4; ++corner)
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        square.corner[corner][axis] =
            scratch().points[corner < 2 ? upper : 1 - upper].channel(axis)[x + corner % 2];
    square.x = static_cast<float>(column_ * kSampledEdge + x);
    square.y = static_cast<float>(row_ * kSampledEdge + first_row_ + y);
    square.pixel = y * kSampledEdge + x;
    square.level = 0;
    push(square);
  }
  /// Stores a waiting square; `square` lies in local store.
  CELLTRACE_ONE_COPY void push(const Square& square) {
    send(&square, stored_square(waiting_++), sizeof square);
    arrive();
  }

  /// Divides each square with samples in four: squares with equal corners are complete, other squares wait.
  CELLTRACE_ONE_COPY void divide_squares() {
    fetch_squares();
    take_channels(requested_ * kSamplesOfSquare);
    for (uint32_t i = 0; i < requested_; ++i)
      divide(scratch().squares[i], i * kSamplesOfSquare);
  }
  CELLTRACE_ONE_COPY void divide(Square& square, uint32_t first) {
    // Nine points, row by row: corners are known, the points between them are samples.
    float points[9][kChannels];
    for (uint32_t axis = 0; axis < kChannels; ++axis)
      for (uint32_t i = 0; i < 9; ++i)
        points[i][axis] = i % 2 == 0 && i != 4 ? square.corner[i / 6 * 2 + i % 3 / 2][axis]
                                               : scratch().sampled[axis][first + i / 2 + (i > 4 ? 1 : 0)];
    float* const encoded = scratch().encoding;
    __builtin_memcpy(encoded, points, sizeof points);
    for (uint32_t i = 9 * kChannels; i < kEncoded; ++i)
      encoded[i] = 0.0f;
    encode(encoded, kEncoded, encoded);
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
      float(*const sums)[kSampledEdge] = sums_.row[pixel / kSampledEdge];
      for (uint32_t axis = 0; axis < kChannels; ++axis)
        sums[axis][pixel % kSampledEdge] += share * (points[corners[0]][axis] + points[corners[1]][axis] +
                                                     points[corners[2]][axis] + points[corners[3]][axis]);
    }
  }
  /// Returns the difference of two colours.
  CELLTRACE_ONE_COPY static float distance(const float* a, const float* b) {
    const float sum = magnitude(a[0] - b[0]) + magnitude(a[1] - b[1]) + magnitude(a[2] - b[2]);
    if constexpr (kHasAlpha)
      return sum + magnitude(a[3] - b[3]);
    else
      return sum;
  }
  bool differ(const float* encoded, const uint32_t (&corners)[4]) const {
    for (uint32_t i = 1; i < 4; ++i)
      for (uint32_t j = 0; j < i; ++j)
        if (distance(encoded + kChannels * corners[i], encoded + kChannels * corners[j]) >=
            frame_.sampling.threshold)
          return true;
    return false;
  }

  /// Writes finished pixels over the grid points in the picture.
  CELLTRACE_ONE_COPY void write_rows() {
    for (uint32_t y = 0; y < rows_; ++y) {
      encode_pixels_of(sums_.row[y], scratch().words);
      const ea_t to = frame_.surface + (first_line() + first_row_ + y) * frame_.surface_pitch +
                      column_ * kSampledEdge * static_cast<uint32_t>(sizeof(uint32_t));
      send(scratch().words, to, (width_ + 3) / 4 * 16);
      if (wants_colours()) {
        gather_colours(sums_.row[y][0], kSampledEdge, width_);
        put_colours(scratch_.colours, width_, 0, first_row_ + y);
      }
      arrive();
    }
    rows_ = 0;
  }

  Sums& sums_;
  uint32_t first_row_ = 0, rows_ = 0; ///< rows that are being summed up
  uint32_t next_row_ = 0;
  uint32_t waiting_ = 0; ///< number of waiting squares in the store
};

} // namespace celltrace::kernel

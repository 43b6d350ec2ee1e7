// The SPE's graphical subsystem: encodes colours as pixels, which leave by double-buffered DMA. Kernel
// dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "celltrace/spe/types.hpp"
#include "kernel/math.hpp"
#include "kernel/modules.hpp"
#include "kernel/packet.hpp"
#include "kernel/program/block_encoder.hpp"
#include "records/frame.hpp"

namespace celltrace::kernel {

/// Returns the sRGB encoding (IEC 61966-2-1) of linear values in [0, 1]; absolute error below 1e-6. The power
/// 1 / 2.4 is the fourth root to the power 5 / 3, which a polynomial approximates (interpolated at
/// Chebyshev's points).
template <class S> typename S::F encode_srgb(const typename S::F& linear) {
  using F = typename S::F;
  const F root = S::sqrt(S::sqrt(linear));
  const F power =
      F(-0.0585816804f) +
      root * (F(0.1255060825f) +
              root * (F(1.4502420989f) +
                      root * (F(-1.1208492925f) +
                              root * (F(1.1465150163f) +
                                      root * (F(-0.8337865229f) +
                                              root * (F(0.3589463740f) + root * F(-0.0679922621f)))))));
  return S::select(linear <= F(0.0031308f), linear * F(12.92f), power);
}

namespace detail {

/// Quantises a channel to 0..255 without branches.
template <class S>
[[gnu::always_inline]] inline typename S::I quantise(const FrameBlock& frame, const typename S::F& value) {
  using F = typename S::F;
  const auto round_up = [](const F& unit) { return S::to_int(S::min(unit, F(1.0f)) * F(255.0f) + F(0.5f)); };
  const F clipped = S::min(S::max(value, F(0.0f)), F(1.0f));
  if (static_cast<GammaEncoding>(frame.gamma_encoding) == GammaEncoding::none) return round_up(clipped);
  const F linear = frame.assumed_gamma == 1.0f ? clipped : pow<S>(clipped, F(frame.assumed_gamma));
  return round_up(encode_srgb<S>(linear));
}
/// Packs channels as bytes R, G, B, A in the order of memory.
template <class S>
typename S::I pack(const typename S::I& r, const typename S::I& g, const typename S::I& b) {
  using I = typename S::I;
  const I opaque = I::splat(0xFF);
  if constexpr (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
    return S::template shift_left<24>(r) | S::template shift_left<16>(g) | S::template shift_left<8>(b) |
           opaque;
  else
    return r | S::template shift_left<8>(g) | S::template shift_left<16>(b) |
           S::template shift_left<24>(opaque);
}

} // namespace detail

/// Returns the pixels of sixteen colours.
template <class Spu>
[[gnu::always_inline]] inline typename Spu::simd::I encode_pixels(const FrameBlock& frame,
                                                                  const V3<typename Spu::simd>& colour) {
  using S = typename Spu::simd;
  const auto channel = [&](const typename S::F& value) {
    return Strategy<Spu>::template quantise<S>(frame, value);
  };
  return detail::pack<S>(channel(colour.x), channel(colour.y), channel(colour.z));
}

/// Writes `kRows` rows of packets at once, as pixels or as blocks of BC1. All packets in the picture of a
/// block of kRows x kRows have to be put before packets of another block, and before flush().
template <class Spu, uint32_t kRows = 1> class PixelWriter {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  PixelWriter(Spu& spu, const FrameBlock& frame)
      : spu_(spu), frame_(frame), runs_(spu.template allocate<Run>(2)) {}

  /// Encodes sixteen colours, which leave together with the colours of the next packets in the row. `column`
  /// and `row` count packets.
  void put(uint32_t column, uint32_t row, const V3<S>& colour) {
    const uint32_t below = row % kRows; // row in its block
    Run& run = run_for(column, row - below);
    const uint32_t x = column - column_;
    WordLanes pixels;
    encode(colour).store(reinterpret_cast<int32_t*>(pixels.lane));
    for (uint32_t y = 0; y < kPacketEdge; ++y)
      U4::load(pixels.lane + y * kPacketEdge).store(run.pixels[below * kPacketEdge + y] + x * kPacketEdge);
    if (x == columns_) ++columns_;
  }

  /// Puts one colour for all packets of the block whose first packet is at (column, row).
  void fill(uint32_t column, uint32_t row, const V3<S>& colour) {
    static_assert(kRows * kPacketEdge == kSimdLanes, "a row of the block is one vector");
    Run& run = run_for(column, row);
    const uint32_t x = column - column_;
    const I pixels = encode(colour);
    for (uint32_t y = 0; y < kRows * kPacketEdge; ++y)
      pixels.store(reinterpret_cast<int32_t*>(run.pixels[y] + x * kPacketEdge));
    columns_ = x + kRows;
  }

  /// Drops the block at (column, row) if packets were put to it last.
  void drop(uint32_t column, uint32_t row) {
    if (row == row_ && column - column_ < columns_) columns_ = column - column_;
  }

  void reset_counters() {
    bytes_ = 0;
    error_ = 0;
  }
  /// Return the number of bytes sent since reset_counters(), and the sum of the blocks' errors.
  uint32_t bytes() const { return bytes_; }
  uint64_t error() const { return error_; }

  /// Waits until all pixels are in main memory.
  void flush() {
    send();
    spu_.wait_all(3u << kFirstTag);
  }

private:
  using U4 = typename S::U4;

  static constexpr uint32_t kFirstTag = 2;
  static constexpr uint32_t kPacketRowBytes = kPacketEdge * 4;
  static constexpr uint32_t kBlockBytes = sizeof(EncodedBlock::bytes);
  /// Number of packets whose rows fill a line of main memory, which is transferred at once.
  static constexpr uint32_t kRunPackets = kLineBytes / kPacketRowBytes;

  /// Neighbouring packets of a row.
  struct alignas(128) Run {
    uint32_t pixels[kRows * kPacketEdge][kRunPackets * kPacketEdge];
    ListElement list[kRows * kPacketEdge];
  };

  /// Returns the run for a packet in a column, in the block that begins at `row`.
  Run& run_for(uint32_t column, uint32_t row) {
    if (columns_ != 0 &&
        (row != row_ || column < column_ || column > column_ + columns_ || column - column_ >= kRunPackets))
      send();
    if (columns_ == 0) {
      spu_.wait_all(1u << (kFirstTag + current_));
      column_ = column;
      row_ = row;
      if (!has_blocks())
        Strategy<Spu>::claim_lines(corner_of_run(), kRows * kPacketEdge, frame_.surface_pitch);
    }
    return runs_[current_];
  }

  ea_t corner_of_run() const {
    return frame_.surface + (row_ - frame_.surface_row) * kPacketEdge * frame_.surface_pitch +
           column_ * kPacketRowBytes;
  }

  // Sends the current run. Not inlined, as local store is short.
  CELLTRACE_ONE_COPY void send() {
    if (columns_ == 0) return;
    if (has_blocks()) {
      spu_.enter_module(modules::kEncoding);
      send_blocks();
    } else {
      send_pixels();
    }
    columns_ = 0;
    current_ ^= 1;
  }
  /// Returns the number of rows of packets in a run.
  uint32_t rows_of_run() const {
    const uint32_t left = frame_.packet_rows - row_;
    return left < kRows ? left : kRows;
  }
  [[gnu::always_inline]] void send_pixels() {
    Run& run = runs_[current_];
    const uint32_t rows = rows_of_run() * kPacketEdge;
    const uint32_t bytes = columns_ * kPacketRowBytes;
    const ea_t corner = corner_of_run();
    for (uint32_t y = 0; y < rows; ++y)
      run.list[y] = ListElement::make(bytes, corner + y * frame_.surface_pitch);
    if (columns_ == kRunPackets) {
      spu_.putl(run.pixels[0], corner, run.list, rows, kFirstTag + current_);
    } else {
      // Elements of a list follow each other in local store; elements of an unfinished run do not.
      for (uint32_t y = 0; y < rows; ++y)
        spu_.put(run.pixels[y], corner + y * frame_.surface_pitch, bytes, kFirstTag + current_);
    }
    bytes_ += bytes * rows;
  }

  bool has_blocks() const { return static_cast<FramePurpose>(frame_.purpose) == FramePurpose::blocks; }

  /// Sends blocks, which overwrite pixels that have been encoded.
  CELLTRACE_ONE_COPY void send_blocks() {
    spu_.run_in_module(modules::kEncoding);
    Run& run = runs_[current_];
    const uint32_t rows = rows_of_run();
    // The size is in whole quadwords: a row of packets may end with half of one.
    const uint32_t bytes = (columns_ + 1) / 2 * 2 * kBlockBytes;
    for (uint32_t y = 0; y < rows; ++y) {
      auto* const out = reinterpret_cast<uint8_t*>(run.pixels[y * kPacketEdge]);
      for (uint32_t x = 0; x < columns_; ++x) {
        WordLanes pixels;
        for (uint32_t line = 0; line < kPacketEdge; ++line)
          U4::load(run.pixels[y * kPacketEdge + line] + x * kPacketEdge)
              .store(pixels.lane + line * kPacketEdge);
        const uint32_t lanes = extend_pixels((column_ + x) * kPacketEdge, (row_ + y) * kPacketEdge,
                                             frame_.width, frame_.height, pixels);
        EncodedBlock block;
        encode_block<S>(pixels, lanes, block);
        __builtin_memcpy(out + x * kBlockBytes, block.bytes, kBlockBytes);
        error_ += block.error;
      }
      spu_.put(out, frame_.surface + (row_ + y) * frame_.surface_pitch + column_ * kBlockBytes, bytes,
               kFirstTag + current_);
    }
    bytes_ += bytes * rows;
  }

  [[gnu::always_inline]] I encode(const V3<S>& colour) const { return encode_pixels<Spu>(frame_, colour); }

  Spu& spu_;
  const FrameBlock& frame_;
  Run* runs_;
  uint32_t current_ = 0;          ///< index of the run that is being filled
  uint32_t columns_ = 0;          ///< number of columns of packets in the current run
  uint32_t column_ = 0, row_ = 0; ///< position of the first packet of the run
  uint32_t bytes_ = 0;
  uint64_t error_ = 0;
};

} // namespace celltrace::kernel

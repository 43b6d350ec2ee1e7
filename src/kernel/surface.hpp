// The SPE's graphical subsystem: colours become pixels and leave as 4x4 blocks through double-buffered DMA.
// Kernel dialect.
#pragma once

#include "celltrace/spe/types.hpp"
#include "kernel/math.hpp"
#include "kernel/packet.hpp"

namespace celltrace::kernel {

/// sRGB encoding (IEC 61966-2-1) of linear values in [0, 1].
template <class S> typename S::F encode_srgb(const typename S::F& linear) {
  using F = typename S::F;
  const F line = linear * F(12.92f);
  const auto dark = linear <= F(0.0031308f);
  if (dark.bits() == (1u << kSimdLanes) - 1) return line;
  const F power = F(1.055f) * pow<S>(linear, F(1.0f / 2.4f)) - F(0.055f);
  return S::select(dark, line, power);
}

template <class Spu> class PixelWriter {
public:
  using S = typename Spu::simd;
  using F = typename S::F;
  using I = typename S::I;

  PixelWriter(Spu& spu, const FrameBlock& frame)
      : spu_(spu), frame_(frame), blocks_(spu.template allocate<Block>(2)) {}

  /// Encodes sixteen colours and starts their way to the surface. `column` and `row` count packets.
  void put(uint32_t column, uint32_t row, const V3<S>& colour) {
    Block& block = blocks_[current_];
    const uint32_t tag = kFirstTag + current_;
    spu_.wait_all(1u << tag);
    pack(quantise(colour.x), quantise(colour.y), quantise(colour.z))
        .store(reinterpret_cast<int32_t*>(block.pixels.lane));
    const ea_t corner = frame_.surface + row * kPacketEdge * frame_.surface_pitch + column * kRowBytes;
    for (uint32_t y = 0; y < kPacketEdge; ++y)
      block.list[y] = ListElement::make(kRowBytes, corner + y * frame_.surface_pitch);
    spu_.putl(block.pixels.lane, corner, block.list, kPacketEdge, tag);
    current_ ^= 1;
  }

  /// Waits until all pixels have arrived.
  void flush() { spu_.wait_all(3u << kFirstTag); }

private:
  static constexpr uint32_t kFirstTag = 2;
  static constexpr uint32_t kRowBytes = kPacketEdge * 4;

  struct alignas(128) Block {
    WordLanes pixels;
    ListElement list[kPacketEdge];
  };

  /// Normalises to 0..255 without branches.
  I quantise(const F& value) const {
    const F clipped = S::min(S::max(value, F(0.0f)), F(1.0f));
    if (static_cast<GammaEncoding>(frame_.gamma_encoding) == GammaEncoding::none) return round_up(clipped);
    const F linear = frame_.assumed_gamma == 1.0f ? clipped : pow<S>(clipped, F(frame_.assumed_gamma));
    return round_up(encode_srgb<S>(linear));
  }
  static I round_up(const F& unit) { return S::to_int(S::min(unit, F(1.0f)) * F(255.0f) + F(0.5f)); }

  /// Bytes R, G, B, A in the order of memory.
  static I pack(const I& r, const I& g, const I& b) {
    const I opaque = I::splat(0xFF);
    if constexpr (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__)
      return S::template shift_left<24>(r) | S::template shift_left<16>(g) | S::template shift_left<8>(b) |
             opaque;
    else
      return r | S::template shift_left<8>(g) | S::template shift_left<16>(b) |
             S::template shift_left<24>(opaque);
  }

  Spu& spu_;
  const FrameBlock& frame_;
  Block* blocks_;
  uint32_t current_ = 0;
};

} // namespace celltrace::kernel

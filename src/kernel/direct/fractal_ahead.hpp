// Values of a fractal at the hits of a bundle's rays, computed before they are needed. Kernel dialect, for
// direct memory.
//
// Near the edge of the Mandelbrot set one point takes ten rounds and its neighbour ten thousand. Packet by
// packet, all lanes would wait for the last one, and each round for the previous one. Here lanes that have
// ended are filled with points of other packets, and two vectors are iterated at a time. A WavefrontQueue
// cannot refill single lanes: its body ends for all lanes of a packet.
#pragma once

#include "celltrace/spe/simd.hpp"
#include "kernel/math.hpp"
#include "kernel/packet.hpp"
#include "kernel/textures/iterated_squares.hpp"
#include "kernel/tuning.hpp"

namespace celltrace::kernel {

/// Values of one pattern at points of `kPackets` packets.
template <class S, uint32_t kPackets> class FractalValues {
public:
  using F = typename S::F;
  using I = typename S::I;
  using M = typename S::M;

  /// Adds the rounds of a packet that has been iterated separately.
  void count(uint32_t rounds) { rounds_ += rounds; }
  /// Forgets all values. Returns true if the values of the next packets should be found together, because the
  /// last packets' values took long.
  bool begin() {
    const bool takes_long = rounds_ >= tuning::kLeastRoundsOfFractals;
    rounds_ = 0;
    pattern_ = nullptr;
    return takes_long;
  }

  static bool takes(const PatternRecord& r) {
    if (!SquareIteration::describes(r)) return false;
    const SquareIteration iteration{r};
    return !iteration.wants_least() && iteration.most() > kFirstRounds;
  }
  /// Adds points of some lanes of a packet, in the space of a pattern for which takes() is true. Points of
  /// another pattern than the first one are ignored, and have to be evaluated separately. Points that escape
  /// soon get their values at once.
  void add(uint32_t packet, const PatternRecord& r, uint32_t lanes, const Complex<S>& at) {
    if (pattern_ == nullptr) begin_pattern(r);
    lanes &= ~known_[packet];
    if (pattern_ != &r || lanes == 0) return;
    const SquareIteration iteration{r};
    const Complex<S> c = iteration.constant<S>(at);
    const M inside = iteration.is_julia() ? M::none() : surely_bounded<S>(c);
    IteratedSquares<S, false> squares(at);
    uint32_t pending = lanes & ~inside.bits();
    for (uint32_t i = 0; i < kFirstRounds && pending != 0; i += kRounds) {
      for (uint32_t round = 0; round < kRounds; ++round)
        squares.iterate(c);
      pending &= squares.bounded.bits();
    }
    known_[packet] |= lanes;
    Packet& to = packets_[packet];
    const auto put = [&](FloatLanes& field, const F& value) {
      S::select(M::from_bits(lanes), value, F::load(field.lane)).store(field.lane);
    };
    put(to.x, at.a);
    put(to.y, at.b);
    put(to.value, S::select(inside, F(iteration.inner()), iteration.outer<S>(squares.rounds)));
    if (pending == 0) return;
    FloatLanes a, b, c_a, c_b;
    squares.z.a.store(a.lane);
    squares.z.b.store(b.lane);
    c.a.store(c_a.lane);
    c.b.store(c_b.lane);
    for_each_lane(pending, [&](uint32_t lane) {
      points_[count_++] = {a.lane[lane], b.lane[lane], c_a.lane[lane], c_b.lane[lane],
                           packet * kSimdLanes + lane};
    });
  }
  /// Finds the values of the points that have been added.
  [[gnu::noinline]] void run() {
    if (pattern_ == nullptr) return;
    if (count_ > kSimdLanes) rounds_ = tuning::kLeastRoundsOfFractals; // as a guess for the next packets
    const SquareIteration iteration{*pattern_};
    const F most(static_cast<float>(iteration.most())), inner(iteration.inner());
    Stream streams[kStreams];
    uint32_t next = 0;
    for (Stream& stream : streams)
      for (uint32_t lane = 0; lane < kSimdLanes; ++lane)
        fill(stream, lane, next);
    while ((streams[0].busy | streams[1].busy) != 0) {
      IteratedSquares<S, false> squares[kStreams] = {streams[0].squares(), streams[1].squares()};
      const Complex<S> c[kStreams] = {load(streams[0].c), load(streams[1].c)};
      Complex<S> kept[kStreams] = {load(streams[0].kept), load(streams[1].kept)};
      uint32_t ended[kStreams];
      do {
        for (uint32_t round = 0; round < kRounds; ++round)
          for (uint32_t k = 0; k < kStreams; ++k)
            squares[k].iterate(c[k]);
        for (uint32_t k = 0; k < kStreams; ++k) {
          const F rounds = squares[k].rounds;
          const M iterating = squares[k].bounded & (rounds < most) & !squares[k].is_at(kept[k]);
          ended[k] = streams[k].busy & ~iterating.bits();
          // Detects cycles (Brent): the number of each round is compared with a kept number, which is
          // replaced whenever the count of rounds is a power of 2.
          const I whole = S::to_int(rounds);
          const M keeps = (whole & (whole - I::splat(1))) == I::splat(0);
          kept[k] = {S::select(keeps, squares[k].z.a, kept[k].a),
                     S::select(keeps, squares[k].z.b, kept[k].b)};
        }
      } while ((ended[0] | ended[1]) == 0);
      for (uint32_t k = 0; k < kStreams; ++k) {
        streams[k].keep(squares[k], kept[k]);
        FloatLanes values;
        S::select(squares[k].bounded | (squares[k].rounds >= most), inner,
                  iteration.outer<S>(squares[k].rounds))
            .store(values.lane);
        for_each_lane(ended[k], [&](uint32_t lane) {
          const uint32_t place = streams[k].place[lane];
          packets_[place / kSimdLanes].value.lane[place % kSimdLanes] = values.lane[lane];
          fill(streams[k], lane, next);
        });
      }
    }
  }

  /// Selects the packet whose points are evaluated from now on.
  void show(uint32_t packet) { shown_ = packet; }
  /// Returns the lanes of points whose values are known, and sets `value` there.
  M find(const PatternRecord& r, const Complex<S>& at, F& value) const {
    if (pattern_ != &r) return M::none();
    const Packet& packet = packets_[shown_];
    const M found =
        M::from_bits(known_[shown_]) & (at.a == F::load(packet.x.lane)) & (at.b == F::load(packet.y.lane));
    value = S::select(found, F::load(packet.value.lane), value);
    return found;
  }

private:
  /// Rounds between two checks for ended lanes; and rounds of a packet by itself before lanes are filled
  /// again.
  static constexpr uint32_t kRounds = 8, kFirstRounds = 4 * kRounds;
  /// Number of vectors that are iterated together: a round of one vector takes half as long as the latency of
  /// its result.
  static constexpr uint32_t kStreams = 2;

  struct ComplexLanes {
    FloatLanes a, b;
  };
  static Complex<S> load(const ComplexLanes& z) { return {F::load(z.a.lane), F::load(z.b.lane)}; }
  /// Points that are being iterated.
  struct Stream {
    ComplexLanes z, c, kept;
    FloatLanes rounds;
    uint32_t place[kSimdLanes];
    uint32_t busy = 0; ///< lanes with a point

    IteratedSquares<S, false> squares() const {
      IteratedSquares<S, false> all(load(z));
      all.rounds = F::load(rounds.lane);
      return all;
    }
    void keep(const IteratedSquares<S, false>& all, const Complex<S>& back) {
      all.z.a.store(z.a.lane);
      all.z.b.store(z.b.lane);
      all.rounds.store(rounds.lane);
      back.a.store(kept.a.lane);
      back.b.store(kept.b.lane);
    }
  };
  /// A point that waits to be iterated.
  struct Point {
    float a, b, c_a, c_b;
    uint32_t place; ///< packet and lane
  };
  struct Packet {
    FloatLanes x, y, value;
  };

  void begin_pattern(const PatternRecord& r) {
    for (uint32_t& known : known_)
      known = 0;
    count_ = 0;
    pattern_ = &r;
  }
  /// Gives a lane the next point, or none.
  void fill(Stream& stream, uint32_t lane, uint32_t& next) {
    const bool is_busy = next < count_;
    const Point point = is_busy ? points_[next++] : Point{0, 0, 0, 0, 0};
    stream.z.a.lane[lane] = point.a;
    stream.z.b.lane[lane] = point.b;
    stream.c.a.lane[lane] = point.c_a;
    stream.c.b.lane[lane] = point.c_b;
    stream.kept.a.lane[lane] = stream.kept.b.lane[lane] = 1e30f;
    stream.rounds.lane[lane] = static_cast<float>(kFirstRounds);
    stream.place[lane] = point.place;
    stream.busy = (stream.busy & ~(1u << lane)) | (is_busy ? 1u << lane : 0);
  }

  uint32_t rounds_ = 0;
  const PatternRecord* pattern_ = nullptr; ///< pattern of the known values; null: there are none
  uint32_t known_[kPackets];               ///< index: packet; lanes with known values
  uint32_t shown_ = 0;
  uint32_t count_ = 0;
  Packet packets_[kPackets];
  Point points_[kPackets * kSimdLanes];
};

} // namespace celltrace::kernel

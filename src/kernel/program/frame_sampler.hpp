// The sampler for frames: by either method, with or without alpha. Kernel dialect.
#pragma once

#include "kernel/program/adaptive_sampler.hpp"
#include "kernel/program/fixed_sampler.hpp"

#include <new>
#include <type_traits>

namespace celltrace::kernel {

/// One of the four samplers, which stays the same for its lifetime.
template <class Spu> class FrameSampler {
public:
  FrameSampler(Spu& spu, const FrameBlock& frame, SampleBundle<Spu>& samples, uint8_t* scratch)
      : spu_(spu), kind_(kind_of(frame)) {
    visit([&](auto& sampler) {
      using Sampler = Of<decltype(sampler)>;
      new (static_cast<void*>(&sampler)) Sampler(spu, frame, samples, scratch);
    });
  }

  /// Returns true if this is the sampler for frames like `frame`.
  bool serves(const FrameBlock& frame) const { return kind_ == kind_of(frame); }

  /// Begins a frame; see PixelSampler.
  [[gnu::always_inline]] void begin_frame() {
    visit([](auto& sampler) { sampler.begin_frame(); });
  }
  /// Takes colours and makes samples; see FixedSampler::advance().
  bool advance(uint32_t column, uint32_t row) {
    bool more = false;
    visit([&](auto& sampler) {
      spu_.enter_module(Of<decltype(sampler)>::module());
      more = sampler.advance(column, row);
    });
    return more;
  }

  /// Scratch memory of the samplers with alpha, which need most.
  static constexpr uint32_t kScratchBytes =
      FixedSampler<Spu, 4>::kScratchBytes > AdaptiveSampler<Spu, 4>::kScratchBytes
          ? FixedSampler<Spu, 4>::kScratchBytes
          : AdaptiveSampler<Spu, 4>::kScratchBytes;

private:
  static uint32_t kind_of(const FrameBlock& frame) {
    const bool adaptive = static_cast<SamplingMethod>(frame.sampling.method) == SamplingMethod::adaptive;
    return static_cast<uint32_t>(adaptive) + 2u * static_cast<uint32_t>(wants_alpha(frame));
  }

  template <class Reference> using Of = std::remove_reference_t<Reference>;

  template <class Visit> [[gnu::always_inline]] void visit(const Visit& visit) {
    switch (kind_) {
    case 0:
      return visit(any_.fixed);
    case 1:
      return visit(any_.adaptive);
    case 2:
      return visit(any_.fixed_alpha);
    default:
      return visit(any_.adaptive_alpha);
    }
  }

  union Any {
    Any() {}
    FixedSampler<Spu, 3> fixed;
    AdaptiveSampler<Spu, 3> adaptive;
    FixedSampler<Spu, 4> fixed_alpha;
    AdaptiveSampler<Spu, 4> adaptive_alpha;
  };

  Spu& spu_;
  uint32_t kind_;
  Any any_;
};

} // namespace celltrace::kernel

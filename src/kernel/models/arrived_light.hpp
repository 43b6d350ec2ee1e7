// The light that has arrived at the surfaces of a context: answers to the context's shadow searches, in place
// of a Traversal. Kernel dialect.
#pragma once

#include "kernel/lights/area_shadow.hpp"
#include "kernel/models/search_record.hpp"
#include "kernel/shading/lighting.hpp"

namespace celltrace::kernel::models {

/// An answer with the head of its question.
struct alignas(64) SearchAnswer {
  ShadowRayLight light;
  uint32_t kind, lanes, primary, number, unused[12];
};
static_assert(sizeof(SearchAnswer) == search_part::answer_and_head, "part of a SearchRecord");

/// Answers of one job in local store.
struct alignas(128) AnswerBlock {
  static constexpr uint32_t kAnswers = 8;
  SearchAnswer answers[kAnswers];
};

/// Fetches the answers from index `first` on, of `searches` in all.
template <class Spu>
void fetch_answers(Spu& spu, ea_t first_search, uint32_t first, uint32_t searches, AnswerBlock& block,
                   uint32_t tag) {
  const uint32_t left = searches - first;
  const uint32_t n = left < AnswerBlock::kAnswers ? left : AnswerBlock::kAnswers;
  const ea_t from =
      first_search + static_cast<ea_t>(first) * sizeof(SearchRecord) + search_part::answer_offset;
  for (uint32_t i = 0; i < n; ++i)
    spu.get(&block.answers[i], from + i * sizeof(SearchRecord), search_part::answer_and_head, tag);
}

template <class Spu> class ArrivedLight {
public:
  using S = typename Spu::simd;

  ArrivedLight(Spu& spu, const FrameBlock& frame)
      : spu_(spu), area_(allocate_area_shadow(spu, frame)),
        to_place_(area_ != nullptr ? spu.template allocate<ShadowRays>() : nullptr) {}

  /// Returns true if some lights of the frame have areas.
  bool has_areas() const { return area_ != nullptr; }

  /// Begins to read the answers to `searches` searches. `block` holds the first ones already; more are
  /// fetched under `tag`.
  void arrive(ea_t first_search, uint32_t searches, AnswerBlock& block, uint32_t tag) {
    first_search_ = first_search;
    searches_ = searches;
    block_ = &block;
    tag_ = tag;
    first_ = 0;
    cursor_ = 0;
  }

  /// Begins without answers, as no light was asked for.
  void arrive_nothing() { searches_ = cursor_ = 0; }

  /// Replaces the gathered light of a round by the light that has arrived. Answers are in the order of the
  /// lights; lights that count in no lane have no answer.
  void take(const LightRound& round) {
    round.clear<S>();
    for (; cursor_ < searches_; ++cursor_) {
      const SearchAnswer& next = answer(cursor_);
      if (next.number >= round.next()) return;
      round.gathered[next.number - round.first] = next.light.colour;
    }
  }
  /// Replaces the gathered light of a round if some lights of the frame have areas. The round has gathered
  /// again, and a light counts in the lanes that `lanes_of(gathered)` returns. Returns the number of rays
  /// that sampling these lights would have traced.
  template <class LanesOf>
  uint32_t take(SceneAccess<Spu>& scene, const FrameBlock& frame, const LightRound& round,
                Surfaces<S>& surfaces, const LanesOf& lanes_of) {
    uint32_t rays = 0;
    for_each_light(scene, frame, round.first, round.count, [&](uint32_t number, const LightRecord& light) {
      VectorLanes& gathered = round.gathered[number - round.first];
      if (cursor_ == searches_ || answer(cursor_).number != number) {
        const typename S::F zero(0.0f);
        return gathered.template store<S>({zero, zero, zero});
      }
      if (!has_area(light)) {
        gathered = answer(cursor_++).light.colour;
        return;
      }
      const uint32_t lanes = lanes_of(gathered);
      surfaces.any_side = lanes;
      IncidentLight<S> incident(light.colour);
      illuminate(scene, light, surfaces, lanes, incident);
      // All places of the light were asked for, row by row.
      rays += sample_area(
          spu_, light, surfaces, incident, *to_place_, *area_, gathered, [&](AreaShadow<S>& shadow) {
            shadow.light() =
                answer(cursor_ + shadow.place.row * light.columns + shadow.place.column).light.colour;
          });
      cursor_ += light.columns * light.rows;
    });
    return rays;
  }

private:
  const SearchAnswer& answer(uint32_t index) {
    const uint32_t first = index & ~(AnswerBlock::kAnswers - 1);
    if (first != first_) {
      fetch_answers(spu_, first_search_, first, searches_, *block_, tag_);
      spu_.wait_all(1u << tag_);
      first_ = first;
    }
    return block_->answers[index - first];
  }

  Spu& spu_;
  AreaShadow<S>* area_;  ///< null if no light has an area
  ShadowRays* to_place_; ///< null if no light has an area
  ea_t first_search_ = 0;
  uint32_t searches_ = 0;
  AnswerBlock* block_ = nullptr;
  uint32_t tag_ = 0;
  uint32_t first_ = 0;  ///< index of the first answer in the block
  uint32_t cursor_ = 0; ///< index of the next answer
};

} // namespace celltrace::kernel::models

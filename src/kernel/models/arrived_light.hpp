// The light that has arrived at the surfaces of a context: the answers to its shadow searches, in place of a
// Traversal. Kernel dialect.
#pragma once

#include "kernel/lights/area_shadow.hpp"
#include "kernel/models/search_record.hpp"

namespace celltrace::kernel::models {

/// An answer with what was asked.
struct alignas(64) AnsweredSearch {
  LightOnItsWay light;
  uint32_t kind, lanes, primary, number, unused[12];
};
static_assert(sizeof(AnsweredSearch) == search_part::answer_and_head, "part of a SearchRecord");

/// Answers of one job in local store.
struct alignas(128) AnswerBlock {
  static constexpr uint32_t kAnswers = 8;
  AnsweredSearch answers[kAnswers];
};

/// Fetches answers from `first` on, of `searches`.
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

  ArrivedLight(Spu& spu, const FrameBlock& frame) : spu_(spu), area_(allocate_area_shadow(spu, frame)) {}

  /// Answers to `searches` searches, the first of which `block` holds already. More are fetched under `tag`.
  void arrive(ea_t first_search, uint32_t searches, AnswerBlock& block, uint32_t tag) {
    first_search_ = first_search;
    searches_ = searches;
    block_ = &block;
    tag_ = tag;
    first_ = 0;
    cursor_ = 0;
  }

  /// As Intersector's.
  uint32_t transmittance(const LightRecord& source, const Surfaces<S>& surfaces,
                         const IncidentLight<S>& incident, uint32_t number, VectorLanes& light) {
    // Lights come in order, and from the beginning again for each of a face's materials.
    while (answer(cursor_).number != number)
      cursor_ = cursor_ + 1 == searches_ ? 0 : cursor_ + 1;
    if (has_area(source)) {
      // All its places were asked for, row by row.
      const uint32_t first = cursor_;
      cursor_ += source.columns * source.rows - 1;
      return sample_area(spu_, source, surfaces, incident, *area_, light, [&](AreaShadow<S>& shadow) {
        shadow.light = answer(first + shadow.place.row * source.columns + shadow.place.column).light.colour;
      });
    }
    light = answer(cursor_).light.colour;
    return static_cast<uint32_t>(__builtin_popcount(incident.facing));
  }

private:
  const AnsweredSearch& answer(uint32_t index) {
    const uint32_t first = index & ~(AnswerBlock::kAnswers - 1);
    if (first != first_) {
      fetch_answers(spu_, first_search_, first, searches_, *block_, tag_);
      spu_.wait_all(1u << tag_);
      first_ = first;
    }
    return block_->answers[index - first];
  }

  Spu& spu_;
  AreaShadow<S>* area_; ///< null if no light has an area
  ea_t first_search_ = 0;
  uint32_t searches_ = 0;
  AnswerBlock* block_ = nullptr;
  uint32_t tag_ = 0;
  uint32_t first_ = 0;  ///< index of the answer that the block begins with
  uint32_t cursor_ = 0; ///< answer that was asked for last
};

} // namespace celltrace::kernel::models

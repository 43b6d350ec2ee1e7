// The light that has arrived at the surfaces of a context: the answers to its shadow searches, in place of a
// Traversal. Kernel dialect.
#pragma once

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
  explicit ArrivedLight(Spu& spu) : spu_(spu) {}

  /// Answers to `searches` searches, the first of which `block` holds already. More are fetched under `tag`.
  void arrive(ea_t first_search, uint32_t searches, AnswerBlock& block, uint32_t tag) {
    first_search_ = first_search;
    searches_ = searches;
    block_ = &block;
    tag_ = tag;
    first_ = 0;
    cursor_ = 0;
  }

  /// No light was asked for.
  void arrive_nothing() { searches_ = cursor_ = 0; }

  /// Puts what has arrived from the `count` lights from `first` on where it belongs. Lights come in order; of
  /// those that no surface faces nothing was asked.
  void take(uint32_t first, uint32_t count, VectorLanes* colours) {
    for (; cursor_ < searches_; ++cursor_) {
      const AnsweredSearch& next = answer(cursor_);
      if (next.number >= first + count) return;
      colours[next.number - first] = next.light.colour;
    }
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
  ea_t first_search_ = 0;
  uint32_t searches_ = 0;
  AnswerBlock* block_ = nullptr;
  uint32_t tag_ = 0;
  uint32_t first_ = 0;  ///< index of the answer that the block begins with
  uint32_t cursor_ = 0; ///< answer that was asked for last
};

} // namespace celltrace::kernel::models

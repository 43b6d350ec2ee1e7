#include "celltrace/spe/simulation.hpp"

namespace celltrace {

void SpuProfile::add(const std::vector<Word>& words) {
  const std::lock_guard lock(mutex_);
  words_.resize(kWords);
  for (std::size_t i = 0; i < words.size() && i < kWords; ++i) {
    const Word& more = words[i];
    if (more.hits == 0) continue;
    Word& sum = words_[i];
    sum.hits += more.hits;
    sum.cycles += more.cycles;
    sum.dual += more.dual;
    sum.dependency += more.dependency;
    sum.branch_miss += more.branch_miss;
    sum.prefetch_miss += more.prefetch_miss;
    sum.hint_target += more.hint_target;
    sum.fp_resource += more.fp_resource;
    sum.channel += more.channel;
    sum.instruction = more.instruction;
  }
}

} // namespace celltrace

// The status of tag groups: channels 12 and 22 to 24.
//
// A request (channel 23) is answered at once if its condition holds. Otherwise the request waits, and its
// condition is checked again when a command completes or the mask changes. An answer stays until it is read;
// the answer to a later request replaces it.
#pragma once

#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <optional>

namespace celltrace::cell_emu {

class TagGroups {
public:
  std::uint32_t mask() const { return mask_; }
  void write_mask(std::uint32_t mask) { mask_ = mask; }
  void request(TagUpdate update) { request_ = update; }

  /// Answers the waiting request if its condition holds. `outstanding`: the tags with commands in the queue.
  /// `last_command`: number of the newest command, up to which the answer is valid. Returns true if the count
  /// of channel 24 rose from 0 to 1, which raises the tag status event for every kind of request.
  bool judge(std::uint32_t outstanding, std::uint64_t last_command) {
    if (!request_) return false;
    const std::uint32_t completed = mask_ & ~outstanding;
    const TagUpdate update = *request_;
    if (update == TagUpdate::any && completed == 0) return false;
    if (update == TagUpdate::all && completed != mask_) return false;
    const bool rises = !status_;
    request_.reset();
    status_ = completed;
    answered_up_to_ = last_command;
    return rises;
  }

  bool waiting() const { return request_.has_value(); }
  /// Returns whether the count of channel 24 is 1.
  bool available() const { return status_.has_value(); }
  /// Returns the number of the newest command for which the answer is valid.
  std::uint64_t answered_up_to() const { return answered_up_to_; }
  /// Removes and returns the answer. There must be one.
  std::uint32_t take() {
    const std::uint32_t status = *status_;
    status_.reset();
    return status;
  }

private:
  std::uint32_t mask_ = 0;
  std::optional<TagUpdate> request_;
  std::optional<std::uint32_t> status_;
  std::uint64_t answered_up_to_ = 0;
};

} // namespace celltrace::cell_emu

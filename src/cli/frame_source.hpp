// Frames of an animation, ready to be rendered: while one is traced, the next one is read and prepared by
// another thread.
#pragma once

#include "celltrace/render.hpp"
#include "cli/command_line.hpp"
#include "cli/scene_reading.hpp"

#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace celltrace::cli {

class FrameSource {
public:
  struct Frame {
    int number = 0;
    ReadScene read;               ///< without a scene: the user interrupted it
    bool is_prepared = false;     ///< false with a scene: the same, while image and accelerator were made
    Renderer* renderer = nullptr; ///< that has the frame; until the next but one is taken
    std::string messages;         ///< of reading
  };

  /// `frames`: numbers, at least one. Reading the first one begins. Throws InputError for options out of
  /// range.
  FrameSource(const RenderRequest& request, const RenderOptions& options, std::vector<int> frames);
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  ~FrameSource();

  bool is_at_end() const { return next_ == frames_.size(); }
  /// Waits for the next frame and begins with the one after it. `accelerator_bytes`: what the last one had;
  /// if it is much, there is never more than one. Throws what reading and preparing throw, a SceneError with
  /// the frame's number.
  Frame take(std::uint64_t accelerator_bytes);

private:
  void begin(std::size_t index, bool prepares);
  Frame make(int number, Renderer* prepare_with) const;

  const RenderRequest& request_;
  std::vector<int> frames_;
  std::vector<std::unique_ptr<Renderer>> renderers_; ///< one, or two that take turns
  std::size_t next_ = 0;
  std::future<Frame> coming_;
};

} // namespace celltrace::cli

// Provides frames of an animation, ready to be rendered: while one is traced, another thread reads and
// prepares the next one.
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
    ReadScene read; ///< without a scene if the user interrupted it
    bool is_prepared =
        false; ///< false with a scene if it was interrupted while image and accelerator were built
    Renderer* renderer = nullptr; ///< holds the frame until the next but one is taken
    std::string messages;         ///< printed while the scene was read
  };

  /// Starts reading the first of `frames`, of which there is at least one. Throws InputError for options out
  /// of range.
  FrameSource(const RenderRequest& request, const RenderOptions& options, std::vector<int> frames);
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  ~FrameSource();

  bool is_at_end() const { return next_ == frames_.size(); }
  /// Waits for the next frame and starts the one after it. `accelerator_bytes` is the size of the last
  /// frame's accelerator; if it is large, only one frame is in memory. Throws the exceptions of reading and
  /// preparing; a SceneError gets the frame's number.
  Frame take(std::uint64_t accelerator_bytes);

private:
  void begin(std::size_t index, bool prepares);
  Frame make(int number, Renderer* prepare_with) const;

  const RenderRequest& request_;
  std::vector<int> frames_;
  std::vector<std::unique_ptr<Renderer>> renderers_; ///< one, or two that alternate
  std::size_t next_ = 0;
  std::future<Frame> coming_;
};

} // namespace celltrace::cli

#include "cli/frame_source.hpp"

#include "celltrace/error.hpp"
#include "cli/interrupt.hpp"

#include <utility>

namespace celltrace::cli {

FrameSource::FrameSource(const RenderRequest& request, const RenderOptions& options, std::vector<int> frames)
    : request_(request), frames_(std::move(frames)) {
  RenderOptions own = options;
  own.build_progress = [](double) { return !interrupted(); };
  // An emulated machine gets one renderer: its time and its trace continue from frame to frame.
  const bool prepares_ahead = options.backend == Backend::native && frames_.size() > 1;
  for (int i = 0; i < (prepares_ahead ? 2 : 1); ++i)
    renderers_.push_back(std::make_unique<Renderer>(own));
  begin(0, prepares_ahead);
}

FrameSource::~FrameSource() {
  if (coming_.valid()) coming_.wait();
}

void FrameSource::begin(std::size_t index, bool prepares) {
  Renderer* const renderer = prepares ? renderers_[index % renderers_.size()].get() : nullptr;
  coming_ =
      std::async(std::launch::async, [this, index, renderer] { return make(frames_[index], renderer); });
}

FrameSource::Frame FrameSource::make(int number, Renderer* prepare_with) const {
  Frame frame;
  frame.number = number;
  try {
    frame.read = read_scene(
        request_, number, [&](std::string_view text) { frame.messages += text; }, [](double) {});
  } catch (const SceneError& error) {
    if (!request_.animation.is_on()) throw;
    throw SceneError(std::string(error.what()) + "\n  in frame " + std::to_string(number), error.findings());
  }
  if (frame.read.scene && prepare_with != nullptr)
    frame.is_prepared = prepare_with->prepare(*frame.read.scene);
  return frame;
}

FrameSource::Frame FrameSource::take(std::uint64_t accelerator_bytes) {
  constexpr std::uint64_t kMuch = std::uint64_t{256} << 20;
  Frame frame = coming_.get();
  frame.renderer = renderers_[next_ % renderers_.size()].get();
  if (frame.read.scene && !frame.is_prepared && !interrupted())
    frame.is_prepared = frame.renderer->prepare(*frame.read.scene);
  ++next_;
  if (!is_at_end() && !interrupted()) begin(next_, renderers_.size() > 1 && accelerator_bytes < kMuch);
  return frame;
}

} // namespace celltrace::cli

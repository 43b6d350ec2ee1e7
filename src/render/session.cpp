#include "celltrace/session.hpp"

#include "celltrace/error.hpp"
#include "render/picture_options.hpp"

#include <atomic>
#include <cstring>
#include <string>
#include <utility>

namespace celltrace {

namespace {

template <class Entries> auto& entry(Entries& entries, Index index, const char* what) {
  if (index >= entries.size())
    throw InputError("there is no " + std::string(what) + " " + std::to_string(index) + ": the scene has " +
                     std::to_string(entries.size()));
  return entries[index];
}

void copy_row(const std::uint8_t* from, std::uint8_t* to, int pixels, PixelFormat format) {
  switch (format) {
  case PixelFormat::rgba8:
    std::memcpy(to, from, std::size_t{4} * static_cast<std::size_t>(pixels));
    return;
  case PixelFormat::bgra8:
    for (int i = 0; i < pixels; ++i, from += 4, to += 4) {
      to[0] = from[2];
      to[1] = from[1];
      to[2] = from[0];
      to[3] = from[3];
    }
    return;
  case PixelFormat::rgb8:
    for (int i = 0; i < pixels; ++i, from += 4, to += 3)
      std::memcpy(to, from, 3);
    return;
  case PixelFormat::rgba16:
  case PixelFormat::rgba32f:
    return; // made from floats at the end
  }
}

bool is_made_from_floats(PixelFormat format) {
  return format == PixelFormat::rgba16 || format == PixelFormat::rgba32f;
}

/// Returns the address of a pixel.
std::uint8_t* place_in(const Framebuffer& framebuffer, int x, int y) {
  return static_cast<std::uint8_t*>(framebuffer.pixels) + framebuffer.pitch * static_cast<std::size_t>(y) +
         bytes_of(framebuffer.format) * static_cast<std::size_t>(x);
}

template <class Channel>
void copy_region(const BasicImage<Channel>& from, const PictureRegion& region, const Framebuffer& to) {
  const std::size_t row = 4 * sizeof(Channel) * static_cast<std::size_t>(region.right - region.left);
  for (int y = region.top; y < region.bottom; ++y)
    std::memcpy(place_in(to, region.left, y), from.pixel(region.left, y), row);
}

void check(const Framebuffer& framebuffer, int width) {
  if (framebuffer.pixels == nullptr ||
      framebuffer.pitch < bytes_of(framebuffer.format) * static_cast<std::size_t>(width))
    throw InputError("the framebuffer has no pixels, or rows that are shorter than the picture's");
}

} // namespace

std::size_t bytes_of(PixelFormat format) {
  switch (format) {
  case PixelFormat::rgb8:
    return 3;
  case PixelFormat::rgba16:
    return 8;
  case PixelFormat::rgba32f:
    return 16;
  default:
    return 4;
  }
}

class Session::Impl {
public:
  Impl(Scene scene, const RenderOptions& options)
      : scene_(std::move(scene)), given_(options), renderer_(own_options(options)) {}

  RenderResult render(const Progress& progress) {
    cancelled_.store(false, std::memory_order_relaxed);
    const Progress unless_cancelled = [&](double fraction) {
      return !cancelled_.load(std::memory_order_relaxed) && (!progress || progress(fraction));
    };
    RenderResult result = renderer_.render(scene_, changes_, unless_cancelled);
    // No changes are left: if the accelerator was not finished, the renderer knows that it has no scene.
    changes_ = {false, false};
    if (wants_floats()) copy_floats(result);
    return result;
  }

  /// Returns options for the renderer, in which functions of this object stand for the caller's functions.
  RenderOptions own_options(const RenderOptions& options) {
    RenderOptions own = options;
    own.build_progress = [this](double fraction) {
      return !cancelled_.load(std::memory_order_relaxed) &&
             (!given_.build_progress || given_.build_progress(fraction));
    };
    own.colours |= wants_floats();
    if ((framebuffer_ && !wants_floats()) || options.finished_block)
      own.finished_block = [this](const PictureBlock& block) { finish(block); };
    return own;
  }

  void set_picture(const RenderOptions& options) {
    if (framebuffer_) check(*framebuffer_, options.width);
    const RenderOptions changed = with_picture_of(given_, options);
    renderer_.set_picture(own_options(changed));
    given_ = changed;
  }

  void set_framebuffer(const std::optional<Framebuffer>& framebuffer) {
    if (framebuffer) check(*framebuffer, given_.width);
    const std::optional<Framebuffer> before = std::exchange(framebuffer_, framebuffer);
    try {
      renderer_.set_picture(own_options(given_));
    } catch (...) {
      framebuffer_ = before;
      throw;
    }
  }

  bool wants_floats() const { return framebuffer_ && is_made_from_floats(framebuffer_->format); }
  /// Copies a complete frame; after a frame that was ended the framebuffer stays as it is.
  void copy_floats(RenderResult& result) {
    if (result.complete) {
      const PictureRegion region = given_.region.value_or(PictureRegion{0, given_.width, 0, given_.height});
      if (framebuffer_->format == PixelFormat::rgba32f)
        copy_region(result.colours, region, *framebuffer_);
      else
        copy_region(to_deep_image(result.colours), region, *framebuffer_);
      generation_.fetch_add(1, std::memory_order_release);
    }
    if (!given_.colours) result.colours = ColourImage();
  }

  void finish(const PictureBlock& block) {
    if (framebuffer_ && !wants_floats()) {
      std::uint8_t* to = place_in(*framebuffer_, block.region.left, block.region.top);
      const std::uint8_t* from = block.first;
      for (int y = block.region.top; y < block.region.bottom;
           ++y, from += block.pitch, to += framebuffer_->pitch)
        copy_row(from, to, block.region.right - block.region.left, framebuffer_->format);
      generation_.fetch_add(1, std::memory_order_release);
    }
    if (given_.finished_block) given_.finished_block(block);
  }

  Scene scene_;
  RenderOptions given_;
  SceneChanges changes_;
  std::optional<Framebuffer> framebuffer_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<std::uint64_t> generation_ = 0;
  Renderer renderer_; ///< last member, since it calls functions that use the others
};

Session::Session(Scene scene, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(std::move(scene), options)) {
}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

const Scene& Session::scene() const {
  return impl_->scene_;
}
const RenderOptions& Session::options() const {
  return impl_->given_;
}

void Session::set_camera(const Camera& camera) {
  impl_->scene_.camera = camera;
}
void Session::set_light(Index light, const Light& to) {
  entry(impl_->scene_.lights, light, "light") = to;
  impl_->changes_.surfaces = true;
}
void Session::set_material(Index material, const Material& to) {
  entry(impl_->scene_.materials, material, "material") = to;
  impl_->changes_.surfaces = true;
}
void Session::set_interior(Index interior, const Interior& to) {
  entry(impl_->scene_.interiors, interior, "interior") = to;
  impl_->changes_.surfaces = true;
}
void Session::set_object(Index object, const Object& to) {
  entry(impl_->scene_.objects, object, "object") = to;
  impl_->changes_.objects = true;
}
void Session::set_transform(Index object, const Transform& to) {
  entry(impl_->scene_.objects, object, "object").transform = to;
  impl_->changes_.objects = true;
}
void Session::set_material_of(Index object, Index material) {
  entry(impl_->scene_.objects, object, "object").material = material;
  impl_->changes_.objects = true;
}
void Session::show(Index object, bool visible) {
  entry(impl_->scene_.objects, object, "object").is_hidden = !visible;
  impl_->changes_.objects = true;
}
void Session::edit(const SceneChanges& changes, const std::function<void(Scene& scene)>& edit) {
  const SceneChanges before = std::exchange(impl_->changes_, SceneChanges{true, true});
  edit(impl_->scene_);
  impl_->changes_ = {before.objects || changes.objects, before.surfaces || changes.surfaces};
}
void Session::replace(Scene scene) {
  impl_->scene_ = std::move(scene);
  impl_->changes_ = {};
}

void Session::set_picture(const RenderOptions& options) {
  impl_->set_picture(options);
}
void Session::set_framebuffer(const std::optional<Framebuffer>& framebuffer) {
  impl_->set_framebuffer(framebuffer);
}

RenderResult Session::render(const Progress& progress) {
  return impl_->render(progress);
}
RayQueries Session::ray_queries() const {
  return impl_->renderer_.ray_queries();
}
void Session::cancel() noexcept {
  impl_->cancelled_.store(true, std::memory_order_relaxed);
}
std::uint64_t Session::generation() const noexcept {
  return impl_->generation_.load(std::memory_order_acquire);
}

} // namespace celltrace

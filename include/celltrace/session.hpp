// A session: a scene on a machine, rendered frame after frame while it changes.
//
//   Session session(parse_file("scene.pov"), options);
//   session.render();
//   session.set_transform(3, Transform::translate({0, 1, 0}));
//   RenderResult next = session.render();      // takes as long as the changes need
//
// Indices are indices into the vectors of Scene. Thread safety: one thread at a time, except that any thread
// may call cancel() and generation() at any time; different sessions are independent.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/render.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace celltrace {

/// The channels of a pixel, in their order in memory.
enum class PixelFormat {
  rgba8, ///< R, G, B, A
  bgra8, ///< B, G, R, A, often used by window systems
  rgb8,  ///< R, G, B
  // Pixels of the formats below are written all at once, at the end of a frame that was not cancelled. These
  // formats take the memory of RenderOptions::colours, and work with model `shared` only.
  rgba16, ///< as from to_deep_image(): 16 bits a channel, in the host's byte order
  rgba32f ///< floats as in RenderResult::colours
};
/// Returns the bytes of a pixel, 3 to 16.
CELLTRACE_EXPORT std::size_t bytes_of(PixelFormat format);

/// Memory of the application that pictures are written to while they are rendered. It must stay valid as long
/// as the session may render into it.
struct Framebuffer {
  void* pixels = nullptr; ///< the upper left pixel, aligned for its channels
  std::size_t pitch = 0;  ///< bytes from one row to the next, at least the bytes of a row of the picture
  PixelFormat format = PixelFormat::rgba8;
};

class CELLTRACE_EXPORT Session {
public:
  /// Throws InputError for options out of range. The scene is checked when it is first rendered.
  explicit Session(Scene scene, const RenderOptions& options = {});
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  const Scene& scene() const;
  const RenderOptions& options() const;

  // Changes to the scene, which take effect with the next frame. Functions that take an index throw
  // InputError if it is out of range.

  void set_camera(const Camera& camera);
  void set_light(Index light, const Light& to);
  void set_material(Index material, const Material& to);
  void set_interior(Index interior, const Interior& to);
  void set_object(Index object, const Object& to);
  void set_transform(Index object, const Transform& to);
  void set_material_of(Index object, Index material);
  void show(Index object, bool visible);
  /// Calls `edit` with the scene, for all other changes. Edits of parts that `changes` does not name may have
  /// no effect. If `edit` throws, everything counts as changed.
  void edit(const SceneChanges& changes, const std::function<void(Scene& scene)>& edit);
  /// Replaces the scene.
  void replace(Scene scene);

  /// Takes over from `options` the size of pictures, the region, antialiasing, and whether colours, alpha,
  /// first hits, blocks, a work map and finished parts are wanted. The scene stays on the machine. Throws
  /// InputError if an option is out of range; then nothing has changed.
  void set_picture(const RenderOptions& options);
  /// Sets the memory that finished pixels are written to, opaque, besides the result's image; nothing: no
  /// such memory. Before set_picture() makes pictures larger, set a framebuffer with room for them. Throws
  /// InputError if the pitch is too small, or with RenderOptions::blocks; then nothing has changed.
  void set_framebuffer(const std::optional<Framebuffer>& framebuffer);

  /// Renders the scene as it is now, as Renderer::render() does. After an InputError the machine still has
  /// the scene from before the changes, and the next frame applies the changes again.
  RenderResult render(const Progress& progress = {});

  /// Returns queries of the scene as it was rendered last, as Renderer::ray_queries() does.
  RayQueries ray_queries() const;

  /// Cancels the frame that is being rendered, if any: render() returns soon, with the finished pixels. The
  /// next frame is rendered as usual.
  void cancel() noexcept;
  /// Returns the number of blocks of pixels that have been written to framebuffers. A greater number than
  /// before means that there is something new to show; the blocks' pixels are visible to the thread that
  /// reads the number.
  std::uint64_t generation() const noexcept;

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace celltrace

// A session: a scene on a machine, rendered frame after frame while it changes.
//
//   Session session(parse_file("scene.pov"), options);
//   session.render();
//   session.set_transform(3, Transform::translate({0, 1, 0}));
//   RenderResult next = session.render();      // costs what has changed
//
// Indices are those of the vectors in Scene. Thread safety: one thread at a time, but for cancel() and
// generation(), which any thread may call at any time; different sessions are independent.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/render.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace celltrace {

/// Bytes of a pixel in the order of memory.
enum class PixelFormat {
  rgba8, ///< R, G, B, A
  bgra8, ///< B, G, R, A, as windows often have it
  rgb8,  ///< R, G, B
  // These come all at once, at the end of a frame that was not broken off, and take the memory of
  // RenderOptions::colours. Model `shared` only.
  rgba16, ///< as to_deep_image() makes them, 16 bits each, in the host's byte order
  rgba32f ///< floats as in RenderResult::colours
};
/// 3 to 16.
CELLTRACE_EXPORT std::size_t bytes_of(PixelFormat format);

/// Memory of the application's that pictures are put into while they are rendered. Has to stay as long as the
/// session may render into it.
struct Framebuffer {
  void* pixels = nullptr; ///< the upper left one, aligned for its channels
  std::size_t pitch = 0;  ///< bytes from a row to the next one, at least the picture's
  PixelFormat format = PixelFormat::rgba8;
};

class CELLTRACE_EXPORT Session {
public:
  /// Throws InputError for options out of range. The scene is looked at when it is first rendered.
  explicit Session(Scene scene, const RenderOptions& options = {});
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  const Scene& scene() const;
  const RenderOptions& options() const;

  // Changes; they take effect with the next frame. Those with an index throw InputError where there is no
  // such thing.

  void set_camera(const Camera& camera);
  void set_light(Index light, const Light& to);
  void set_material(Index material, const Material& to);
  void set_interior(Index interior, const Interior& to);
  void set_object(Index object, const Object& to);
  void set_transform(Index object, const Transform& to);
  void set_material_of(Index object, Index material);
  void show(Index object, bool visible);
  /// Any others: calls `edit` with the scene. What it does to the scene and `changes` does not say may not be
  /// seen. If it throws, all may have changed.
  void edit(const SceneChanges& changes, const std::function<void(Scene& scene)>& edit);
  /// Another scene.
  void replace(Scene scene);

  /// The size of pictures, the region, antialiasing, and whether colours, alpha, first hits, blocks, a work
  /// map and finished parts are wanted, of `options`; the scene stays on the machine. Throws InputError if
  /// something is out of range; then nothing has changed.
  void set_picture(const RenderOptions& options);
  /// Where finished pixels go besides the result's image, opaque; nothing: nowhere. Give one with a size that has
  /// room for the pictures before set_picture() makes them larger. Throws InputError if the pitch is too
  /// small, or if pictures are wanted in blocks; then nothing has changed.
  void set_framebuffer(const std::optional<Framebuffer>& framebuffer);

  /// Renders the scene as it is now. As Renderer::render(). After an InputError the machine has the scene as
  /// it was before the changes, which are still to be made.
  RenderResult render(const Progress& progress = {});

  /// As Renderer::ray_queries(), of the scene as it was rendered last.
  RayQueries ray_queries() const;

  /// Breaks off the frame that is being rendered, if any: render() returns soon, with what is complete. The
  /// next frame is rendered as usual.
  void cancel() noexcept;
  /// How many blocks of pixels have been put into framebuffers. A number that has grown says that there is
  /// something new to show; the pixels of its blocks are visible to who reads it.
  std::uint64_t generation() const noexcept;

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace celltrace

// Cameras and scenes as Python has them: a camera also says what happens where a picture has another shape
// than it has.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>
#include <vector>

namespace celltrace {

/// How a camera adapts to the ratio of a picture's width to its height.
enum class Framing {
  fixed, ///< not at all, as in POV-Ray: what it sees is squeezed into the picture
  width, ///< what it sees is as wide as before, and higher or lower
  whole  ///< what it sees is wider or higher, and never less
};

struct FramedCamera : Camera {
  Framing framing = Framing::fixed;
};

/// What the camera is in a picture of that size.
Camera framed(const FramedCamera& camera, int width, int height);

/// A mesh with colours whose materials are in a scene already.
struct PlacedColours {
  std::shared_ptr<const Mesh> of; ///< the mesh as it was given
  Material material;              ///< that they were made of
  std::shared_ptr<const Mesh> mesh;
  Index index; ///< of the material that an object has with it
};

struct PythonScene : Scene {
  PythonScene() = default;
  PythonScene(Scene scene) : Scene(std::move(scene)) {}

  FramedCamera framed_camera() const { return {camera, framing}; }
  /// The scene for a picture of that size.
  Scene framed(int width, int height) const {
    Scene scene = *this;
    scene.camera = celltrace::framed(framed_camera(), width, height);
    return scene;
  }

  Framing framing = Framing::fixed;          ///< of its camera
  std::vector<PlacedColours> placed_colours; ///< instances share them
};

} // namespace celltrace

// The forms that objects of a scene have in the scene image.
#pragma once

#include <cstdint>

namespace celltrace {

/// The form in which the image holds an object: records of its own, a copy of a mesh, or an instance of a
/// mesh.
enum class ObjectForm : std::uint8_t { itself, copy, instance };

} // namespace celltrace

// The forms that objects of a scene have in the scene image.
#pragma once

#include <cstdint>

namespace celltrace {

/// How the image holds an object: by records of its own, as a copy of a mesh, or as an instance of one.
enum class ObjectForm : std::uint8_t { itself, copy, instance };

} // namespace celltrace

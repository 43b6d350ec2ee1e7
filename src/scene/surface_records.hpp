// The records of materials and lights.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/records.hpp"

namespace celltrace {

kernel::LightRecord make_record(const Light& light);
kernel::MaterialRecord make_record(const Material& material, const Scene& scene);
/// Whether shadow rays stop at it. Without a map.
bool is_opaque(const Pigment& pigment);

} // namespace celltrace

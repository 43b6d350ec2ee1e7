// The records of materials, interiors, fogs, rainbows and lights.
#pragma once

#include "celltrace/scene.hpp"
#include "records/atmosphere.hpp"
#include "records/light.hpp"
#include "records/material.hpp"

namespace celltrace {

kernel::LightRecord make_record(const Light& light);
kernel::MaterialRecord make_record(const Material& material, const Scene& scene);
/// Whether it has more than a material's record says.
bool has_record(const Finish& finish);
kernel::FinishRecord make_record(const Finish& finish, const Scene& scene);
kernel::InteriorRecord make_record(const Interior& interior);
kernel::FogRecord make_record(const Fog& fog, const Scene& scene);
/// Whether anything of it is seen.
bool is_visible(const Rainbow& rainbow);
/// Without its colours.
kernel::RainbowRecord make_record(const Rainbow& rainbow);
/// Whether shadow rays stop at it. Without a map.
bool is_opaque(const Pigment& pigment);

} // namespace celltrace

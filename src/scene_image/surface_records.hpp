// The records of materials, interiors, fogs, rainbows and lights.
#pragma once

#include "celltrace/scene.hpp"
#include "records/atmosphere.hpp"
#include "records/light.hpp"
#include "records/material.hpp"

namespace celltrace {

kernel::LightRecord make_record(const Light& light);
kernel::MaterialRecord make_record(const Material& material, const Scene& scene);
/// Returns whether a finish needs a record besides the fields in a material's record.
bool has_record(const Finish& finish);
kernel::FinishRecord make_record(const Finish& finish, const Scene& scene);
kernel::InteriorRecord make_record(const Interior& interior);
kernel::FogRecord make_record(const Fog& fog, const Scene& scene);
/// Returns whether any colour of a rainbow is visible.
bool is_visible(const Rainbow& rainbow);
/// Returns the record of a rainbow, without its colours.
kernel::RainbowRecord make_record(const Rainbow& rainbow);
/// Returns whether shadow rays stop at a pigment without a map.
bool is_opaque(const Pigment& pigment);

} // namespace celltrace

// From a Scene to the tables of its image.
#pragma once

#include "celltrace/scene.hpp"
#include "kernel/overlap.hpp"
#include "kernel/records.hpp"

#include <vector>

namespace celltrace {

/// The tables; their records refer to each other by index until make_offsets().
struct ImageTables {
  std::vector<kernel::LightRecord> lights;
  std::vector<kernel::MaterialRecord> materials;
  std::vector<kernel::BlendRecord> blends;
  std::vector<kernel::InteriorRecord> interiors;
  std::vector<kernel::NormalsRecord> normals;
  std::vector<kernel::ObjectRecord> objects;
  kernel::Box bounds; ///< of all objects, a little larger than they are
};

/// Objects are transformed to the world, in single precision; spheres that a transformation leaves round stay
/// spheres. Spheres without a radius and triangles without an area are left out. Throws InputError if an
/// object's coordinates leave what single precision can hold.
ImageTables build_tables(const Scene& scene);

/// Turns indices into offsets from the image's base.
void make_offsets(ImageTables& tables, const kernel::ImageHeader& header);

} // namespace celltrace

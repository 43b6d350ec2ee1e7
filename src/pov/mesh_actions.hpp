// Triangles and the lists of meshes.
#pragma once

#include "pov/mesh.hpp"
#include "pov/session.hpp"

namespace celltrace::pov {

std::shared_ptr<ObjectDefinition>
lone_triangle(Session& session, std::shared_ptr<TriangleDefinition> triangle, const Location& where);
void add_triangle(Session& session, MeshBuilder& builder, const TriangleDefinition& triangle,
                  const Location& where);
std::shared_ptr<TriangleDefinition> flat_triangle(const Quantity& a, const Quantity& b, const Quantity& c);
std::shared_ptr<TriangleDefinition> smooth_triangle(const std::array<Quantity, 3>& corners,
                                                    const std::array<Quantity, 3>& normals);
/// Sets the textures of a mesh2; fails unless there are as many as announced.
void set_textures(Session& session, Mesh2Definition& mesh, double count, std::vector<TexturePtr> textures,
                  const Location& where);
/// Sets the textures of a triangle's corners. Fails unless there are three.
void set_textures(Session& session, TriangleDefinition& triangle, const std::vector<TexturePtr>& textures,
                  const Location& where);
/// Sets the surface coordinates of a triangle; warns if some are not finite, and sets them to 0.
void set_coordinates(Session& session, TriangleDefinition& triangle, const std::array<Vec3, 3>& uv,
                     const Location& where);
/// Returns an inside vector; 0, with a warning, if the given one is not finite.
Vec3 inside_vector(Session& session, const Quantity& vector, const Location& where);
std::shared_ptr<ObjectDefinition> mesh(Session& session, MeshBuilder& builder, const Location& where);
std::shared_ptr<ObjectDefinition> mesh2(Session& session, Mesh2Definition& definition, const Location& where);
/// Checks the count that leads a list of mesh2.
void check_count(Session& session, double announced, std::size_t found, const Location& where);
/// Returns a list without the count that leads it, which must be right.
CountedList counted(Session& session, std::vector<ListEntry>& list, const Location& where);
/// Returns a list of face_indices in the same way; the count is that of its vectors alone.
CountedList faces(Session& session, std::vector<ListEntry>& list, const Location& where);
/// Returns a list of vectors in the same way; warns of entries that are not finite.
CountedList vectors(Session& session, std::vector<ListEntry>& list, const Location& where);

} // namespace celltrace::pov

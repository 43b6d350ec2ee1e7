// How textures, and what has some, get their parts.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pov/pattern_changes.hpp"

namespace celltrace::pov {

/// Returns the texture with a change to its pattern. The texture must have a pattern.
TexturePtr changed(Session& session, const TexturePtr& texture, const PatternChange& change,
                   const Location& where);
/// Fails if a texture has no pigment, normal and finish of its own, because it has a pattern of textures or
/// is on surface coordinates.
void require_plain(Session& session, const TexturePtr& texture, const Location& where);
/// Returns `given` as a layer on `below`, which may be null. Fails if a texture cannot be a layer. Up to
/// version 3.1 all layers but the lowest one transmit what they filter.
TexturePtr layer(Session& session, const TexturePtr& below, const TexturePtr& given, const Location& where);
TexturePtr transformed(Session& session, const TexturePtr& texture, const Transform& next,
                       const Location& where);

void set_colour(PigmentDefinition& pigment, const Pigment& colour);
/// Sets the colour that stands for the pigment in pictures of low quality.
void set_quick_colour(Session& session, PigmentDefinition& pigment, const Pigment& colour);

/// Fails if the pigment depends on a surface: a sky has none.
// Textures as they were before version 3.0 (old_textures.cpp)

/// Returns the texture with a colour; a single number is its graininess instead.
TexturePtr with_old_colour(Session& session, const TexturePtr& texture, const Quantity& colour);
/// Gives the texture's normal the pattern of a word or, if it is no pattern of normals, gives it to the
/// pigment. `number` is the number behind the word: the amount of the normal, or the graininess.
TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, int pattern,
                            std::optional<double> number);
/// Changes the pattern of the texture's pigment.
TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, const PatternChange& change);
/// Changes the waves of the texture's normal.
TexturePtr with_old_waves(Session& session, const TexturePtr& texture, const PatternChange& change);
TexturePtr with_old_finish(const TexturePtr& texture, const std::function<void(FinishDefinition&)>& change);

TexturePtr with_old_colours(Session& session, const TexturePtr& texture, int pattern, const PigmentMap& list,
                            const Location& where);
TexturePtr with_old_map(Session& session, const TexturePtr& texture, const PigmentMap& map,
                        const Location& where);

// Maps and lists (maps.cpp)

void add(Session& session, PigmentMap& map, double position, const PigmentDefinition& pigment,
         const Location& where);
void add(Session& session, NormalMap& map, double position, const NormalDefinition& normal,
         const Location& where);
void add(Session& session, TextureMap& map, double position, const TexturePtr& texture,
         const Location& where);
void add(Session& session, PigmentMap& map, double position, const Pigment& colour, const Location& where);
void add_colour(Session& session, PigmentMap& map, double position, const Quantity& colour,
                const Location& where);
/// Appends the entries of another map.
void add(Session& session, PigmentMap& map, const PigmentMap& entries, const Location& where);

void add(Session& session, std::vector<SlopePoint>& map, double position, const Vec3& height_and_slope,
         const Location& where);
/// Returns a slope map with ascending positions, as a Scene's maps need them.
std::vector<SlopePoint> ascending(std::vector<SlopePoint> map);

void set_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where);
/// Sets a map as before version 3.0, when the pattern could follow the map.
void set_old_map(Session& session, PigmentDefinition& pigment, const PigmentMap& map, const Location& where);
void set_map(Session& session, NormalDefinition& normal, const NormalMap& map, const Location& where);
TexturePtr with_map(Session& session, const TexturePtr& texture, const TextureMap& map,
                    const Location& where);
/// Gives a list to a pattern that takes one. If the list is too short, POV-Ray's colours or the defaults
/// follow.
void set_colours(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
                 const Location& where);
void set_list(Session& session, PigmentDefinition& pigment, int pattern, PigmentMap list,
              const Location& where);
void set_list(Session& session, NormalDefinition& normal, int pattern, NormalMap list, const Location& where);
// Overloads for the pattern of an object:
void set_colours(Session& session, PigmentDefinition& pigment, const Limit& object, PigmentMap list,
                 const Location& where);
void set_list(Session& session, PigmentDefinition& pigment, const Limit& object, PigmentMap list,
              const Location& where);
void set_list(Session& session, NormalDefinition& normal, const Limit& object, NormalMap list,
              const Location& where);
TexturePtr with_pattern(Session& session, const TexturePtr& texture, const PatternChange& pattern);
TexturePtr with_list(Session& session, const TexturePtr& texture, int pattern, TextureMap list,
                     const Location& where);
/// Returns a texture of tiles: as in POV-Ray, `second` is where the checker pattern has its first colour.
TexturePtr with_tiles(Session& session, const TexturePtr& texture, const TexturePtr& first,
                      const TexturePtr& second, const Location& where);

/// Returns a texture by the pattern of an object.
TexturePtr with_object(Session& session, const TexturePtr& texture, const Limit& object, TextureMap list,
                       const Location& where);

// Fail if a pattern lacks what it needs.
void check(Session& session, const PigmentDefinition& pigment, const Location& where);
/// Also replaces an `accuracy` of 0, and marks a normal that it makes undefined.
void check(Session& session, NormalDefinition& normal, const Location& where);
void check(Session& session, const TexturePtr& texture, const Location& where);

// Return the texture with another pigment, normal or finish. Fail if the texture has none of its own.
TexturePtr with(Session& session, const TexturePtr& texture, const PigmentPtr& pigment,
                const Location& where);
TexturePtr with(Session& session, const TexturePtr& texture, const NormalPtr& normal, const Location& where);
TexturePtr with(Session& session, const TexturePtr& texture, const FinishPtr& finish, const Location& where);
/// Returns the texture with the pigment, normal or finish that a name stands for.
TexturePtr with_named(const TexturePtr& texture, const Value& part);
/// Returns the same, but fails if the texture has no pigment, normal or finish of its own.
TexturePtr with_named(Session& session, const TexturePtr& texture, const Value& part, const Location& where);
// While a part in braces is read, the whole that it is a part of is kept in session.unfinished.

/// Removes and returns the whole that was kept last, which is a T.
template <class T> T kept(Session& session) {
  T last = std::get<T>(std::move(session.unfinished.back()));
  session.unfinished.pop_back();
  return last;
}
/// Keeps a texture. Its pigment, normal or finish is read next, and starts as a copy of the present one.
void start_part(Session& session, TexturePtr texture);
/// Keeps an object. A part of its texture is read next.
void start_part(Session& session, std::shared_ptr<ObjectDefinition> object, const Location& where);
// Keep a material or an object. Its interior is read next.
void start_part(Session& session, MaterialDefinition material);
void start_interior(Session& session, std::shared_ptr<ObjectDefinition> object);
/// Keeps a finish. Its irid { } is read next.
void start_irid(Session& session, std::shared_ptr<FinishDefinition> finish, double amount);
/// Returns the kept finish.
Finish& irid(Session& session);
// Each returns the kept object with a pigment, normal, finish or interior.
std::shared_ptr<ObjectDefinition> dressed(Session& session, const PigmentDefinition& pigment);
std::shared_ptr<ObjectDefinition> dressed(Session& session, const NormalPtr& normal);
std::shared_ptr<ObjectDefinition> dressed(Session& session, const FinishDefinition& finish);
std::shared_ptr<ObjectDefinition> with_interior(Session& session, const InteriorDefinition& interior);
/// Returns a copy to change, or a new one for null.
std::shared_ptr<NormalDefinition> copy_of_normal(const NormalPtr& normal);
/// The declared texture in place of `before`, on surface coordinates if that was to be.
TexturePtr with_texture(const TexturePtr& before, const TexturePtr& declared);
/// Checks and completes the texture that has been read.
TexturePtr finished_texture(Session& session, const TexturePtr& texture, const Location& where);
void transform(Session& session, MaterialDefinition& material, const Transform& next, const Location& where);

} // namespace celltrace::pov

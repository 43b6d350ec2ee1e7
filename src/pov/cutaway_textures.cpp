// cutaway_textures: gives faces that CSG cuts the texture of the object that is cut.
#include "pov/actions.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace celltrace::pov {

namespace {

using Operation = Csg::Operation;

/// A texture of parts that counts at points in one of `solids`, or at all points.
struct CutTexture {
  TexturePtr texture;
  Transform transform; ///< map from the texture's space to that of the CSG
  bool is_everywhere;
  std::vector<ObjectPtr> solids;

  bool is_same_as(const CutTexture& other) const {
    return texture == other.texture &&
           std::equal(std::begin(transform.rows), std::end(transform.rows), std::begin(other.transform.rows));
  }
};

ObjectPtr make_solid(Operation operation, std::vector<ObjectPtr> parts) {
  if (parts.size() == 1) return parts.front();
  auto object = std::make_shared<ObjectDefinition>();
  Compound compound;
  compound.operation = operation;
  compound.parts = std::move(parts);
  object->shape = std::make_shared<const Compound>(std::move(compound));
  return object;
}

bool has_texture(const ObjectDefinition& object) {
  const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
  return object.texture ||
         (compound && std::any_of((*compound)->parts.begin(), (*compound)->parts.end(),
                                  [](const ObjectPtr& part) { return has_texture(*part); }));
}

/// Collects the textures for faces without one. As in POV-Ray, a point on such a face takes the textures of
/// all textured shapes that contain it, in equal shares. A shape without a texture adds none, except in a
/// union, where it has the default texture.
class CutTextures {
public:
  CutTextures(Session& session, const Compound& whole) : session_(session) {
    add_parts(whole, {nullptr, {}, {}});
  }

  const std::vector<CutTexture>& all() const { return textures_; }

private:
  /// Properties that a part gets from the CSG around it.
  struct Around {
    TexturePtr texture;          ///< null: none
    Transform texture_transform; ///< to the space of the whole
    Transform transform;         ///< to the space of the whole
    std::vector<ObjectPtr> in =
        {};                      ///< objects that contain all points of the part; the part itself comes last,
    bool is_last_itself = false; ///< if it is part of a union
  };

  void add(const ObjectDefinition& object, const Around& around) {
    session_.tokens.spend(1);
    if (object.inverse || object.light()) return;
    Around own = around;
    own.transform = object.transform.then(around.transform);
    if (object.texture) {
      own.texture = object.texture;
      own.texture_transform = (*object.texture_transform).then(around.transform);
    }
    const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
    if (compound == nullptr) {
      if (own.texture) add_texture(own);
      return;
    }
    // A point in a part of a union is in the union.
    if (own.is_last_itself && joins((*compound)->operation)) own.in.pop_back();
    own.is_last_itself = false;
    add_parts(**compound, own);
  }

  /// A point in an intersection is in all of its parts, a point in a difference in the first one.
  void add_parts(const Compound& compound, const Around& around) {
    const bool is_union = joins(compound.operation);
    for (const ObjectPtr& part : compound.parts) {
      Around own = around;
      if (is_union) {
        if (!own.texture && !std::holds_alternative<std::shared_ptr<const Compound>>(part->shape))
          own.texture = session_.builder.default_texture;
        auto placed = std::make_shared<ObjectDefinition>(*part);
        placed->apply(around.transform);
        own.in.push_back(std::move(placed));
        own.is_last_itself = true;
      }
      add(*part, own);
      if (compound.operation == Operation::difference) return;
    }
  }

  void add_texture(const Around& part) {
    CutTexture found = {part.texture, part.texture_transform, part.in.empty(), {}};
    if (!part.in.empty()) found.solids.push_back(make_solid(Operation::intersection, part.in));
    for (CutTexture& known : textures_)
      if (known.is_same_as(found)) {
        known.is_everywhere = known.is_everywhere || found.is_everywhere;
        known.solids.insert(known.solids.end(), found.solids.begin(), found.solids.end());
        return;
      }
    // With more textures, the result is an error in any case.
    if (textures_.size() <= std::size_t{kMostMapEntries}) textures_.push_back(std::move(found));
  }

  Session& session_;
  std::vector<CutTexture> textures_;
};

/// Returns the look of a face without any texture: black.
TexturePtr no_texture() {
  auto texture = std::make_shared<TextureDefinition>();
  Finish& finish = texture->finish.own().value;
  finish.ambient = Vec3(0);
  finish.diffuse = 0;
  return texture;
}

/// Returns the mean of textures.
TexturePtr average(Session& session, const std::vector<TexturePtr>& textures, const Location& where) {
  if (textures.empty()) return no_texture();
  if (textures.size() == 1) return textures.front();
  TextureMap map;
  for (const TexturePtr& texture : textures)
    add(session, map, 1, texture, where);
  auto result = std::make_shared<TextureDefinition>();
  choose(result->pattern, average_number());
  return with_map(session, result, map, where);
}

/// Returns a texture that is `inside` at points in one of `solids`, and `outside` elsewhere.
TexturePtr by_place(Session& session, std::vector<ObjectPtr> solids, const TexturePtr& inside,
                    const TexturePtr& outside, const Location& where) {
  TextureMap list;
  add(session, list, 0, outside, where);
  add(session, list, 0, inside, where);
  return with_object(session, std::make_shared<TextureDefinition>(),
                     {make_solid(Operation::union_, std::move(solids)), Transform()}, std::move(list), where);
}

using Textures = std::vector<CutTexture>::const_iterator;

/// Returns the texture of points that are in all of `chosen` and may be in any of [next, end).
TexturePtr all_of(Session& session, Textures next, Textures end, const std::vector<TexturePtr>& chosen,
                  const Location& where) {
  if (next == end) return average(session, chosen, where);
  std::vector<TexturePtr> more = chosen;
  more.push_back(transformed(next->texture, next->transform));
  const TexturePtr inside = all_of(session, next + 1, end, more, where);
  if (next->is_everywhere) return inside;
  return by_place(session, next->solids, inside, all_of(session, next + 1, end, chosen, where), where);
}

/// Returns a texture for points that are in at least one of [begin, end). Each point has one texture, of a
/// shape that contains the point.
TexturePtr one_of(Session& session, Textures begin, Textures end, const Location& where) {
  if (end - begin == 1) return transformed(begin->texture, begin->transform);
  const Textures middle = begin + (end - begin) / 2;
  std::vector<ObjectPtr> solids;
  for (Textures texture = begin; texture != middle; ++texture)
    solids.insert(solids.end(), texture->solids.begin(), texture->solids.end());
  return by_place(session, std::move(solids), one_of(session, begin, middle, where),
                  one_of(session, middle, end, where), where);
}

} // namespace

void set_cutaway_textures(Session& session, ObjectDefinition& object, const Location& where) {
  auto* compound = std::get_if<std::shared_ptr<const Compound>>(&object.shape);
  if (compound == nullptr ||
      ((*compound)->operation != Operation::intersection && (*compound)->operation != Operation::difference))
    session.fail(where, "'cutaway_textures' is for intersections and differences alone");
  if (object.size > session.options.limits.objects) return; // rejected where it is placed
  if (!has_texture(object)) return;                         // all parts have the default texture
  std::vector<CutTexture> textures = CutTextures(session, **compound).all();
  if (textures.size() == 1)
    textures.front().is_everywhere = true; // a point on a face is in the object that is cut
  // If all textures at a point share it, each texture with a limited place adds one level of nested maps, and
  // doubles their number. If one of the textures is chosen instead, the maps nest only as deep as the
  // textures can be halved.
  constexpr std::ptrdiff_t kMostShared = kDeepestMap - 2;
  constexpr std::size_t kMost = std::size_t{1} << (kDeepestMap - 2);
  const auto is_everywhere = [](const CutTexture& texture) { return texture.is_everywhere; };
  const bool are_shared =
      std::count_if(textures.begin(), textures.end(), std::not_fn(is_everywhere)) <= kMostShared;
  if (!are_shared) std::erase_if(textures, is_everywhere);
  if (!are_shared && textures.size() > kMost) {
    const std::string what = "'cutaway_textures' of more than " + std::to_string(kMost) + " textures";
    mark(object.unsupported, std::make_shared<Unsupported>(Unsupported{what, where}));
    return;
  }
  auto changed = std::make_shared<Compound>(**compound);
  changed->cut_texture = are_shared ? all_of(session, textures.begin(), textures.end(), {}, where)
                                    : one_of(session, textures.begin(), textures.end(), where);
  *compound = std::move(changed);
}

} // namespace celltrace::pov

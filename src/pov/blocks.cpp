#include "pov/blocks.hpp"

#include "pov/grammar.hpp"

namespace celltrace::pov {

namespace {

using tokens = Parser::token;

bool is_transformation(int token) {
  return token == tokens::T_TRANSLATE || token == tokens::T_ROTATE || token == tokens::T_SCALE ||
         token == tokens::T_MATRIX || token == tokens::T_TRANSFORM;
}

bool is_of_textures(Block block) {
  return block == Block::pigment || block == Block::normal || block == Block::pattern ||
         block == Block::old_texture;
}

/// Tells blocks in which POV-Ray has patterns and objects that this program does not.
bool is_definition(Block block) {
  switch (block) {
  case Block::settings:
  case Block::finish:
  case Block::interior:
  case Block::material:
  case Block::fog:
  case Block::rainbow:
  case Block::sky_sphere:
  case Block::light_source:
    return true;
  default:
    return false;
  }
}

bool is_fixed(Block block) {
  return block == Block::settings || block == Block::finish || block == Block::interior ||
         block == Block::rainbow;
}

} // namespace

Block block_behind(int terminal) {
  switch (terminal) {
  case tokens::T_GLOBAL_SETTINGS:
    return Block::settings;
  case tokens::T_FINISH:
    return Block::finish;
  case tokens::T_REFLECTION:
    return Block::reflection;
  case tokens::T_IRID:
    return Block::irid;
  case tokens::T_OLD_TEXTURE:
    return Block::old_texture;
  case tokens::T_INTERIOR:
    return Block::interior;
  case tokens::T_MATERIAL:
    return Block::material;
  case tokens::T_FOG:
    return Block::fog;
  case tokens::T_RAINBOW:
    return Block::rainbow;
  case tokens::T_SKY_SPHERE:
    return Block::sky_sphere;
  case tokens::T_CAMERA:
    return Block::camera;
  case tokens::T_LIGHT_SOURCE:
    return Block::light_source;
  case tokens::T_LIGHT_GROUP:
    return Block::light_group;
  case tokens::T_SHAPE:
  case tokens::T_CSG:
  case tokens::T_OBJECT:
  case tokens::T_MESH:
  case tokens::T_TRIANGLE:
  case tokens::T_SMOOTH_TRIANGLE:
  case tokens::T_LOOKS_LIKE:
  case tokens::T_PROJECTED_THROUGH:
    return Block::object;
  case tokens::T_BLOB:
  case tokens::T_LIST_PATTERN: // cubic
  case tokens::T_POLY:
  case tokens::T_QUARTIC:
  case tokens::T_TEXT_OBJECT:
    return Block::object;
  case tokens::T_MESH2:
    return Block::mesh2;
  case tokens::T_BICUBIC_PATCH:
    return Block::bicubic_patch;
  case tokens::T_PICTURE:
    return Block::picture;
  case tokens::T_HEIGHT_FIELD:
    return Block::height_field;
  case tokens::T_PHOTONS:
    return Block::photons;
  case tokens::T_TEXTURE:
  case tokens::T_TEXTURE_MAP:
  case tokens::T_INTERIOR_TEXTURE:
    return Block::pattern;
  case tokens::T_PIGMENT:
  case tokens::T_PIGMENT_MAP:
  case tokens::T_PIGMENT_PATTERN:
    return Block::pigment;
  case tokens::T_NORMAL:
  case tokens::T_NORMAL_MAP:
    return Block::normal;
  case tokens::T_WARP:
    return Block::warp;
  default:
    return Block::none;
  }
}

int terminal_in(Block block, int token) {
  switch (token) {
  case tokens::T_NORMAL:
    return is_definition(block) || block == Block::camera ? tokens::T_UNSUPPORTED : token;
  case tokens::T_PATTERN:
    return is_definition(block) ? tokens::T_UNSUPPORTED : token;
  case tokens::T_UNSUPPORTED_OBJECT:
    return is_definition(block) || is_of_textures(block) ? tokens::T_UNSUPPORTED : token;
  case tokens::T_USER_FUNCTION:
    return is_definition(block) ? tokens::T_UNSUPPORTED : token;
  case tokens::T_WARP:
    return is_of_textures(block) ? token : tokens::T_MISPLACED;
  default:
    return is_transformation(token) && is_fixed(block) ? tokens::T_MISPLACED : token;
  }
}

bool takes(Block block, const Value& named) {
  const bool is_pigment = std::holds_alternative<PigmentPtr>(named);
  const bool is_normal = std::holds_alternative<NormalPtr>(named);
  const bool is_finish = std::holds_alternative<FinishPtr>(named);
  switch (block) {
  case Block::finish:
    return is_finish;
  case Block::pigment:
    return is_pigment;
  case Block::normal:
    return is_normal;
  case Block::pattern:
  case Block::old_texture:
    return is_pigment || is_normal || is_finish;
  case Block::interior:
    return std::holds_alternative<InteriorPtr>(named);
  case Block::material:
    return std::holds_alternative<std::shared_ptr<const MaterialDefinition>>(named);
  case Block::fog:
    return std::holds_alternative<FogPtr>(named);
  case Block::rainbow:
    return std::holds_alternative<RainbowPtr>(named);
  case Block::sky_sphere:
    return std::holds_alternative<SkySpherePtr>(named);
  case Block::camera:
    return std::holds_alternative<std::shared_ptr<const CameraDefinition>>(named);
  default:
    return true;
  }
}

} // namespace celltrace::pov

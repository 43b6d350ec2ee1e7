#include "pov/items.hpp"

#include <algorithm>
#include <iterator>

#include "pov/item_tables.hpp"

namespace celltrace::pov {

namespace {

struct BlockTable {
  Block block;
  Block base;
  std::vector<ItemWord> (*words)();
};

std::vector<ItemWord> no_items() {
  return {};
}

const BlockTable kTables[] = {
    {Block::none, Block::none, no_items},
    {Block::scene, Block::none, scene_items},
    {Block::settings, Block::scene, setting_items},
    {Block::finish, Block::none, finish_items},
    {Block::reflection, Block::none, reflection_items},
    {Block::irid, Block::none, irid_items},
    {Block::old_texture, Block::pattern, old_texture_items},
    {Block::interior, Block::none, interior_items},
    {Block::material, Block::none, no_items},
    {Block::fog, Block::none, fog_items},
    {Block::rainbow, Block::none, rainbow_items},
    {Block::sky_sphere, Block::none, sky_sphere_items},
    {Block::camera, Block::none, camera_items},
    {Block::light_source, Block::none, light_source_items},
    {Block::light_group, Block::none, light_group_items},
    {Block::object, Block::none, object_items},
    {Block::mesh2, Block::object, mesh2_items},
    {Block::bicubic_patch, Block::object, bicubic_patch_items},
    {Block::picture, Block::none, picture_items},
    {Block::height_field, Block::object, height_field_items},
    {Block::photons, Block::none, photons_items},
    {Block::pattern, Block::none, pattern_items},
    {Block::pigment, Block::pattern, pigment_items},
    {Block::normal, Block::pattern, normal_items},
    {Block::warp, Block::none, warp_items},
};

const BlockTable& table_of(Block block) {
  return *std::find_if(std::begin(kTables), std::end(kTables),
                       [&](const BlockTable& table) { return table.block == block; });
}

} // namespace

std::vector<ItemWord> item_words(Block block) {
  return table_of(block).words();
}

Block base_of(Block block) {
  return table_of(block).base;
}

Item item(int row, const Location& where) {
  Item item;
  item.row = row;
  item.where = where;
  return item;
}

Item item(int row, const Location& where, const Quantity& value, const Location& value_where) {
  Item result = item(row, where);
  result.has_value = true;
  result.value = {value, value_where};
  return result;
}

Item item(int row, const Location& where, const ShapeArgument& first, const ShapeArgument& second) {
  Item result = item(row, where, first.value, first.where);
  result.second = std::make_shared<const ShapeArgument>(second);
  return result;
}

} // namespace celltrace::pov

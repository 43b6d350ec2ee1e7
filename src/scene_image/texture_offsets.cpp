// Turns indices of textures into offsets in the image.
#include "records/csg.hpp"
#include "records/offsets.hpp"
#include "scene_image/textures.hpp"

namespace celltrace {

using namespace kernel;

namespace {

template <class Record> void to_offset(std::uint32_t& index, std::uint32_t table) {
  if (index != kNoOffset) index = table + index * static_cast<std::uint32_t>(sizeof(Record));
}

} // namespace

void TextureTables::relocate(const ImageHeader& header) {
  for (SpaceStepRecord& r : steps)
    if (reads_features(r)) r.table = header.feature_offset;
  for (PictureRecord& r : pictures)
    to_offset<TexelTileRecord>(r.tiles, header.texel_tile_offset);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    PatternRecord& r = patterns[i];
    to_offset<MapEntryRecord>(r.entries, header.map_entry_offset);
    to_offset<SpaceStepRecord>(r.steps, header.space_step_offset);
    switch (tables_[i]) {
    case PatternTable::features:
      r.table = header.feature_offset;
      break;
    case PatternTable::gradients:
      r.table = header.gradient_offset;
      break;
    case PatternTable::waves:
      r.table = header.wave_offset;
      break;
    case PatternTable::slopes:
      to_offset<SlopeRecord>(r.table, header.slope_offset);
      break;
    case PatternTable::pigments:
      to_offset<PatternRecord>(r.table, header.pattern_offset);
      break;
    case PatternTable::objects:
      to_offset<CsgRecord>(r.table, header.csg_offset);
      break;
    case PatternTable::functions:
      to_offset<FunctionStepRecord>(r.table, header.function_step_offset);
      break;
    case PatternTable::pictures:
      to_offset<PictureRecord>(r.table, header.picture_offset);
      break;
    case PatternTable::none:
      break;
    }
  }
  for (std::size_t i = 0; i < entries.size(); ++i)
    switch (children_[i]) {
    case Child::pattern:
      to_offset<PatternRecord>(entries[i].child, header.pattern_offset);
      break;
    case Child::normal:
      to_offset<NormalRecord>(entries[i].child, header.normal_offset);
      break;
    case Child::material:
      to_offset<MaterialRecord>(entries[i].child, header.material_offset);
      break;
    case Child::none:
      break;
    }
  for (RainbowRecord& r : rainbows)
    to_offset<MapEntryRecord>(r.entries, header.map_entry_offset);
  for (NormalRecord& r : normals)
    to_offset<PatternRecord>(r.pattern, header.pattern_offset);
  for (MaterialRecord& r : materials) {
    to_offset<PatternRecord>(r.pattern, header.pattern_offset);
    to_offset<NormalRecord>(r.normal, header.normal_offset);
    to_offset<MaterialRecord>(r.below, header.material_offset);
    to_offset<MaterialRecord>(r.inside, header.material_offset);
    to_offset<FinishRecord>(r.finish, header.finish_offset);
  }
}

} // namespace celltrace

// Scene images as bytes: saved with a checksum, loaded with full checks.
#include "celltrace/error.hpp"
#include "celltrace/spe/types.hpp"
#include "records/accelerator.hpp"
#include "records/atmosphere.hpp"
#include "records/light.hpp"
#include "records/material.hpp"
#include "records/mesh.hpp"
#include "records/pattern.hpp"
#include "records/random_tables.hpp"
#include "scene_image/image_checks.hpp"
#include "scene_image/scene_image.hpp"

#include <cstring>
#include <string>

namespace celltrace {

using namespace kernel;

namespace {

/// Returns the FNV-1a hash of 64-bit words; the size of the block is a multiple of a cache line.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xCBF29CE484222325u;
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    if (at != offsetof(ImageHeader, checksum)) std::memcpy(&word, bytes.data() + at, 8);
    sum = (sum ^ word) * 0x100000001B3u;
  }
  return sum;
}

/// Returns true if a table of `count` records at `offset` lies within `bytes` and is aligned.
bool table_fits(std::uint32_t offset, std::uint32_t count, std::size_t record, std::size_t bytes) {
  return offset % kLineBytes == 0 && offset >= sizeof(ImageHeader) && offset <= bytes &&
         std::uint64_t{count} * record <= bytes - offset;
}

} // namespace

std::vector<std::byte> SceneImage::to_bytes() const {
  std::vector<std::byte> bytes(block_.data(), block_.data() + header().bytes);
  const std::uint64_t sum = checksum(bytes);
  std::memcpy(bytes.data() + offsetof(ImageHeader, checksum), &sum, sizeof sum);
  return bytes;
}

SceneImage SceneImage::from_bytes(std::span<const std::byte> bytes) {
  SceneImage image;
  if (bytes.size() < sizeof(ImageHeader)) throw InputError("not a scene image: too short");
  image.block_ = AlignedBlock::uninitialised(bytes.size());
  std::memcpy(image.block_.data(), bytes.data(), bytes.size());
  const ImageHeader& h = image.header();
  if (h.magic != kImageMagic) throw InputError("not a scene image");
  if (h.version != kImageVersion)
    throw InputError("scene image of version " + std::to_string(h.version) + "; this library reads version " +
                     std::to_string(kImageVersion));
  if (h.bytes != bytes.size() || h.bytes % kLineBytes != 0)
    throw InputError("scene image: its size is wrong");
  if (h.checksum != checksum(bytes)) throw InputError("scene image: its checksum is wrong");
  if (!table_fits(h.light_offset, h.light_count, sizeof(LightRecord), bytes.size()) ||
      !table_fits(h.light_word_offset, h.light_word_count, sizeof(std::uint32_t), bytes.size()) ||
      !table_fits(h.material_offset, h.material_count, sizeof(MaterialRecord), bytes.size()) ||
      !table_fits(h.pattern_offset, h.pattern_count, sizeof(PatternRecord), bytes.size()) ||
      !table_fits(h.space_step_offset, h.space_step_count, sizeof(SpaceStepRecord), bytes.size()) ||
      !table_fits(h.map_entry_offset, h.map_entry_count, sizeof(MapEntryRecord), bytes.size()) ||
      !table_fits(h.normal_offset, h.normal_count, sizeof(NormalRecord), bytes.size()) ||
      !table_fits(h.feature_offset, h.feature_count, sizeof(FeatureRecord), bytes.size()) ||
      !table_fits(h.gradient_offset, h.gradient_count, sizeof(GradientRecord), bytes.size()) ||
      !table_fits(h.wave_offset, h.wave_count, sizeof(WaveRecord), bytes.size()) ||
      !table_fits(h.slope_offset, h.slope_count, sizeof(SlopeRecord), bytes.size()) ||
      !table_fits(h.function_step_offset, h.function_step_count, sizeof(FunctionStepRecord), bytes.size()) ||
      !table_fits(h.picture_offset, h.picture_count, sizeof(PictureRecord), bytes.size()) ||
      !table_fits(h.texel_tile_offset, h.texel_tile_count, sizeof(TexelTileRecord), bytes.size()) ||
      !table_fits(h.blend_offset, h.blend_count, sizeof(BlendRecord), bytes.size()) ||
      !table_fits(h.interior_offset, h.interior_count, sizeof(InteriorRecord), bytes.size()) ||
      !table_fits(h.finish_offset, h.finish_count, sizeof(FinishRecord), bytes.size()) ||
      !table_fits(h.fog_offset, h.fog_count, sizeof(FogRecord), bytes.size()) ||
      !table_fits(h.rainbow_offset, h.rainbow_count, sizeof(RainbowRecord), bytes.size()) ||
      !table_fits(h.shape_data_offset, h.shape_data_count, sizeof(ShapeDataRecord), bytes.size()) ||
      !table_fits(h.extra_offset, h.extra_count, sizeof(ExtraRecord), bytes.size()) ||
      !table_fits(h.object_offset, h.object_count, sizeof(ObjectRecord), bytes.size()) ||
      std::uint64_t{h.unbounded_count} + h.projector_count >
          (h.object_offset - sizeof(ImageHeader)) / sizeof(ObjectRecord) ||
      !table_fits(h.csg_offset, h.csg_count, sizeof(CsgRecord), bytes.size()) ||
      !table_fits(h.csg_step_offset, h.csg_step_count, sizeof(CsgStep), bytes.size()) ||
      !table_fits(h.solid_offset, h.solid_count, sizeof(SolidRecord), bytes.size()) ||
      !table_fits(h.mesh_grid_offset, h.mesh_grid_count, sizeof(MeshGridRecord), bytes.size()) ||
      !table_fits(h.mesh_word_offset, h.mesh_word_count, sizeof(std::uint32_t), bytes.size()) ||
      !table_fits(h.mesh_triangle_offset, h.mesh_triangle_count, sizeof(MeshTriangleRecord), bytes.size()) ||
      !table_fits(h.crossed_mesh_offset, h.crossed_mesh_count, sizeof(CrossedMeshRecord), bytes.size()) ||
      !table_fits(h.instance_offset, h.instance_count, sizeof(InstanceRecord), bytes.size()) ||
      !table_fits(h.mesh_object_offset, h.mesh_object_count, sizeof(ObjectRecord), bytes.size()) ||
      !table_fits(h.mesh_node_offset, h.mesh_node_count, sizeof(NodeRecord), bytes.size()) ||
      (h.instance_count != 0 && h.bytes > kInstancedBit) ||
      !table_fits(h.group_offset, h.group_count, sizeof(GroupRecord), bytes.size()) ||
      !table_fits(h.prototype_offset, h.prototype_count, sizeof(std::uint32_t), bytes.size()) ||
      !objects_are_valid(image.base(), h) || !lights_are_valid(image.base(), h) ||
      !textures_are_valid(image.base(), h) || !csg_is_valid(image.base(), h) ||
      !mesh_insides_are_valid(image.base(), h) || !crossed_meshes_are_valid(image.base(), h) ||
      !groups_are_valid(image.base(), h) || !prototypes_are_valid(image.base(), h) ||
      !instances_are_valid(image.base(), h))
    throw InputError("scene image: an offset is out of range");
  return image;
}

} // namespace celltrace
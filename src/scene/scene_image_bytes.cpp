// Scene images as bytes: out with a checksum, in with distrust.
#include "scene/scene_image.hpp"

#include "celltrace/error.hpp"
#include "kernel/lights/list.hpp"
#include "kernel/primitives/list.hpp"

#include <algorithm>
#include <cstring>
#include <string>

namespace celltrace {

using namespace kernel;

namespace {

/// FNV-1a over 64-bit words; the block is a multiple of a line long.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xCBF29CE484222325u;
  for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    if (at != offsetof(ImageHeader, checksum)) std::memcpy(&word, bytes.data() + at, 8);
    sum = (sum ^ word) * 0x100000001B3u;
  }
  return sum;
}

/// True if a table of `count` records at `offset` lies within `bytes` and is aligned.
bool table_fits(std::uint32_t offset, std::uint32_t count, std::size_t record, std::size_t bytes) {
  return offset % kLineBytes == 0 && offset >= sizeof(ImageHeader) && offset <= bytes &&
         std::uint64_t{count} * record <= bytes - offset;
}
/// True if `offset` is that of a record of the table.
bool refers_to(std::uint32_t offset, std::uint32_t table, std::uint32_t count, std::size_t record) {
  return offset >= table && (offset - table) % record == 0 && (offset - table) / record < count;
}

bool needs_extra(std::uint32_t flags) {
  bool has_parameters = false;
  Primitives::dispatch(flags & object_flag::kind_mask,
                       [&](auto shape) { has_parameters = decltype(shape)::kHasParameters; });
  return has_parameters || (flags & (object_flag::smooth | object_flag::csg)) != 0;
}

bool references_are_valid(const std::byte* base, const ImageHeader& h) {
  const auto* objects = reinterpret_cast<const ObjectRecord*>(base + h.object_offset);
  const auto is_material = [&](std::uint32_t offset) {
    return refers_to(offset, h.material_offset, h.material_count, sizeof(MaterialRecord));
  };
  const auto* blends = reinterpret_cast<const BlendRecord*>(base + h.blend_offset);
  for (std::uint32_t i = 0; i < h.blend_count; ++i)
    for (std::uint32_t material : blends[i].material)
      if (!is_material(material)) return false;
  for (std::uint32_t i = 0; i < h.object_count + h.unbounded_count; ++i) {
    const ObjectRecord& object = objects[i];
    const std::uint32_t flags = object.kind_and_flags;
    const bool blended = (flags & object_flag::blended) != 0;
    if ((flags & object_flag::kind_mask) >= kPrimitives) return false;
    if (blended ? !refers_to(object.material, h.blend_offset, h.blend_count, sizeof(BlendRecord))
                : !is_material(object.material))
      return false;
    if (!refers_to(object.interior, h.interior_offset, h.interior_count, sizeof(InteriorRecord)))
      return false;
    if (needs_extra(flags) && !refers_to(object.extra, h.extra_offset, h.extra_count, sizeof(ExtraRecord)))
      return false;
    if ((flags & object_flag::csg) != 0 &&
        !refers_to(reinterpret_cast<const ExtraRecord*>(base + object.extra)->csg, h.csg_offset, h.csg_count,
                   sizeof(CsgRecord)))
      return false;
  }
  return true;
}

bool lights_are_valid(const std::byte* base, const ImageHeader& h) {
  const auto* lights = reinterpret_cast<const LightRecord*>(base + h.light_offset);
  return std::all_of(lights, lights + h.light_count, [](const LightRecord& light) {
    const auto is_count = [](std::uint32_t places) { return places - 1 < kMaxLightPlaces; };
    return (light.kind_and_flags & light_flag::kind_mask) < Lights::kCount &&
           (!has_area(light) ||
            (is_count(light.columns) && is_count(light.rows) && light.columns * light.rows > 1));
  });
}

/// True if conditions end, and so do their programs.
bool csg_is_valid(const std::byte* base, const ImageHeader& h) {
  const auto* records = reinterpret_cast<const CsgRecord*>(base + h.csg_offset);
  for (std::uint32_t i = 0; i < h.csg_count; ++i) {
    const CsgRecord& r = records[i];
    if (r.next != kNoOffset && !refers_to(r.next, h.csg_offset, i, sizeof(CsgRecord))) return false;
    if (!refers_to(r.steps, h.csg_step_offset, h.csg_step_count, sizeof(CsgStep)) ||
        r.count > h.csg_step_count - (r.steps - h.csg_step_offset) / sizeof(CsgStep) ||
        r.skip_begin > r.skip_end || r.skip_end > r.count)
      return false;
    const auto* steps = reinterpret_cast<const CsgStep*>(base + r.steps);
    for (std::uint32_t s = 0; s < r.count; ++s)
      for (const std::uint32_t target : {steps[s].if_inside, steps[s].if_outside})
        if (target < kCsgReject && (target <= s || target >= r.count)) return false;
  }
  const auto* steps = reinterpret_cast<const CsgStep*>(base + h.csg_step_offset);
  for (std::uint32_t i = 0; i < h.csg_step_count; ++i)
    if (!refers_to(steps[i].solid, h.solid_offset, h.solid_count, sizeof(SolidRecord))) return false;
  return true;
}

/// True if there are no groups, or each object is in one.
bool groups_are_valid(const std::byte* base, const ImageHeader& h) {
  const auto* groups = reinterpret_cast<const GroupRecord*>(base + h.group_offset);
  std::uint32_t objects = 0;
  std::uint32_t longest = 0;
  for (std::uint32_t i = 0; i < h.group_count; ++i) {
    if (groups[i].first != objects || groups[i].count == 0 || groups[i].count > h.object_count - objects)
      return false;
    objects += groups[i].count;
    longest = std::max(longest, groups[i].count);
  }
  return (h.group_count == 0 || objects == h.object_count) && longest == h.longest_group;
}

/// True if there are no copies, or each of them and its prototype are of one number of objects, and not many.
/// The groups are valid.
bool prototypes_are_valid(const std::byte* base, const ImageHeader& h) {
  if (h.prototype_count == 0) return true;
  if (h.prototype_count != h.group_count) return false;
  const auto* groups = reinterpret_cast<const GroupRecord*>(base + h.group_offset);
  const auto* prototypes = reinterpret_cast<const std::uint32_t*>(base + h.prototype_offset);
  for (std::uint32_t i = 0; i < h.group_count; ++i) {
    const std::uint32_t prototype = prototypes[i];
    if (prototype == kNoGroup) continue;
    if (prototype > i || prototypes[prototype] != prototype || groups[prototype].count != groups[i].count ||
        groups[i].count > kMaxCopiedObjects)
      return false;
  }
  return true;
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
      !table_fits(h.material_offset, h.material_count, sizeof(MaterialRecord), bytes.size()) ||
      !table_fits(h.blend_offset, h.blend_count, sizeof(BlendRecord), bytes.size()) ||
      !table_fits(h.interior_offset, h.interior_count, sizeof(InteriorRecord), bytes.size()) ||
      !table_fits(h.extra_offset, h.extra_count, sizeof(ExtraRecord), bytes.size()) ||
      h.unbounded_count > 0xFFFFFFFFu - h.object_count ||
      !table_fits(h.object_offset, h.object_count + h.unbounded_count, sizeof(ObjectRecord), bytes.size()) ||
      !table_fits(h.csg_offset, h.csg_count, sizeof(CsgRecord), bytes.size()) ||
      !table_fits(h.csg_step_offset, h.csg_step_count, sizeof(CsgStep), bytes.size()) ||
      !table_fits(h.solid_offset, h.solid_count, sizeof(SolidRecord), bytes.size()) ||
      !table_fits(h.group_offset, h.group_count, sizeof(GroupRecord), bytes.size()) ||
      !table_fits(h.prototype_offset, h.prototype_count, sizeof(std::uint32_t), bytes.size()) ||
      !references_are_valid(image.base(), h) || !lights_are_valid(image.base(), h) ||
      !csg_is_valid(image.base(), h) || !groups_are_valid(image.base(), h) ||
      !prototypes_are_valid(image.base(), h))
    throw InputError("scene image: an offset is out of range");
  return image;
}

} // namespace celltrace

#include "scene/scene_image.hpp"

#include "celltrace/error.hpp"
#include "scene/image_builder.hpp"

#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>

namespace celltrace {

using namespace kernel;

namespace {

constexpr std::uint32_t kMagic = 0x43545349; // "CTSI"
constexpr std::uint32_t kVersion = 1;

std::size_t round_up(std::size_t bytes) {
  return (bytes + kLineBytes - 1) / kLineBytes * kLineBytes;
}

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

/// Appends tables to a block whose size is known beforehand.
class Layout {
public:
  explicit Layout(std::size_t begin) : end_(begin) {}
  template <class Record> std::uint32_t place(const std::vector<Record>& table) {
    const std::size_t offset = end_;
    end_ = round_up(end_ + table.size() * sizeof(Record));
    if (end_ > std::numeric_limits<std::uint32_t>::max())
      throw InputError("the scene is too large: its image would pass 4 GB");
    return static_cast<std::uint32_t>(offset);
  }
  std::size_t end() const { return end_; }

private:
  std::size_t end_;
};

template <class Record>
void copy_table(std::byte* base, std::uint32_t offset, const std::vector<Record>& table) {
  if (!table.empty()) std::memcpy(base + offset, table.data(), table.size() * sizeof(Record));
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

bool references_are_valid(const std::byte* base, const ImageHeader& h) {
  const auto* objects = reinterpret_cast<const ObjectRecord*>(base + h.object_offset);
  const auto is_material = [&](std::uint32_t offset) {
    return refers_to(offset, h.material_offset, h.material_count, sizeof(MaterialRecord));
  };
  const auto* blends = reinterpret_cast<const BlendRecord*>(base + h.blend_offset);
  for (std::uint32_t i = 0; i < h.blend_count; ++i)
    for (std::uint32_t material : blends[i].material)
      if (!is_material(material)) return false;
  for (std::uint32_t i = 0; i < h.object_count; ++i) {
    const ObjectRecord& object = objects[i];
    const std::uint32_t flags = object.kind_and_flags;
    const bool blended = (flags & object_flag::blended) != 0;
    if ((flags & object_flag::kind_mask) > static_cast<std::uint32_t>(ObjectKind::triangle)) return false;
    if (blended ? !refers_to(object.material, h.blend_offset, h.blend_count, sizeof(BlendRecord))
                : !is_material(object.material))
      return false;
    if (!refers_to(object.interior, h.interior_offset, h.interior_count, sizeof(InteriorRecord)))
      return false;
    if ((flags & object_flag::smooth) != 0 &&
        !refers_to(object.normals, h.normals_offset, h.normals_count, sizeof(NormalsRecord)))
      return false;
  }
  return true;
}

} // namespace

SceneImage::SceneImage(const Scene& scene) {
  validate(scene);
  ImageTables tables = build_tables(scene);

  Layout layout(sizeof(ImageHeader));
  ImageHeader header{};
  header.magic = kMagic;
  header.version = kVersion;
  header.light_offset = layout.place(tables.lights);
  header.light_count = static_cast<std::uint32_t>(tables.lights.size());
  header.material_offset = layout.place(tables.materials);
  header.material_count = static_cast<std::uint32_t>(tables.materials.size());
  header.blend_offset = layout.place(tables.blends);
  header.blend_count = static_cast<std::uint32_t>(tables.blends.size());
  header.interior_offset = layout.place(tables.interiors);
  header.interior_count = static_cast<std::uint32_t>(tables.interiors.size());
  header.normals_offset = layout.place(tables.normals);
  header.normals_count = static_cast<std::uint32_t>(tables.normals.size());
  header.object_offset = layout.place(tables.objects);
  header.object_count = static_cast<std::uint32_t>(tables.objects.size());
  header.bytes = layout.end();
  for (int i = 0; i < 3; ++i) {
    header.bounds_min[i] = tables.bounds.min[i];
    header.bounds_max[i] = tables.bounds.max[i];
  }
  make_offsets(tables, header);

  block_ = AlignedBlock(layout.end());
  std::byte* base = block_.data();
  copy_table(base, header.light_offset, tables.lights);
  copy_table(base, header.material_offset, tables.materials);
  copy_table(base, header.blend_offset, tables.blends);
  copy_table(base, header.interior_offset, tables.interiors);
  copy_table(base, header.normals_offset, tables.normals);
  copy_table(base, header.object_offset, tables.objects);
  std::memcpy(base, &header, sizeof(header));
  header.checksum = checksum({base, layout.end()});
  std::memcpy(base, &header, sizeof(header));
}

SceneImage SceneImage::from_bytes(std::span<const std::byte> bytes) {
  SceneImage image;
  if (bytes.size() < sizeof(ImageHeader)) throw InputError("not a scene image: too short");
  image.block_ = AlignedBlock(bytes.size());
  std::memcpy(image.block_.data(), bytes.data(), bytes.size());
  const ImageHeader& h = image.header();
  if (h.magic != kMagic) throw InputError("not a scene image");
  if (h.version != kVersion)
    throw InputError("scene image of version " + std::to_string(h.version) + "; this library reads version " +
                     std::to_string(kVersion));
  if (h.bytes != bytes.size() || h.bytes % kLineBytes != 0)
    throw InputError("scene image: its size is wrong");
  if (h.checksum != checksum(bytes)) throw InputError("scene image: its checksum is wrong");
  if (!table_fits(h.light_offset, h.light_count, sizeof(LightRecord), bytes.size()) ||
      !table_fits(h.material_offset, h.material_count, sizeof(MaterialRecord), bytes.size()) ||
      !table_fits(h.blend_offset, h.blend_count, sizeof(BlendRecord), bytes.size()) ||
      !table_fits(h.interior_offset, h.interior_count, sizeof(InteriorRecord), bytes.size()) ||
      !table_fits(h.normals_offset, h.normals_count, sizeof(NormalsRecord), bytes.size()) ||
      !table_fits(h.object_offset, h.object_count, sizeof(ObjectRecord), bytes.size()) ||
      !references_are_valid(image.base(), h))
    throw InputError("scene image: an offset is out of range");
  return image;
}

void SceneImage::reserve_accelerator(std::uint64_t table_bytes, std::uint32_t list_words) {
  const std::size_t begin = header().bytes;
  const std::size_t lists = round_up(begin + table_bytes);
  const std::size_t end = round_up(lists + std::size_t{list_words} * sizeof(std::uint32_t));
  if (end > std::numeric_limits<std::uint32_t>::max())
    throw InputError("the scene is too large: its image would pass 4 GB");
  if (end > block_.size()) {
    AlignedBlock larger(end);
    std::memcpy(larger.data(), block_.data(), begin);
    block_ = std::move(larger);
  }
  table_offset_ = static_cast<std::uint32_t>(begin);
  list_offset_ = static_cast<std::uint32_t>(lists);
}

const ImageHeader& SceneImage::header() const noexcept {
  return *reinterpret_cast<const ImageHeader*>(block_.data());
}

std::span<const std::byte> SceneImage::static_part() const noexcept {
  return {block_.data(), static_cast<std::size_t>(header().bytes)};
}

} // namespace celltrace

// What SPEs of another byte order read and write, by a reader that knows only where a field lies.
#include "celltrace/spe/machine.hpp"
#include "render/models/stage_fields.hpp"
#include "render/scenes.hpp"
#include "render/work_plan.hpp"
#include "scene_image/image_fields.hpp"
#include "scene_image/shared_image.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <random>

using namespace celltrace;
using namespace celltrace::kernel;
using namespace celltrace::kernel::models;
using namespace celltrace::test;

namespace {

constexpr std::endian kForeign =
    std::endian::native == std::endian::little ? std::endian::big : std::endian::little;

/// A number of T's width in the byte order that is not the host's.
template <class T> T foreign(const void* memory, std::size_t at) {
  std::byte bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[i] = static_cast<const std::byte*>(memory)[at + sizeof(T) - 1 - i];
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}
const std::byte* at_ea(ea_t ea) {
  return reinterpret_cast<const std::byte*>(static_cast<std::uintptr_t>(ea));
}

template <class Record> Record random_record() {
  static std::mt19937 random(1);
  Record record;
  auto* bytes = reinterpret_cast<std::byte*>(&record);
  for (std::size_t i = 0; i < sizeof record; ++i)
    bytes[i] = static_cast<std::byte>(random());
  return record;
}

template <class Record> bool same_bytes(const Record& a, const Record& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace

TEMPLATE_TEST_CASE("Records survive the way to another byte order and back", "", ImageHeader, ObjectRecord,
                   ExtraRecord, BlendRecord, MaterialRecord, FinishRecord, InteriorRecord, FogRecord,
                   LightRecord, GroupRecord, CellRecord, NodeRecord, CameraRecord, GridRecord, BvhRecord,
                   FrameBlock, UnitRecord, StripRecord, ReportRecord, StageBlock, StageReport, SpeAddresses) {
  STATIC_REQUIRE(HasFields<TestType>);
  const auto record = random_record<TestType>();
  TestType there = record;
  reverse_bytes(there);
  CHECK_FALSE(same_bytes(there, record));
  reverse_bytes(there);
  CHECK(same_bytes(there, record));
}

TEST_CASE("Numbers of every width are converted in their places") {
  UnitRecord unit{0x0102, 0x0304, 0x05060708};
  reverse_bytes(unit);
  CHECK(foreign<std::uint16_t>(&unit, 0) == 0x0102);
  CHECK(foreign<std::uint16_t>(&unit, 2) == 0x0304);
  CHECK(foreign<std::uint32_t>(&unit, 4) == 0x05060708);

  FrameBlock frame{};
  frame.camera.dy[2] = 1.5f;
  frame.grid.cells[2] = 77;
  frame.image = 0x0102030405060708;
  frame.work_memory[1] = 0x1112131415161718;
  frame.adc_bailout = 0.25f;
  frame.camera_interiors[7] = 0x21222324;
  reverse_bytes(frame);
  CHECK(foreign<float>(&frame, offsetof(FrameBlock, camera) + offsetof(CameraRecord, dy) + 8) == 1.5f);
  CHECK(foreign<std::uint32_t>(&frame, offsetof(FrameBlock, grid) + offsetof(GridRecord, cells) + 8) == 77);
  CHECK(foreign<ea_t>(&frame, offsetof(FrameBlock, image)) == 0x0102030405060708);
  CHECK(foreign<ea_t>(&frame, offsetof(FrameBlock, work_memory) + 8) == 0x1112131415161718);
  CHECK(foreign<float>(&frame, offsetof(FrameBlock, adc_bailout)) == 0.25f);
  CHECK(foreign<std::uint32_t>(&frame, offsetof(FrameBlock, camera_interiors) + 28) == 0x21222324);

  StageBlock orders{};
  orders.jobs = 0x0102030405060708;
  orders.tasks = 0x11121314;
  orders.tester[5] = 0x21;
  reverse_bytes(orders);
  CHECK(foreign<ea_t>(&orders, offsetof(StageBlock, jobs)) == 0x0102030405060708);
  CHECK(foreign<std::uint32_t>(&orders, offsetof(StageBlock, tasks)) == 0x11121314);
  CHECK(orders.tester[5] == 0x21);
}

TEST_CASE("A scene image is the same in another byte order") {
  for (const NamedScene& named : scenes()) {
    INFO(named.name);
    SceneImage image(named.make());
    image.reserve_accelerator(3 * sizeof(NodeRecord), 50);
    // As if there were an accelerator.
    auto* const behind = const_cast<std::byte*>(image.base()) + image.table_offset();
    for (std::uint32_t at = 0; at < image.end_offset() - image.table_offset(); ++at)
      behind[at] = static_cast<std::byte>(at * 7);

    SharedImage shared(image, kForeign);
    shared.publish_all();
    REQUIRE(shared.ea() % kLineBytes == 0);
    REQUIRE(shared.ea() != to_ea(image.base()));
    const std::byte* const there = at_ea(shared.ea());
    CHECK(foreign<std::uint64_t>(there, offsetof(ImageHeader, bytes)) == image.header().bytes);
    CHECK(foreign<std::uint32_t>(there, offsetof(ImageHeader, object_count)) == image.header().object_count);
    bool same = true;
    for (std::uint32_t at = sizeof(ImageHeader); at < image.end_offset(); at += 4) {
      std::uint32_t word;
      std::memcpy(&word, image.base() + at, 4);
      same = same && foreign<std::uint32_t>(there, at) == word;
    }
    CHECK(same);
  }
}

TEST_CASE("A scene image is shared as it is where byte orders agree") {
  SceneImage image(scene_named("meshes"));
  image.reserve_accelerator(128, 1);
  SharedImage shared(image, std::endian::native);
  shared.publish_static();
  CHECK(shared.ea() == to_ea(image.base()));
  image.reserve_accelerator(1 << 20, 1);
  shared.publish_all();
  CHECK(shared.ea() == to_ea(image.base()));
}

TEST_CASE("Plans are read, and learn, in another byte order") {
  constexpr std::uint32_t columns = 100, rows = 75, spes = 8;
  WorkPlan here(Balance::gde, columns, rows, spes);
  WorkPlan there(Balance::gde, columns, rows, spes, kForeign);
  for (int round = 0; round < 3; ++round) {
    FrameBlock near{}, far{};
    here.place(near);
    there.place(far);
    REQUIRE(far.unit_count == near.unit_count);
    const auto* const units = reinterpret_cast<const UnitRecord*>(at_ea(near.units));
    const auto* const strips = reinterpret_cast<const StripRecord*>(at_ea(near.strips));
    bool same = true;
    for (std::uint32_t i = 0; i < near.unit_count; ++i)
      same = same && foreign<std::uint16_t>(at_ea(far.units), i * 8) == units[i].column &&
             foreign<std::uint16_t>(at_ea(far.units), i * 8 + 2) == units[i].row &&
             foreign<std::uint32_t>(at_ea(far.units), i * 8 + 4) == units[i].bundles;
    for (std::uint32_t spe = 0; spe < spes; ++spe)
      same = same && foreign<std::uint32_t>(at_ea(far.strips), spe * 16) == strips[spe].begin &&
             foreign<std::uint32_t>(at_ea(far.strips), spe * 16 + 4) == strips[spe].end;
    CHECK(same);
    auto* const costs = reinterpret_cast<std::uint32_t*>(static_cast<std::uintptr_t>(near.costs));
    auto* const far_costs = reinterpret_cast<std::uint32_t*>(static_cast<std::uintptr_t>(far.costs));
    for (std::uint32_t i = 0; i < near.unit_count; ++i) {
      costs[i] = i % 13 * 300;
      far_costs[i] = foreign<std::uint32_t>(&costs[i], 0);
    }
    here.learn();
    there.learn();
  }
}

// Records that PPE and SPEs share, in one byte order and in two.
#include "celltrace/spe/shared_records.hpp"

#include <catch2/catch.hpp>

#include <vector>

namespace celltrace::test {

struct alignas(16) Task {
  ea_t blocks;
  std::uint32_t count;
  float scale;
};
FieldList<&Task::blocks, &Task::count, &Task::scale> fields_of(const Task&);

namespace {

constexpr std::endian kForeign =
    std::endian::native == std::endian::little ? std::endian::big : std::endian::little;

Task& as_spes_see(const SharedRecords<Task>& tasks, std::size_t index) {
  return *reinterpret_cast<Task*>(static_cast<std::uintptr_t>(tasks.ea(index)));
}

TEST_CASE("records say of themselves whether they are words") {
  STATIC_REQUIRE(HasFields<Task>);
  STATIC_REQUIRE_FALSE(HasFields<float>);
  STATIC_REQUIRE_FALSE(consists_of_words<Task>());
  STATIC_REQUIRE(consists_of_words<float[3][4]>());
  STATIC_REQUIRE_FALSE(consists_of_words<std::uint16_t[2]>());
}

TEST_CASE("numbers of every width reverse") {
  std::uint8_t byte = 0x12;
  std::uint16_t half = 0x1234;
  std::uint32_t words[2] = {0x12345678, 0x9ABCDEF0};
  std::uint64_t wide = 0x0102030405060708;
  float number = 1.0f;
  reverse_bytes(byte);
  reverse_bytes(half);
  reverse_bytes(words);
  reverse_bytes(wide);
  reverse_bytes(number);
  CHECK(byte == 0x12);
  CHECK(half == 0x3412);
  CHECK(words[0] == 0x78563412);
  CHECK(words[1] == 0xF0DEBC9A);
  CHECK(wide == 0x0807060504030201);
  CHECK(std::bit_cast<std::uint32_t>(number) == 0x0000803F);
}

TEST_CASE("SPEs of the host's byte order share the PPE's own records") {
  SharedRecords<Task> tasks(3, std::endian::native);
  CHECK(tasks.ea() % kLineBytes == 0);
  CHECK(&as_spes_see(tasks, 2) == &tasks[2]);
  tasks[2].count = 7;
  tasks.publish();
  tasks.fetch();
  CHECK(as_spes_see(tasks, 2).count == 7);
}

TEST_CASE("SPEs of another byte order have records of their own") {
  SharedRecords<Task> tasks(3, kForeign);
  CHECK(tasks.ea() % kLineBytes == 0);
  CHECK(tasks.ea(2) - tasks.ea() == 2 * sizeof(Task));
  tasks[2] = {0x0102030405060708, 0x11121314, 1.0f};
  CHECK(as_spes_see(tasks, 2).count == 0);
  tasks.publish();
  CHECK(as_spes_see(tasks, 2).blocks == 0x0807060504030201);
  CHECK(as_spes_see(tasks, 2).count == 0x14131211);

  as_spes_see(tasks, 1).count = 0x01000000;
  CHECK(tasks[1].count == 0);
  tasks.fetch();
  CHECK(tasks[1].count == 1);
  CHECK(tasks[2].scale == 1.0f);

  tasks.clear();
  CHECK(as_spes_see(tasks, 2).count == 0);
  CHECK(tasks[1].count == 0);
  tasks.assign(std::vector<Task>(100, Task{1, 2, 3}));
  CHECK(tasks.size() == 100);
  CHECK(as_spes_see(tasks, 99).count == 0x02000000);
}

TEST_CASE("There may be no records to convert") {
  SharedRecords<Task> tasks(0, kForeign);
  tasks.publish();
  tasks.fetch();
  tasks.assign({});
  CHECK(tasks.size() == 0);
}

} // namespace
} // namespace celltrace::test

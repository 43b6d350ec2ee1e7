// What takes a reservation away on the emulated Cell, and what says so (event 0x400).
#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

const std::string kEmulator = "cell_emu";

struct alignas(128) Line {
  std::uint32_t word[32];
};
struct Lines {
  Line reserved;
  Line other;
  std::uint32_t events;
  bool written;
};

/// SPE 0 reserves a line, then does `Act`; was the event raised, and does putllc still write?
template <class Act> Lines after(Act) {
  Lines lines{};
  const auto kernel = [](auto& spu, ea_t argument) {
    Lines& data = at<Lines>(argument);
    auto* line = spu.template allocate<Line>();
    spu.write_event_mask(event::reservation_lost);
    spu.getllar(line, to_ea(&data.reserved));
    Act{}(spu, data, line);
    data.events = spu.event_count() != 0 ? spu.read_event_status() : 0;
    data.written = spu.putllc(line, to_ea(&data.reserved));
  };
  run_on(kEmulator, 1, kernel, to_ea(&lines));
  return lines;
}

TEST_CASE("nothing happens: the reservation holds") {
  const Lines lines = after([](auto&, Lines&, Line*) {});
  CHECK(lines.events == 0);
  CHECK(lines.written);
}

TEST_CASE("an own plain put of the line loses it, with the event") {
  const Lines lines = after([](auto& spu, Lines& data, Line* line) {
    spu.put(line, to_ea(&data.reserved) + 112, 16, 0);
    spu.wait_all(1);
  });
  CHECK(lines.events == event::reservation_lost);
  CHECK_FALSE(lines.written);
}

TEST_CASE("an own put next to the line leaves it") {
  const Lines lines = after([](auto& spu, Lines& data, Line* line) {
    spu.put(line, to_ea(&data.other), 128, 0);
    spu.wait_all(1);
  });
  CHECK(lines.events == 0);
  CHECK(lines.written);
}

TEST_CASE("an own putlluc of the line loses it without the event") {
  const Lines lines =
      after([](auto& spu, Lines& data, Line* line) { spu.putlluc(line, to_ea(&data.reserved)); });
  CHECK(lines.events == 0);
  CHECK_FALSE(lines.written);
}

TEST_CASE("own lock-line commands on another line replace it or lose it without the event") {
  const Lines replaced =
      after([](auto& spu, Lines& data, Line* line) { spu.getllar(line, to_ea(&data.other)); });
  CHECK(replaced.events == 0);
  CHECK_FALSE(replaced.written);
  const Lines lost = after([](auto& spu, Lines& data, Line* line) { spu.putllc(line, to_ea(&data.other)); });
  CHECK(lost.events == 0);
  CHECK_FALSE(lost.written);
}

TEST_CASE("any write by another SPE loses it, with the event") {
  const std::uint32_t how = GENERATE(0u, 1u, 2u, 3u);
  CAPTURE(how);
  Lines lines{};
  lines.other.word[0] = how;
  const auto kernel = [](auto& spu, ea_t argument) {
    Lines& data = at<Lines>(argument);
    const ea_t reserved = to_ea(&data.reserved);
    const std::uint32_t way = data.other.word[0];
    auto* line = spu.template allocate<Line>();
    if (spu.id() == 1) {
      spu.read_signal_1();
      if (way == 0) spu.put(line, reserved, 16, 0);
      if (way == 1) spu.putlluc(line, reserved);
      if (way == 2) spu.putqlluc(line, reserved, 0);
      if (way == 3) {
        spu.getllar(line, reserved);
        if (!spu.putllc(line, reserved)) spu.halt(HaltCode::internal_error);
      }
      return;
    }
    spu.write_event_mask(event::reservation_lost);
    spu.getllar(line, reserved);
    spu.send_signal(1, Signal::one, 1);
    data.events = spu.read_event_status();
    data.written = spu.putllc(line, reserved);
  };
  run_on(kEmulator, 2, kernel, to_ea(&lines));
  CHECK(lines.events == event::reservation_lost);
  CHECK_FALSE(lines.written);
}

TEST_CASE("a reservation ends with its kernel") {
  Lines lines{};
  const auto machine = machine_of(kEmulator, 1);
  const auto reserve = [](auto& spu, ea_t argument) { spu.getllar(spu.template allocate<Line>(), argument); };
  const auto write = [](auto& spu, ea_t argument) {
    at<Lines>(argument).written = spu.putllc(spu.template allocate<Line>(), argument);
  };
  lines.written = true;
  run_on(kEmulator, *machine, reserve, to_ea(&lines), [](Machine&) {});
  run_on(kEmulator, *machine, write, to_ea(&lines), [](Machine&) {});
  CHECK_FALSE(lines.written);
}

} // namespace
} // namespace celltrace::test

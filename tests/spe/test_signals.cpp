#include "spe/run_on.hpp"

namespace celltrace::test {
namespace {

TEST_CASE("a token goes round by signals") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  std::uint32_t found[4] = {};
  const auto pass_token = [](auto& spu, ea_t argument) {
    const std::uint32_t right = (spu.id() + 1) % spu.count();
    for (std::uint32_t round = 0; round < 50; ++round) {
      const std::uint32_t token = spu.read_signal_1();
      at<std::uint32_t[4]>(argument)[spu.id()] = token;
      if (spu.id() + 1 < spu.count() || round < 49) spu.send_signal(right, Signal::one, token + 1);
    }
  };
  const auto machine = machine_of(key, 4);
  run_on(key, *machine, pass_token, to_ea(&found), [](Machine& ppe) { ppe.write_signal(0, Signal::one, 1); });
  for (std::uint32_t spe = 0; spe < 4; ++spe)
    CHECK(found[spe] == 49 * 4 + spe + 1);
  CHECK(machine->statistics(0).signals_sent == 50);
}

TEST_CASE("a register overwrites or collects, by its mode") {
  const std::string key = GENERATE(from_range(spu_keys()));
  CAPTURE(key);
  MachineConfig config;
  config.signal_mode[0] = SignalMode::logical_or;
  config.signal_mode[1] = SignalMode::overwrite;
  const auto machine = machine_of(key, 1, config);
  for (const Signal which : {Signal::one, Signal::two}) {
    machine->write_signal(0, which, 0x1);
    machine->write_signal(0, which, 0x4);
  }
  std::uint32_t found[6] = {};
  const auto read = [](auto& spu, ea_t argument) {
    auto& seen = at<std::uint32_t[6]>(argument);
    seen[0] = spu.signal_1_count();
    seen[1] = spu.read_signal_1();
    seen[2] = spu.signal_1_count();
    seen[3] = spu.signal_2_count();
    seen[4] = spu.read_signal_2();
    spu.send_signal(0, Signal::one, 0x10);
    seen[5] = spu.read_signal_1();
  };
  run_on(key, *machine, read, to_ea(&found), [](Machine&) {});
  CHECK(found[0] == 1);
  CHECK(found[1] == 0x5);
  CHECK(found[2] == 0);
  CHECK(found[3] == 1);
  CHECK(found[4] == 0x4);
  CHECK(found[5] == 0x10);
}

} // namespace
} // namespace celltrace::test

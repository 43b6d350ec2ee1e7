#include <celltrace/emulator.hpp>

#include <catch2/catch.hpp>

TEST_CASE("a get brings the data") {
  alignas(128) float data[32] = {1, 2, 3};
  const auto run = celltrace::emulate(celltrace::lockstep(1), [&](celltrace::EmulatedSpu& spu) {
    float* buffer = spu.allocate<float>(32);
    spu.get(buffer, celltrace::to_ea(data), sizeof data, 0);
    spu.wait_all(1 << 0);
    CHECK(buffer[2] == 3);
  });
  CHECK(run.ok());
}

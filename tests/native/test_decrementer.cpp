#include "backends/native/decrementer.hpp"

#include <catch2/catch.hpp>

#include <thread>

using celltrace::native::Decrementer;

TEST_CASE("the decrementer counts down, wraps and expires once") {
  Decrementer decrementer;
  CHECK_FALSE(decrementer.take_expiry());
  decrementer.write(1000000000);
  CHECK(decrementer.read() <= 1000000000);
  CHECK_FALSE(decrementer.take_expiry());

  decrementer.write(0);
  std::this_thread::sleep_until(decrementer.next_expiry());
  CHECK(decrementer.read() > 0x80000000u);
  CHECK(decrementer.take_expiry());
  CHECK_FALSE(decrementer.take_expiry());
}

TEST_CASE("a stopped decrementer keeps its value until it is written") {
  Decrementer decrementer;
  decrementer.write(5000);
  decrementer.stop();
  const auto value = decrementer.read();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(decrementer.read() == value);
  CHECK_FALSE(decrementer.counts());
}

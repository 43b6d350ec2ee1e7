#include "cli/interrupt.hpp"
#include "cli/progress_line.hpp"

#include <csignal>
#include <sstream>

#include <catch2/catch.hpp>

using namespace celltrace::cli;

TEST_CASE("the progress line says how far and how long") {
  CHECK(progress_text(0, 0, {}) == "  0 %  0:00");
  CHECK(progress_text(0.5, 65, 65) == " 50 %  1:05, 1:05 to go");
  CHECK(progress_text(1, 3600, 0) == "100 %  60:00, 0:00 to go");
}

TEST_CASE("time to go is what an even job still takes") {
  RemainingTime to_go;
  CHECK(!to_go.at(0));
  to_go.learn(0, 0);
  to_go.learn(0.05, 0.5);
  CHECK(!to_go.at(0.5)); // too early
  for (int second = 1; second <= 10; ++second) {
    to_go.learn(0.1 * second, second);
    CHECK(*to_go.at(second) == Approx(10 - second).margin(0.01));
  }
}

TEST_CASE("time to go runs down while nothing is heard, and never to nothing") {
  RemainingTime to_go;
  to_go.learn(0, 0);
  to_go.learn(0.5, 10);
  CHECK(*to_go.at(10) == Approx(10));
  CHECK(*to_go.at(13) == Approx(7)); // and not 13
  CHECK(*to_go.at(40) > 10);
  // What comes late moves it by a part.
  to_go.learn(0.51, 14);
  CHECK(*to_go.at(14) < 10);
  CHECK(*to_go.at(14) > 6);
}

TEST_CASE("time to go of a job that goes on leaves out what was done before") {
  RemainingTime to_go;
  to_go.learn(0.8, 0);
  to_go.learn(0.9, 30);
  CHECK(*to_go.at(30) == Approx(30));
}

TEST_CASE("a visible progress line wipes itself, an invisible one writes nothing") {
  std::ostringstream shown, hidden;
  {
    ProgressLine line(shown, true), none(hidden, false);
    line.update(0.25);
    none.update(0.25);
    CHECK(shown.str() == "\r\x1b[K 25 %  0:00");
  }
  CHECK(shown.str() == "\r\x1b[K 25 %  0:00\r\x1b[K");
  CHECK(hidden.str().empty());
}

TEST_CASE("a progress line names its job, waits, and makes room") {
  std::ostringstream shown, late;
  ProgressLine line(shown, true, "reading "), patient(late, true, "reading ", std::chrono::hours(1));
  line.update(0.5);
  line.wipe();
  line.wipe();
  CHECK(shown.str() == "\r\x1b[Kreading  50 %  0:00\r\x1b[K");
  patient.update(0.5);
  CHECK(late.str().empty());
}

TEST_CASE("the first interrupt is only noted") {
  catch_interrupts();
  CHECK_FALSE(interrupted());
  std::raise(SIGINT);
  CHECK(interrupted());
  std::signal(SIGTERM, SIG_DFL);
}

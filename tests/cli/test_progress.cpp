#include "cli/interrupt.hpp"
#include "cli/progress_line.hpp"

#include <csignal>
#include <sstream>

#include <catch2/catch.hpp>

using namespace celltrace::cli;
using std::chrono::seconds;

TEST_CASE("the progress line says how far and how long") {
  CHECK(progress_text(0, seconds(0)) == "  0 %  0:00");
  CHECK(progress_text(0.5, seconds(65)) == " 50 %  1:05, 1:05 to go");
  CHECK(progress_text(1, seconds(3600)) == "100 %  60:00, 0:00 to go");
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

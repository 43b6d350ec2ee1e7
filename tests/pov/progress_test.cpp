// Progress of a parse while it runs, and how a parse is stopped.
#include <catch2/catch.hpp>

#include "celltrace/error.hpp"
#include "pov/parsing.hpp"

using namespace celltrace;
using test::parse;
using test::repeated;

namespace {

void check_progress(const std::string& text) {
  ParseOptions options;
  std::uint64_t last = 0;
  int calls = 0, steps = 0;
  options.progress = [&](std::uint64_t bytes, std::uint64_t total) {
    CHECK(total == text.size());
    CHECK(bytes >= last);
    CHECK(bytes <= total);
    steps += bytes > last;
    last = bytes;
    ++calls;
    return true;
  };
  parse(text, options);
  CHECK(calls > 3);
  CHECK(steps > 2);
}

} // namespace

TEST_CASE("a long scene says how far it has been read") {
  check_progress(repeated("sphere { <1, 2, 3>, 0.5 }\n", 20000));
  check_progress("mesh2 { vertex_vectors { 200000, " +
                 repeated("<1, 2, 3>,\n<2, 2, 3>,\n<2, 4, 3>,\n<2, 2, 5>,\n", 50000) +
                 "} face_indices { 1, <0, 1, 2> } } sphere { 0, 1 }");
}

TEST_CASE("a parse can be stopped before it starts, in a list and in a loop") {
  const auto stop_after = [](int calls, const std::string& text) {
    ParseOptions options;
    options.progress = [calls](std::uint64_t, std::uint64_t) mutable { return calls-- > 0; };
    CHECK_THROWS_AS(parse(text, options), Cancelled);
  };
  stop_after(0, "sphere { 0, 1 }");
  stop_after(1, "mesh2 { vertex_vectors { 200000, " + repeated("<1, 2, 3>,\n", 200000) + "} }");
  stop_after(5, "#declare A = 1; #while (A) #declare A = A + 1; #end");
}

// What was found in a scene's text, as data; and files that are the application's.
#include <map>

#include <unistd.h>

#include <catch2/catch.hpp>

#include "celltrace/error.hpp"
#include "pov/parsing.hpp"

using namespace celltrace;
using test::parse;
using Severity = Finding::Severity;

namespace {

/// Of a scene that is refused.
std::vector<Finding> findings_of(std::string_view text, const ParseOptions& options = {}) {
  try {
    parse(text, options);
  } catch (const SceneError& error) {
    return error.findings();
  }
  FAIL("the scene was accepted");
  return {};
}

} // namespace

TEST_CASE("every finding of a run comes as data, in order, with its place and the way there") {
  std::vector<Finding> heard;
  ParseOptions options;
  options.finding = [&](const Finding& finding) { heard.push_back(finding); };
  const auto findings = findings_of("#warning \"old\"\n"
                                    "ovus { }\n"
                                    "#macro M()\n  julia_fractal { <0,0,0,0> }\n#end\n"
                                    "M()\n"
                                    "#macro N()\n  oops\n#end\n"
                                    "N()",
                                    options);
  REQUIRE(findings.size() == 4);
  CHECK(findings[0].severity == Severity::warning);
  CHECK(findings[0].file == "scene.pov");
  CHECK(findings[0].line == 1);
  CHECK(findings[0].column == 1);
  CHECK(findings[0].text == "old");
  CHECK(findings[1].severity == Severity::error);
  CHECK(findings[1].line == 2);
  CHECK(findings[1].text == "'ovus' is not supported yet");
  CHECK(findings[2].line == 4);
  CHECK(findings[2].column == 3);
  CHECK(findings[2].reached_by == std::vector<std::string>{"in macro 'M' called from scene.pov:6"});
  CHECK(findings[3].line == 8);
  CHECK(findings[3].text == "'oops' is not declared");
  CHECK(findings[3].reached_by == std::vector<std::string>{"in macro 'N' called from scene.pov:10"});
  REQUIRE(heard.size() == 4);
  for (std::size_t i = 0; i < heard.size(); ++i)
    CHECK(to_text(heard[i]) == to_text(findings[i]));
  CHECK(to_text(findings[3]) == "scene.pov:8:3: error: 'oops' is not declared\n"
                                "    in macro 'N' called from scene.pov:10");
}

TEST_CASE("scenes that are refused before their first token have findings, too") {
  try {
    parse_file("no/such.pov");
    FAIL("it was read");
  } catch (const SceneError& error) {
    REQUIRE(error.findings().size() == 1);
    CHECK(error.findings()[0].file == "no/such.pov");
    CHECK(error.findings()[0].line == 0);
    CHECK(error.findings()[0].text == "there is no such file");
  }
}

TEST_CASE("warnings of a scene that is accepted are heard of") {
  std::vector<Finding> heard;
  ParseOptions options;
  options.finding = [&](const Finding& finding) { heard.push_back(finding); };
  options.lenient = true;
  parse("#warning \"a\" ovus { } sphere { 0, 1 }", options);
  REQUIRE(heard.size() == 2);
  CHECK(heard[0].severity == Severity::warning);
  CHECK(heard[1].text == "'ovus' is not supported yet and left out");
}

TEST_CASE("remarks that a scene repeats without end are not all kept") {
  std::size_t heard = 0;
  ParseOptions options;
  options.finding = [&](const Finding&) { ++heard; };
  CHECK(findings_of("#for (I, 1, 3000) #warning \"again\" #end oops", options).size() == 1001);
  CHECK(heard == 3001);
}

TEST_CASE("a scene writes nothing to the application's streams") {
  int pipes[2];
  REQUIRE(pipe(pipes) == 0);
  const int streams[] = {STDOUT_FILENO, STDERR_FILENO};
  const int before[] = {dup(streams[0]), dup(streams[1])};
  for (const int stream : streams)
    dup2(pipes[1], stream);
  parse("#warning \"a\" #debug \"b\\n\" #statistics \"c\\n\" #render \"d\\n\" sphere { 0, 1 }");
  for (int i = 0; i < 2; ++i) {
    dup2(before[i], streams[i]);
    close(before[i]);
  }
  close(pipes[1]);
  char byte;
  CHECK(read(pipes[0], &byte, 1) == 0);
  close(pipes[0]);
}

TEST_CASE("files of a scene may be the application's") {
  const std::map<std::string, std::string> files = {
      {"parts/a.inc", "#include \"b.inc\" #declare A = B;"},
      {"b.inc", "#declare B = 3;"},
      {"numbers.csv", "4, 5"},
  };
  ParseOptions options;
  options.file = [&](const std::string& name) -> std::optional<std::string> {
    const auto file = files.find(name);
    return file == files.end() ? std::nullopt : std::optional(file->second);
  };
  CHECK(test::output("#include \"parts\\a.inc\" #debug str(A, 0, 0)", options) == "3");
  CHECK(test::output("#fopen F \"numbers.csv\" read #read (F, X, Y) #debug str(X * Y, 0, 0)", options) ==
        "20");
  CHECK(test::error_line("#include \"c.inc\"", options) ==
        "scene.pov:1:10: error: cannot find the include file 'c.inc'");
  options.limits.file_bytes = 10;
  CHECK(test::error_line("#include \"b.inc\"", options) ==
        "scene.pov:1:10: error: include file 'b.inc': this file is larger than 10 bytes");
}

// The documents for users of the emulator say what is so.
#include "celltrace/spe/diagnostic.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>

namespace celltrace::test {
namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream file(CELLTRACE_SOURCE_DIR "/" + path);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string word_for(Action action) {
  return action == Action::stop ? "stop" : action == Action::warn ? "warning" : "ignored";
}

TEST_CASE("docs/testing-spe-code.md lists every rule with its action and text") {
  const std::string page = text_of_file("docs/testing-spe-code.md");
  std::string table;
  for (unsigned i = 1; i < kRules; ++i) {
    const auto rule = static_cast<Rule>(i);
    table += "| `" + std::string(name_of(rule)) + "` | " + word_for(default_action(rule)) + " | " +
             std::string(text_of(rule)) + " |\n";
  }
  INFO(table);
  CHECK(page.find("| --- | --- | --- |\n" + table + "\n") != std::string::npos);
}

TEST_CASE("the first test of the documents is one that runs") {
  const std::string test = "```cpp\n" + text_of_file("examples/testing_spe_code/first_test.cpp") + "```\n";
  CHECK(text_of_file("docs/testing-spe-code.md").find(test) != std::string::npos);
}

} // namespace
} // namespace celltrace::test

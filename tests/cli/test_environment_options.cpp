#include "cli/environment_options.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

using celltrace::InputError;
using celltrace::cli::environment_options;
using celltrace::cli::split_words;
using Words = std::vector<std::string>;

namespace {

Words options_in(const char* text) {
  setenv("CELLTRACE_OPTIONS", text, 1);
  try {
    const Words words = environment_options();
    unsetenv("CELLTRACE_OPTIONS");
    return words;
  } catch (...) {
    unsetenv("CELLTRACE_OPTIONS");
    throw;
  }
}

} // namespace

TEST_CASE("words are split as a shell splits them") {
  CHECK(split_words("").empty());
  CHECK(split_words(" \t\n").empty());
  CHECK(split_words("--lenient") == Words{"--lenient"});
  CHECK(split_words("  --allow /a\t--allow-write\n/b ") == Words{"--allow", "/a", "--allow-write", "/b"});
  CHECK(split_words("--allow '/my data' \"/it's\" /a\\ b") == Words{"--allow", "/my data", "/it's", "/a b"});
  CHECK(split_words("a\"b c\"'d e'f") == Words{"ab cd ef"});
  CHECK(split_words("'' \"\" a") == Words{"", "", "a"});
  CHECK(split_words(R"("\"\\\$\`\n" '\' \"\')") == Words{R"("\$`\n)", "\\", "\"'"});
  CHECK(split_words("$HOME ~ * #") == Words{"$HOME", "~", "*", "#"});
  CHECK_THROWS_AS(split_words("'a"), InputError);
  CHECK_THROWS_AS(split_words("\"a\\\""), InputError);
  CHECK_THROWS_AS(split_words("a\\"), InputError);
}

TEST_CASE("options of the environment cannot change what the arguments mean") {
  unsetenv("CELLTRACE_OPTIONS");
  CHECK(environment_options().empty());
  CHECK(options_in("--lenient --allow /a") == Words{"--lenient", "--allow", "/a"});
  CHECK(options_in("--allow --") == Words{"--allow", "--"});
  CHECK_THROWS_WITH(options_in("--allow 'a"), "CELLTRACE_OPTIONS: a quote is not closed");
  CHECK_THROWS_WITH(options_in("--lenient --allow"),
                    "CELLTRACE_OPTIONS: --allow: its value is missing, or there is no such option");
  CHECK_THROWS_WITH(options_in("--lenient -- a"), "CELLTRACE_OPTIONS: -- cannot stand here");
}

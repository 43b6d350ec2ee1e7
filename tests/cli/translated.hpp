// Command lines as tests of the translation of POV-Ray's switches see them.
#pragma once

#include "cli/pov_switches.hpp"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace celltrace::test {

using Arguments = std::vector<std::string>;

/// Translates arguments; the leading "render" is left out.
inline Arguments translated(const Arguments& arguments) {
  Arguments result = cli::translate_pov_switches(arguments).arguments;
  REQUIRE(result.at(0) == "render");
  result.erase(result.begin());
  return result;
}

/// Counts the notes of a translation.
inline std::size_t notes(const Arguments& arguments) {
  return cli::translate_pov_switches(arguments).notes.size();
}

} // namespace celltrace::test

// POV-Ray's internal functions against its own values at three points each (tests/evidence/functions.json: number,
// parameters, values with eight digits).
#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;
using nlohmann::json;

TEST_CASE("internal functions have POV-Ray's values") {
  std::ifstream file(CELLTRACE_SOURCE_DIR "/tests/evidence/functions.json");
  const json evidence = json::parse(file);
  for (const auto& [name, function] : evidence["functions"].items()) {
    INFO(name);
    std::ostringstream scene;
    scene.precision(17);
    scene << "#declare F = function { internal(" << function[0] << ") }\n";
    for (const json& point : evidence["points"]) {
      scene << "#debug concat(str(F(" << point[0] << ", " << point[1] << ", " << point[2];
      for (const json& parameter : function[1])
        scene << ", " << parameter;
      scene << "), 0, 12), \" \")\n";
    }
    std::istringstream said(test::output(scene.str()));
    for (const json& expected : function[2]) {
      double found = 0;
      said >> found;
      CHECK(found == Approx(expected.get<double>()).epsilon(1e-6).margin(1e-7));
    }
  }
}

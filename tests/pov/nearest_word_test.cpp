#include "parsing.hpp"
#include "pov/nearest_word.hpp"

#include <catch2/catch.hpp>

using namespace celltrace::pov;

TEST_CASE("distances of words") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("sphere", "sphere") == 0);
  CHECK(edit_distance("shpere", "sphere") == 1); // swapped
  CHECK(edit_distance("spere", "sphere") == 1);
  CHECK(edit_distance("spphere", "sphere") == 1);
  CHECK(edit_distance("sphore", "sphere") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest word is near, or none is") {
  const std::vector<std::string> words = {"sphere", "pigment", "box", "finish", "spheres"};
  CHECK(nearest_word("shpere", words) == "sphere");
  CHECK(nearest_word("sphere", words) == "sphere");
  CHECK(nearest_word("pigmnet", words) == "pigment");
  CHECK(nearest_word("pgimnet", words) == "pigment");
  CHECK(nearest_word("xigmxtx", words) == "");
  CHECK(nearest_word("bx", words) == "");
  CHECK(nearest_word("bix", words) == ""); // of three letters
  CHECK(nearest_word(std::string(65, 'a'), {std::string(65, 'a')}) == "");
  CHECK(nearest_word(std::string(64, 'a'), {std::string(64, 'a')}) != "");
}

TEST_CASE("a misspelt word of a scene suggests the nearest") {
  using celltrace::test::error_line;
  CHECK(error_line("shpere { 0, 1 }") == "scene.pov:1:1: error: 'shpere' is not declared: 'sphere' perhaps?");
  CHECK(error_line("#declare My_Pigment = pigment { rgb 1 } sphere { 0, 1 pigment { My_Pigmnet } }") ==
        "scene.pov:1:65: error: 'My_Pigmnet' is not declared: 'My_Pigment' perhaps?");
  // What has gone out of scope is no guess.
  CHECK(error_line("#macro M() #local Something = 1; #end M() #declare A = Somethin;") ==
        "scene.pov:1:56: error: 'Somethin' is not declared");
}

// Several parses at once share nothing.
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "pov/parsing.hpp"

using namespace celltrace;

TEST_CASE("scenes are parsed in several threads at once") {
  std::vector<std::size_t> objects(4);
  std::vector<std::string> errors(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      const std::string count = std::to_string(100 * (i + 1));
      objects[i] =
          test::parse("#macro S(R) sphere { 0, R } #end #for (I, 1, " + count + ") S(I) #end").objects.size();
      errors[i] = test::error_line("#for (I, 1, " + count + ") #end oops");
    });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(objects[i] == 100 * (i + 1));
    CHECK(errors[i].find("'oops' is not declared") != std::string::npos);
  }
}

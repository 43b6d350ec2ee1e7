#include "cli/declares.hpp"
#include "cli/pov_numbers.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace celltrace::cli;

TEST_CASE("whole numbers end where their digits end") {
  CHECK(read_whole("0100")->value == 100);
  CHECK(read_whole("385.97")->value == 385);
  CHECK(read_whole("385.97")->rest == ".97");
  CHECK(read_whole(" +7 x")->value == 7);
  CHECK(read_whole(" +7 x")->rest == "x");
  CHECK(read_whole("-3")->value == -3);
  CHECK(read_whole("0x10")->value == 0);
  CHECK_FALSE(read_whole(""));
  CHECK_FALSE(read_whole("-"));
  CHECK_FALSE(read_whole(".9e2"));
  CHECK(std::isinf(read_whole(std::string(400, '9'))->value));
}

TEST_CASE("numbers have fractions and exponents") {
  CHECK(read_real("1e-05")->value == 1e-05);
  CHECK(read_real("+.5")->value == 0.5);
  CHECK(read_real("5.")->value == 5);
  CHECK(read_real("1e")->rest == "e");
  CHECK(read_real("1.2.3")->value == 1.2);
  CHECK(read_real("1.2.3")->rest == ".3");
  CHECK(read_real("0x10")->value == 16);
  CHECK(std::isinf(read_real("1e400")->value));
  for (const char* text : {"", "-", ".", "--1", "inf", "nan", "x1", "-.e1"})
    CHECK_FALSE(read_real(text));
}

TEST_CASE("numbers are written so that they can be read again") {
  CHECK(number_text(100000) == "100000");
  CHECK(number_text(-3) == "-3");
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(1e-05) == "1e-05");
  CHECK(number_text(1e300) == "1e+300");
}

TEST_CASE("what is declared is a number or a string") {
  CHECK(std::get<double>(declared_value("+1")) == 1);
  CHECK(std::get<double>(declared_value("-1.5e2")) == -150);
  CHECK(std::get<std::string>(declared_value("\"5\"")) == "5");
  CHECK(std::get<std::string>(declared_value("'te xt'")) == "te xt");
  CHECK(std::get<std::string>(declared_value("1x")) == "1x");
  CHECK(std::get<std::string>(declared_value("\"")) == "\"");
  CHECK(parse_declare("a=b=c") == std::pair<std::string, std::string>("a", "b=c"));
  for (const char* text : {"a", "=1", "a=1e400"})
    CHECK_THROWS_AS(parse_declare(text), celltrace::InputError);
}

// The scanf family.
#include "simulator/fake_spe.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace celltrace::test;

namespace {

constexpr unsigned kVfscanf = 36, kVscanf = 38, kVsscanf = 41;
constexpr std::uint32_t kA = 0x3000, kB = 0x3100, kC = 0x3200;

class Scanner : public FakeSpe {
public:
  using FakeSpe::FakeSpe;
  std::int32_t scan(const std::string& input, const std::string& format) {
    const Answer answer = c99_variable(kVsscanf, {text(input), text(format)}, {kA, kB, kC});
    last_errno = answer.spu_errno;
    return answer.value;
  }
  std::int32_t word(std::uint32_t at) const { return static_cast<std::int32_t>(load<std::uint32_t>(at)); }
  double floating(std::uint32_t at) const { return std::bit_cast<double>(load<std::uint64_t>(at)); }
  std::uint32_t last_errno = 0;
};

} // namespace

TEST_CASE("integers are read") {
  Scanner spe;
  CHECK(spe.scan("12 -34 +56", "%d%d%d") == 3);
  CHECK(spe.word(kA) == 12);
  CHECK(spe.word(kB) == -34);
  CHECK(spe.word(kC) == 56);
  CHECK(spe.scan("0x1f 017 99", "%i %i %i") == 3);
  CHECK(spe.word(kA) == 31);
  CHECK(spe.word(kB) == 15);
  CHECK(spe.word(kC) == 99);
  CHECK(spe.scan("ff 0XAb 777", "%x%x%o") == 3);
  CHECK(spe.word(kA) == 0xFF);
  CHECK(spe.word(kB) == 0xAB);
  CHECK(spe.word(kC) == 0777);
  CHECK(spe.scan("12345", "%2d%3d") == 2);
  CHECK(spe.word(kA) == 12);
  CHECK(spe.word(kB) == 345);
  CHECK(spe.scan("0", "%i") == 1);
  CHECK(spe.word(kA) == 0);
  CHECK(spe.scan("-1", "%u") == 1);
  CHECK(spe.word(kA) == -1);
}

TEST_CASE("integers have the size that is asked for, and its limits") {
  Scanner spe;
  spe.store<std::uint64_t>(kA, 0);
  CHECK(spe.scan("258", "%hhd") == 1);
  CHECK(spe.load<std::uint8_t>(kA) == 2);
  CHECK(spe.load<std::uint8_t>(kA + 1) == 0);
  CHECK(spe.scan("70000", "%hd") == 1);
  CHECK(spe.load<std::uint16_t>(kA) == 4464);
  CHECK(spe.scan("-9000000000", "%lld") == 1);
  CHECK(static_cast<std::int64_t>(spe.load<std::uint64_t>(kA)) == -9000000000);
  CHECK(spe.scan("99999999999 -99999999999 99999999999", "%d%ld%u") == 3);
  CHECK(spe.word(kA) == INT32_MAX);
  CHECK(spe.word(kB) == INT32_MIN);
  CHECK(spe.word(kC) == -1);
  CHECK(spe.scan("99999999999999999999 -99999999999999999999", "%lld%jd") == 2);
  CHECK(spe.load<std::uint64_t>(kA) == INT64_MAX);
  CHECK(spe.load<std::uint64_t>(kB) == std::uint64_t{1} << 63);
}

TEST_CASE("floating-point numbers are read") {
  Scanner spe;
  CHECK(spe.scan("1.5 -2e3 .25", "%lf%lf%lf") == 3);
  CHECK(spe.floating(kA) == 1.5);
  CHECK(spe.floating(kB) == -2000);
  CHECK(spe.floating(kC) == 0.25);
  CHECK(spe.scan("0.1 1e40", "%f%f") == 2);
  CHECK(std::bit_cast<float>(spe.load<std::uint32_t>(kA)) == 0.1f);
  CHECK(spe.load<std::uint32_t>(kB) == 0x7F800000);
  CHECK(spe.scan("0x1.8p4 inf nan", "%la%lg%le") == 3);
  CHECK(spe.floating(kA) == 24);
  CHECK(std::isinf(spe.floating(kB)));
  CHECK(std::isnan(spe.floating(kC)));
  CHECK(spe.scan("-infinity", "%lf") == 1);
  CHECK(spe.floating(kA) < -1e308);
  CHECK(spe.scan("1e999 1e-999 0.0", "%lf%lf%lf") == 3);
  CHECK(std::isinf(spe.floating(kA)));
  CHECK(spe.floating(kB) == 0);
  CHECK(spe.scan("1.5.5", "%3lf%lf") == 2);
  CHECK(spe.floating(kB) == 0.5);
  CHECK(spe.scan("1e", "%lf") == 0);
  CHECK(spe.scan(".", "%lf") == 0);
}

TEST_CASE("words, characters and sets are read") {
  Scanner spe;
  CHECK(spe.scan("  one two", "%s%s") == 2);
  CHECK(spe.text_at(kA) == "one");
  CHECK(spe.text_at(kB) == "two");
  CHECK(spe.scan("abcdef", "%2s%3c") == 2);
  CHECK(spe.text_at(kA) == "ab");
  CHECK(spe.load<std::uint8_t>(kB + 2) == 'e');
  CHECK(spe.scan(" x", "%c") == 1);
  CHECK(spe.load<std::uint8_t>(kA) == ' ');
  CHECK(spe.scan("a-b]z", "%[]a-c-]%s") == 2);
  CHECK(spe.text_at(kA) == "a-b]");
  CHECK(spe.scan("key=value;", "%[^=]=%[^;];") == 2);
  CHECK(spe.text_at(kA) == "key");
  CHECK(spe.text_at(kB) == "value");
  CHECK(spe.scan("ab", "%ls") == 1);
  CHECK(spe.load<std::uint32_t>(kA + 4) == 'b');
  CHECK(spe.load<std::uint32_t>(kA + 8) == 0);
}

TEST_CASE("what does not match ends the reading") {
  Scanner spe;
  CHECK(spe.scan("12 x", "%d%d") == 1);
  CHECK(spe.scan("x", "%d") == 0);
  CHECK(spe.scan("", "%d") == -1);
  CHECK(spe.scan("   ", "%d") == -1);
  CHECK(spe.scan("12", "%d%d") == 1);
  CHECK(spe.scan("12,34", "%d;%d") == 1);
  CHECK(spe.scan("12 % 34", "%d%%%d") == 2);
  CHECK(spe.scan("1 2 3", "%*d%d%n") == 1);
  CHECK(spe.word(kA) == 2);
  CHECK(spe.word(kB) == 3);
  CHECK(spe.scan("1", "%y") == -1);
  CHECK(spe.last_errno == 22);
  CHECK(spe.scan("1", "%[a") == -1);
}

TEST_CASE("streams are read up to where the next call goes on") {
  celltrace::cell_emu::PpeCallsConfig config;
  config.standard_input = "7 apples\nrest";
  Scanner spe(std::move(config));
  CHECK(spe.c99_variable(kVscanf, {spe.text("%d")}, {kA}).value == 1);
  CHECK(spe.word(kA) == 7);
  CHECK(spe.c99_variable(kVfscanf, {1, spe.text("%s")}, {kA}).value == 1);
  CHECK(spe.text_at(kA) == "apples");
  CHECK(spe.c99(20, {}).value == '\n');
  CHECK(spe.c99_variable(kVscanf, {spe.text("%s")}, {kA}).value == 1);
  CHECK(spe.c99_variable(kVscanf, {spe.text("%s")}, {kA}).value == -1);
  CHECK(spe.c99(3, {1}).value == 1); // feof
  CHECK(spe.c99_variable(kVfscanf, {2, spe.text("%s")}, {kA}).spu_errno == 9);
}

TEST_CASE("nothing is written outside local store") {
  Scanner spe;
  const std::uint32_t end = FakeSpe::kBytes - 4;
  spe.set_bytes(0, "first");
  CHECK(spe.c99_variable(kVsscanf, {spe.text("abcdefgh"), spe.text("%s")}, {end}).spu_errno == 14);
  CHECK(spe.text_at(0).starts_with("first"));
  CHECK(spe.c99_variable(kVsscanf, {spe.text("1"), spe.text("%lld")}, {end}).spu_errno == 14);

  std::mt19937 random(4);
  const std::string pieces[] = {"%",     "*", "d", "s", "n", "lf", "[a-z]", "[", "^", "]", "c",  "9",
                                "99999", "x", "i", " ", "p", "L",  "h",     "q", "-", "a", "%%", "S"};
  for (int i = 0; i < 3000; ++i) {
    std::string format, input;
    for (unsigned n = random() % 20; n > 0; --n)
      format += pieces[random() % std::size(pieces)];
    for (unsigned n = random() % 40; n > 0; --n)
      input += "0123456789abcx.-+ eE%pinf"[random() % 25];
    std::vector<Slot> arguments;
    for (int n = 0; n < 8; ++n)
      arguments.push_back(static_cast<std::uint32_t>(random()));
    FakeSpe other;
    other.c99_variable(kVsscanf, {other.text(input), other.text(format)}, arguments);
    CHECK(other.known());
  }
}

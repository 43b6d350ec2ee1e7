// The printf family: whatever format and value, the host's own printf is the judge.
#include "simulator/fake_spe.hpp"

#include <catch2/catch.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

using namespace celltrace::test;

namespace {

constexpr unsigned kVfprintf = 35, kVprintf = 37, kVsnprintf = 39, kVsprintf = 40;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#pragma GCC diagnostic ignored "-Wformat-security"
template <class... Values> std::string host(const std::string& format, Values... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format.c_str(), values...)) + 1, 0);
  std::snprintf(text.data(), text.size(), format.c_str(), values...);
  text.pop_back();
  return text;
}
#pragma GCC diagnostic pop

/// Flags, width and precision of a directive.
std::string random_modifiers(std::mt19937& random) {
  std::string text = "%";
  for (const char flag : std::string("-+ #0"))
    if (random() % 4 == 0) text += flag;
  if (random() % 2 == 0) text += std::to_string(1 + random() % 30);
  if (random() % 2 == 0) {
    text += '.';
    if (random() % 4 != 0) text += std::to_string(random() % 25);
  }
  return text;
}

} // namespace

TEST_CASE("integers are printed as the host prints them") {
  FakeSpe spe;
  std::mt19937 random(1);
  const std::int64_t edges[] = {0,     1,     -1,    9,         127,       128,       255,
                                32767, 32768, 65535, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN};
  for (int i = 0; i < 4000; ++i) {
    std::int64_t value = edges[random() % std::size(edges)];
    if (random() % 2 == 0)
      value = static_cast<std::int64_t>(std::uint64_t{random()} << 32 | random()) >> random() % 64;
    const char conversion = "diouxX"[random() % 6];
    const std::string modifiers = random_modifiers(random);
    const auto word = static_cast<int>(value);
    CAPTURE(modifiers, conversion, value);
    switch (random() % 7) {
    case 0:
      CHECK(spe.printed(modifiers + conversion, {word}) == host(modifiers + conversion, word));
      break;
    case 1:
      CHECK(spe.printed(modifiers + "hh" + conversion, {word}) == host(modifiers + "hh" + conversion, word));
      break;
    case 2:
      CHECK(spe.printed(modifiers + "h" + conversion, {word}) == host(modifiers + "h" + conversion, word));
      break;
    case 3: // of 32 bits on the SPU
      CHECK(spe.printed(modifiers + "l" + conversion, {word}) == host(modifiers + conversion, word));
      break;
    case 4: // so is size_t
      CHECK(spe.printed(modifiers + "z" + conversion, {word}) == host(modifiers + conversion, word));
      break;
    case 5:
      CHECK(spe.printed(modifiers + "j" + conversion, {Slot::wide(static_cast<std::uint64_t>(value))}) ==
            host(modifiers + "j" + conversion, value));
      break;
    default:
      CHECK(spe.printed(modifiers + "ll" + conversion, {Slot::wide(static_cast<std::uint64_t>(value))}) ==
            host(modifiers + "ll" + conversion, static_cast<long long>(value)));
    }
  }
}

TEST_CASE("floating-point numbers are printed as the host prints them") {
  FakeSpe spe;
  std::mt19937_64 random(2);
  using Limits = std::numeric_limits<double>;
  const double edges[] = {0.0,
                          -0.0,
                          0.5,
                          1,
                          1.5,
                          2.5,
                          9.5,
                          0.1,
                          123456,
                          1e15,
                          1e16,
                          1e100,
                          0.00001234,
                          99999.95,
                          999999.5,
                          1e-5,
                          9.9999e-5,
                          Limits::max(),
                          Limits::min(),
                          Limits::denorm_min(),
                          Limits::infinity(),
                          -Limits::infinity(),
                          Limits::quiet_NaN(),
                          -Limits::quiet_NaN(),
                          1.0 / 3,
                          0.125,
                          1.9999999999999998,
                          5e-324,
                          8.98846567431158e307};
  for (int i = 0; i < 8000; ++i) {
    double value = edges[random() % std::size(edges)];
    if (random() % 3 == 0) value = std::bit_cast<double>(random());
    if (random() % 3 == 0)
      value = static_cast<double>(static_cast<std::int64_t>(random()) >> random() % 60) / 1000;
    std::mt19937 modifiers_random(static_cast<unsigned>(random()));
    const std::string format = random_modifiers(modifiers_random) + "fFeEgGaA"[random() % 8];
    // Some versions of glibc drop zeros that # keeps when 9.99... becomes 10.
    if (std::tolower(format.back()) == 'g' && format.find('#') != std::string::npos) continue;
    CAPTURE(format, value);
    CHECK(spe.printed(format, {value}) == host(format, value));
  }
  CHECK(spe.printed("%#g %#.3G %#g %#.1g %#g", {1.5, 1e20, 999999.5, 3.0, 0.0}) ==
        "1.50000 1.00E+20 1.00000e+06 3. 0.00000");
}

TEST_CASE("precisions beyond all digits are zeros") {
  FakeSpe spe;
  for (const std::string format : {"%.2000f", "%.2000e", "%#.2000g", "%.2000g", "%.2000a", "%-3000.1500f|"})
    for (const double value : {1.0 / 3, 1e300, 5e-324, 0.0}) {
      CAPTURE(format, value);
      CHECK(spe.printed(format, {value}) == host(format, value));
    }
  CHECK(spe.printed("%.1500d", {42}) == host("%.1500d", 42));
}

TEST_CASE("characters, strings and pointers are printed") {
  FakeSpe spe;
  const std::uint32_t hello = spe.text("hello");
  for (const char* modifiers : {"%", "%-10", "%10", "%.3", "%-10.3", "%.0", "%.", "%2.9"}) {
    const std::string format = std::string("[") + modifiers + "s]";
    CHECK(spe.printed(format, {hello}) == host(format, "hello"));
  }
  CHECK(spe.printed("%c%5c%-3c|", {'a', 'b', 'c'}) == "a    bc  |");
  CHECK(spe.printed("%c", {0}) == std::string(1, 0));
  CHECK(spe.printed("%c", {0x141}) == "A");
  CHECK(spe.printed("%s|%.3s|%8s", {0, 0, 0}) == "(null)||  (null)");
  CHECK(spe.printed("%p %p %12p", {0x1234, 0, 0x3FFF0}) == "0x1234 (nil)      0x3fff0");
  CHECK(spe.printed("100%% %y %5%", {}) == "100% %y %");

  for (std::uint32_t i = 0; i < 3; ++i)
    spe.store<std::uint32_t>(0x3000 + 4 * i, i < 2 ? 'w' : 0);
  CHECK(spe.printed("%ls %5.1ls %lc", {0x3000, 0x3000, 'x'}) == "ww     w x");
  CHECK(spe.c99_variable(kVprintf, {spe.text("%lc")}, {0x20AC}).spu_errno == 84);
}

TEST_CASE("widths and precisions may be arguments") {
  FakeSpe spe;
  CHECK(spe.printed("[%*d]", {6, 42}) == "[    42]");
  CHECK(spe.printed("[%*d]", {-6, 42}) == "[42    ]");
  CHECK(spe.printed("[%.*f]", {2, 3.14159}) == "[3.14]");
  CHECK(spe.printed("[%.*f]", {-1, 3.14159}) == "[3.141590]");
  CHECK(spe.printed("[%*.*e]", {12, 3, 31.4159}) == "[   3.142e+01]");
}

TEST_CASE("arguments go on behind the caller's frame") {
  FakeSpe spe;
  for (std::size_t registers = 0; registers <= 6; ++registers) {
    spe.take_out();
    const Answer answer = spe.c99_variable(kVprintf, {spe.text("%d %lld %.1f %c %d")},
                                           {1, Slot::wide(1ull << 40), 2.5, 'x', -5}, registers);
    CHECK(answer.value == 24);
    CHECK(spe.out() == "1 1099511627776 2.5 x -5");
  }
}

TEST_CASE("counts are stored") {
  FakeSpe spe;
  spe.printed("12345%n67%hhn%hn%lln", {0x3000, 0x3010, 0x3020, 0x3030});
  CHECK(spe.load<std::uint32_t>(0x3000) == 5);
  CHECK(spe.load<std::uint8_t>(0x3010) == 7);
  CHECK(spe.load<std::uint8_t>(0x3011) == 0xEE);
  CHECK(spe.load<std::uint16_t>(0x3020) == 7);
  CHECK(spe.load<std::uint64_t>(0x3030) == 7);
}

TEST_CASE("strings are printed into local store, cut where they must be") {
  FakeSpe spe;
  CHECK(spe.c99_variable(kVsprintf, {0x3000, spe.text("a%db")}, {77}).value == 4);
  CHECK(spe.text_at(0x3000) == "a77b");
  CHECK(spe.c99_variable(kVsnprintf, {0x3100, 3, spe.text("a%db")}, {77}).value == 4);
  CHECK(spe.text_at(0x3100) == "a7");
  CHECK(spe.load<std::uint8_t>(0x3103) == 0xEE);
  CHECK(spe.c99_variable(kVsnprintf, {0x3200, 0, spe.text("%1000d")}, {77}).value == 1000);
  CHECK(spe.load<std::uint8_t>(0x3200) == 0xEE);
  CHECK(spe.c99_variable(kVsnprintf, {0x3200, -1, spe.text("all")}, {}).value == 3);
  CHECK(spe.text_at(0x3200) == "all");
  // Into its own format and argument.
  const std::uint32_t own = spe.text("<%s>");
  CHECK(spe.c99_variable(kVsprintf, {own, own}, {own}).value == 6);
  CHECK(spe.text_at(own) == "<<%s>>");
}

TEST_CASE("formats and arguments that lead nowhere fail") {
  FakeSpe spe;
  const auto failure = [&](const std::string& format, const std::vector<Slot>& arguments) {
    const Answer answer = spe.c99_variable(kVprintf, {spe.text(format)}, arguments);
    CHECK(answer.value == -1);
    return answer.spu_errno;
  };
  spe.set_bytes(FakeSpe::kBytes - 4, "open");
  CHECK(failure("%s", {static_cast<int>(FakeSpe::kBytes) - 4}) == 14);
  CHECK(failure("%.5s", {static_cast<int>(FakeSpe::kBytes) - 4}) == 14);
  CHECK(spe.printed("%.4s", {static_cast<int>(FakeSpe::kBytes) - 4}) == "open");
  CHECK(failure("%n", {static_cast<int>(FakeSpe::kBytes) - 2}) == 14);
  CHECK(failure("%", {}) == 22);
  CHECK(failure("%-5.2l", {}) == 22);
  CHECK(failure("%999999999d", {1}) == 75);
  CHECK(failure("%.999999999f", {1.0}) == 75);
  CHECK(failure("%*d", {INT32_MIN, 1}) == 75);
  CHECK(spe.c99(kVprintf, {FakeSpe::kBytes - 4, 0, 0}).spu_errno == 14);
  CHECK(spe.c99_variable(kVsprintf, {FakeSpe::kBytes - 4, spe.text("five!")}, {}).spu_errno == 14);
  CHECK(spe.c99_variable(kVfprintf, {9, spe.text("x")}, {}).spu_errno == 9);
  CHECK(spe.c99_variable(kVfprintf, {1, spe.text("x")}, {}).spu_errno == 9); // standard input
  CHECK(spe.out().empty());
}

TEST_CASE("no format takes the printer out of local store or keeps it for long") {
  FakeSpe spe;
  std::mt19937 random(3);
  const std::string pieces[] = {"%", "*", ".", "l", "h", "ll", "d",        "s", "n", "f",  "e", "g", "a", "c",
                                "p", "x", "S", "-", "#", "0",  "99999999", "3", " ", "%%", "z", "C", "q"};
  for (int i = 0; i < 3000; ++i) {
    std::string format;
    for (unsigned n = random() % 40; n > 0; --n)
      format += pieces[random() % std::size(pieces)];
    std::vector<Slot> arguments;
    for (int n = 0; n < 8; ++n)
      arguments.push_back(Slot::wide(std::uint64_t{random()} << 32 | random()));
    const Answer answer = spe.c99_variable(kVsnprintf, {0x20000, 0x1000, spe.text(format)}, arguments);
    CHECK(spe.known());
    CHECK((answer.value >= 0) == (answer.spu_errno == 0));
    spe = FakeSpe();
  }
}

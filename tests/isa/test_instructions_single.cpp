// Single precision, its conversions and its estimates.
#include "isa/instruction_rows.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {

namespace {

const Row kRows[] = {
    // 1 + 2, 1 - 1, -1 + 2, 0 + -0: zeros are +0.
    {.op = "fa",
     .ra = "3f800000 3f800000 bf800000 00000000",
     .rb = "40000000 bf800000 40000000 80000000",
     .gives = "40400000 00000000 3f800000 00000000"},
    // Toward zero, below half of a unit, beyond it, and from both sides.
    {.op = "fa",
     .ra = "3f800000 3f800000 3f800000 bf800000",
     .rb = "33000000 33ffffff b3000000 33000000",
     .gives = "3f800000 3f800000 3f7fffff bf7fffff"},
    // The range goes on beyond 2^128, and ends in the largest number.
    {.op = "fa",
     .ra = "7f000000 7f800000 7fffffff ffffffff",
     .rb = "7f000000 7f800000 7fffffff ffffffff",
     .gives = "7f800000 7fffffff 7fffffff ffffffff"},
    // Denormals are zeros, of operands and of results.
    {.op = "fa",
     .ra = "007fffff 3f800000 00800001 01000000",
     .rb = "007fffff 007fffff 80800000 80800000",
     .gives = "00000000 3f800000 00000000 00800000"},
    {.op = "fs",
     .ra = "3f800000 3f800000 7fffffff 80000000",
     .rb = "3f800000 c0000000 ffffffff 80000000",
     .gives = "00000000 40400000 7fffffff 00000000"},
    {.op = "fm",
     .ra = "3f800001 40000000 7fffffff 00800000",
     .rb = "3f800001 c0400000 3f800000 3f000000",
     .gives = "3f800002 c0c00000 7fffffff 00000000"},
    {.op = "fm",
     .ra = "80800000 007fffff 7f800000 ff800000",
     .rb = "3f000000 7f000000 40000000 40000000",
     .gives = "00000000 00000000 7fffffff ffffffff"},
    {.op = "fm",
     .ra = "20000000 1fffffff 5fffffff bfffffff",
     .rb = "20000000 20000000 5fffffff 3fffffff",
     .gives = "00800000 00000000 7fffffff c07ffffe"},

    // The product is whole: (1 + u)^2 - (1 + 2u) = u^2.
    {.op = "fma",
     .ra = "3f800001 3f800000 7fffffff 00000000",
     .rb = "3f800001 40000000 7fffffff 7fffffff",
     .rc = "bf800002 3f800000 ffffffff 007fffff",
     .gives = "28800000 40400000 7fffffff 00000000"},
    // However small it is, it counts.
    {.op = "fma",
     .ra = "00800000 00800000 80800000 00800000",
     .rb = "00800000 00800000 00800000 00800000",
     .rc = "bf800000 3f800000 3f800000 00000000",
     .gives = "bf7fffff 3f800000 3f7fffff 00000000"},
    // Only the sum can overflow: 2^129 - (2^129 - 2^105).
    {.op = "fma", .ra = "7f800000", .rb = "40000000", .rc = "ffffffff", .gives = "74000000"},
    {.op = "fms",
     .ra = "3f800001 40000000 00000000 3f800000",
     .rb = "3f800001 40400000 00000000 3f800000",
     .rc = "3f800002 3f800000 3f800000 3f800000",
     .gives = "28800000 40a00000 bf800000 00000000"},
    {.op = "fnms",
     .ra = "3f800001 40000000 00000000 3f800000",
     .rb = "3f800001 40400000 00000000 3f800000",
     .rc = "3f800002 3f800000 3f800000 3f800000",
     .gives = "a8800000 c0a00000 3f800000 00000000"},

    {.op = "fceq",
     .ra = "00000000 3f800000 007fffff 7fffffff",
     .rb = "80000000 3f800000 80000001 7fffffff",
     .gives = "ffffffff ffffffff ffffffff ffffffff"},
    {.op = "fceq",
     .ra = "3f800000 00800000 7f800000 7f800001",
     .rb = "bf800000 00000000 7f800001 ff800001",
     .gives = "00000000 00000000 00000000 00000000"},
    {.op = "fcmeq",
     .ra = "3f800000 007fffff 7fffffff 3f800000",
     .rb = "bf800000 80000000 ffffffff 3f800001",
     .gives = "ffffffff ffffffff ffffffff 00000000"},
    {.op = "fcgt",
     .ra = "3f800000 bf800000 00000000 7fffffff",
     .rb = "bf800000 3f800000 80000000 7f800000",
     .gives = "ffffffff 00000000 00000000 ffffffff"},
    {.op = "fcgt",
     .ra = "007fffff 00800000 80800000 00000000",
     .rb = "00000000 007fffff 80000000 80800000",
     .gives = "00000000 ffffffff 00000000 ffffffff"},
    {.op = "fcgt", .ra = "bf800000 c0000000", .rb = "c0000000 bf800000", .gives = "ffffffff 00000000"},
    {.op = "fcmgt",
     .ra = "bf800000 c0000000 80000001 ffffffff",
     .rb = "3f800000 3f800000 00000000 7f7fffff",
     .gives = "00000000 ffffffff 00000000 ffffffff"},

    // From integers: divided by 2^(155 - immediate).
    {.op = "csflt",
     .ra = "00000001 ffffffff 7fffffff 80000000",
     .immediate = 155,
     .gives = "3f800000 bf800000 4effffff cf000000"},
    {.op = "csflt",
     .ra = "01ffffff fe000001 00000000 fffffffe",
     .immediate = 155,
     .gives = "4bffffff cbffffff 00000000 c0000000"},
    {.op = "csflt",
     .ra = "00000001 00000002 80000000 ffffffff",
     .immediate = 28,
     .gives = "00000000 00800000 8f800000 00000000"},
    {.op = "cuflt",
     .ra = "00000001 ffffffff 80000000 00000000",
     .immediate = 155,
     .gives = "3f800000 4f7fffff 4f000000 00000000"},
    {.op = "cuflt",
     .ra = "00000001 ffffffff 80000000 00000000",
     .immediate = 154,
     .gives = "3f000000 4effffff 4e800000 00000000"},
    // To integers: multiplied by 2^(173 - immediate).
    {.op = "cflts",
     .ra = "3f800000 bfc00000 4f000000 cf000000",
     .immediate = 173,
     .gives = "00000001 ffffffff 7fffffff 80000000"},
    {.op = "cflts",
     .ra = "7fffffff ffffffff 3f7fffff 007fffff",
     .immediate = 173,
     .gives = "7fffffff 80000000 00000000 00000000"},
    {.op = "cflts",
     .ra = "4effffff ceffffff cf000001 bf7fffff",
     .immediate = 173,
     .gives = "7fffff80 80000080 80000000 00000000"},
    {.op = "cflts",
     .ra = "3f800000 bf800000 3d800000 4d000000",
     .immediate = 169,
     .gives = "00000010 fffffff0 00000001 7fffffff"},
    {.op = "cfltu",
     .ra = "3f800000 bf800000 4f7fffff 4f800000",
     .immediate = 173,
     .gives = "00000001 00000000 ffffff00 ffffffff"},
    {.op = "cfltu",
     .ra = "7fffffff ffffffff 4f000000 3fffffff",
     .immediate = 173,
     .gives = "ffffffff 00000000 80000000 00000001"},
    {.op = "cfltu",
     .ra = "3f800000 00800000 01000000 007fffff",
     .immediate = 46,
     .gives = "ffffffff 00000002 00000004 00000000"},

    {.op = "frest",
     .ra = "3f800000 bf800000 00000000 80000000",
     .gives = "3f7ffbe0 bf7ffbe0 7ffffbe0 fffffbe0"},
    {.op = "frest",
     .ra = "40000000 3fffffff 7f800000 7e800000",
     .gives = "3efffbe0 3f041d07 007ffbe0 007ffbe0"},
    {.op = "frsqest",
     .ra = "3f800000 bf800000 40000000 00000000",
     .gives = "3f7ffdf4 3f7ffdf4 3f350160 7fb50160"},
    {.op = "frsqest",
     .ra = "40800000 7fffffff 00800000 807fffff",
     .gives = "3efffdf4 1f37e8ba 5efffdf4 7f820c83"},
    {.op = "fi",
     .ra = "3f800000 3f87ffff 3f87ffff 3f87ffff",
     .rb = "3f7ffbe0 3f7ffbe0 3f800001 008003ff",
     .gives = "3f7ff800 3f707801 3f7ff800 00000000"},
    {.op = "fi",
     .ra = "00000000 00000000 00000000 00000000",
     .rb = "bf8003ff 7fffffff 00000000 80000000",
     .gives = "bf800000 7ffffc00 00000000 00000000"},
};

} // namespace

std::span<const Row> single_rows() {
  return kRows;
}

TEST_CASE("single precision does as the ISA says") {
  check(kRows);
}

} // namespace celltrace::test

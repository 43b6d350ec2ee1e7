// Shuffles, selections, masks and their gathering, controls for insertion.
#include "isa/instruction_rows.hpp"

#include <catch2/catch.hpp>

namespace celltrace::test {

namespace {

const Row kRows[] = {
    {.op = "shufb",
     .ra = "00010203 04050607 08090a0b 0c0d0e0f",
     .rb = "10111213 14151617 18191a1b 1c1d1e1f",
     .rc = "00010203 1f1e1d1c 80bfc0df e0ff2041",
     .gives = "00010203 1f1e1d1c 0000ffff 80800001"},
    {.op = "shufb",
     .ra = "00010203 04050607 08090a0b 0c0d0e0f",
     .rb = "10111213 14151617 18191a1b 1c1d1e1f",
     .rc = "607f5a0f",
     .gives = "001f1a0f"},
    {.op = "selb",
     .ra = "00000000 ffffffff 12345678 f0f0f0f0",
     .rb = "ffffffff 00000000 9abcdef0 0f0f0f0f",
     .rc = "0000ffff ff00ff00 ffffffff 00000000",
     .gives = "0000ffff 00ff00ff 9abcdef0 f0f0f0f0"},

    {.op = "fsmb", .ra = "00008001 ffffffff", .gives = "ff000000 00000000 00000000 000000ff"},
    {.op = "fsmb", .ra = "ffff0000 ffffffff", .gives = "00"},
    {.op = "fsmh", .ra = "00000081 ffffffff", .gives = "ffff0000 00000000 00000000 0000ffff"},
    {.op = "fsmh", .ra = "ffffff00 ffffffff", .gives = "00"},
    {.op = "fsm", .ra = "00000005 ffffffff", .gives = "00000000 ffffffff 00000000 ffffffff"},
    {.op = "fsm", .ra = "fffffff0 ffffffff", .gives = "00"},
    {.op = "fsmbi", .immediate = 0x8001, .gives = "ff000000 00000000 00000000 000000ff"},
    {.op = "fsmbi", .immediate = 0xF00F, .gives = "ffffffff 00000000 00000000 ffffffff"},
    {.op = "gb", .ra = "00000001 fffffffe 00000003 80000001", .gives = "0000000b 00000000 00000000 00000000"},
    {.op = "gbh",
     .ra = "0001 0000 ffff fffe 0003 8000 0001 0001",
     .gives = "000000ab 00000000 00000000 00000000"},
    {.op = "gbb", .ra = "01 00 ff fe 03 80 01 01", .gives = "0000abab 00000000 00000000 00000000"},
    {.op = "orx",
     .ra = "00000001 00000010 80000000 0000f000",
     .gives = "8000f011 00000000 00000000 00000000"},

    {.op = "cbd", .ra = "00000005", .immediate = 3, .gives = "10111213 14151617 03191a1b 1c1d1e1f"},
    {.op = "cbd", .ra = "00000000", .immediate = -1, .gives = "10111213 14151617 18191a1b 1c1d1e03"},
    {.op = "chd", .ra = "00000005", .immediate = 2, .gives = "10111213 14150203 18191a1b 1c1d1e1f"},
    {.op = "cwd", .ra = "0000000e", .immediate = 0, .gives = "10111213 14151617 18191a1b 00010203"},
    {.op = "cwd", .ra = "00000001", .immediate = -2, .gives = "10111213 14151617 18191a1b 00010203"},
    {.op = "cdd", .ra = "00000009", .immediate = 0, .gives = "10111213 14151617 00010203 04050607"},
    {.op = "cdd", .ra = "00000007", .immediate = 0, .gives = "00010203 04050607 18191a1b 1c1d1e1f"},
    {.op = "cbx", .ra = "00000005", .rb = "00000006", .gives = "10111213 14151617 18191a03 1c1d1e1f"},
    {.op = "cbx", .ra = "00000001", .rb = "ffffffff", .gives = "03111213 14151617 18191a1b 1c1d1e1f"},
    {.op = "chx", .ra = "00000005", .rb = "00000006", .gives = "10111213 14151617 18190203 1c1d1e1f"},
    {.op = "cwx", .ra = "00000005", .rb = "00000006", .gives = "10111213 14151617 00010203 1c1d1e1f"},
    {.op = "cdx", .ra = "00000005", .rb = "00000006", .gives = "10111213 14151617 00010203 04050607"},
};

} // namespace

std::span<const Row> shuffle_rows() {
  return kRows;
}

TEST_CASE("shuffles, masks and insertion controls do as the ISA says") {
  check(kRows);
}

} // namespace celltrace::test

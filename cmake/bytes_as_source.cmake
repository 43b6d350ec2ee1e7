# Writes a C++ source that has the bytes of a file in it.
#
#   cmake -DINPUT=file -DFUNCTION=name -DOUTPUT=source.cpp -P bytes_as_source.cmake
#
# defines `std::span<const std::uint8_t> celltrace::FUNCTION()`; its user declares it.

file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n" lines "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," lines "${lines}")
file(WRITE ${OUTPUT} "#include <cstdint>
#include <span>

namespace celltrace {

namespace {

constexpr std::uint8_t kBytes[] = {
${lines}
};

} // namespace

std::span<const std::uint8_t> ${FUNCTION}();
std::span<const std::uint8_t> ${FUNCTION}() {
  return kBytes;
}

} // namespace celltrace
")

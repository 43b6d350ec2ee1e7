// Bytes as text, for tests that compare them.
#pragma once

#include <cstdio>
#include <string>

namespace celltrace::test {

/// Returns two hexadecimal digits for each byte.
inline std::string hex(const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", static_cast<unsigned>(static_cast<unsigned char>(byte)));
    text += two;
  }
  return text;
}

} // namespace celltrace::test

// libFuzzer target: any bytes are a scene, or a fault with a message.
#include "celltrace/error.hpp"
#include "fuzz/limits.hpp"

#include <cstdlib>
#include <string_view>

using namespace celltrace;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    validate(parse_string({reinterpret_cast<const char*>(data), size}, test::fuzzing_options()));
  } catch (const InputError& error) {
    if (*error.what() == '\0') std::abort();
  }
  return 0;
}

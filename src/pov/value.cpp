#include "pov/value.hpp"

namespace celltrace::pov {

const char* kind_name(const Value& value) {
  if (const auto* quantity = std::get_if<Quantity>(&value))
    return quantity->is_colour ? "a colour" : quantity->is_float() ? "a float" : "a vector";
  static constexpr const char* kNames[] = {
      "nothing",     "a number",          "a string",    "a pigment",    "a normal",
      "a finish",    "a texture",         "a color map", "a normal map", "a texture map",
      "a slope map", "a sky sphere",      "a fog",       "a rainbow",    "an interior",
      "a material",  "a camera",          "an object",   "a transform",  "an array",
      "a macro",     "not supported yet", "a file",      "a function",   "a spline"};
  static_assert(std::size(kNames) == std::variant_size_v<Value>);
  return kNames[value.index()];
}

} // namespace celltrace::pov

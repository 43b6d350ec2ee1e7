// The names of the limits in celltrace/pov.hpp.
#include "celltrace/pov.hpp"

namespace celltrace {

const std::vector<NamedLimit>& parse_limits() {
  static const std::vector<NamedLimit> kLimits = {
      {"file-bytes", &ParseLimits::file_bytes},
      {"include-depth", &ParseLimits::include_depth},
      {"macro-depth", &ParseLimits::macro_depth},
      {"nesting", &ParseLimits::nesting},
      {"loop-steps", &ParseLimits::loop_iterations},
      {"recorded-tokens", &ParseLimits::recorded_tokens},
      {"tokens", &ParseLimits::tokens},
      {"array-elements", &ParseLimits::array_elements},
      {"list-entries", &ParseLimits::list_entries},
      {"string-bytes", &ParseLimits::string_bytes},
      {"text-bytes", &ParseLimits::text_bytes},
      {"memory", &ParseLimits::memory},
      {"seconds", &ParseLimits::seconds},
      {"open-files", &ParseLimits::open_files},
      {"written-bytes", &ParseLimits::written_bytes},
      {"objects", &ParseLimits::objects},
      {"triangles", &ParseLimits::triangles},
      {"map-entries", &ParseLimits::map_entries},
  };
  return kLimits;
}

} // namespace celltrace

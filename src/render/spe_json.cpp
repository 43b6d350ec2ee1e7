#include "render/spe_json.hpp"

#include <nlohmann/json.hpp>

namespace celltrace {

nlohmann::ordered_json cycles_json(const SpuCycles& cycles) {
  nlohmann::ordered_json json;
  for (const auto& [name, count] : kSpuCycleCounts)
    json[name] = cycles.*count;
  return json;
}

nlohmann::ordered_json diagnostic_json(const Diagnostic& d) {
  const std::string_view file(d.site.file);
  return {{"rule", name_of(d.rule)},
          {"text", text_of(d.rule)},
          {"by", d.spe == Diagnostic::kPpe ? "PPE" : "SPE " + std::to_string(d.spe)},
          {"command", d.command},
          {"cycle", d.cycle},
          {"file", file.substr(file.find_last_of('/') + 1)},
          {"line", d.site.line}};
}

} // namespace celltrace

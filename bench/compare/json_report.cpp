#include "report.hpp"

#include <nlohmann/json.hpp>

namespace celltrace::compare {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Samples& samples) {
  const Range range = range_of(samples.values);
  return {{"name", samples.name}, {"unit", samples.unit}, {"median", range.median},
          {"low", range.low},     {"high", range.high},   {"samples", samples.values}};
}

Json json_of(const Figure& figure) {
  Json json = {{"measure", figure.measure}, {"against", figure.against},
               {"scene", figure.scene},     {"primitives", figure.primitives},
               {"threads", figure.threads}, {"result", json_of(figure.result)}};
  if (figure.bar)
    json["bar"] = {{"sense", figure.bar->sense == Bar::Sense::at_least ? "at least" : "at most"},
                   {"value", figure.bar->value},
                   {"reached", figure.reached()}};
  json["from"] = Json::array();
  for (const Samples& samples : figure.from)
    json["from"].push_back(json_of(samples));
  return json;
}

} // namespace

void write_json(std::ostream& out, const Report& report) {
  Json json;
  for (const auto& [name, value] : report.conditions)
    json["conditions"][name] = value;
  json["left_out"] = report.notes;
  json["figures"] = Json::array();
  for (const Figure& figure : report.figures)
    json["figures"].push_back(json_of(figure));
  out << json.dump(2) << '\n';
}

} // namespace celltrace::compare

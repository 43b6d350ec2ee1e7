// Writes a study as text, JSON, CSV files and pictures.
#include "celltrace/error.hpp"
#include "image/file.hpp"
#include "study/chart.hpp"
#include "study/study.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include <nlohmann/json.hpp>

namespace celltrace::study {

namespace {

namespace fs = std::filesystem;

std::string as_text(const Value& value, int decimals) {
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  if (const auto* number = std::get_if<double>(&value)) {
    std::ostringstream out;
    out.setf(std::ios::fixed);
    out.precision(decimals);
    out << *number;
    return out.str();
  }
  return "";
}

bool is_number(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const std::vector<Value>& row) {
    return std::holds_alternative<double>(row[column]);
  });
}

void write_lines(std::ostream& out, const std::string& heading, const std::string& words) {
  constexpr std::size_t kColumns = 110;
  out << heading;
  std::size_t at = heading.size();
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    if (at + word.size() + 1 > kColumns) {
      out << "\n ";
      at = 1;
    }
    out << ' ' << word;
    at += word.size() + 1;
  }
  out << '\n';
}

void write_table(std::ostream& out, const Table& table) {
  out << table.title << '\n' << std::string(table.title.size(), '=') << "\n\n";
  std::vector<std::size_t> widths;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::size_t width = table.columns[column].name.size();
    for (const std::vector<Value>& row : table.rows)
      width = std::max(width, as_text(row[column], table.columns[column].decimals).size());
    widths.push_back(width);
  }
  const auto cell = [&](std::size_t column, const std::string& text) {
    const std::string blank(widths[column] - text.size(), ' ');
    out << (column == 0 ? "" : "  ") << (is_number(table, column) ? blank + text : text + blank);
  };
  for (std::size_t column = 0; column < table.columns.size(); ++column)
    cell(column, table.columns[column].name);
  out << '\n';
  for (const std::vector<Value>& row : table.rows) {
    for (std::size_t column = 0; column < row.size(); ++column)
      cell(column, as_text(row[column], table.columns[column].decimals));
    out << '\n';
  }
  out << '\n';
  write_lines(out, "The thesis:", table.thesis);
  write_lines(out, "Here:", table.here);
  out << '\n';
}

void write_claims(std::ostream& out, const std::map<std::string, Claim>& claims) {
  if (claims.empty()) return;
  out << "Claims\n======\n\n";
  for (const auto& [name, claim] : claims) {
    out << name << std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') << as_text(claim.value, 3)
        << "  (" << (claim.at_most ? "at most " : "at least ") << claim.bar
        << (claim.reached() ? ": reached" : ": MISSED");
    if (claim.thesis != 0) out << "; the thesis: " << as_text(claim.thesis, 2);
    out << ")  " << claim.scene << ": " << claim.parameters << '\n';
  }
}

nlohmann::ordered_json to_json(const Claim& claim) {
  nlohmann::ordered_json json = {
      {"value", claim.value},           {"scene", claim.scene},
      {"parameters", claim.parameters}, {claim.at_most ? "at_most" : "at_least", claim.bar},
      {"reached", claim.reached()},     {"missed_on", claim.missed}};
  if (claim.thesis != 0) json["thesis"] = claim.thesis;
  return json;
}

nlohmann::ordered_json to_json(const Table& table) {
  nlohmann::ordered_json json = {
      {"id", table.id}, {"title", table.title}, {"thesis", table.thesis}, {"here", table.here}};
  for (const Column& column : table.columns)
    json["columns"].push_back(column.name);
  json["rows"] = nlohmann::ordered_json::array();
  for (const std::vector<Value>& row : table.rows) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (const Value& value : row)
      std::visit(
          [&](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
              values.push_back(nullptr);
            else
              values.push_back(held);
          },
          value);
    json["rows"].push_back(values);
  }
  return json;
}

/// Writes a field as in RFC 4180.
void write_csv_field(std::ostream& out, const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    out << text;
    return;
  }
  out << '"';
  for (const char each : text)
    (each == '"' ? out << each : out) << each;
  out << '"';
}

std::string to_csv(const Table& table) {
  std::ostringstream out;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    if (column > 0) out << ',';
    write_csv_field(out, table.columns[column].name);
  }
  out << "\r\n";
  for (const std::vector<Value>& row : table.rows) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      if (column > 0) out << ',';
      write_csv_field(out, as_text(row[column], table.columns[column].decimals));
    }
    out << "\r\n";
  }
  return out.str();
}

void write_file(const fs::path& path, const std::string& content) {
  try {
    image::OutputFile file(path);
    std::fwrite(content.data(), 1, content.size(), file.get()); // commit() reports failures
    file.commit();
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

} // namespace

std::string to_text(const Study& study) {
  std::ostringstream out;
  for (const Table& table : study.tables)
    write_table(out, table);
  write_claims(out, study.claims);
  return out.str();
}

void save(const Study& study, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("cannot make the folder '" + folder.string() + "': " + error.message());
  nlohmann::ordered_json json = {{"quick", study.quick},
                                 {"backend", name_of(study.backend)},
                                 {"claims", nlohmann::ordered_json::object()}};
  for (const auto& [name, claim] : study.claims)
    json["claims"][name] = to_json(claim);
  json["tables"] = nlohmann::ordered_json::array();
  for (const Table& table : study.tables) {
    json["tables"].push_back(to_json(table));
    write_file(folder / (table.id + ".csv"), to_csv(table));
    if (!table.chart.series.empty()) write_file(folder / (table.id + ".svg"), draw(table.title, table.chart));
  }
  write_file(folder / "study.json", json.dump(2) + "\n");
  write_file(folder / "study.txt", to_text(study));
}

} // namespace celltrace::study

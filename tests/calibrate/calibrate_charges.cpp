// Compares what cell_emu counts with what cell_sim executes, and fits the charges of compute() and the
// statistical parameters of the pipeline to that; see tools/calibrate-charges.sh.
//
//   calibrate_charges measure [SCENE.pov...] > FILE     renders: minutes
//   calibrate_charges fit FILE [HEADER...]              prints; writes the charges into headers that have
//   them
#include "calibration.hpp"

#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

namespace {

using namespace celltrace::calibration;

/// In every line `constexpr ScalarWork kName = {...};` of a header.
void replace_charges(const std::string& path, const Fit& fitted) {
  std::ifstream in(path);
  std::ostringstream out;
  const std::regex definition("(.*constexpr ScalarWork (k\\w+) = )\\{.*\\};");
  for (std::string line; std::getline(in, line);) {
    std::smatch parts;
    const bool defines = std::regex_match(line, parts, definition);
    const auto found = defines ? fitted.charges.find(parts[2]) : fitted.charges.end();
    if (found == fitted.charges.end()) {
      out << line << '\n';
      continue;
    }
    out << parts[1] << '{';
    for (const double charge : found->second)
      out << static_cast<long>(charge) << ", ";
    out << '"' << parts[2] << "\"};\n";
  }
  in.close();
  std::ofstream(path) << out.str();
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("Calibrates the charges of compute()");
  std::vector<std::string> scenes, headers;
  std::string file;
  unsigned threads = 0;
  double trust = 0.3; // in what is there before
  app.require_subcommand(1);
  CLI::App* const measuring = app.add_subcommand("measure");
  measuring->add_option("scenes", scenes)->check(CLI::ExistingFile);
  measuring->add_option("--threads", threads);
  CLI::App* const fitting = app.add_subcommand("fit");
  fitting->add_option("file", file)->required()->check(CLI::ExistingFile);
  fitting->add_option("headers", headers)->check(CLI::ExistingFile);
  fitting->add_option("--trust", trust);
  CLI11_PARSE(app, argc, argv);
  if (measuring->parsed()) {
    measure(scenes, threads, std::cout);
    return 0;
  }
  std::ifstream in(file);
  const Fit fitted = fit(read(in), trust, std::cout);
  for (const std::string& header : headers)
    replace_charges(header, fitted);
  return 0;
}

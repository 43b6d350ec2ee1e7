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

int main(int argc, char** argv) {
  using namespace celltrace::calibration;
  CLI::App app("Calibrates the charges of compute()");
  std::vector<std::string> scenes, headers;
  std::string file;
  unsigned threads = 0;
  double trust = 1;
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
    write(std::cout, measure(scenes, threads));
    return 0;
  }
  std::ifstream in(file);
  fit(read(in), trust, std::cout);
  return 0;
}

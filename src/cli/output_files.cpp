#include "cli/output_files.hpp"

#include "celltrace/error.hpp"

#include <iostream>

namespace celltrace::cli {

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path) {
  if (!path.empty()) file_.open(path, std::ios::binary);
  check();
}

void OutputFile::finish() {
  if (!path_.empty()) file_.close();
  check();
}

void OutputFile::check() const {
  if (!file_) throw InputError(path_.string() + ": cannot be written");
}

void write_report(const std::string& where, const std::string& text) {
  if (where == "-") {
    std::cout << text << std::flush;
    return;
  }
  std::ofstream file(where);
  if (!(file << text << std::flush)) throw InputError(where + ": cannot be written");
}

} // namespace celltrace::cli

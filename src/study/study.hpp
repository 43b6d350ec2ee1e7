// The thesis's experiments again: on the emulated Cell in lockstep, whose virtual cycles are the same on
// every machine, with seconds of the host beside them.
#pragma once

#include "celltrace/spe/backend.hpp"
#include "study/table.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace celltrace::study {

struct StudyOptions {
  bool quick = false;   ///< smaller pictures and fewer scenes; the tables are the same
  unsigned threads = 0; ///< of the host; 0: as many as it has
  std::string only;     ///< id of the one table that is wanted; "": all
  /// Whose cycles: of cell_emu, counted operations, or of cell_sim, machine code. What machine code
  /// cannot show (`shapes`, `simd`) is of cell_emu all the same.
  Backend backend = Backend::cell_emu;
};

/// A ratio or a rest that the thesis claims, where it is best shown, and where it is not.
struct Claim {
  double value = 0;
  double thesis = 0;               ///< 0: it says nothing
  std::string scene;               ///< that `value` is of
  std::string parameters;          ///< of the render command, to reproduce it
  double bar = 0;                  ///< what is to be reached
  bool at_most = false;            ///< the bar is a ceiling
  std::vector<std::string> missed; ///< scenes on which the bar is not reached

  bool reached() const { return at_most ? value <= bar : value >= bar; }
};

struct Study {
  bool quick = false;
  Backend backend = Backend::cell_emu;
  std::vector<Table> tables;
  std::map<std::string, Claim> claims;
};

/// The ids of all tables, in their order.
std::vector<std::string> table_ids();

/// `progress` hears the number of jobs that are done, and the name of the table being made, from any thread
/// but one at a time. Throws InputError for an unknown id or another backend, or
/// cell_sim in a build without the SPU's machine code, and Error if two ways to render a scene give
/// different pictures.
Study run_study(const StudyOptions& options,
                const std::function<void(const std::string& table, int jobs)>& progress);

/// As people read it.
std::string to_text(const Study& study);

/// Writes study.txt, study.json, and a CSV file and an SVG picture for every table. Makes the folder; throws
/// InputError if a file cannot be written.
void save(const Study& study, const std::filesystem::path& folder);

} // namespace celltrace::study

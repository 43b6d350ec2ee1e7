// Repeats the thesis's experiments on the emulated Cell in lockstep, whose virtual cycles are the same on
// every machine; seconds of the host are given beside them.
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
  unsigned threads = 0; ///< threads of the host; 0: as many as it has
  std::string only;     ///< id of the only table to make; "": all
  /// Backend whose cycles are shown: cell_emu counts operations, cell_sim executes machine code. Tables that
  /// machine code cannot show (`shapes`, `simd`) use cell_emu in any case.
  Backend backend = Backend::cell_emu;
};

/// A ratio or a remainder that the thesis claims, the scene that shows it best, and the scenes that miss it.
struct Claim {
  double value = 0;
  double thesis = 0;               ///< value in the thesis; 0: none
  std::string scene;               ///< scene of `value`
  std::string parameters;          ///< options of the render command that reproduce it
  double bar = 0;                  ///< value to reach
  bool at_most = false;            ///< true: the bar is an upper limit
  std::vector<std::string> missed; ///< scenes that miss the bar

  bool reached() const { return at_most ? value <= bar : value >= bar; }
};

struct Study {
  bool quick = false;
  Backend backend = Backend::cell_emu;
  std::vector<Table> tables;
  std::map<std::string, Claim> claims;
};

/// Returns the ids of all tables, in their order.
std::vector<std::string> table_ids();

/// Runs the study. `progress` is called with the name of the present table and the number of finished jobs,
/// by any thread but one at a time. Throws InputError for an unknown id or another backend, or for cell_sim
/// in a build without the SPU's machine code, and Error if two ways to render a scene give different
/// pictures.
Study run_study(const StudyOptions& options,
                const std::function<void(const std::string& table, int jobs)>& progress);

/// Returns the study as text for people.
std::string to_text(const Study& study);

/// Writes study.txt, study.json, and a CSV file and an SVG picture for every table. Makes the folder; throws
/// InputError if a file cannot be written.
void save(const Study& study, const std::filesystem::path& folder);

} // namespace celltrace::study

#include "cli/spu_command.hpp"

#include "celltrace/error.hpp"
#include "celltrace/simulator.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_files.hpp"
#include "cli/spu_report.hpp"
#include "cli/unreadable_file.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <thread>

#include <unistd.h>

namespace celltrace::cli {

namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;

Bytes read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file || std::filesystem::is_directory(path)) throw unreadable(path);
  return bytes;
}

Bytes read_program(const std::filesystem::path& path) {
  Bytes elf = read_file(path);
  try {
    check_spu_program(elf);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return elf;
}

/// Forwards an interrupt by the user to code that takes a stop token.
class InterruptWatch {
public:
  InterruptWatch() {
    catch_interrupts();
    thread_ = std::jthread([this](const std::stop_token& over) {
      // Polls, since a signal handler may not request a stop itself.
      while (!over.stop_requested() && !interrupted())
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (interrupted()) source_.request_stop();
    });
  }
  std::stop_token token() const { return source_.get_token(); }

private:
  std::stop_source source_;
  std::jthread thread_;
};

auto writer_to(std::ostream& stream) {
  return [&stream](std::string_view piece) { stream << piece << std::flush; };
}

/// Returns the input that is available, at least one byte before the end; a terminal provides a line.
std::string read_piece(int descriptor) {
  std::string piece(65536, '\0');
  ssize_t count = 0;
  do
    count = ::read(descriptor, piece.data(), piece.size());
  while (count < 0 && errno == EINTR && !interrupted());
  piece.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return piece;
}

SimulatedRun run_program(const SpuRequest& request, const Bytes& elf, std::ostream* trace,
                         SpuProfile* profile) {
  MachineConfig config = request.machine;
  config.simulation.output = writer_to(std::cout);
  config.simulation.error_output = writer_to(std::cerr);
  if (request.input.empty()) {
    config.simulation.more_input = [] { return read_piece(STDIN_FILENO); };
  } else {
    const Bytes input = read_file(request.input);
    config.simulation.input.assign(input.begin(), input.end());
  }
  config.simulation.profile = profile;
  config.emulation.trace = trace;
  const InterruptWatch watch;
  return simulate(config, elf, 0, {}, watch.token());
}

bool failed(const SimulatedRun& run) {
  return std::any_of(run.errors.begin(), run.errors.end(),
                     [](const std::string& error) { return !error.empty(); });
}

/// Returns the errors that ended the run, each once: the error of one SPE also ends the others.
std::vector<std::string> errors_of(const SimulatedRun& run) {
  std::vector<std::string> errors;
  for (const std::string& error : run.errors)
    if (!error.empty()) errors.push_back(error);
  const auto repeats_another = [&](const std::string& error) {
    return std::any_of(errors.begin(), errors.end(), [&](const std::string& other) {
      return other.size() < error.size() && error.find(other) != std::string::npos;
    });
  };
  std::vector<std::string> firsts;
  std::copy_if(errors.begin(), errors.end(), std::back_inserter(firsts), std::not_fn(repeats_another));
  return firsts;
}

/// Prints warnings and errors; the diagnostic that stopped a program is among the errors.
void print_messages(const SimulatedRun& run, bool quiet) {
  for (const Diagnostic& diagnostic : run.diagnostics)
    if (diagnostic.action == Action::warn && !quiet)
      std::cerr << "celltrace: warning: " << diagnostic.text << '\n';
  for (const std::string& error : errors_of(run))
    std::cerr << "celltrace: error: " << error << '\n';
}

void write_profile(const SpuRequest& request, const SpuProfile& profile, const Bytes& elf) {
  const bool as_json = std::filesystem::path(request.profile).extension() == ".json";
  const double listed = request.profile_all ? 1 : 0.95;
  write_report(request.profile,
               as_json ? profile_json(profile, elf) + "\n" : profile_text(profile, elf, listed));
}

int exit_code_of(const SimulatedRun& run) {
  if (interrupted()) return kSpuInterrupted;
  if (run.broke(Rule::time_limit)) return kSpuLimitReached;
  if (failed(run)) return kSpuRunFailed;
  const auto code = std::find_if(run.exit_codes.begin(), run.exit_codes.end(),
                                 [](std::uint32_t each) { return each != 0; });
  return code == run.exit_codes.end() ? 0 : static_cast<int>(*code);
}

} // namespace

int run_spu(const SpuRequest& request) {
  const Bytes elf = read_program(request.program);
  OutputFile trace(request.trace, true);
  SpuProfile profile;
  const Clock::time_point start = Clock::now();
  const SimulatedRun run =
      run_program(request, elf, trace.stream(), request.profile.empty() ? nullptr : &profile);
  const std::chrono::duration<double> seconds = Clock::now() - start;
  trace.finish();
  print_messages(run, request.quiet);
  // A run that failed has statistics, too.
  if (!request.stats.empty())
    write_report(request.stats, spu_statistics(run, request.machine, seconds.count()));
  if (!request.profile.empty()) write_profile(request, profile, elf);
  if (request.summary) std::cerr << counters_text(run, request.machine.emulation.timing) << std::flush;
  return exit_code_of(run);
}

} // namespace celltrace::cli

#include "celltrace/error.hpp"
#include "cli/batch.hpp"
#include "cli/command_line.hpp"
#include "cli/compare_command.hpp"
#include "cli/invocation.hpp"
#include "cli/lenient_note.hpp"
#include "cli/message_files.hpp"
#include "cli/output_files.hpp"
#include "cli/render_command.hpp"
#include "cli/replay_command.hpp"
#include "cli/sandbox.hpp"
#include "cli/spu_command.hpp"
#include "cli/study_command.hpp"
#include "cli/used_files.hpp"
#include "cli/view_command.hpp"
#include "memory/huge_pages.hpp"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#include <unistd.h>
#endif

namespace {

using namespace celltrace::cli;

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes)
    std::cerr << "note: " << note << '\n';
}

/// Prepares the heap for a picture, which takes a few large blocks one after the other. By default glibc
/// would return each block to the system and fault in the pages of the next one anew, and cut the heap into
/// pieces too short for huge pages. Growing the heap once is enough for nearly all scenes, and puts it on
/// huge pages as a whole: large scenes are read in 0.75 of the time. That takes address space, but no memory
/// except for the last huge page.
void prepare_heap() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, -1);
  constexpr int kHeapOfMostScenes = 512 << 20;
  mallopt(M_TOP_PAD, kHeapOfMostScenes);
  char* const before = static_cast<char*>(sbrk(0));
  void* volatile grows = std::malloc(celltrace::kHugePage); // volatile, so that it is not optimised away
  std::free(grows);
  char* const after = static_cast<char*>(sbrk(0));
  if (after > before) celltrace::use_huge_pages(before, static_cast<std::size_t>(after - before));
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

int run_with_files(RenderRequest render) {
  const bool has_all = prepare_outputs(render);
  if (render.is_sandboxed) enter_sandbox(sandbox_files(render));
  const int code = run_render(render);
  return code == 0 && !has_all ? 1 : code;
}

int run(const char* program, const std::vector<std::string>& arguments, MessageFiles& messages) {
  const auto [request, notes] = read_invocation(program, arguments);
  if (const auto* information = std::get_if<InformationRequest>(&request)) {
    (information->is_for_stderr ? std::cerr : std::cout) << information->text << std::flush;
    return 0;
  }
  if (const auto* compare = std::get_if<CompareRequest>(&request)) return run_compare(*compare);
  if (const auto* view = std::get_if<ViewRequest>(&request)) return run_view(*view);
  if (const auto* spu = std::get_if<SpuRequest>(&request)) return run_spu(*spu);
  if (const auto* replay = std::get_if<ReplayRequest>(&request)) return run_replay(*replay);
  if (const auto* study = std::get_if<StudyRequest>(&request)) return run_study_command(*study);
  if (const auto* batch = std::get_if<BatchRequest>(&request)) {
    messages.open(batch->renders.front().messages);
    if (!batch->renders.front().quiet) print_notes(notes);
    return run_batch(*batch);
  }
  const auto& render = std::get<RenderRequest>(request);
  messages.open(render.messages);
  if (!render.quiet) {
    print_notes(notes);
    print_notes(render.notes);
  }
  return run_with_files(render);
}

/// Prints an error. Its text includes the place and "error:", except for a file that cannot be read: all such
/// files get the same message.
void print(const celltrace::SceneError& error) {
  const celltrace::Finding& first = error.findings().front();
  if (first.line == 0)
    std::cerr << "celltrace: error: " << first.file << ": " << first.text << '\n';
  else
    std::cerr << error.what() << '\n';
}

/// Returns the exit code for errors: `spu` leaves 1 to the programs that it runs.
int error_code(const std::vector<std::string>& arguments) {
  return !arguments.empty() && arguments.front() == "spu" ? kSpuRunFailed : 1;
}

} // namespace

int main(int argc, char** argv) {
  prepare_heap();
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  occupy_standard_streams();
  MessageFiles messages; // also gets errors
  try {
    const int code = run(argc > 0 ? argv[0] : "", arguments, messages);
    check_standard_output();
    return code;
  } catch (const celltrace::SceneError& error) {
    print(error);
    if (is_unsupported(error)) std::cerr << kLenientNote;
  } catch (const std::bad_alloc&) {
    std::cerr << "celltrace: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "celltrace: error: " << error.what() << '\n';
  }
  return error_code(arguments);
}

#include "cli/batch.hpp"

#include "celltrace/error.hpp"
#include "cli/contact_sheet.hpp"
#include "cli/interrupt.hpp"
#include "cli/lenient_note.hpp"
#include "cli/render_command.hpp"
#include "cli/sandbox.hpp"
#include "cli/used_files.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iostream>

namespace celltrace::cli {

namespace {

/// Renders a scene. If it fails, the error's first line becomes the result's text, and the whole error goes
/// to stderr.
SheetEntry render_one(RenderRequest render) {
  SheetEntry entry;
  entry.scene = render.scene.string();
  entry.picture = render.output.filename().string();
  const auto start = std::chrono::steady_clock::now();
  try {
    prepare_outputs(render);
    if (!render.quiet)
      for (const std::string& note : render.notes)
        std::cerr << "note: " << note << '\n';
    const int code = run_render(render);
    entry.state = code == 0 ? SheetEntry::State::done : SheetEntry::State::partial;
    if (!std::filesystem::exists(render.output)) throw Error("there is not a pixel of it");
  } catch (const SceneError& error) {
    entry.text = error.what();
    entry.is_unsupported = is_unsupported(error);
  } catch (const std::bad_alloc&) {
    entry.text = "celltrace: error: out of memory";
  } catch (const std::exception& error) {
    entry.text = std::string("celltrace: error: ") + error.what();
  }
  if (!entry.text.empty()) std::cerr << entry.text << '\n';
  entry.text = entry.text.substr(0, entry.text.find('\n'));
  entry.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return entry;
}

/// Returns the files of all renders together: one sandbox has to serve all, as the process cannot leave it.
SandboxFiles files_of_all(const BatchRequest& batch) {
  SandboxFiles files;
  for (const RenderRequest& render : batch.renders) {
    const SandboxFiles more = sandbox_files(render);
    files.readable.insert(files.readable.end(), more.readable.begin(), more.readable.end());
    files.writable.insert(files.writable.end(), more.writable.begin(), more.writable.end());
  }
  return files;
}

} // namespace

int run_batch(const BatchRequest& batch) {
  make_folder(batch.folder);
  const RenderRequest& first = batch.renders.front();
  if (first.is_sandboxed) enter_sandbox(files_of_all(batch));
  ContactSheet sheet;
  for (const RenderRequest& render : batch.renders) {
    sheet.add(render_one(render));
    interrupt_after(0); // ends the time limit of the last scene
    if (interrupted()) break;
  }
  const std::filesystem::path page = batch.folder / "contact-sheet.html";
  sheet.write(page);
  if (sheet.count_unsupported() != 0) std::cerr << kLenientNote;
  if (!first.quiet)
    std::cerr << page.string() << ": " << sheet.count(SheetEntry::State::done) << " of "
              << batch.renders.size() << " scenes rendered"
              << (interrupted() ? "; to finish, run the same command with --resume (+C)" : "") << '\n';
  if (sheet.count(SheetEntry::State::failed) != 0) return 1;
  return interrupted() || sheet.count(SheetEntry::State::partial) != 0 ? 2 : 0;
}

} // namespace celltrace::cli

// Restricts the process while it reads and renders an untrusted scene (`--sandbox`).
#pragma once

#include "cli/command_line.hpp"

#include <filesystem>
#include <vector>

namespace celltrace::cli {

/// Files, and folders with everything below them.
struct SandboxFiles {
  std::vector<std::filesystem::path> readable, writable;
};

/// Returns the files that a render needs: for reading, the scene's folder, the folders of its options and
/// those of POV-Ray's include files; for writing, the folders of its outputs and of `--allow-write`.
SandboxFiles sandbox_files(const RenderRequest& request);

/// Restricts this thread, and the threads that it starts, to these files from now on; they can start no
/// process and open no socket. Open files stay open. Throws Error if the kernel (Landlock, seccomp) or the
/// build (libseccomp) cannot enforce all of that.
void enter_sandbox(const SandboxFiles& files);

} // namespace celltrace::cli

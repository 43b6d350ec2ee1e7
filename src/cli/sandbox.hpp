// Limits of the process while it reads and renders a scene that nobody trusts (`--sandbox`).
#pragma once

#include "cli/command_line.hpp"

#include <filesystem>
#include <vector>

namespace celltrace::cli {

/// Files and folders with all below them.
struct SandboxFiles {
  std::vector<std::filesystem::path> readable, writable;
};

/// Returns what a render needs: the scene's folder, the folders of its options and those of POV-Ray's include
/// files to read, and the folders of its outputs and `--allow-write` to write.
SandboxFiles sandbox_files(const RenderRequest& request);

/// From now on this thread, and those that it starts, can open these files alone, and start no process and
/// open no socket. What is open stays open. Throws Error where the kernel (Landlock, seccomp) or the build
/// (libseccomp) cannot do all of that.
void enter_sandbox(const SandboxFiles& files);

} // namespace celltrace::cli

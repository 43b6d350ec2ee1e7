// The options of `render` for the destinations of messages.
#pragma once

#include "cli/command_line.hpp"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

/// Texts that CLI11 fills in besides the request.
struct MessageTexts {
  std::vector<std::string> files; ///< KIND=FILE
  std::vector<std::string> hidden;
  std::string append = "off";
};

void add_message_options(CLI::App& command, MessageTexts& texts);

/// Completes the request, whose output must be known: puts files without a folder beside the picture, as
/// POV-Ray does. Throws InputError for an unknown kind of messages, and if a file is the same as the
/// picture's.
void finish_messages(RenderRequest& request, const MessageTexts& texts);

} // namespace celltrace::cli

// The options of `render` that say where messages go.
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

/// Puts files without a folder beside the picture, as POV-Ray does; the request's output has to be known.
/// Throws InputError for a kind of messages that there is not, and for a file that is the picture's, too.
void finish_messages(RenderRequest& request, const MessageTexts& texts);

} // namespace celltrace::cli

#include "cli/message_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"
#include "image/file.hpp"

#include <algorithm>
#include <optional>

namespace celltrace::cli {

namespace {

constexpr std::pair<const char*, MessageKind> kKinds[] = {{"debug", MessageKind::debug},
                                                          {"error", MessageKind::error},
                                                          {"render", MessageKind::render},
                                                          {"statistics", MessageKind::statistics},
                                                          {"warning", MessageKind::warning}};

/// Returns the kind with this name; nothing for "all".
std::optional<MessageKind> kind_named(const std::string& name, const std::string& option) {
  if (name == "all") return std::nullopt;
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const auto& kind) { return name == kind.first; });
  if (found != std::end(kKinds)) return found->second;
  throw InputError(option + ": '" + name +
                   "' is no kind of messages: all, debug, error, render, statistics and warning are");
}

std::filesystem::path place_of(const std::filesystem::path& file, const RenderRequest& request) {
  const bool is_stream = request.output == kStandardOutput || image::is_stream(request.output);
  const std::filesystem::path place =
      file.has_parent_path() || is_stream ? file : request.output.parent_path() / file;
  for (const std::filesystem::path& other : {request.output, std::filesystem::path(request.stats)})
    if (place.lexically_normal() == other.lexically_normal())
      throw InputError(place.string() + ": this file would be written twice");
  return place;
}

} // namespace

void add_message_options(CLI::App& command, MessageTexts& texts) {
  command
      .add_option("--message-file", texts.files,
                  "Also write messages of a kind into this file: all, debug, error, render, statistics or "
                  "warning; may be repeated")
      ->type_name("KIND=FILE")
      ->allow_extra_args(false);
  add_choice(command, "--append-messages", texts.append, {{"on", "off"}, {}},
             "Whether messages are appended to the files of --message-file");
  command
      .add_option("--hide", texts.hidden,
                  "Do not print messages of this kind, except errors; may be repeated")
      ->type_name("KIND")
      ->allow_extra_args(false);
}

void finish_messages(RenderRequest& request, const MessageTexts& texts) {
  MessageRequest& messages = request.messages;
  messages.appends = texts.append == "on";
  for (const std::string& text : texts.files) {
    const std::size_t equals = std::min(text.find('='), text.size());
    if (equals + 1 >= text.size()) throw InputError("--message-file: '" + text + "' is not KIND=FILE");
    const std::filesystem::path file = place_of(text.substr(equals + 1), request);
    if (const auto kind = kind_named(text.substr(0, equals), "--message-file"))
      messages.files.emplace_back(*kind, file);
    else
      messages.all_files.push_back(file);
  }
  for (const std::string& name : texts.hidden) {
    const std::optional<MessageKind> kind = kind_named(name, "--hide");
    for (const auto& [other, each] : kKinds)
      if (kind ? each == *kind : each != MessageKind::error) messages.hidden.push_back(each);
  }
}

} // namespace celltrace::cli

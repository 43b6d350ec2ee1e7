#include "cli/pov_choices.hpp"

#include "cli/pov_numbers.hpp"

#include <algorithm>
#include <cctype>

namespace celltrace::cli {

namespace {

struct FileType {
  char letter; // lower case
  std::string_view name;
  bool has_bits; // 8 or 16 bits per channel
};

constexpr FileType kFileTypes[] = {
    {'n', "png", true},  {'p', "ppm", true},  {'e', "exr", false}, {'h', "hdr", false},
    {'t', "tga", false}, {'c', "tga", false}, {'b', "bmp", false}, {'j', "jpeg", false},
};

const FileType* find_file_type(char letter) {
  const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const auto found = std::find_if(std::begin(kFileTypes), std::end(kFileTypes),
                                  [&](const FileType& type) { return type.letter == lower; });
  return found == std::end(kFileTypes) ? nullptr : found;
}

using Options = std::vector<std::string>;

void add(Options& options, const char* name, std::string value) {
  options.emplace_back(name);
  options.push_back(std::move(value));
}

} // namespace

std::vector<std::string> SamplingChoice::options() const {
  Options options;
  if (!is_on || method == 0.0) return options;
  add(options, "--antialias", number_text(threshold));
  if (method) add(options, "--antialias-method", number_text(*method));
  if (depth) add(options, "--antialias-depth", number_text(*depth));
  if (jitters && jitter > 0) add(options, "--antialias-jitter", number_text(jitter));
  if (gamma) add(options, "--antialias-gamma", number_text(*gamma));
  return options;
}

std::string_view file_type_name(char letter) {
  const FileType* type = find_file_type(letter);
  return type ? type->name : std::string_view();
}

std::vector<std::string> FileChoice::options() const {
  constexpr int kDefaultQuality = 2; // lower values choose JPEG's default quality
  Options options;
  const FileType* const file_type = find_file_type(type == 0 ? 'n' : type);
  if (bits && file_type->has_bits && !is_grey) add(options, "--bits", *bits > 8 ? "16" : "8");
  if (is_grey) add(options, "--grey", "on");
  if (file_type->letter == 'c') add(options, "--compression", "rle");
  if (gamma) add(options, "--file-gamma", number_text(*gamma));
  if (file_type->name == "jpeg" && compression >= kDefaultQuality)
    add(options, "--jpeg-quality", number_text(std::min(compression, 100.0)));
  return options;
}

std::vector<std::string> MessageChoice::options() const {
  Options options;
  for (const auto& [kind, is_printed] : printed)
    if (!is_printed) add(options, "--hide", kind);
  for (const auto& [kind, file] : files)
    add(options, "--message-file", kind + '=' + file);
  if (appends && !files.empty()) add(options, "--append-messages", "on");
  return options;
}

} // namespace celltrace::cli

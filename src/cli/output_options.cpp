#include "cli/output_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"

#include <algorithm>
#include <cctype>

namespace celltrace::cli {

namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string extension_of(const OutputTexts& texts) {
  return '.' + (texts.file_type.empty() ? "png" : texts.file_type);
}

/// POV-Ray adds the extension where a file name has none, and the scene's name to a folder.
std::filesystem::path output_of(const RenderRequest& request, const OutputTexts& texts) {
  if (texts.picture == "off") return {};
  const std::string extension = extension_of(texts);
  std::filesystem::path output = request.output;
  if (output == kStandardOutput) return output;
  // The scene's folder is POV-Ray's choice.
  if (output.empty() && request.stands_in_for_povray) output = request.scene.parent_path() / "";
  if (!output.has_filename()) return output / (request.scene.stem().string() + extension);
  if (!output.has_extension()) return output += extension;
  if (!texts.file_type.empty() && lower_extension(output) != extension)
    throw InputError(output.string() + ": the name does not say that the picture is to be a " +
                     texts.file_type);
  return output;
}

FilmFormat film_of(const RenderRequest& request, const OutputTexts& texts) {
  if (request.output != kStandardOutput) return film_format_of(request.output);
  return texts.file_type == "y4m" ? FilmFormat::y4m : FilmFormat::none;
}

/// What the picture's format asks of rendering.
void set_format(RenderRequest& request, const OutputTexts& texts) {
  RenderOptions& options = request.options;
  options.alpha = texts.alpha == "on";
  options.first_hits = texts.first_hits == "on";
  request.bits = texts.bits.value_or(8);
  if (request.output.empty()) return;
  const bool is_film = request.film != FilmFormat::none;
  const bool is_stdout = request.output == kStandardOutput;
  if (!is_film)
    request.format = image_format_of(is_stdout ? "stdout" + extension_of(texts) : request.output.string());
  const auto is = [&](ImageFormat format) { return !is_film && request.format == format; };
  const bool is_exr = is(ImageFormat::exr);
  if (options.alpha && !is_exr && !is(ImageFormat::png))
    throw InputError("only PNG and OpenEXR files have alpha");
  if (options.first_hits && !is_exr) throw InputError("--first-hits is for OpenEXR files");
  if (is_film) return;
  const int least = is_exr ? 16 : 8;
  const bool has_depths = is_exr || is(ImageFormat::png) || is(ImageFormat::ppm);
  request.bits = texts.bits.value_or(least);
  if (request.bits != least && (!has_depths || request.bits != 2 * least))
    throw InputError("--bits " + std::to_string(request.bits) + " is not for pictures of this format");
  options.colours = holds_numbers(request.format) || request.bits == 16;
  // Of other pictures the blocks are made in the end.
  options.blocks =
      is(ImageFormat::dds) && options.model == Model::shared && !options.antialiasing && !options.region;
}

} // namespace

void add_output_options(CLI::App& command, RenderRequest& request, OutputTexts& texts) {
  command
      .add_option("-o,--output", request.output,
                  "The picture or the film; default: the scene's name, here. A folder: the scene's name, "
                  "there. - is stdout")
      ->type_name("OUT.png|ppm|exr|hdr|dds|y4m|mp4|DIR/|-");
  add_choice(command, "--file-type,--format", texts.file_type,
             {{"png", "ppm", "exr", "hdr", "dds", "y4m"}, {}},
             "What the picture is if its name does not say; default: png");
  command
      .add_option("--bits", texts.bits,
                  "Bits a channel of the picture: 8 or 16; of OpenEXR 16 or 32, which are floats")
      ->check(CLI::IsMember({8, 16, 32}));
  add_choice(command, "--first-hits", texts.first_hits, {{"on", "off"}, {}},
             "Whether an OpenEXR file has depths, normals and numbers of objects, too");
  add_choice(command, "--picture", texts.picture, {{"on", "off"}, {}}, "Whether the picture is written");
  add_choice(command, "--alpha", texts.alpha, {{"on", "off"}, {}},
             "Whether pixels are clear where nothing is, and half clear behind what is transparent");
}

void finish_output(RenderRequest& request, const OutputTexts& texts) {
  request.output = output_of(request, texts);
  request.film = film_of(request, texts);
  set_format(request, texts);
  if (request.output != kStandardOutput) return;
  if (request.stats == kStandardOutput)
    throw InputError("picture and statistics cannot both go to standard output");
  if (request.animation.is_on() && request.film == FilmFormat::none)
    throw InputError("an animation goes to standard output as a film, of --file-type y4m");
}

} // namespace celltrace::cli

#include "cli/output_options.hpp"

#include "celltrace/error.hpp"
#include "cli/choice.hpp"
#include "cli/output_files.hpp"
#include "image/file.hpp"
#include "image/format_table.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include <sys/stat.h>

namespace celltrace::cli {

namespace {

/// Returns the words of --file-type: extensions of pictures and films.
std::vector<std::string> file_types() {
  return {"png", "ppm", "jpg", "jpeg", "tga", "bmp", "exr", "hdr", "dds", "y4m"};
}

std::string extension_of(const OutputTexts& texts) {
  return '.' + (texts.file_type.empty() ? "png" : texts.file_type == "jpeg" ? "jpg" : texts.file_type);
}

/// Returns the output file: a name without an extension gets that of the file type, and a folder the scene's
/// name.
std::filesystem::path own_output(const RenderRequest& request, const OutputTexts& texts) {
  const std::string extension = extension_of(texts);
  std::filesystem::path output = request.output;
  if (std::error_code ignored; output.has_filename() && std::filesystem::is_directory(output, ignored))
    output /= "";
  // POV-Ray writes to the scene's folder.
  if (output.empty() && request.stands_in_for_povray) output = request.scene.parent_path() / "";
  if (!output.has_filename()) return output / (request.scene.stem().string() + extension);
  if (!output.has_extension()) return output += extension;
  if (texts.file_type.empty()) return output;
  const bool is_film = texts.file_type == "y4m";
  const bool is_right =
      is_film ? film_format_of(output) == FilmFormat::y4m
              : image::find_format(output.extension().string()) == image::find_format(extension);
  if (!is_right)
    throw InputError(output.string() + ": the name does not say that the picture is to be a " +
                     texts.file_type);
  return output;
}

bool is_stream_of_bytes(const std::filesystem::path& output) {
  return output == kStandardOutput || (!output.empty() && image::is_stream(output));
}

std::filesystem::path output_of(const RenderRequest& request, const OutputTexts& texts) {
  if (texts.picture == "off") return {};
  const bool is_own = texts.pov_name.empty() || !request.output.empty();
  const std::filesystem::path given = is_own ? request.output : std::filesystem::path(texts.pov_name);
  if (is_stream_of_bytes(given)) return given;
  if (is_own) return own_output(request, texts);
  // POV-Ray has no films, so that these have names as everywhere.
  if (film_format_of(given) != FilmFormat::none) return given;
  return pov_output(texts.pov_name, request.scene, extension_of(texts));
}

FilmFormat film_of(const RenderRequest& request, const OutputTexts& texts) {
  if (!is_stream_of_bytes(request.output)) return film_format_of(request.output);
  return texts.file_type == "y4m" ? FilmFormat::y4m : FilmFormat::none;
}

FileGamma file_gamma_of(const std::string& text) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == "srgb") return {};
  double power = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), power);
  if (error != std::errc() || end != text.data() + text.size() || !(power > 0) || !std::isfinite(power))
    throw InputError("--file-gamma has to be sRGB or a number above 0, not '" + text + "'");
  return {power};
}

/// Returns the bits per channel of the file. As in POV-Ray, any number is accepted for any format.
int bits_of(RenderRequest& request, const OutputTexts& texts, const image::FormatRow& row) {
  const int usual = request.file.grey ? row.holds.bits.back() : row.holds.bits.front(); // as in POV-Ray
  const int wanted = texts.bits.value_or(usual);
  for (const int bits : row.holds.bits)
    if (bits == wanted) return bits;
  if (wanted > 16)
    throw InputError("--bits " + std::to_string(wanted) + " is not for pictures of this format");
  const auto enough =
      std::find_if(row.holds.bits.begin(), row.holds.bits.end(), [&](int bits) { return bits > wanted; });
  const int bits = enough != row.holds.bits.end() ? *enough : row.holds.bits.back();
  request.notes.push_back("--bits " + std::to_string(wanted) + ": " + row.name + " has " +
                          std::to_string(bits) + " bits a channel here");
  return bits;
}

/// Sets rendering options that a picture's format needs.
void set_picture_format(RenderRequest& request, const OutputTexts& texts) {
  RenderOptions& options = request.options;
  const bool is_stream = is_stream_of_bytes(request.output);
  request.format = image_format_of(is_stream ? "stdout" + extension_of(texts) : request.output.string());
  const image::FormatRow& row = image::row_of(request.format);
  const std::string name = row.name;
  FileOptions& file = request.file;
  file.format = request.format;
  if (file.grey && !row.holds.grey) throw InputError("--grey: " + name + " has no grey pixels");
  if (file.run_lengths && request.format != ImageFormat::tga)
    throw InputError("--compression rle is for TGA files");
  if (options.first_hits && request.format != ImageFormat::exr)
    throw InputError("--first-hits is for OpenEXR files");
  request.bits = file.bits = bits_of(request, texts, row);
  if (options.alpha && row.holds.pixels == image::Pixels::blocks) throw InputError(name + " has no alpha");
  if (options.alpha && row.holds.alpha) file.alpha = true;
  if (options.alpha && !row.holds.alpha)
    request.notes.push_back(name + " has no alpha: the picture is in front of black");
  options.colours =
      row.holds.pixels == image::Pixels::numbers ||
      (row.holds.pixels == image::Pixels::encoded &&
       (request.bits == 16 || file.grey || file.gamma.power || (options.alpha && !row.holds.alpha)));
  // The blocks of other pictures are encoded at the end.
  options.blocks = row.holds.pixels == image::Pixels::blocks && options.model == Model::shared &&
                   !options.antialiasing && !options.region;
}

void set_format(RenderRequest& request, const OutputTexts& texts) {
  RenderOptions& options = request.options;
  options.alpha = texts.alpha == "on";
  options.first_hits = texts.first_hits == "on";
  request.bits = texts.bits.value_or(8);
  request.file.grey = texts.grey == "on";
  request.file.run_lengths = texts.compression == "rle";
  request.file.gamma = file_gamma_of(texts.file_gamma);
  if (request.output.empty()) return;
  if (request.film == FilmFormat::none) return set_picture_format(request, texts);
  if (options.alpha) throw InputError("a film has no alpha");
  if (request.file.grey) throw InputError("--grey is not for films");
  if (options.first_hits) throw InputError("--first-hits is for OpenEXR files");
}

/// Returns whether the output is /dev/null, which accepts any number of pictures.
bool is_nothing(const std::filesystem::path& output) {
  struct stat status, nothing;
  return output != kStandardOutput && stat(output.c_str(), &status) == 0 &&
         stat("/dev/null", &nothing) == 0 && S_ISCHR(status.st_mode) && status.st_rdev == nothing.st_rdev;
}

} // namespace

std::filesystem::path pov_output(const std::string& name, const std::filesystem::path& scene,
                                 const std::string& extension) {
  if (name.empty() || name.back() == '/') return name + scene.stem().string() + extension;
  const std::size_t dot = name.find_last_of("./");
  const bool has_extension = dot != std::string::npos && name.compare(dot, std::string::npos, extension) == 0;
  // A name that is only an extension gets the scene's name in front.
  if (has_extension && (dot == 0 || name[dot - 1] == '/'))
    return name.substr(0, dot) + scene.stem().string() + extension;
  if (has_extension) return name;
  return (name.back() == '.' ? name.substr(0, name.size() - 1) : name) + extension;
}

void add_output_options(CLI::App& command, RenderRequest& request, OutputTexts& texts) {
  command
      .add_option("-o,--output", request.output,
                  "The picture or film to write, or its folder; default: the scene's name, in the current "
                  "folder; - is stdout")
      ->type_name("OUT.png|jpg|tga|bmp|ppm|exr|hdr|dds|y4m|mp4|DIR/|-");
  command
      .add_option("--pov-output", texts.pov_name,
                  "The picture's name by the rule of POV-Ray's +O: a name with another extension than the "
                  "file type's gets this one appended")
      ->type_name("NAME|DIR/");
  add_choice(command, "--file-type,--format", texts.file_type, {file_types(), {}},
             "Type of the picture if its name has no extension; default: png");
  command
      .add_option("--bits", texts.bits,
                  "Bits of a channel of the picture: 8 or 16; for OpenEXR 16 or 32 (floats)")
      ->check(CLI::Range(1, 32));
  add_choice(
      command, "--grey", texts.grey, {{"on", "off"}, {}},
      "Whether a PNG, PPM, TGA or JPEG has the luminance of colours alone; PNG and PPM then have 16 bits by "
      "default");
  command
      .add_option("--file-gamma", texts.file_gamma,
                  "Encoding of colours in files of 8 and 16 bits a channel; default: sRGB")
      ->type_name("sRGB|POWER");
  command.add_option("--jpeg-quality", request.file.jpeg_quality, "Quality of a JPEG, 0 to 100; default: 85")
      ->check(CLI::Range(0, 100));
  add_choice(command, "--compression", texts.compression, {{"none", "rle"}, {}},
             "Compression of a TGA file: none or run lengths");
  add_choice(
      command, "--first-hits", texts.first_hits, {{"on", "off"}, {}},
      "Whether an OpenEXR file also has the depth, normal and object number of each pixel's first hit");
  add_choice(command, "--picture", texts.picture, {{"on", "off"}, {}}, "Whether the picture is written");
  add_choice(command, "--alpha", texts.alpha, {{"on", "off"}, {}},
             "Whether the picture has alpha: pixels are transparent where nothing is, and partly transparent "
             "behind glass and in fog");
}

void finish_output(RenderRequest& request, const OutputTexts& texts) {
  request.makes_folder = !request.output.empty() && !request.output.has_filename();
  request.output = output_of(request, texts);
  request.film = film_of(request, texts);
  set_format(request, texts);
  if (!is_stream_of_bytes(request.output)) return;
  if (request.output == kStandardOutput && request.stats == kStandardOutput)
    throw InputError("picture and statistics cannot both go to standard output");
  if (!request.animation.is_on() || request.film != FilmFormat::none) return;
  if (!is_nothing(request.output))
    throw InputError("an animation goes to " +
                     (request.output == kStandardOutput ? "standard output" : request.output.string()) +
                     " as a film, of --file-type y4m");
  request.output.clear();
}

} // namespace celltrace::cli

#include "cli/pov_settings.hpp"

#include "celltrace/image.hpp"
#include "cli/frame_numbers.hpp"

#include <algorithm>
#include <cctype>

namespace celltrace::cli {

namespace {

constexpr double kMostRegion = 1e9; // in pixels

constexpr PovSetting kSettings[] = {
    {"I", "input_file_name", Action::scene},
    {"HI", "include_header", Action::header},
    {"L", "library_path", Action::folder},
    {"", "include_ini", Action::include_ini},
    {"", "declare", Action::declare},
    {"MV", "version", Action::real, "--language-version", 1, 100, OutOfRange::nearest},

    {"W", "width", Action::whole, "-W", 1, kMaxImageSide},
    {"H", "height", Action::whole, "-H", 1, kMaxImageSide},
    {"SC", "start_column", Action::real, "--start-column", 0, kMostRegion},
    {"EC", "end_column", Action::real, "--end-column", 0, kMostRegion},
    {"SR", "start_row", Action::real, "--start-row", 0, kMostRegion},
    {"ER", "end_row", Action::real, "--end-row", 0, kMostRegion},
    {"Q", "quality", Action::whole, "--quality", 0, 11, OutOfRange::nearest},
    {"WT", "work_threads", Action::whole, "--spes", 1, 256, OutOfRange::nearest},

    {"A", "antialias", Action::antialias, {}, 0, 3},
    {"", "antialias_threshold", Action::threshold, {}, 0, 3, OutOfRange::nearest},
    {"AM", "sampling_method", Action::sampling, {}, 0, 2, OutOfRange::nearest},
    {"R", "antialias_depth", Action::sampling_depth, {}, 1, 9, OutOfRange::nearest},
    {"AG", "antialias_gamma", Action::sampling_gamma, {}, 0.01, 100, OutOfRange::nearest},
    {"J", "jitter", Action::jitter, {}, 0, 1, OutOfRange::nearest},
    {"", "jitter_amount", Action::jitter_amount, {}, 0, 1, OutOfRange::nearest},

    {"K", "clock", Action::real, "--clock"},
    {"KC", "cyclic_animation", Action::on_off, "--cyclic"},
    {"KI", "initial_clock", Action::real, "--initial-clock"},
    {"KF", "final_clock", Action::real, "--final-clock"},
    {"KFI", "initial_frame", Action::whole, "--initial-frame", 0, kMaxFrame, OutOfRange::nearest},
    {"KFF", "final_frame", Action::whole, "--final-frame", 0, kMaxFrame},
    {"SF", "subset_start_frame", Action::real, "--start-frame", 0, kMaxFrame, OutOfRange::nearest},
    {"EF", "subset_end_frame", Action::real, "--end-frame", 0, kMaxFrame, OutOfRange::nearest},
    {"STP", "frame_step", Action::whole, "--frame-step", 1, kMaxFrame, OutOfRange::nearest},
    {"", "clockless_animation", Action::refused_if_on, "an animation that changes cameras"},
    {"UF", "field_render", Action::without_effect},
    {"UO", "odd_field", Action::without_effect},

    {"O", "output_file_name", Action::output},
    {"", "output_to_file", Action::to_file},
    {"F", "", Action::file_switch},
    {"", "output_file_type", Action::file_type},
    {"", "bits_per_color", Action::bits},
    {"", "bits_per_colour", Action::bits},
    {"UA", "output_alpha", Action::on_off, "--alpha"},
    {"", "grayscale_output", Action::grey},
    {"", "file_gamma", Action::file_gamma, {}, 0.01, 100},
    {"", "compression", Action::compression},
    {"C", "continue_trace", Action::resume},

    {"GA", "", Action::stream, "all"},
    {"GD", "", Action::stream, "debug"},
    {"GF", "", Action::stream, "error"},
    {"GR", "", Action::stream, "render"},
    {"GS", "", Action::stream, "statistics"},
    {"GW", "", Action::stream, "warning"},
    {"", "all_console", Action::console, "all"},
    {"", "debug_console", Action::console, "debug"},
    {"", "fatal_console", Action::console, "error"},
    {"", "render_console", Action::console, "render"},
    {"", "statistic_console", Action::console, "statistics"},
    {"", "warning_console", Action::console, "warning"},
    {"", "all_file", Action::text_file, "all"},
    {"", "debug_file", Action::text_file, "debug"},
    {"", "fatal_file", Action::text_file, "error"},
    {"", "render_file", Action::text_file, "render"},
    {"", "statistic_file", Action::text_file, "statistics"},
    {"", "warning_file", Action::text_file, "warning"},
    {"", "append_file", Action::append},
    {"V", "verbose", Action::on_off, "--verbose"},

    {"", "pre_scene_command", Action::never_run},
    {"", "pre_frame_command", Action::never_run},
    {"", "post_scene_command", Action::never_run},
    {"", "post_frame_command", Action::never_run},
    {"", "user_abort_command", Action::never_run},
    {"", "fatal_error_command", Action::never_run},
    {"", "pre_scene_return", Action::ignored_word},
    {"", "pre_frame_return", Action::ignored_word},
    {"", "post_scene_return", Action::ignored_word},
    {"", "post_frame_return", Action::ignored_word},
    {"", "user_abort_return", Action::ignored_word},
    {"", "fatal_error_return", Action::ignored_word},

    {"B", "buffer_output", Action::ignored_perhaps},
    {"BM", "bounding_method", Action::ignored_number},
    {"BP", "", Action::ignored_perhaps},
    {"BS", "render_block_size", Action::ignored_number},
    {"D", "display", Action::ignored_word},
    {"DV", "", Action::ignored},
    {"EP", "preview_end_size", Action::ignored_number},
    {"GI", "create_ini", Action::ignored_word},
    {"GP", "", Action::ignored_word},
    {"HR", "high_reproducibility", Action::ignored},
    {"MB", "bounding", Action::ignored_perhaps},
    {"MI", "max_image_buffer_memory", Action::ignored_number},
    {"P", "pause_when_done", Action::ignored},
    {"RF", "radiosity_file_name", Action::ignored_word},
    {"RFI", "radiosity_from_file", Action::ignored},
    {"RFO", "radiosity_to_file", Action::ignored},
    {"RP", "render_pattern", Action::ignored_number},
    {"RS", "render_block_step", Action::ignored_number},
    {"RTR", "real_time_raytracing", Action::ignored},
    {"RVP", "radiosity_vain_pretrace", Action::ignored},
    {"SP", "preview_start_size", Action::ignored_number},
    {"SU", "split_unions", Action::ignored},
    {"TH", "dither", Action::ignored},
    {"UD", "draw_vistas", Action::ignored},
    {"UL", "light_buffer", Action::ignored},
    {"UR", "remove_bounds", Action::ignored},
    {"UV", "vista_buffer", Action::ignored},
    {"WL", "warning_level", Action::ignored_number},
    {"X", "test_abort", Action::ignored_perhaps},
    {"", "antialias_confidence", Action::ignored_number},
    {"", "bounding_threshold", Action::ignored_number},
    {"", "bsp_baseaccesscost", Action::ignored_number},
    {"", "bsp_childaccesscost", Action::ignored_number},
    {"", "bsp_isectcost", Action::ignored_number},
    {"", "bsp_maxdepth", Action::ignored_number},
    {"", "bsp_misschance", Action::ignored_number},
    {"", "buffer_size", Action::ignored_number},
    {"", "create_continue_trace_log", Action::ignored},
    {"", "create_histogram", Action::ignored},
    {"", "display_gamma", Action::ignored_word},
    {"", "dither_method", Action::ignored_word},
    {"", "histogram_grid_size", Action::ignored_word},
    {"", "histogram_name", Action::ignored_word},
    {"", "histogram_type", Action::ignored_word},
    {"", "palette", Action::ignored_word},
    {"", "stochastic_seed", Action::ignored_number},
    {"", "test_abort_count", Action::ignored_number},
    {"", "video_mode", Action::ignored_word},
};

bool same_letter(char a, char lower) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(lower));
}

} // namespace

bool begins_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), same_letter);
}

bool ends_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && begins_with(text.substr(text.size() - word.size()), word);
}

bool same_word(std::string_view text, std::string_view word) {
  return text.size() == word.size() && begins_with(text, word);
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return same_word(text, word); });
}

const PovSetting* find_switch(std::string_view text) {
  const PovSetting* best = nullptr;
  for (const PovSetting& candidate : kSettings)
    if (!candidate.letters.empty() && begins_with(text, candidate.letters) &&
        (!best || candidate.letters.size() > best->letters.size()))
      best = &candidate;
  return best;
}

const PovSetting* find_setting(std::string_view name) {
  const auto found = std::find_if(std::begin(kSettings), std::end(kSettings), [&](const PovSetting& setting) {
    return !setting.name.empty() && same_word(name, setting.name);
  });
  return found == std::end(kSettings) ? nullptr : found;
}

bool takes_blanks(Action action) {
  switch (action) {
  case Action::scene:
  case Action::output:
  case Action::header:
  case Action::folder:
  case Action::include_ini:
  case Action::declare:
  case Action::stream:
  case Action::text_file:
  case Action::never_run:
  case Action::ignored_word:
    return true;
  default:
    return false;
  }
}

bool is_on(std::string_view value) {
  return begins_with(value, "on") || begins_with(value, "y") || begins_with(value, "t") ||
         begins_with(value, "1");
}

bool is_off_word(std::string_view value) {
  return is_one_of(value, {"off", "no", "false", "0"});
}

} // namespace celltrace::cli

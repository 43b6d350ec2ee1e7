#include "cli/command_line.hpp"

#include "celltrace/error.hpp"
#include "celltrace/version.hpp"
#include "cli/animation_options.hpp"
#include "cli/choice.hpp"
#include "cli/completions.hpp"
#include "cli/declares.hpp"
#include "cli/help_page.hpp"
#include "cli/keyword_page.hpp"
#include "cli/machine_options.hpp"
#include "cli/man_page.hpp"
#include "cli/message_options.hpp"
#include "cli/option_errors.hpp"
#include "cli/output_options.hpp"
#include "cli/pov_numbers.hpp"
#include "cli/sampling_options.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <sstream>

#include <CLI/CLI.hpp>

namespace celltrace::cli {

namespace {

bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

/// Returns the texts before and after the first `separator`; the whole text and "" if there is none.
std::pair<std::string, std::string> split(const std::string& text, char separator) {
  const std::size_t at = std::min(text.find(separator), text.size());
  return {text.substr(0, at), text.substr(std::min(at + 1, text.size()))};
}

constexpr const char* kRenderSeconds = "render-seconds";
constexpr const char* kRenderMemory = "render-memory";

/// Sets a limit from NAME=VALUE, where K, M and G after the value stand for 2^10, 2^20 and 2^30.
void set_limit(RenderRequest& request, const std::string& text) {
  const auto [wanted_name, value] = split(text, '=');
  const std::string& wanted = wanted_name;
  const auto& known = parse_limits();
  const auto limit = std::find_if(known.begin(), known.end(),
                                  [&wanted](const NamedLimit& each) { return each.name == wanted; });
  const bool is_of_rendering = wanted == kRenderSeconds || wanted == kRenderMemory;
  if ((limit == known.end() && !is_of_rendering) || wanted.size() == text.size()) {
    std::string names = std::string(kRenderSeconds) + ", " + kRenderMemory;
    for (const NamedLimit& each : known)
      names += ", " + std::string(each.name);
    throw InputError("--max: '" + text + "' is not NAME=VALUE with a name of " + names);
  }
  const auto read = read_real(value);
  double number = read ? read->value : -1;
  if (read && !read->rest.empty()) {
    const std::size_t unit = std::string_view("KMG").find(read->rest);
    const bool is_unit = read->rest.size() == 1 && unit != std::string_view::npos;
    number = is_unit ? std::ldexp(number, 10 * (static_cast<int>(unit) + 1)) : -1;
  }
  if (!(number >= 0 && number <= 1e18))
    throw InputError("--max: '" + value +
                     "' is not a number from 0 to 1e18, perhaps with K, M or G behind it");
  if (wanted == kRenderSeconds)
    request.most_seconds = number;
  else if (wanted == kRenderMemory)
    request.options.most_memory = static_cast<std::uint64_t>(number);
  else
    request.limits.*limit->limit = static_cast<std::uint64_t>(number);
}

/// Texts that CLI11 fills in besides the request.
struct RenderTexts {
  std::vector<std::filesystem::path> scenes;
  MachineTexts machine;
  std::vector<std::string> declares;
  std::vector<std::string> limits;
  MessageTexts messages;
  SamplingTexts sampling;
  std::string verbose, povray = "off";
  OutputTexts output;
  AnimationTexts animation;
};

void add_scene_options(CLI::App& command, RenderRequest& request, RenderTexts& texts) {
  command.add_option("scene", texts.scenes, "The scene, a POV-Ray file")->required()->type_name("SCENE.pov");
  RenderOptions& options = request.options;
  const CLI::Range side(1, kMaxImageSide);
  command.add_option("-W,--width", options.width, "Pixels a row")->check(side)->capture_default_str();
  command.add_option("-H,--height", options.height, "Rows")->check(side)->capture_default_str();
  command
      .add_option("-L,--library", request.library_paths,
                  "Search this folder for included files; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command
      .add_option("--allow", request.readable_folders,
                  "The scene may read what is in this folder, too; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command
      .add_option("--allow-write", request.writable_folders,
                  "The scene may write files into this folder, and read them; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command
      .add_option("--max", texts.limits,
                  "Change a limit on the cost of reading and rendering the scene; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--declare", texts.declares, "Declare a number or string before the scene begins")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_flag(
      "--lenient", texts.machine.emulation.lenient,
      "Leave out parts of the scene that are not supported; on an emulated or simulated Cell also ignore "
      "broken rules that the hardware tolerates");
  command.add_option("--header", request.header, "Include this file before the scene begins")
      ->type_name("FILE");
  command
      .add_option("--language-version", request.language_version,
                  "Version of POV-Ray's language, such as 3.1, for a scene without #version")
      ->check(number_range(0.1, 100))
      ->type_name("FLOAT");
  command
      .add_option("--max-level", options.max_trace_level,
                  "Depth of the ray tree; default: the scene's max_trace_level")
      ->check(CLI::Range(1, 256));
  command
      .add_option("--adc", options.adc_bailout,
                  "Do not trace rays that add less than this to a pixel; default: the scene's adc_bailout")
      ->check(number_range(0, 1));
}

void add_report_options(CLI::App& command, RenderRequest& request) {
  command.add_option("--stats", request.stats, "Write statistics as JSON; - is stdout")->type_name("FILE|-");
  command.add_flag("--quiet", request.quiet, "Print no progress, notes or summary");
}

void add_client_options(CLI::App& command, RenderTexts& texts) {
  add_choice(command, "--povray", texts.povray, {{"on", "off"}, {}},
             "Stand in for povray: read its INI file and obey povray.conf; default: on if started as povray");
  add_choice(command, "--verbose", texts.verbose, {{"on", "off"}, {}},
             "Write progress as POV-Ray does if stderr is no terminal");
}

/// Makes the last one of repeated options count, except for options that collect values.
void take_last_options(CLI::App& command) {
  for (CLI::Option* option : command.get_options())
    if (!option->get_positional() && option->get_items_expected_max() == 1)
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  for (CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; }))
    take_last_options(*group);
}

void add_quality_option(CLI::App& command, RenderRequest& request) {
  command
      .add_option("--quality", request.options.quality,
                  "Quality of the picture, from 0 (colours alone) to 9 and more (everything)")
      ->check(CLI::Range(0, 11))
      ->capture_default_str();
}

void add_view_options(CLI::App& command, ViewRequest& request) {
  command
      .add_option("--font", request.font, "Font of the text over the picture; default: one of the system's")
      ->type_name("FILE.ttf");
  command.add_option("--state", request.state, "Write a line of JSON for each change of what is seen")
      ->type_name("FILE");
  command
      .add_option(
          "--keys", request.keys,
          "Input to simulate, the next whenever the picture is final: names of keys, WIDTHxHEIGHT, drag:X,Y, "
          "wheel:N")
      ->type_name("KEYS")
      ->delimiter(' ');
}

void add_compare_options(CLI::App& command, CompareRequest& request) {
  command.add_option("a", request.a, "A picture")->required()->type_name("A.png");
  command.add_option("b", request.b, "The picture to compare it with")->required()->type_name("B.png");
  command.add_option("--min-psnr", request.min_psnr, "Exit 1 if the PSNR is below this")->type_name("DB");
  command
      .add_option("--min-ssim", request.min_ssim,
                  "Exit 1 if the SSIM of any block of 8x8 pixels is below this")
      ->check(number_range(-1, 1));
  command.add_option("--diff", request.difference, "Write the difference, 8 times as bright")
      ->type_name("OUT.png");
  command.add_flag("--json", request.json, "Print JSON");
}

void add_spu_options(CLI::App& command, SpuRequest& request, EmulationTexts& texts) {
  SimulationConfig& simulation = request.machine.simulation;
  command.add_option("program", request.program, "An executable for the SPU")
      ->required()
      ->type_name("PROGRAM.elf");
  command.add_option("arguments", simulation.arguments,
                     "Arguments of the program (argv); put -- before any that begin with a dash");
  command.add_option("--spes", request.machine.spes, "SPEs, each of which runs the program")
      ->check(CLI::Range(1u, 256u))
      ->capture_default_str();
  command
      .add_option("--allow", simulation.allowed_folders,
                  "The program may read, write, make and remove files in this folder; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command
      .add_option("--stdin", request.input, "File for the program's standard input; default: celltrace's own")
      ->type_name("FILE");
  command.add_flag("--summary", request.summary, "Print counters to stderr");
  command.add_option("--stats", request.stats, "Write statistics as JSON; - is stdout")->type_name("FILE|-");
  command
      .add_option("--profile", request.profile,
                  "Write where the cycles went, by function and instruction; - is stdout")
      ->type_name("FILE|FILE.json|-");
  command.add_flag("--profile-all", request.profile_all,
                   "List the instructions of all functions, not only of those that take 95 % of the cycles");
  command.add_flag("--quiet", request.quiet, "No warnings");
  command.add_flag("--lenient", texts.lenient, "Ignore broken rules that the hardware tolerates");
  add_emulation_options(command, texts, Schedule::lockstep);
}

struct ReplayTexts {
  std::vector<std::string> caches;
  bool demand = false;
};

void add_replay_options(CLI::App& command, ReplayRequest& request, ReplayTexts& texts) {
  command.add_option("trace", request.trace, "A file that render --cache-trace wrote")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--cache", texts.caches,
                  "A software cache, as for render; may be repeated; default: the recorded one")
      ->type_name("CACHE")
      ->allow_extra_args(false);
  command.add_flag("--no-prefetch", texts.demand, "Leave out the program's prefetches");
  command.add_flag("--json", request.json, "Print JSON");
}

void add_study_options(CLI::App& command, StudyRequest& request, std::string& backend) {
  command
      .add_option("--out", request.out,
                  "Folder for study.txt, study.json, and a CSV and an SVG file of each table")
      ->type_name("DIR");
  command.add_flag("--quick", request.options.quick,
                   "Render smaller pictures: takes about a minute on two cores");
  command
      .add_option("--backend", backend,
                  "Source of the cycles: counted operations (cell_emu) or machine code (cell_sim)")
      ->check(CLI::IsMember({"cell_emu", "cell_sim"}))
      ->capture_default_str();
  command.add_option("--only", request.options.only, "Make one table only")
      ->check(CLI::IsMember(study::table_ids()));
  command.add_option("--threads", request.options.threads, "Threads of the host to use; default: all")
      ->check(CLI::Range(1, 256));
  command.add_flag("--quiet", request.quiet, "Print no progress, and no tables on stdout");
}

/// Completes the parts of a request that `render` and `view` share.
void finish_scene(RenderRequest& request, const RenderTexts& texts, Schedule schedule) {
  finish_machine(request.options, texts.machine, schedule);
  request.lenient = texts.machine.emulation.lenient;
  request.options.antialiasing = antialiasing_of(texts.sampling);
  for (const std::string& text : texts.declares)
    request.declares.push_back(parse_declare(text));
  for (const std::string& text : texts.limits)
    set_limit(request, text);
}

void finish(RenderRequest& request, const RenderTexts& texts) {
  finish_scene(request, texts, Schedule::free);
  request.trace = texts.machine.emulation.trace;
  request.cache_trace = texts.machine.emulation.cache_trace;
  request.options.region = region_of(texts.sampling, request.options);
  if (!texts.verbose.empty()) request.verbose = texts.verbose == "on";
  request.stands_in_for_povray = texts.povray == "on";
  set_frames(request.animation, texts.animation);
  finish_output(request, texts.output);
  finish_animation(request, texts.animation);
  finish_messages(request, texts.messages);
  if (request.is_sandboxed && request.film == FilmFormat::ffmpeg)
    throw InputError("--sandbox starts no process, and this film needs ffmpeg: .y4m does not");
}

/// Gives each picture a name of its own: if scenes have the same name, later pictures get their folder's name
/// in front, or a number at the end.
void give_own_names(std::vector<RenderRequest>& renders) {
  std::set<std::filesystem::path> taken;
  for (RenderRequest& render : renders) {
    const std::filesystem::path folder = render.output.parent_path();
    const std::string name = render.output.stem().string(), extension = render.output.extension().string();
    std::string parent = std::filesystem::absolute(render.scene).parent_path().filename().string();
    if (!taken.count(render.output)) parent.clear();
    std::filesystem::path output =
        parent.empty() ? render.output : folder / (parent + '-' + name + extension);
    for (int number = 2; !taken.insert(output).second; ++number)
      output = folder / (name + '-' + std::to_string(number) + extension);
    render.output = output;
  }
}

/// Makes a request for each scene.
BatchRequest batch_of(const RenderRequest& render, const RenderTexts& texts) {
  const std::filesystem::path& output = render.output;
  if (texts.output.picture == "off" || output.empty() || (output.has_filename() && !is_folder(output)))
    throw InputError("'" + texts.scenes[1].string() +
                     "' is one scene too many: many need a folder for their pictures, -o DIR/");
  if (!render.stats.empty() || !texts.machine.emulation.trace.empty() ||
      !texts.machine.emulation.cache_trace.empty())
    throw InputError("--stats, --trace and --cache-trace are for one scene at a time");
  BatchRequest batch;
  batch.folder = render.output / "";
  for (const std::filesystem::path& scene : texts.scenes) {
    RenderRequest one = render;
    one.scene = scene;
    one.output = batch.folder;
    finish(one, texts);
    if (one.animation.is_on() || one.film != FilmFormat::none)
      throw InputError("animations are rendered from one scene at a time");
    batch.renders.push_back(std::move(one));
  }
  give_own_names(batch.renders);
  return batch;
}

void finish(ViewRequest& view, const RenderTexts& texts) {
  if (texts.scenes.size() > 1) throw InputError("a window shows one scene");
  view.render.scene = texts.scenes.front();
  finish_scene(view.render, texts, Schedule::lockstep);
  if (!texts.sampling.antialias) view.render.options.antialiasing = Antialiasing(); // for still pictures
}

/// Removes the arguments after the first "--": CLI11 would pass them to a command only before its positional
/// arguments.
std::vector<std::string> split_rest(std::vector<std::string>& arguments) {
  const auto mark = std::find(arguments.begin(), arguments.end(), "--");
  if (mark == arguments.end()) return {};
  std::vector<std::string> rest(mark + 1, arguments.end());
  arguments.erase(mark, arguments.end());
  return rest;
}

void finish(SpuRequest& request, const EmulationTexts& texts, const std::vector<std::string>& rest) {
  request.machine.emulation = emulation_config(texts, request.machine.backend, Schedule::lockstep);
  request.trace = texts.trace;
  if (request.profile_all && request.profile.empty()) throw InputError("--profile-all needs --profile");
  std::vector<std::string>& arguments = request.machine.simulation.arguments;
  arguments.insert(arguments.begin(), request.program.string());
  arguments.insert(arguments.end(), rest.begin(), rest.end());
}

void finish(ReplayRequest& request, const ReplayTexts& texts) {
  for (const std::string& text : texts.caches)
    request.shapes.push_back(parse_cache(text));
  request.prefetches = !texts.demand;
}

class HelpFormatter : public CLI::Formatter {
public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    std::vector<DescribedCommand> commands = describe(*app);
    DescribedCommand described = commands.front();
    commands.erase(commands.begin());
    if (app->get_parent() != nullptr) described.name = app->get_name();
    return help_page(described, commands);
  }
};

} // namespace

Request parse_command_line(std::vector<std::string> arguments) {
  CLI::App app("Ray-traces POV-Ray scenes with a program written for the Cell's SPEs, on any machine.",
               "celltrace");
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", std::string("celltrace ") + version());
  app.add_flag_callback(
      "--list-keywords", [] { throw CLI::CallForVersion(keyword_page(), 0); },
      "Say which words of POV-Ray's language are supported");
  app.add_flag_callback(
      "--man-page", [&app] { throw CLI::CallForVersion(man_page(describe(app)), 0); },
      "Print the manual page, for man -l -");
  app.add_option_function<std::string>(
         "--completions",
         [&app](const std::string& shell) {
           throw CLI::CallForVersion(completions(describe(app), shell), 0);
         },
         "Print a script with which a shell completes celltrace's options")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->type_name("SHELL")
      ->trigger_on_parse();
  app.footer(
      "`celltrace SCENE.pov` means render. POV-Ray's switches (+W640 +H480 +Iscene.pov ...) are understood.\n"
      "The environment variable CELLTRACE_OPTIONS may hold options of render, which are read before the "
      "arguments.\n"
      "Exit codes: 0 done; 1 error, or compare found too great a difference; 2 interrupted.");

  RenderRequest render;
  RenderTexts texts;
  CLI::App& render_command = *app.add_subcommand("render", "Render a scene into a picture");
  add_scene_options(render_command, render, texts);
  add_output_options(render_command, render, texts.output);
  add_quality_option(render_command, render);
  add_region_options(render_command, texts.sampling);
  add_animation_options(render_command, render, texts.animation);
  add_antialiasing_options(render_command, texts.sampling);
  add_machine_options(render_command, render.options, texts.machine);
  add_report_options(render_command, render);
  render_command.add_flag("--sandbox", render.is_sandboxed,
                          "Have Linux (Landlock, seccomp) deny celltrace all folders that its options do not "
                          "name, new processes and the network");
  add_message_options(render_command, texts.messages);
  add_client_options(render_command, texts);
  take_last_options(render_command);

  ViewRequest view;
  RenderTexts view_texts;
  CLI::App& view_command = *app.add_subcommand("view", "Look around in a scene, in a window");
  add_scene_options(view_command, view.render, view_texts);
  add_quality_option(view_command, view.render);
  view_command.add_option("--clock", view.render.clock, "The scene's clock");
  add_antialiasing_options(view_command, view_texts.sampling);
  add_machine_options(view_command, view.render.options, view_texts.machine);
  add_view_options(view_command, view);
  view_command.footer("H in the window shows the keys.");

  CompareRequest compare;
  CLI::App& compare_command = *app.add_subcommand("compare", "Measure the difference between two pictures");
  add_compare_options(compare_command, compare);

  SpuRequest spu;
  EmulationTexts spu_texts;
  CLI::App& spu_command = *app.add_subcommand("spu", "Run a program for the SPU, instruction by instruction");
  add_spu_options(spu_command, spu, spu_texts);
  spu_command.footer("Exit codes: the program's; 124 limit reached, 125 error of the run, 130 interrupted.");

  ReplayRequest replay;
  ReplayTexts replay_texts;
  CLI::App& replay_command =
      *app.add_subcommand("replay", "Replay a recorded cache trace with other software caches");
  add_replay_options(replay_command, replay, replay_texts);

  StudyRequest study;
  std::string study_backend = name_of(study.options.backend);
  CLI::App& study_command =
      *app.add_subcommand("study", "Repeat the experiments of the thesis on the emulated Cell");
  add_study_options(study_command, study, study_backend);

  read_as_decimal(app);
  std::vector<std::string> rest;
  if (!arguments.empty() && arguments.front() == "spu") rest = split_rest(arguments);
  try {
    std::reverse(arguments.begin(), arguments.end()); // in CLI11's order
    app.parse(std::move(arguments));
  } catch (const CLI::Success& information) {
    std::ostringstream out, err;
    app.exit(information, out, err);
    return InformationRequest{out.str()};
  } catch (const CLI::ParseError& error) {
    throw InputError(option_error(app, error));
  }
  if (compare_command.parsed()) return compare;
  if (view_command.parsed()) {
    finish(view, view_texts);
    return view;
  }
  if (study_command.parsed()) {
    study.options.backend = backend_named(study_backend);
    return study;
  }
  if (spu_command.parsed()) {
    finish(spu, spu_texts, rest);
    return spu;
  }
  if (replay_command.parsed()) {
    finish(replay, replay_texts);
    return replay;
  }
  if (texts.scenes.size() > 1) return batch_of(render, texts);
  render.scene = texts.scenes.front();
  finish(render, texts);
  return render;
}

} // namespace celltrace::cli

// The entry points of celltrace/pov.hpp.
#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"
#include "pov/constants.hpp"
#include "pov/session.hpp"

namespace celltrace {

namespace {

Scene parse(std::string text, const ParseOptions& options, const std::string& name,
            const std::filesystem::path& folder) {
  pov::Session session(options);
  session.sources.set_scene_folder(folder);
  session.tokens.open(std::move(text), name, folder);
  pov::declare_predefined(session);
  try {
    session.tokens.evaluate(pov::Start::scene);
    session.tokens.close_data_files();
  } catch (const pov::LimitPassed& passed) {
    session.exceed(session.tokens.last_place(), passed.limit, passed.who, passed.unit);
  }
  if (session.tokens.is_empty()) throw SceneError(name + ":1:1: error: the scene is empty");
  Scene scene = session.builder.finish(name);
  session.diagnostics.require_supported();
  return scene;
}

} // namespace

Scene parse_file(const std::filesystem::path& path, const ParseOptions& options) {
  if (options.reads_file) options.reads_file(path);
  std::string text;
  try {
    text = pov::read_text(path, options.limits.file_bytes);
  } catch (const InputError& error) {
    throw SceneError(path.string() + ":1:1: error: " + error.what());
  }
  return parse(std::move(text), options, path.string(), path.parent_path());
}

Scene parse_string(std::string_view text, const ParseOptions& options, std::string name) {
  return parse(std::string(text), options, name, {});
}

} // namespace celltrace

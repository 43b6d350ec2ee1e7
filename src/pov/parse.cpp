// The entry points of celltrace/pov.hpp.
#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"
#include "pov/constants.hpp"
#include "pov/session.hpp"

#include <new>

namespace celltrace {

namespace {

constexpr std::size_t kCopiedAtOnce = 1u << 20;

/// Runs `work`. Throws Errors of this library in place of std::bad_alloc and LimitPassed.
template <class Work> Scene within_memory(Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw OutOfMemory();
  } catch (const pov::LimitPassed& passed) {
    throw InputError(std::string("a limit leaves no room for a scene's beginning: ") + passed.who +
                     " too much");
  }
}

/// Tells the application that no byte of the scene has been parsed yet. Throws Cancelled if it does not want
/// to go on.
void check_cancelled(const ParseOptions& options, std::uint64_t bytes) {
  if (options.progress && !options.progress(0, bytes)) throw Cancelled();
}

/// Opens the header, so that it is read before the scene.
void open_header(pov::Session& session, const std::filesystem::path& header) {
  if (header.empty()) return;
  if (session.options.reads_file) session.options.reads_file(header);
  try {
    std::string text = pov::read_text(header, session.options.limits.file_bytes,
                                      [&] { check_cancelled(session.options, 0); });
    session.symbols.enter_scope();
    session.tokens.open(std::move(text), header.lexically_normal().string(), header.parent_path());
    session.input.top().opened_at = pov::Location(); // the scene's beginning
  } catch (const InputError& error) {
    throw InputError("header " + header.string() + ": " + error.what());
  }
}

Scene parse(std::string text, const ParseOptions& options, const std::string& name,
            const std::filesystem::path& folder) {
  pov::Session session(options);
  session.sources.set_scene_folder(folder);
  session.tokens.open(std::move(text), name, folder);
  if (const auto& version = options.version) {
    constexpr double kNone = 1000;
    if (!(*version > 0 && *version < kNone)) throw InputError("there is no such version of the language");
    session.builder.set_version(*version);
  }
  try {
    pov::declare_predefined(session);
    open_header(session, options.header);
    session.tokens.evaluate(pov::Start::scene);
    session.tokens.close_data_files();
  } catch (const pov::LimitPassed& passed) {
    session.exceed(session.tokens.last_place(), passed.limit, passed.who, passed.unit);
  }
  if (session.tokens.is_empty())
    session.diagnostics.warn({0, 1, 1}, "the scene is empty: its picture is black");
  Scene scene = session.builder.finish(name);
  session.diagnostics.require_supported();
  return scene;
}

} // namespace

Scene parse_file(const std::filesystem::path& path, const ParseOptions& options) {
  return within_memory([&] {
    if (options.reads_file) options.reads_file(path);
    std::error_code none;
    const std::uint64_t bytes = std::filesystem::file_size(path, none);
    std::string text;
    try {
      text = pov::read_text(path, options.limits.file_bytes,
                            [&] { check_cancelled(options, none ? 0 : bytes); });
    } catch (const InputError& error) {
      pov::refuse_scene(path.string(), error.what(), options);
    }
    return parse(std::move(text), options, path.string(), path.parent_path());
  });
}

Scene parse_string(std::string_view text, const ParseOptions& options, std::string name) {
  return within_memory([&] {
    std::string copy = pov::make_text(text.size());
    for (std::size_t at = 0; at < text.size(); at += kCopiedAtOnce) {
      check_cancelled(options, text.size());
      copy += text.substr(at, kCopiedAtOnce);
    }
    return parse(std::move(copy), options, name, {});
  });
}

} // namespace celltrace

#include "cli/film.hpp"

#include "celltrace/error.hpp"
#include "image/file.hpp"
#include "image/y4m.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

/// Runs `work`, and puts the name of the file in front of its errors.
template <class Work> auto naming(const std::string& name, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

/// Writes frames to a stream, which a Film owns.
class Y4mWriter {
public:
  explicit Y4mWriter(FrameRate rate) : rate_(rate) {}

  void add(std::FILE* file, const Image& frame) {
    if (!std::exchange(has_begun_, true))
      image::write_y4m_header(file, frame.width, frame.height, rate_.frames, rate_.seconds);
    image::write_y4m_frame(file, frame);
  }

private:
  FrameRate rate_;
  bool has_begun_ = false;
};

class Y4mFile : public Film {
public:
  Y4mFile(const fs::path& path, FrameRate rate)
      : name_(path.string()), writer_(rate), file_(naming(name_, [&] { return image::OutputFile(path); })) {}

  void add(const Image& frame) override {
    naming(name_, [&] { writer_.add(file_.get(), frame); });
  }
  void finish() override {
    naming(name_, [&] { file_.commit(); });
  }

private:
  std::string name_;
  Y4mWriter writer_;
  image::OutputFile file_;
};

class Y4mOutput : public Film {
public:
  explicit Y4mOutput(FrameRate rate) : writer_(rate) {}

  void add(const Image& frame) override {
    naming("standard output", [&] {
      writer_.add(stdout, frame);
      if (std::fflush(stdout) != 0)
        throw InputError("cannot be written: " + std::generic_category().message(errno));
    });
  }
  void finish() override {}

private:
  Y4mWriter writer_;
};

/// A film that ffmpeg writes under a temporary name with the same extension.
class FfmpegFilm : public Film {
public:
  FfmpegFilm(const fs::path& path, FrameRate rate) : path_(path), writer_(rate) {
    part_ = path.parent_path() /
            (path.stem().string() + '.' + std::to_string(getpid()) + ".part" + path.extension().string());
    start();
  }
  FfmpegFilm(const FfmpegFilm&) = delete;
  FfmpegFilm& operator=(const FfmpegFilm&) = delete;
  ~FfmpegFilm() override {
    pipe_.reset();
    if (process_ > 0) waitpid(process_, nullptr, 0);
    std::error_code ignored;
    fs::remove(part_, ignored);
  }

  void add(const Image& frame) override {
    try {
      writer_.add(pipe_.get(), frame);
      if (std::fflush(pipe_.get()) != 0) throw InputError("ends");
    } catch (const InputError&) {
      pipe_.reset();
      fail(wait());
    }
  }
  void finish() override {
    // Ends ffmpeg's input; ffmpeg reports errors of data that is still to be written.
    pipe_.reset();
    if (const int status = wait(); status != 0) fail(status);
    std::error_code error;
    fs::rename(part_, path_, error);
    if (error) throw InputError(path_.string() + ": cannot be written: " + error.message());
  }

private:
  /// Starts ffmpeg in a process group of its own: Ctrl-C is for celltrace, which then lets ffmpeg finish the
  /// frames it has.
  void start() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw InputError("no pipe to ffmpeg: " + std::generic_category().message(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    // Redirects ffmpeg's stdout to stderr, as celltrace may write reports to stdout.
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    sigset_t defaults;
    sigemptyset(&defaults);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM})
      sigaddset(&defaults, signal);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    std::vector<std::string> arguments = command();
    std::vector<char*> argv;
    for (std::string& argument : arguments)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    const int error = posix_spawnp(&process_, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    pipe_.reset(fdopen(ends[1], "wb"));
    if (error == 0) return;
    process_ = -1;
    if (error == ENOENT)
      throw InputError(path_.string() +
                       ": films of this kind are made by ffmpeg, which is not installed; a .y4m "
                       "film needs nothing");
    throw InputError(path_.string() +
                     ": ffmpeg cannot be started: " + std::generic_category().message(error));
  }

  /// Returns ffmpeg's command line. ffmpeg chooses codecs by the kind of file. Players need chroma at half
  /// resolution each way, for which sides must be even, and the meaning of colours.
  std::vector<std::string> command() const {
    return {"ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "yuv4mpegpipe", "-i",
            "pipe:0", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-color_range", "tv",
            "-colorspace", "smpte170m", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1",
            // The prefix protects names that begin with a dash.
            "file:" + part_.string()};
  }

  /// Waits for ffmpeg. Returns its exit code, or 128 plus the signal that ended it.
  int wait() {
    int status = 0;
    pid_t ended = 0;
    do
      ended = waitpid(process_, &status, 0);
    while (ended < 0 && errno == EINTR);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  [[noreturn]] void fail(int status) const {
    throw InputError(path_.string() + ": ffmpeg could not make the film (exit code " +
                     std::to_string(status) + ")");
  }

  fs::path path_, part_;
  Y4mWriter writer_;
  image::File pipe_;
  pid_t process_ = -1;
};

} // namespace

FilmFormat film_format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".y4m") return FilmFormat::y4m;
  for (const char* each : {".mp4", ".mkv", ".mov", ".webm"})
    if (extension == each) return FilmFormat::ffmpeg;
  return FilmFormat::none;
}

std::unique_ptr<Film> open_film(const fs::path& path, FilmFormat format, FrameRate rate) {
  std::signal(SIGPIPE, SIG_IGN);
  if (path == "-") return std::make_unique<Y4mOutput>(rate);
  if (format == FilmFormat::y4m) return std::make_unique<Y4mFile>(path, rate);
  return std::make_unique<FfmpegFilm>(path, rate);
}

} // namespace celltrace::cli

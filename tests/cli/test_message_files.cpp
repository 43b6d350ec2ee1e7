#include "cli/message_files.hpp"

#include "celltrace/error.hpp"
#include "files.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <iostream>
#include <sstream>

using namespace celltrace::cli;
using celltrace::test::TemporaryFolder;

namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Catches what is written to stderr, for as long as it lives.
class CaughtErrors {
public:
  CaughtErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  CaughtErrors(const CaughtErrors&) = delete;
  CaughtErrors& operator=(const CaughtErrors&) = delete;
  ~CaughtErrors() { std::cerr.rdbuf(before_); }

  std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// Returns what comes out at stderr.
std::string printed(const MessageRequest& request, const std::string& text) {
  const CaughtErrors errors;
  {
    MessageFiles files;
    files.open(request);
    std::cerr << text << std::flush;
  }
  return errors.text();
}

const char kText[] = "note: '+D' has no effect here\n"
                     "hello\n"
                     "a.pov:1:1: warning: odd\n"
                     "  included from b.pov:3\n"
                     "Rendered 3 of 6\rRendered 6 of 6\r\n"
                     "a.png: 4x3, avx2, 2 SPEs; render 0.00 s; 1.2 million rays/s\n"
                     "celltrace: error: gone\n";

} // namespace

TEST_CASE("messages go into files by their kinds") {
  const TemporaryFolder folder;
  MessageRequest request;
  request.all_files = {folder / "all"};
  request.files = {{MessageKind::debug, folder / "debug"},
                   {MessageKind::warning, folder / "warning"},
                   {MessageKind::error, folder / "error"},
                   {MessageKind::statistics, folder / "statistics"}};
  CHECK(printed(request, kText) == kText);
  CHECK(content(folder / "debug") == "hello\n\n");
  CHECK(content(folder / "warning") ==
        "note: '+D' has no effect here\na.pov:1:1: warning: odd\n  included from b.pov:3\n");
  CHECK(content(folder / "error") == "celltrace: error: gone\n");
  CHECK_THAT(content(folder / "statistics"), Catch::StartsWith("a.png: 4x3"));
  CHECK_THAT(content(folder / "all"), Catch::StartsWith("note: ") && Catch::EndsWith("gone\n"));
}

TEST_CASE("files of messages are written anew, or go on") {
  const TemporaryFolder folder;
  MessageRequest request;
  request.all_files = {folder / "all"};
  printed(request, "one\n");
  printed(request, "two\n");
  CHECK(content(folder / "all") == "two\n");
  request.appends = true;
  printed(request, "three"); // without an end
  CHECK(content(folder / "all") == "two\nthree");
  request.all_files = {folder / "none" / "all"};
  CHECK_THROWS_WITH(printed(request, ""), Catch::EndsWith("cannot be written"));
}

TEST_CASE("kinds of messages are hidden") {
  MessageRequest request;
  request.hidden = {MessageKind::warning, MessageKind::render};
  CHECK(printed(request, "warning: odd\nhello\nRendered 1\r\033[Krendering 2%") == "hello\n");
  request.hidden = {MessageKind::warning};
  // Progress goes on as it comes.
  CHECK(printed(request, "\r\033[Krendering 2%") == "\r\033[Krendering 2%");
  CHECK(printed({}, "warning: odd\n") == "warning: odd\n");
}

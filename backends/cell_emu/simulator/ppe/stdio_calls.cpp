// The functions of <stdio.h>, in the order of the numbers that libspe2 and newlib have for them.
#include "backends/cell_emu/simulator/ppe/ppe_state.hpp"
#include "backends/cell_emu/simulator/ppe/printf_format.hpp"
#include "backends/cell_emu/simulator/ppe/scanf_format.hpp"

#include <array>
#include <cstdio>
#include <optional>

#include <fcntl.h>
#include <unistd.h>

namespace celltrace::cell_emu {

namespace {

using Arguments = CallArguments;

constexpr std::uint32_t kStandardInput = 1, kStandardOutput = 2, kStandardError = 3; // streams
constexpr std::uint32_t kFullyBuffered = 0, kUnbuffered = 2;                         // modes of setvbuf()
constexpr std::int64_t kEndOfFile = -1;

CallResult success() {
  return CallResult::number(0);
}

OpenFile::From origin(std::uint32_t whence) {
  if (whence > 2) throw CallFailed{SpuErrno::invalid};
  return static_cast<OpenFile::From>(whence);
}

std::int64_t offset_of_32_bits(std::int64_t offset) {
  if (offset > INT32_MAX) throw CallFailed{SpuErrno::overflow};
  return offset;
}

// --- opening and closing
// ----------------------------------------------------------------------------------------

/// A mode of fopen(), such as "r+".
struct Mode {
  int host_flags;
  bool reads, writes;
};

Mode parse_mode(std::string_view text) {
  const bool both = text.find('+') != std::string_view::npos;
  const bool exclusive = text.find('x') != std::string_view::npos;
  const char kind = text.empty() ? 0 : text[0];
  Mode mode{0, both || kind == 'r', both || kind != 'r'};
  switch (kind) {
  case 'r':
    break;
  case 'w':
    mode.host_flags = O_CREAT | O_TRUNC;
    break;
  case 'a':
    mode.host_flags = O_CREAT | O_APPEND;
    break;
  default:
    throw CallFailed{SpuErrno::invalid};
  }
  mode.host_flags |= both ? O_RDWR : kind == 'r' ? O_RDONLY : O_WRONLY;
  if (exclusive) mode.host_flags |= O_EXCL;
  return mode;
}

CallResult open_stream(PpeState& state, const Arguments& arguments) {
  const Mode mode = parse_mode(arguments.string(1));
  const std::int32_t descriptor = state.files.add(state.open(arguments.string(0), mode.host_flags, 0666));
  try {
    return CallResult::address(state.streams.add(Stream(state.files, descriptor, mode.reads, mode.writes)));
  } catch (const CallFailed&) {
    state.files.close(descriptor);
    throw;
  }
}

CallResult close_stream(PpeState& state, const Arguments& arguments) {
  const std::uint32_t number = arguments.word(0);
  const std::int32_t descriptor = state.streams.at(number).descriptor();
  state.streams.remove(number);
  state.files.close(descriptor);
  return success();
}

CallResult reopen_stream(PpeState& state, const Arguments& arguments) {
  const std::uint32_t name = arguments.word(0), number = arguments.word(2);
  const Mode mode = parse_mode(arguments.string(1));
  const std::int32_t descriptor = state.streams.at(number).descriptor();
  if (name == 0)
    return CallResult::address(
        number); // freopen() without a name only changes the mode, and binary and text mode are the same
  std::shared_ptr<HostFile> file;
  try {
    file = state.open(arguments.string(0), mode.host_flags, 0666);
  } catch (const CallFailed&) {
    state.streams.remove(number);
    state.files.set(descriptor, nullptr);
    throw;
  }
  state.files.set(descriptor, std::move(file));
  state.streams.set(number, Stream(state.files, descriptor, mode.reads, mode.writes));
  return CallResult::address(number);
}

CallResult open_temporary(PpeState& state, const Arguments&) {
  std::string name;
  std::shared_ptr<HostFile> file = state.make_temporary("tmp", name);
  const AllowedFolders::Place place = state.folders.locate(name, AllowedFolders::SymlinkPolicy::keep);
  ::unlinkat(place.folder.get(), place.name.c_str(), 0);
  const std::int32_t descriptor = state.files.add(std::move(file));
  try {
    return CallResult::address(state.streams.add(Stream(state.files, descriptor, true, true)));
  } catch (const CallFailed&) {
    state.files.close(descriptor);
    throw;
  }
}

CallResult name_temporary(PpeState& state, const Arguments& arguments) {
  const std::uint32_t to = arguments.word(0);
  // Without a buffer there is no place for the name: the program passed none.
  if (to == 0) throw CallFailed{SpuErrno::invalid};
  std::string name = state.temporary_name("tmp");
  name += '\0';
  arguments.local_store().store_bytes(to, name);
  return CallResult::address(to);
}

// --- state
// ------------------------------------------------------------------------------------------------------

Stream& stream(PpeState& state, const Arguments& arguments, unsigned argument = 0) {
  return state.streams.at(arguments.word(argument));
}

CallResult clear_errors(PpeState& state, const Arguments& arguments) {
  stream(state, arguments).clear_errors();
  return success();
}

CallResult at_end(PpeState& state, const Arguments& arguments) {
  return CallResult::number(stream(state, arguments).at_end() ? 1 : 0);
}

CallResult has_error(PpeState& state, const Arguments& arguments) {
  return CallResult::number(stream(state, arguments).has_error() ? 1 : 0);
}

CallResult descriptor_of(PpeState& state, const Arguments& arguments) {
  return CallResult::number(stream(state, arguments).descriptor());
}

CallResult flush(PpeState& state, const Arguments& arguments) {
  if (arguments.word(0) != 0) stream(state, arguments); // nothing is buffered
  return success();
}

CallResult set_buffer(PpeState& state, const Arguments& arguments) {
  stream(state, arguments);
  return success();
}

CallResult set_buffer_mode(PpeState& state, const Arguments& arguments) {
  stream(state, arguments);
  static_assert(kFullyBuffered == 0);
  if (arguments.word(2) > kUnbuffered) throw CallFailed{SpuErrno::invalid};
  return success();
}

CallResult print_error(PpeState& state, const Arguments& arguments) {
  const std::string_view what = arguments.word(0) != 0 ? arguments.string(0) : std::string_view();
  std::string text(what);
  if (!text.empty()) text += ": ";
  text += error_text(arguments.word(1));
  text += '\n';
  state.streams.at(kStandardError).write(text);
  return success();
}

// --- positions
// --------------------------------------------------------------------------------------------------

CallResult seek(PpeState& state, const Arguments& arguments) {
  stream(state, arguments).seek(arguments.number(1), origin(arguments.word(2)));
  return success();
}

CallResult tell(PpeState& state, const Arguments& arguments) {
  return CallResult::number(offset_of_32_bits(stream(state, arguments).tell()));
}

CallResult rewind_stream(PpeState& state, const Arguments& arguments) {
  Stream& rewound = stream(state, arguments);
  rewound.clear_errors();
  rewound.seek(0, OpenFile::From::start);
  return success();
}

/// Stores the position in the first 8 bytes of a program's fpos_t of 16 bytes.
CallResult get_position(PpeState& state, const Arguments& arguments) {
  const std::uint32_t to = arguments.word(1);
  arguments.local_store().store(to, static_cast<std::uint64_t>(stream(state, arguments).tell()));
  arguments.local_store().store(to + 8, std::uint64_t{0});
  return success();
}

CallResult set_position(PpeState& state, const Arguments& arguments) {
  const auto position =
      static_cast<std::int64_t>(arguments.local_store().load<std::uint64_t>(arguments.word(1)));
  if (position < 0) throw CallFailed{SpuErrno::invalid};
  stream(state, arguments).seek(position, OpenFile::From::start);
  return success();
}

// --- characters and blocks
// --------------------------------------------------------------------------------------

CallResult get_from(Stream& from) {
  return CallResult::number(from.get());
}

CallResult get_character(PpeState& state, const Arguments& arguments) {
  return get_from(stream(state, arguments));
}

CallResult get_standard_character(PpeState& state, const Arguments&) {
  return get_from(state.streams.at(kStandardInput));
}

/// Returns the characters up to the next line feed, which is included, at most `most`; none at the end of the
/// file.
std::string read_line(Stream& from, std::size_t most) {
  std::string line;
  while (line.size() < most && !line.ends_with('\n')) {
    const int c = from.get();
    if (c == kEndOfFile) break;
    line += static_cast<char>(c);
  }
  return line;
}

CallResult get_line(PpeState& state, const Arguments& arguments) {
  const std::uint32_t to = arguments.word(0);
  const std::int32_t size = arguments.number(1);
  Stream& from = stream(state, arguments, 2);
  if (size <= 0) throw CallFailed{SpuErrno::invalid};
  const auto room = arguments.local_store().range_up_to(to, static_cast<std::uint64_t>(size));
  std::string line = read_line(from, room.size() - 1);
  if (line.empty() && size > 1) return CallResult::address(0);
  line += '\0';
  arguments.local_store().store_bytes(to, line);
  return CallResult::address(to);
}

CallResult get_standard_line(PpeState& state, const Arguments& arguments) {
  const std::uint32_t to = arguments.word(0);
  const auto room = arguments.local_store().range_up_to(to, LocalStoreView::kBytes);
  std::string line = read_line(state.streams.at(kStandardInput), room.size() - 1);
  if (line.empty()) return CallResult::address(0);
  if (line.ends_with('\n')) line.pop_back();
  line += '\0';
  arguments.local_store().store_bytes(to, line);
  return CallResult::address(to);
}

CallResult put_to(Stream& to, std::uint32_t word) {
  const char character = static_cast<char>(word);
  to.write({&character, 1});
  return CallResult::number(word & 0xFF);
}

CallResult put_character(PpeState& state, const Arguments& arguments) {
  return put_to(stream(state, arguments, 1), arguments.word(0));
}

CallResult put_standard_character(PpeState& state, const Arguments& arguments) {
  return put_to(state.streams.at(kStandardOutput), arguments.word(0));
}

CallResult put_string(PpeState& state, const Arguments& arguments) {
  stream(state, arguments, 1).write(arguments.string(0));
  return CallResult::number(1);
}

CallResult put_line(PpeState& state, const Arguments& arguments) {
  std::string line(arguments.string(0));
  line += '\n';
  state.streams.at(kStandardOutput).write(line);
  return CallResult::number(static_cast<std::int64_t>(line.size()));
}

CallResult push_back(PpeState& state, const Arguments& arguments) {
  const std::int32_t character = arguments.number(0);
  Stream& to = stream(state, arguments, 1);
  if (character == kEndOfFile) return CallResult::number(kEndOfFile);
  to.push_back(character & 0xFF);
  return CallResult::number(character & 0xFF);
}

CallResult read_block(PpeState& state, const Arguments& arguments) {
  const std::uint64_t size = arguments.word(1), count = arguments.word(2);
  Stream& from = stream(state, arguments, 3);
  if (size == 0 || count == 0) return success();
  const auto room = arguments.local_store().range_up_to(arguments.word(0), size * count);
  return CallResult::number(static_cast<std::int64_t>(from.read(room) / size));
}

CallResult write_block(PpeState& state, const Arguments& arguments) {
  const std::uint64_t size = arguments.word(1), count = arguments.word(2);
  Stream& to = stream(state, arguments, 3);
  if (size == 0 || count == 0) return success();
  const auto bytes = arguments.local_store().range(arguments.word(0), size * count);
  to.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return CallResult::number(static_cast<std::int64_t>(count));
}

// --- formatted
// --------------------------------------------------------------------------------------------------

CallResult print_to(Stream& to, const Arguments& arguments, unsigned format) {
  FormattedText text;
  format_printf(text, arguments.string(format), arguments.local_store(), arguments.variable(format + 1));
  to.write(text.kept());
  return CallResult::number(static_cast<std::int64_t>(text.length()));
}

CallResult print(PpeState& state, const Arguments& arguments) {
  return print_to(stream(state, arguments), arguments, 1);
}

CallResult print_standard(PpeState& state, const Arguments& arguments) {
  return print_to(state.streams.at(kStandardOutput), arguments, 0);
}

CallResult print_string_of(const Arguments& arguments, std::optional<std::uint32_t> size, unsigned format) {
  FormattedText text(!size ? FormattedText::kMostBytes : *size != 0 ? *size - 1 : 0);
  format_printf(text, arguments.string(format), arguments.local_store(), arguments.variable(format + 1));
  if (!size || *size != 0) {
    std::string result = text.kept();
    result += '\0';
    arguments.local_store().store_bytes(arguments.word(0), result);
  }
  return CallResult::number(static_cast<std::int64_t>(text.length()));
}

CallResult print_string(PpeState&, const Arguments& arguments) {
  return print_string_of(arguments, std::nullopt, 1);
}

CallResult print_limited_string(PpeState&, const Arguments& arguments) {
  return print_string_of(arguments, arguments.word(1), 2);
}

CallResult scan_from(CharacterSource& from, const Arguments& arguments, unsigned format) {
  return CallResult::number(scan_formatted(from, arguments.string(format), arguments.local_store(),
                                           arguments.variable(format + 1)));
}

CallResult scan(PpeState& state, const Arguments& arguments) {
  return scan_from(stream(state, arguments), arguments, 1);
}

CallResult scan_standard(PpeState& state, const Arguments& arguments) {
  return scan_from(state.streams.at(kStandardInput), arguments, 0);
}

CallResult scan_string(PpeState&, const Arguments& arguments) {
  StringSource text(arguments.string(0));
  return scan_from(text, arguments, 1);
}

// --- names and commands
// -----------------------------------------------------------------------------------------

CallResult remove_name(PpeState& state, const Arguments& arguments) {
  const auto place = state.folders.locate(arguments.string(0), AllowedFolders::SymlinkPolicy::keep);
  if (::unlinkat(place.folder.get(), place.name.c_str(), 0) == 0) return success();
  if (::unlinkat(place.folder.get(), place.name.c_str(), AT_REMOVEDIR) != 0) fail_with_host_errno();
  return success();
}

CallResult rename_file(PpeState& state, const Arguments& arguments) {
  const auto from = state.folders.locate(arguments.string(0), AllowedFolders::SymlinkPolicy::keep);
  const auto to = state.folders.locate(arguments.string(1), AllowedFolders::SymlinkPolicy::keep);
  if (::renameat(from.folder.get(), from.name.c_str(), to.folder.get(), to.name.c_str()) != 0)
    fail_with_host_errno();
  return success();
}

/// Fails for every command, because there is no command processor.
CallResult run_command(PpeState&, const Arguments& arguments) {
  if (arguments.word(0) != 0) throw CallFailed{SpuErrno::not_implemented};
  return success();
}

constexpr auto kZero = PpeCall::OnFailure::zero;

constexpr std::array kStdioCalls = {
    PpeCall{},
    PpeCall{clear_errors, kZero},
    PpeCall{close_stream},
    PpeCall{at_end, kZero},
    PpeCall{has_error, kZero},
    PpeCall{flush},
    PpeCall{get_character}, // fgetc
    PpeCall{get_position},
    PpeCall{get_line, kZero},
    PpeCall{descriptor_of},
    PpeCall{open_stream, kZero}, // 10
    PpeCall{put_character},      // fputc
    PpeCall{put_string},
    PpeCall{read_block, kZero},
    PpeCall{reopen_stream, kZero},
    PpeCall{seek},
    PpeCall{set_position},
    PpeCall{tell},
    PpeCall{write_block, kZero},
    PpeCall{get_character},          // getc
    PpeCall{get_standard_character}, // 20
    PpeCall{get_standard_line, kZero},
    PpeCall{print_error, kZero},
    PpeCall{put_character}, // putc
    PpeCall{put_standard_character},
    PpeCall{put_line},
    PpeCall{remove_name},
    PpeCall{rename_file},
    PpeCall{rewind_stream, kZero},
    PpeCall{set_buffer, kZero},
    PpeCall{set_buffer_mode}, // 30
    PpeCall{run_command},
    PpeCall{open_temporary, kZero},
    PpeCall{name_temporary, kZero},
    PpeCall{push_back},
    PpeCall{print}, // vfprintf
    PpeCall{scan},
    PpeCall{print_standard},
    PpeCall{scan_standard},
    PpeCall{print_limited_string},
    PpeCall{print_string}, // 40
    PpeCall{scan_string},
};
static_assert(kStdioCalls.size() == 42);

} // namespace

std::span<const PpeCall> c99_calls() {
  return kStdioCalls;
}

} // namespace celltrace::cell_emu

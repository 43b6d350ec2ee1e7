// POSIX calls of newlib for the SPU, in the order of libspe2's numbers.
#include "backends/cell_emu/simulator/ppe/ppe_state.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace celltrace::cell_emu {

namespace {

using Arguments = CallArguments;
using SymlinkPolicy = AllowedFolders::SymlinkPolicy;

CallResult success() {
  return CallResult::number(0);
}

/// Returns 0, or fails with the host's errno.
CallResult checked(int host_result) {
  if (host_result != 0) fail_with_host_errno();
  return success();
}

int host_descriptor(PpeState& state, std::int32_t descriptor) {
  const int host = state.files.at(descriptor)->host_descriptor();
  if (host < 0) throw CallFailed{SpuErrno::invalid};
  return host;
}

// --- open files
// -------------------------------------------------------------------------------------------------

/// Converts the flags of open() from Linux's values, which programs pass, to the host's.
int host_flags(std::uint32_t flags) {
  int host = 0;
  switch (flags & 3) {
  case 0:
    host = O_RDONLY;
    break;
  case 1:
    host = O_WRONLY;
    break;
  case 2:
    host = O_RDWR;
    break;
  default:
    throw CallFailed{SpuErrno::invalid};
  }
  if ((flags & 0x40) != 0) host |= O_CREAT;
  if ((flags & 0x80) != 0) host |= O_EXCL;
  if ((flags & 0x200) != 0) host |= O_TRUNC;
  if ((flags & 0x400) != 0) host |= O_APPEND;
  return host;
}

CallResult open_file(PpeState& state, const Arguments& arguments) {
  return CallResult::number(
      state.files.add(state.open(arguments.string(0), host_flags(arguments.word(1)), arguments.word(2))));
}

CallResult create_file(PpeState& state, const Arguments& arguments) {
  return CallResult::number(
      state.files.add(state.open(arguments.string(0), O_WRONLY | O_CREAT | O_TRUNC, arguments.word(1))));
}

CallResult close_file(PpeState& state, const Arguments& arguments) {
  state.files.close(arguments.number(0));
  return success();
}

CallResult duplicate(PpeState& state, const Arguments& arguments) {
  std::shared_ptr<OpenFile> file = state.files.at(arguments.number(0));
  return CallResult::number(state.files.add(std::move(file)));
}

CallResult duplicate_to(PpeState& state, const Arguments& arguments) {
  std::shared_ptr<OpenFile> file = state.files.at(arguments.number(0));
  state.files.set(arguments.number(1), std::move(file));
  return CallResult::number(arguments.number(1));
}

CallResult seek(PpeState& state, const Arguments& arguments) {
  const std::uint32_t whence = arguments.word(2);
  OpenFile& file = *state.files.at(arguments.number(0));
  if (whence > 2) throw CallFailed{SpuErrno::invalid};
  const std::int64_t position = file.seek(arguments.number(1), static_cast<OpenFile::From>(whence));
  if (position > INT32_MAX) throw CallFailed{SpuErrno::overflow};
  return CallResult::number(position);
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

CallResult read_bytes(PpeState& state, const Arguments& arguments) {
  OpenFile& file = *state.files.at(arguments.number(0));
  const auto to = arguments.local_store().range_up_to(arguments.word(1), arguments.word(2));
  return CallResult::number(static_cast<std::int64_t>(file.read(to)));
}

CallResult write_bytes(PpeState& state, const Arguments& arguments) {
  OpenFile& file = *state.files.at(arguments.number(0));
  const auto from = arguments.local_store().range(arguments.word(1), arguments.word(2));
  file.write(text_of(from));
  return CallResult::number(static_cast<std::int64_t>(from.size()));
}

/// Returns the host's descriptor of a file with a position. Throws CallFailed for standard streams, which
/// have no position.
int positioned(PpeState& state, const Arguments& arguments) {
  const int host = state.files.at(arguments.number(0))->host_descriptor();
  if (host < 0) throw CallFailed{SpuErrno::illegal_seek};
  if (arguments.number(3) < 0) throw CallFailed{SpuErrno::invalid};
  return host;
}

CallResult read_bytes_at(PpeState& state, const Arguments& arguments) {
  const int host = positioned(state, arguments);
  const auto to = arguments.local_store().range_up_to(arguments.word(1), arguments.word(2));
  const ssize_t count = ::pread(host, to.data(), to.size(), arguments.number(3));
  if (count < 0) fail_with_host_errno();
  return CallResult::number(count);
}

CallResult write_bytes_at(PpeState& state, const Arguments& arguments) {
  const int host = positioned(state, arguments);
  const auto from = arguments.local_store().range(arguments.word(1), arguments.word(2));
  const ssize_t count = ::pwrite(host, from.data(), from.size(), arguments.number(3));
  if (count < 0) fail_with_host_errno();
  return CallResult::number(count);
}

/// Calls `transfer` for each part of a readv() or writev(). A part is an address and a length of 32 bits
/// each.
template <class Transfer> CallResult for_each_part(const Arguments& arguments, const Transfer& transfer) {
  constexpr std::int32_t kMostParts = 1024;
  const LocalStoreView& local_store = arguments.local_store();
  const std::uint32_t parts = arguments.word(1);
  const std::int32_t count = arguments.number(2);
  if (count < 0 || count > kMostParts) throw CallFailed{SpuErrno::invalid};
  std::int64_t total = 0;
  for (std::uint32_t part = parts; part != parts + static_cast<std::uint32_t>(count) * 8; part += 8) {
    const auto bytes =
        local_store.range(local_store.load<std::uint32_t>(part), local_store.load<std::uint32_t>(part + 4));
    const std::size_t done = transfer(bytes);
    total += static_cast<std::int64_t>(done);
    if (done < bytes.size()) break;
  }
  return CallResult::number(total);
}

CallResult read_parts(PpeState& state, const Arguments& arguments) {
  OpenFile& file = *state.files.at(arguments.number(0));
  return for_each_part(arguments, [&](std::span<std::uint8_t> part) { return file.read(part); });
}

CallResult write_parts(PpeState& state, const Arguments& arguments) {
  OpenFile& file = *state.files.at(arguments.number(0));
  return for_each_part(arguments, [&](std::span<std::uint8_t> part) {
    file.write(text_of(part));
    return part.size();
  });
}

CallResult truncate_file(PpeState& state, const Arguments& arguments) {
  return checked(::ftruncate(host_descriptor(state, arguments.number(0)), arguments.number(1)));
}

CallResult synchronize_file(PpeState& state, const Arguments& arguments) {
  return checked(::fsync(host_descriptor(state, arguments.number(0))));
}

CallResult change_mode_of_file(PpeState& state, const Arguments& arguments) {
  return checked(::fchmod(host_descriptor(state, arguments.number(0)), arguments.word(1) & 0777));
}

/// Always succeeds, because all SPEs are one process, and a process never waits for its own locks.
CallResult lock_file(PpeState& state, const Arguments& arguments) {
  host_descriptor(state, arguments.number(0));
  return success();
}

// --- names
// ------------------------------------------------------------------------------------------------------

CallResult check_access(PpeState& state, const Arguments& arguments) {
  const auto place = state.folders.locate(arguments.string(0));
  const std::uint32_t mode = arguments.word(1);
  if (mode > 7) throw CallFailed{SpuErrno::invalid};
  int host_mode = F_OK;
  if ((mode & 4) != 0) host_mode |= R_OK;
  if ((mode & 2) != 0) host_mode |= W_OK;
  if ((mode & 1) != 0) host_mode |= X_OK;
  return checked(::faccessat(place.folder.get(), place.name.c_str(), host_mode, AT_SYMLINK_NOFOLLOW));
}

CallResult unlink_file(PpeState& state, const Arguments& arguments) {
  const auto place = state.folders.locate(arguments.string(0), SymlinkPolicy::keep);
  return checked(::unlinkat(place.folder.get(), place.name.c_str(), 0));
}

CallResult make_folder(PpeState& state, const Arguments& arguments) {
  const auto place = state.folders.locate(arguments.string(0), SymlinkPolicy::keep);
  return checked(::mkdirat(place.folder.get(), place.name.c_str(), arguments.word(1) & ~state.umask & 0777));
}

CallResult remove_folder(PpeState& state, const Arguments& arguments) {
  const auto place = state.folders.locate(arguments.string(0), SymlinkPolicy::keep);
  return checked(::unlinkat(place.folder.get(), place.name.c_str(), AT_REMOVEDIR));
}

CallResult change_mode(PpeState& state, const Arguments& arguments) {
  const HostDescriptor file = state.folders.open(arguments.string(0), O_RDONLY, 0);
  return checked(::fchmod(file.get(), arguments.word(1) & 0777));
}

CallResult truncate_name(PpeState& state, const Arguments& arguments) {
  const HostDescriptor file = state.folders.open(arguments.string(0), O_WRONLY, 0);
  return checked(::ftruncate(file.get(), arguments.number(1)));
}

CallResult read_link(PpeState& state, const Arguments& arguments) {
  const auto place = state.folders.locate(arguments.string(0), SymlinkPolicy::keep);
  const auto to = arguments.local_store().range_up_to(arguments.word(1), arguments.word(2));
  if (to.empty()) throw CallFailed{SpuErrno::invalid};
  const ssize_t count =
      ::readlinkat(place.folder.get(), place.name.c_str(), reinterpret_cast<char*>(to.data()), to.size());
  if (count < 0) fail_with_host_errno();
  return CallResult::number(count);
}

CallResult change_folder(PpeState& state, const Arguments& arguments) {
  state.folders.change_to(arguments.string(0));
  return success();
}

CallResult change_to_open_folder(PpeState& state, const Arguments& arguments) {
  const auto file = std::dynamic_pointer_cast<HostFile>(state.files.at(arguments.number(0)));
  if (!file) throw CallFailed{SpuErrno::not_directory};
  state.folders.change_to(file->path());
  return success();
}

CallResult current_folder(PpeState& state, const Arguments& arguments) {
  const std::uint32_t to = arguments.word(0), size = arguments.word(1);
  if (size == 0) throw CallFailed{SpuErrno::invalid};
  std::string path = state.folders.current();
  path += '\0';
  if (path.size() > size) throw CallFailed{SpuErrno::range};
  arguments.local_store().store_bytes(to, path);
  return CallResult::address(to);
}

/// Returns a template's text in front of its last six characters, which must be X.
std::string_view template_prefix(const Arguments& arguments) {
  const std::string_view name = arguments.string(0);
  if (!name.ends_with("XXXXXX")) throw CallFailed{SpuErrno::invalid};
  return name.substr(0, name.size() - 6);
}

CallResult make_temporary(PpeState& state, const Arguments& arguments) {
  std::string name;
  const std::shared_ptr<HostFile> file = state.make_temporary(template_prefix(arguments), name);
  const std::int32_t descriptor = state.files.add(file);
  arguments.local_store().store_bytes(arguments.word(0), name);
  return CallResult::number(descriptor);
}

CallResult name_temporary(PpeState& state, const Arguments& arguments) {
  const std::string name = state.temporary_name(template_prefix(arguments));
  arguments.local_store().store_bytes(arguments.word(0), name);
  return CallResult::address(arguments.word(0));
}

CallResult set_umask(PpeState& state, const Arguments& arguments) {
  return CallResult::number(std::exchange(state.umask, arguments.word(0) & 0777));
}

// --- status
// -----------------------------------------------------------------------------------------------------

/// Stores thirteen words, from which the program's library makes a struct stat.
void store_status(const Arguments& arguments, const struct stat& status) {
  if (status.st_size > INT32_MAX) throw CallFailed{SpuErrno::overflow};
  const std::uint64_t fields[] = {static_cast<std::uint64_t>(status.st_dev),
                                  static_cast<std::uint64_t>(status.st_ino),
                                  status.st_mode,
                                  static_cast<std::uint64_t>(status.st_nlink),
                                  status.st_uid,
                                  status.st_gid,
                                  static_cast<std::uint64_t>(status.st_rdev),
                                  static_cast<std::uint64_t>(status.st_size),
                                  static_cast<std::uint64_t>(status.st_blksize),
                                  static_cast<std::uint64_t>(status.st_blocks),
                                  static_cast<std::uint64_t>(status.st_atime),
                                  static_cast<std::uint64_t>(status.st_mtime),
                                  static_cast<std::uint64_t>(status.st_ctime)};
  const auto to = arguments.local_store().range(arguments.word(1), std::size(fields) * 4);
  for (std::size_t i = 0; i < std::size(fields); ++i)
    store_big_endian(to.data() + 4 * i, static_cast<std::uint32_t>(fields[i]));
}

CallResult status_of_file(PpeState& state, const Arguments& arguments) {
  const int host = state.files.at(arguments.number(0))->host_descriptor();
  struct stat status = {};
  if (host < 0) { // standard streams look like a terminal
    status.st_mode = S_IFCHR | 0620;
    status.st_nlink = 1;
    status.st_blksize = 1024;
  } else if (::fstat(host, &status) != 0) {
    fail_with_host_errno();
  }
  store_status(arguments, status);
  return success();
}

CallResult status_of_name(PpeState& state, const Arguments& arguments, SymlinkPolicy last) {
  const auto place = state.folders.locate(arguments.string(0), last);
  struct stat status = {};
  if (::fstatat(place.folder.get(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    fail_with_host_errno();
  store_status(arguments, status);
  return success();
}

CallResult status(PpeState& state, const Arguments& arguments) {
  return status_of_name(state, arguments, SymlinkPolicy::follow);
}

CallResult status_of_link(PpeState& state, const Arguments& arguments) {
  return status_of_name(state, arguments, SymlinkPolicy::keep);
}

// --- folders
// ----------------------------------------------------------------------------------------------------

struct CloseListing {
  void operator()(DIR* listing) const { ::closedir(listing); }
};

std::unique_ptr<ListedFolder> list_folder(PpeState& state, std::string_view name) {
  HostDescriptor folder = state.folders.open(name, O_RDONLY | O_DIRECTORY, 0);
  const int copy = ::dup(folder.get()); // closedir() closes it
  const std::unique_ptr<DIR, CloseListing> listing(::fdopendir(copy));
  if (!listing) {
    ::close(copy);
    fail_with_host_errno();
  }
  auto listed = std::make_unique<ListedFolder>();
  while (const dirent* entry = ::readdir(listing.get()))
    listed->entries.push_back({static_cast<std::uint32_t>(entry->d_ino), entry->d_name});
  // Sorted, because hosts list folders in different orders.
  std::ranges::sort(listed->entries, {}, &ListedFolder::Entry::name);
  return listed;
}

CallResult open_folder(PpeState& state, const Arguments& arguments) {
  auto& all = state.listed_folders;
  auto free = std::ranges::find_if(all, std::logical_not<>());
  if (free == all.end()) {
    if (all.size() >= state.config.max_open_files) throw CallFailed{SpuErrno::too_many_open_files};
    free = all.emplace(all.end());
  }
  *free = list_folder(state, arguments.string(0));
  return CallResult::wide(static_cast<std::uint64_t>(free - all.begin()) + 1);
}

std::unique_ptr<ListedFolder>& listed_folder(PpeState& state, const Arguments& arguments) {
  const std::uint64_t number = arguments.doubleword(0);
  if (number == 0 || number > state.listed_folders.size() || !state.listed_folders[number - 1])
    throw CallFailed{SpuErrno::bad_file};
  return state.listed_folders[number - 1];
}

CallResult close_folder(PpeState& state, const Arguments& arguments) {
  listed_folder(state, arguments).reset();
  return success();
}

/// Stores the next entry of a folder: a word with its inode, and 256 bytes for its name.
CallResult read_folder(PpeState& state, const Arguments& arguments) {
  constexpr std::size_t kNameBytes = 256;
  ListedFolder& folder = *listed_folder(state, arguments);
  const auto to = arguments.local_store().range(arguments.word(1), 4 + kNameBytes);
  if (folder.next == folder.entries.size()) return CallResult::address(0);
  const ListedFolder::Entry& entry = folder.entries[folder.next++];
  store_big_endian(to.data(), entry.inode);
  std::ranges::fill(to.subspan(4), std::uint8_t{0});
  std::ranges::copy(std::string_view(entry.name).substr(0, kNameBytes - 1), to.begin() + 4);
  return CallResult::address(arguments.word(1));
}

CallResult rewind_folder(PpeState& state, const Arguments& arguments) {
  listed_folder(state, arguments)->next = 0;
  return success();
}

CallResult seek_folder(PpeState& state, const Arguments& arguments) {
  ListedFolder& folder = *listed_folder(state, arguments);
  folder.next = std::min<std::size_t>(arguments.word(1), folder.entries.size());
  return success();
}

CallResult tell_folder(PpeState& state, const Arguments& arguments) {
  return CallResult::number(static_cast<std::int64_t>(listed_folder(state, arguments)->next));
}

// --- time
// -------------------------------------------------------------------------------------------------------

/// A pair of a time_t and a long, such as timeval and timespec.
struct TimePair {
  std::int64_t seconds, fraction;

  static std::uint32_t bytes(const PpeState& state) { return state.config.time_has_32_bits ? 8 : 16; }

  void store(const PpeState& state, const LocalStoreView& local_store, std::uint32_t to) const {
    const bool narrow = state.config.time_has_32_bits;
    if (narrow)
      local_store.store(to, static_cast<std::uint32_t>(seconds));
    else
      local_store.store(to, static_cast<std::uint64_t>(seconds));
    local_store.store(to + (narrow ? 4 : 8), static_cast<std::uint32_t>(fraction));
  }

  static TimePair load(const PpeState& state, const LocalStoreView& local_store, std::uint32_t from) {
    const bool narrow = state.config.time_has_32_bits;
    return {load_time(state, local_store, from),
            static_cast<std::int32_t>(local_store.load<std::uint32_t>(from + (narrow ? 4 : 8)))};
  }

  static std::int64_t load_time(const PpeState& state, const LocalStoreView& local_store,
                                std::uint32_t from) {
    if (state.config.time_has_32_bits)
      return static_cast<std::int32_t>(local_store.load<std::uint32_t>(from));
    return static_cast<std::int64_t>(local_store.load<std::uint64_t>(from));
  }
};

TimePair now(const PpeState& state) {
  constexpr std::int64_t kMillion = 1000000;
  const std::int64_t microseconds = state.now().count();
  return {microseconds / kMillion, microseconds % kMillion};
}

CallResult time_of_day(PpeState& state, const Arguments& arguments) {
  if (const std::uint32_t to = arguments.word(0); to != 0)
    now(state).store(state, arguments.local_store(), to);
  if (const std::uint32_t zone = arguments.word(1); zone != 0)
    arguments.local_store().store(zone, std::uint64_t{0}); // Greenwich time
  return success();
}

CallResult seconds_of_day(PpeState& state, const Arguments& arguments) {
  const std::int64_t seconds = now(state).seconds;
  if (const std::uint32_t to = arguments.word(0); to != 0) {
    if (state.config.time_has_32_bits)
      arguments.local_store().store(to, static_cast<std::uint32_t>(seconds));
    else
      arguments.local_store().store(to, static_cast<std::uint64_t>(seconds));
  }
  return CallResult::number(seconds);
}

/// Returns at once, because only the work of SPUs advances virtual time.
CallResult sleep_for(PpeState& state, const Arguments& arguments) {
  const TimePair wanted = TimePair::load(state, arguments.local_store(), arguments.word(0));
  if (wanted.seconds < 0 || wanted.fraction < 0 || wanted.fraction >= 1000000000)
    throw CallFailed{SpuErrno::invalid};
  if (const std::uint32_t left = arguments.word(1); left != 0)
    TimePair{0, 0}.store(state, arguments.local_store(), left);
  return success();
}

CallResult set_times(PpeState& state, std::string_view name, TimePair accessed, TimePair changed) {
  const auto place = state.folders.locate(name);
  const auto host_time = [](TimePair time) {
    return timespec{static_cast<time_t>(time.seconds), static_cast<long>(time.fraction * 1000)};
  };
  const timespec times[] = {host_time(accessed), host_time(changed)};
  return checked(::utimensat(place.folder.get(), place.name.c_str(), times, AT_SYMLINK_NOFOLLOW));
}

CallResult set_times_in_seconds(PpeState& state, const Arguments& arguments) {
  const std::uint32_t from = arguments.word(1);
  if (from == 0) return set_times(state, arguments.string(0), now(state), now(state));
  const std::uint32_t bytes = TimePair::bytes(state) / 2;
  return set_times(state, arguments.string(0), {TimePair::load_time(state, arguments.local_store(), from), 0},
                   {TimePair::load_time(state, arguments.local_store(), from + bytes), 0});
}

CallResult set_times_in_microseconds(PpeState& state, const Arguments& arguments) {
  const std::uint32_t from = arguments.word(1);
  if (from == 0) return set_times(state, arguments.string(0), now(state), now(state));
  return set_times(state, arguments.string(0), TimePair::load(state, arguments.local_store(), from),
                   TimePair::load(state, arguments.local_store(), from + TimePair::bytes(state)));
}

// --- the rest
// ---------------------------------------------------------------------------------------------------

CallResult page_bytes(PpeState&, const Arguments&) {
  return CallResult::number(4096);
}
CallResult do_nothing(PpeState&, const Arguments&) {
  return success();
}

/// Refuses a call that could reach beyond the allowed folders, or needs privileges.
CallResult refuse(PpeState&, const Arguments&) {
  throw CallFailed{SpuErrno::not_permitted};
}

constexpr auto kZero = PpeCall::OnFailure::zero;

constexpr std::array kPosixCalls = {
    PpeCall{},
    PpeCall{}, // adjtimex
    PpeCall{close_file},
    PpeCall{create_file},
    PpeCall{status_of_file},
    PpeCall{}, // ftok
    PpeCall{page_bytes},
    PpeCall{time_of_day},
    PpeCall{}, // kill
    PpeCall{seek},
    PpeCall{status_of_link}, // 10
    PpeCall{map_memory},
    PpeCall{remap_memory},
    PpeCall{synchronize_memory},
    PpeCall{unmap_memory},
    PpeCall{open_file},
    PpeCall{read_bytes},
    PpeCall{}, // shmat
    PpeCall{}, // shmctl
    PpeCall{}, // shmdt
    PpeCall{}, // 20: shmget
    PpeCall{}, // shm_open
    PpeCall{}, // shm_unlink
    PpeCall{status},
    PpeCall{unlink_file},
    PpeCall{}, // wait
    PpeCall{}, // waitpid
    PpeCall{write_bytes},
    PpeCall{truncate_file},
    PpeCall{check_access},
    PpeCall{duplicate}, // 30
    PpeCall{seconds_of_day},
    PpeCall{sleep_for},
    PpeCall{change_folder},
    PpeCall{change_to_open_folder},
    PpeCall{make_folder},
    PpeCall{refuse}, // mknod
    PpeCall{remove_folder},
    PpeCall{change_mode},
    PpeCall{change_mode_of_file},
    PpeCall{refuse}, // 40: chown
    PpeCall{refuse}, // fchown
    PpeCall{refuse}, // lchown
    PpeCall{current_folder, kZero},
    PpeCall{refuse}, // link
    PpeCall{refuse}, // symlink
    PpeCall{read_link},
    PpeCall{do_nothing, kZero}, // sync
    PpeCall{synchronize_file},
    PpeCall{synchronize_file}, // fdatasync
    PpeCall{duplicate_to},     // 50
    PpeCall{lock_file},
    PpeCall{truncate_name},
    PpeCall{make_temporary},
    PpeCall{name_temporary, kZero},
    PpeCall{open_folder, kZero},
    PpeCall{close_folder},
    PpeCall{read_folder, kZero},
    PpeCall{rewind_folder, kZero},
    PpeCall{seek_folder, kZero},
    PpeCall{tell_folder}, // 60
    PpeCall{do_nothing},  // sched_yield
    PpeCall{set_umask},
    PpeCall{set_times_in_seconds},
    PpeCall{set_times_in_microseconds},
    PpeCall{read_bytes_at},
    PpeCall{write_bytes_at},
    PpeCall{read_parts},
    PpeCall{write_parts},
};
static_assert(kPosixCalls.size() == 69);

} // namespace

std::span<const PpeCall> posix_calls() {
  return kPosixCalls;
}

} // namespace celltrace::cell_emu

#include "cli/sandbox.hpp"

#include "celltrace/error.hpp"
#include "image/file.hpp"
#include "pov/sources.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <iterator>
#include <string>
#include <system_error>

#ifdef CELLTRACE_HAS_SECCOMP
#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace celltrace::cli {
namespace fs = std::filesystem;

namespace {

void add_existing(std::vector<fs::path>& to, const fs::path& path) {
  std::error_code ignored;
  const fs::path known = path.empty() ? fs::path(".") : path;
  if (fs::exists(known, ignored)) to.push_back(known);
}

/// Adds the folder of an output: a file that gets its name at the end needs its folder; a stream does not.
void add_output(std::vector<fs::path>& to, const fs::path& path) {
  if (path.empty() || path == "-") return;
  if (image::is_stream(path)) return add_existing(to, path);
  std::error_code error;
  const fs::path target = fs::weakly_canonical(path, error); // resolves links
  add_existing(to, error ? path.parent_path() : target.parent_path());
}

} // namespace

SandboxFiles sandbox_files(const RenderRequest& request) {
  SandboxFiles files;
  add_existing(files.readable, request.scene.parent_path());
  for (const fs::path& folder : request.library_paths)
    add_existing(files.readable, folder);
  for (const fs::path& folder : request.readable_folders)
    add_existing(files.readable, folder);
  if (!request.header.empty()) add_existing(files.readable, request.header);
  for (const char* const folder : pov::installed_include_folders())
    add_existing(files.readable, folder);
  add_output(files.writable, request.output);
  add_output(files.writable, request.stats);
  add_output(files.writable, request.trace);
  add_output(files.writable, request.cache_trace);
  for (const fs::path& folder : request.writable_folders)
    add_existing(files.writable, folder);
  return files;
}

#ifndef CELLTRACE_HAS_SECCOMP

void enter_sandbox(const SandboxFiles&) {
  throw Error("--sandbox: this build has no libseccomp");
}

#else

namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw Error("--sandbox: " + what + ": " + std::generic_category().message(error));
}

/// Landlock's system calls, by number: headers may be older than the kernel.
namespace landlock {

struct Ruleset {
  std::uint64_t files, network, scopes;
};
struct __attribute__((packed)) PathRule {
  std::uint64_t allowed;
  std::int32_t folder;
};
constexpr std::uint64_t kExecute = 1 << 0, kWriteFile = 1 << 1, kReadFile = 1 << 2, kReadFolder = 1 << 3,
                        kRemoveFile = 1 << 5, kMakeFile = 1 << 8, kTruncate = 1 << 14;
/// The accesses that are denied unless a rule allows them, by version of the interface: all that the version
/// knows.
constexpr std::uint64_t kFiles[] = {(1 << 13) - 1, (1 << 14) - 1, (1 << 15) - 1, (1 << 15) - 1,
                                    (1 << 16) - 1};
constexpr std::uint64_t kBindAndConnect = 3, kScopes = 3;
constexpr std::int32_t kPathRule = 1;
constexpr std::uint32_t kAskVersion = 1;

int version() {
  return static_cast<int>(syscall(SYS_landlock_create_ruleset, nullptr, 0, kAskVersion));
}

void allow(int rules, const fs::path& path, std::uint64_t allowed, std::uint64_t known) {
  const int folder = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (folder < 0) fail(path.string(), errno);
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) allowed &= kExecute | kWriteFile | kReadFile | kTruncate;
  const PathRule rule = {allowed & known, folder};
  const long added = syscall(SYS_landlock_add_rule, rules, kPathRule, &rule, 0);
  const int error = errno;
  close(folder);
  if (added != 0) fail(path.string(), error);
}

void restrict_files(const SandboxFiles& files) {
  const int known = version();
  if (known < 1) fail("this kernel has no Landlock", known < 0 ? errno : ENOSYS);
  const std::uint64_t handled = kFiles[std::min(known, static_cast<int>(std::size(kFiles))) - 1];
  const Ruleset ruleset = {handled, known >= 4 ? kBindAndConnect : 0, known >= 6 ? kScopes : 0};
  const std::size_t size = known >= 6 ? 24 : known >= 4 ? 16 : 8;
  const int rules = static_cast<int>(syscall(SYS_landlock_create_ruleset, &ruleset, size, 0));
  if (rules < 0) fail("Landlock", errno);
  for (const fs::path& path : files.readable)
    allow(rules, path, kReadFile | kReadFolder, handled);
  for (const fs::path& path : files.writable)
    allow(rules, path, kReadFile | kReadFolder | kWriteFile | kRemoveFile | kMakeFile | kTruncate, handled);
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail("no new privileges", errno);
  const long restricted = syscall(SYS_landlock_restrict_self, rules, 0);
  const int error = errno;
  close(rules);
  if (restricted != 0) fail("Landlock", error);
}

} // namespace landlock

/// System calls that start processes, reach other processes or the network, or change the system.
constexpr const char* kDenied[] = {"execve",
                                   "execveat",
                                   "fork",
                                   "vfork",
                                   "socket",
                                   "socketpair",
                                   "connect",
                                   "bind",
                                   "listen",
                                   "accept",
                                   "accept4",
                                   "sendto",
                                   "sendmsg",
                                   "sendmmsg",
                                   "ptrace",
                                   "kill",
                                   "tkill",
                                   "pidfd_open",
                                   "pidfd_getfd",
                                   "pidfd_send_signal",
                                   "mount",
                                   "umount2",
                                   "chroot",
                                   "pivot_root",
                                   "unshare",
                                   "setns",
                                   "bpf",
                                   "keyctl",
                                   "add_key",
                                   "request_key",
                                   "process_vm_readv",
                                   "process_vm_writev",
                                   "perf_event_open",
                                   "userfaultfd",
                                   "io_uring_setup",
                                   "open_by_handle_at",
                                   "init_module",
                                   "finit_module",
                                   "delete_module",
                                   "kexec_load",
                                   "reboot"};

void restrict_calls() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  if (filter == nullptr) fail("seccomp", ENOMEM);
  int error = 0;
  const auto add = [&](std::uint32_t action, int call, unsigned conditions, scmp_arg_cmp condition) {
    if (call == __NR_SCMP_ERROR || error != 0) return;
    error = conditions == 0 ? seccomp_rule_add(filter, action, call, 0)
                            : seccomp_rule_add(filter, action, call, 1, condition);
  };
  for (const char* name : kDenied)
    add(SCMP_ACT_ERRNO(EPERM), seccomp_syscall_resolve_name(name), 0, {});
  // Allows clone() for threads only. The flags of clone3() are in memory, which filters cannot read: without
  // clone3(), libraries use clone().
  const scmp_arg_cmp makes_a_process = {0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0};
  add(SCMP_ACT_ERRNO(EPERM), seccomp_syscall_resolve_name("clone"), 1, makes_a_process);
  add(SCMP_ACT_ERRNO(ENOSYS), seccomp_syscall_resolve_name("clone3"), 0, {});
  if (error == 0) error = seccomp_load(filter);
  seccomp_release(filter);
  if (error != 0) fail("seccomp", -error);
}

} // namespace

void enter_sandbox(const SandboxFiles& files) {
  tzset(); // reads a file now
  landlock::restrict_files(files);
  restrict_calls();
}

#endif

} // namespace celltrace::cli

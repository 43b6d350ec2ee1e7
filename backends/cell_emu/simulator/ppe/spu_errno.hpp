// The values of errno in programs for the SPU: the numbers of Linux on PowerPC.
#pragma once

#include <cstdint>
#include <string_view>

namespace celltrace::cell_emu {

enum class SpuErrno : std::uint32_t {
  none = 0,
  not_permitted = 1,        ///< EPERM
  no_entry = 2,             ///< ENOENT
  io = 5,                   ///< EIO
  bad_file = 9,             ///< EBADF
  no_memory = 12,           ///< ENOMEM
  access = 13,              ///< EACCES
  fault = 14,               ///< EFAULT
  exists = 17,              ///< EEXIST
  no_device = 19,           ///< ENODEV
  not_directory = 20,       ///< ENOTDIR
  is_directory = 21,        ///< EISDIR
  invalid = 22,             ///< EINVAL
  too_many_open_files = 24, ///< EMFILE
  illegal_seek = 29,        ///< ESPIPE
  range = 34,               ///< ERANGE
  name_too_long = 36,       ///< ENAMETOOLONG
  not_implemented = 38,     ///< ENOSYS
  loop = 40,                ///< ELOOP
  overflow = 75,            ///< EOVERFLOW
  illegal_sequence = 84,    ///< EILSEQ
};

/// Exception by which a call fails with an errno. PpeCalls catches it.
struct CallFailed {
  SpuErrno error;
};

/// Returns the SPU's number for an errno of the host; EIO if the SPU has no such error.
SpuErrno spu_errno(int host_errno);

/// Throws CallFailed with the error in the host's errno.
[[noreturn]] void fail_with_host_errno();

/// Returns the text that perror() prints for an error.
std::string_view error_text(std::uint32_t spu_errno);

} // namespace celltrace::cell_emu

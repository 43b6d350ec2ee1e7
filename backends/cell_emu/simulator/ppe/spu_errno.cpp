#include "backends/cell_emu/simulator/ppe/spu_errno.hpp"

#include <algorithm>
#include <cerrno>
#include <iterator>

namespace celltrace::cell_emu {

namespace {

struct Entry {
  std::uint32_t number; // of the SPU
  int host;
  std::string_view text;
};

constexpr Entry kErrors[] = {
    {0, 0, "Success"},
    {1, EPERM, "Operation not permitted"},
    {2, ENOENT, "No such file or directory"},
    {3, ESRCH, "No such process"},
    {4, EINTR, "Interrupted system call"},
    {5, EIO, "Input/output error"},
    {6, ENXIO, "No such device or address"},
    {7, E2BIG, "Argument list too long"},
    {8, ENOEXEC, "Exec format error"},
    {9, EBADF, "Bad file descriptor"},
    {10, ECHILD, "No child processes"},
    {11, EAGAIN, "Resource temporarily unavailable"},
    {12, ENOMEM, "Cannot allocate memory"},
    {13, EACCES, "Permission denied"},
    {14, EFAULT, "Bad address"},
    {16, EBUSY, "Device or resource busy"},
    {17, EEXIST, "File exists"},
    {18, EXDEV, "Invalid cross-device link"},
    {19, ENODEV, "No such device"},
    {20, ENOTDIR, "Not a directory"},
    {21, EISDIR, "Is a directory"},
    {22, EINVAL, "Invalid argument"},
    {23, ENFILE, "Too many open files in system"},
    {24, EMFILE, "Too many open files"},
    {25, ENOTTY, "Inappropriate ioctl for device"},
    {26, ETXTBSY, "Text file busy"},
    {27, EFBIG, "File too large"},
    {28, ENOSPC, "No space left on device"},
    {29, ESPIPE, "Illegal seek"},
    {30, EROFS, "Read-only file system"},
    {31, EMLINK, "Too many links"},
    {32, EPIPE, "Broken pipe"},
    {33, EDOM, "Numerical argument out of domain"},
    {34, ERANGE, "Numerical result out of range"},
    {35, EDEADLK, "Resource deadlock avoided"},
    {36, ENAMETOOLONG, "File name too long"},
    {37, ENOLCK, "No locks available"},
    {38, ENOSYS, "Function not implemented"},
    {39, ENOTEMPTY, "Directory not empty"},
    {40, ELOOP, "Too many levels of symbolic links"},
    {75, EOVERFLOW, "Value too large for defined data type"},
    {84, EILSEQ, "Invalid or incomplete multibyte or wide character"},
    {95, EOPNOTSUPP, "Operation not supported"},
};

} // namespace

SpuErrno spu_errno(int host_errno) {
  const auto* entry = std::ranges::find(kErrors, host_errno, &Entry::host);
  return entry != std::end(kErrors) ? static_cast<SpuErrno>(entry->number) : SpuErrno::io;
}

void fail_with_host_errno() {
  throw CallFailed{spu_errno(errno)};
}

std::string_view error_text(std::uint32_t spu_errno) {
  const auto* entry = std::ranges::find(kErrors, spu_errno, &Entry::number);
  return entry != std::end(kErrors) ? entry->text : "Unknown error";
}

} // namespace celltrace::cell_emu

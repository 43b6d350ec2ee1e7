#include "python/watch.hpp"

#include "celltrace/error.hpp"

namespace celltrace {

namespace py = pybind11;

bool Watch::operator()(double fraction) {
  const double whole = begin_ + (end_ - begin_) * fraction;
  const auto now = std::chrono::steady_clock::now();
  if (ended_ || (whole < 1 && now - last_ < kPeriod)) return !ended_;
  const py::gil_scoped_acquire lock;
  try {
    if (PyErr_CheckSignals()) throw py::error_already_set();
    if (!function_.is_none()) ended_ = function_(whole).is(py::bool_(false));
  } catch (...) {
    error_ = std::current_exception();
    ended_ = true;
  }
  last_ = std::chrono::steady_clock::now();
  return !ended_;
}

void Watch::check(bool is_complete) const {
  if (error_) std::rethrow_exception(error_);
  if (!is_complete) throw Cancelled();
}

} // namespace celltrace

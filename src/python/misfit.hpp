// Errors of calls whose arguments do not fit: they name the parameters, in place of pybind11's list of C++
// types.
#pragma once

#include "python/fields.hpp"

#include <memory>
#include <string>
#include <utility>

namespace celltrace {

/// A first argument of any type, which is accepted only after pybind11 has tried everything else.
struct LastResort {
  py::object given;
};

} // namespace celltrace

namespace pybind11::detail {

template <> struct type_caster<celltrace::LastResort> {
  PYBIND11_TYPE_CASTER(celltrace::LastResort, const_name("object"));

  /// Refuses in pybind11's first round, which converts nothing: a match there would win over overloads that
  /// need conversions.
  bool load(handle source, bool convert) {
    value.given = reinterpret_borrow<object>(source);
    return convert;
  }
};

} // namespace pybind11::detail

namespace celltrace {

/// The last overload of a function, which throws TypeError for every call that reaches it.
class Misfit {
public:
  /// Makes the overload; `parameters` as in signed_doc().
  Misfit(std::string name, std::string parameters)
      : name_(std::move(name)), parameters_(std::move(parameters)) {}

  [[noreturn]] void refuse(const LastResort& first, const py::args& args, const py::kwargs& kwargs) const;

private:
  std::string name_, parameters_;
};

/// Returns the default of the first argument, which means that there is none.
inline py::object no_argument() {
  return py::ellipsis();
}

/// Adds the last overload of a function of a module, or of a static one of a class.
template <class Define> void add_misfit(const Define& define, Misfit misfit) {
  define([misfit = std::move(misfit)](const LastResort& first, const py::args& args,
                                      const py::kwargs& kwargs) { misfit.refuse(first, args, kwargs); },
         py::arg("first") = no_argument());
}
/// Adds the last overload of a method.
template <class Class> void add_method_misfit(Class& bound, const char* name, Misfit misfit) {
  bound.def(
      name,
      [misfit = std::move(misfit)](const py::object&, const LastResort& first, const py::args& args,
                                   const py::kwargs& kwargs) { misfit.refuse(first, args, kwargs); },
      py::arg("first") = no_argument());
}
/// Adds the last overload of the constructor of a class whose values are of type T.
template <class T, class Class> void add_init_misfit(Class& bound, Misfit misfit) {
  bound.def(py::init([misfit = std::move(misfit)](const LastResort& first, const py::args& args,
                                                  const py::kwargs& kwargs) -> std::shared_ptr<T> {
              misfit.refuse(first, args, kwargs);
            }),
            py::arg("first") = no_argument());
}

} // namespace celltrace

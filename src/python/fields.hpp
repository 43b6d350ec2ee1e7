// Structures of the library as Python sees them: fields with names, which keyword arguments set.
#pragma once

#include "python/casters.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace celltrace {

namespace py = pybind11;

/// The fields of a T by name, in an order.
template <class T> class Fields {
public:
  /// `access` gives a reference to the field of a T: a pointer to a member, or a function.
  template <class Access> Fields& add(const char* name, Access access, const char* doc) {
    using Value = std::decay_t<decltype(std::invoke(access, std::declval<T&>()))>;
    fields_.push_back({name, doc,
                       [access, name](T& made, py::handle value) {
                         const auto wrong = [&] {
                           return py::type_error(std::string(name) + ": cannot be " +
                                                 py::repr(value).template cast<std::string>());
                         };
                         try {
                           std::invoke(access, made) = value.cast<Value>();
                         } catch (const py::cast_error&) {
                           throw wrong();
                         } catch (const py::reference_cast_error&) { // of None
                           throw wrong();
                         }
                       },
                       [access](const T& made) {
                         return py::cast(std::invoke(access, const_cast<T&>(made)),
                                         py::return_value_policy::copy);
                       }});
    return *this;
  }

  /// Sets a field; false if there is none of this name.
  bool set(T& made, const std::string& name, py::handle value) const {
    for (const Field& field : fields_)
      if (field.name == name) {
        field.set(made, value);
        return true;
      }
    return false;
  }
  /// By position and by name. Throws TypeError for what there is not, in the name of `what`.
  void set_all(T& made, const py::args& args, const py::kwargs& kwargs, const std::string& what) const {
    if (args.size() > fields_.size())
      throw py::type_error(what + " takes at most " + std::to_string(fields_.size()) + " arguments");
    for (std::size_t i = 0; i < args.size(); ++i) {
      if (kwargs.contains(fields_[i].name.c_str()))
        throw py::type_error(what + ": " + fields_[i].name + " is given twice");
      fields_[i].set(made, args[i]);
    }
    for (const std::pair<py::handle, py::handle> given : kwargs) {
      const auto name = py::cast<std::string>(given.first);
      if (!set(made, name, given.second)) throw py::type_error(what + " has no '" + name + "'");
    }
  }
  /// Each field's name and value, as Python's objects.
  template <class Visit> void for_each(const T& made, const Visit& visit) const {
    for (const Field& field : fields_)
      visit(field.name, field.get(made));
  }
  template <class Visit> void describe(const Visit& visit) const {
    for (const Field& field : fields_)
      visit(field.name.c_str(), field.doc, field.get);
  }

private:
  struct Field {
    std::string name;
    const char* doc;
    std::function<void(T&, py::handle)> set;
    std::function<py::object(const T&)> get;
  };
  std::vector<Field> fields_;
};

/// A class of values: made by keywords, compared and printed by fields, never changed: replace() makes
/// another one.
template <class T>
py::class_<T, std::shared_ptr<T>> bind_values(py::module_& module, const char* name, const char* doc,
                                              const Fields<T>& fields) {
  const auto shared = std::make_shared<const Fields<T>>(fields);
  const std::string what = name;
  py::class_<T, std::shared_ptr<T>> made(module, name, doc);
  made.def(py::init([shared, what](const py::args& args, const py::kwargs& kwargs) {
    auto value = std::make_shared<T>();
    shared->set_all(*value, args, kwargs, what);
    return value;
  }));
  fields.describe([&](const char* field, const char* about, const auto& get) {
    made.def_property_readonly(field, get, about);
  });
  made.def(
      "replace",
      [shared, what](const T& self, const py::kwargs& kwargs) {
        auto value = std::make_shared<T>(self);
        shared->set_all(*value, py::args(), kwargs, what);
        return value;
      },
      "Another one, with these fields instead.");
  made.def("__eq__", [shared](const T& self, const py::object& other) -> py::object {
    if (!py::isinstance<T>(other)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    std::vector<py::object> theirs;
    shared->for_each(other.cast<const T&>(),
                     [&](const std::string&, py::object value) { theirs.push_back(std::move(value)); });
    std::size_t i = 0;
    bool same = true;
    shared->for_each(
        self, [&](const std::string&, const py::object& value) { same = value.equal(theirs[i++]) && same; });
    return py::bool_(same);
  });
  made.def("__repr__", [shared, what](const T& self) {
    std::vector<py::object> usual;
    shared->for_each(T(), [&](const std::string&, py::object value) { usual.push_back(std::move(value)); });
    std::string text;
    std::size_t i = 0;
    shared->for_each(self, [&](const std::string& field, const py::object& value) {
      if (!value.equal(usual[i++]))
        text += (text.empty() ? "" : ", ") + field + "=" + py::repr(value).template cast<std::string>();
    });
    return what + "(" + text + ")";
  });
  return made;
}

} // namespace celltrace

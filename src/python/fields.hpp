// Structures of the library as Python classes: fields with names, which keyword arguments set.
#pragma once

#include "python/bytes.hpp"
#include "python/casters.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace celltrace {

namespace py = pybind11;

/// Returns a default as inspect.signature() can read it: the value, or `...` if it has no literal.
inline std::string literal(const py::object& value) {
  for (const py::handle type : {py::handle(reinterpret_cast<PyObject*>(&PyBool_Type)),
                                py::handle(reinterpret_cast<PyObject*>(&PyLong_Type)),
                                py::handle(reinterpret_cast<PyObject*>(&PyFloat_Type)),
                                py::handle(reinterpret_cast<PyObject*>(&PyUnicode_Type)),
                                py::handle(reinterpret_cast<PyObject*>(&PyTuple_Type)),
                                py::handle(reinterpret_cast<PyObject*>(&PyList_Type))})
    if (py::isinstance(value, type)) return py::repr(value).cast<std::string>();
  return value.is_none() ? "None" : "...";
}

/// Returns " (did you mean 'width'?)" if one of the names is similar to `wrong`.
inline std::string suggestion(const std::string& wrong, const std::vector<std::string>& names) {
  const py::list near = py::module_::import("difflib").attr("get_close_matches")(wrong, names, 1);
  return near.empty() ? "" : " (did you mean '" + near[0].cast<std::string>() + "'?)";
}

/// Returns a docstring that begins with the signature for inspect.signature() and help(), as CPython's own
/// do.
inline std::string signed_doc(const std::string& name, const std::string& parameters,
                              const std::string& doc) {
  return name + "(" + parameters + ")\n--\n\n" + doc;
}

/// Returns the docstring of a class's constructor, which inspect.signature() reads in place of the class's.
inline std::string signed_init(const std::string& parameters) {
  return signed_doc("__init__", parameters.empty() ? "self" : "self, " + parameters, "");
}

template <class T> inline constexpr bool kIsOptional = false;
template <class T> inline constexpr bool kIsOptional<std::optional<T>> = true;

/// Names the type that a field takes, for errors and documentation.
template <class Value> std::string wanted(const char* doc) {
  if constexpr (kIsOptional<Value>)
    return wanted<typename Value::value_type>(doc) + ", or None";
  else if constexpr (std::is_same_v<Value, bool>)
    return "True or False";
  else if constexpr (std::is_integral_v<Value>)
    return "a whole number";
  else if constexpr (std::is_floating_point_v<Value>)
    return "a number";
  else if constexpr (std::is_same_v<Value, Vec3>)
    return "three numbers, or one that stands for all";
  else
    return doc;
}

/// Converts a value that is given under a name. Throws TypeError, which says what type it has to be.
template <class Value> Value value_of(py::handle given, const std::string& name, const char* doc = "") {
  const auto wrong = [&] {
    std::string what = wanted<Value>(doc);
    if (std::is_same_v<Value, Vec3> && py::isinstance<py::str>(given))
      what += "; celltrace.srgb() makes them of a colour's name";
    return py::type_error(name + ": cannot be " + py::repr(given).template cast<std::string>() +
                          (what.empty() ? "" : " (" + what + ")"));
  };
  try {
    return given.cast<Value>();
  } catch (const py::cast_error&) {
    throw wrong();
  } catch (const py::reference_cast_error&) { // thrown for None
    throw wrong();
  }
}

/// The fields of a T by name, in order.
template <class T> class Fields {
public:
  /// Adds a field. `access` returns a reference to the field of a T: a pointer to a member, or a function.
  template <class Access> Fields& add(const char* name, Access access, const char* doc) {
    using Value = std::decay_t<decltype(std::invoke(access, std::declval<T&>()))>;
    fields_.push_back({name, doc,
                       [access, name, doc](T& made, py::handle value) {
                         std::invoke(access, made) = value_of<Value>(value, name, doc);
                       },
                       [access](const T& made) {
                         return py::cast(std::invoke(access, const_cast<T&>(made)),
                                         py::return_value_policy::copy);
                       }});
    return *this;
  }

  /// Sets a field. Returns false if there is none of this name.
  bool set(T& made, const std::string& name, py::handle value) const {
    for (const Field& field : fields_)
      if (field.name == name) {
        field.set(made, value);
        return true;
      }
    return false;
  }
  /// Sets fields by position and by name. Throws TypeError, in the name of `what`, for unknown ones.
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
      if (!set(made, name, given.second))
        throw py::type_error(what + " has no '" + name + "'" + suggestion(name, names()));
    }
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Field& field : fields_)
      all.push_back(field.name);
    return all;
  }
  /// Calls `visit` with each field's name and value, as Python objects.
  template <class Visit> void for_each(const T& made, const Visit& visit) const {
    for (const Field& field : fields_)
      visit(field.name, field.get(made));
  }
  template <class Visit> void describe(const Visit& visit) const {
    for (const Field& field : fields_)
      visit(field.name.c_str(), field.doc, field.get);
  }
  /// Returns "name=default, ...", with the defaults of `usual`.
  std::string signature(const T& usual = T()) const {
    std::string text;
    for_each(usual, [&](const std::string& name, const py::object& value) {
      text += (text.empty() ? "" : ", ") + name + "=" + literal(value);
    });
    return text;
  }
  /// Returns the names of the signature without values.
  std::string signature_of_changes() const {
    std::string text;
    for (const Field& field : fields_)
      text += (text.empty() ? "" : ", ") + field.name + "=...";
    return text;
  }
  /// Returns a line for each field with its meaning.
  std::string listing() const {
    std::string text;
    for (const Field& field : fields_)
      text += "    " + field.name + (*field.doc ? std::string(": ") + field.doc : "") + "\n";
    return text;
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

/// Makes values of a class picklable; copies of immutable values are the same object.
template <class T, class Class> void bind_pickle(Class& made) {
  made.def(py::pickle([](const T& self) { return py::bytes(to_bytes(self)); },
                      [](const py::bytes& state) { return from_bytes<T>(std::string_view(state)); }));
  made.def("__copy__", [](const py::object& self) { return self; });
  made.def("__deepcopy__", [](const py::object& self, const py::object&) { return self; });
}

/// Binds a class of immutable values, made by keywords, compared and printed by fields; replace() makes
/// changed copies.
template <class T>
py::class_<T, std::shared_ptr<T>> bind_values(py::module_& module, const char* name, const char* doc,
                                              const Fields<T>& fields) {
  const auto shared = std::make_shared<const Fields<T>>(fields);
  const std::string what = name;
  py::class_<T, std::shared_ptr<T>> made(module, name, signed_doc(what, fields.signature(), doc).c_str());
  made.def(py::init([shared, what](const py::args& args, const py::kwargs& kwargs) {
             auto value = std::make_shared<T>();
             shared->set_all(*value, args, kwargs, what);
             return value;
           }),
           signed_init(fields.signature()).c_str());
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
      signed_doc("replace", "$self, *, " + fields.signature_of_changes(),
                 "Another one, with these fields instead.")
          .c_str());
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
  bind_pickle<T>(made);
  return made;
}

} // namespace celltrace

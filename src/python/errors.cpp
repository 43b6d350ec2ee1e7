#include "python/bindings.hpp"

#include "celltrace/error.hpp"

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

namespace celltrace {

namespace py = pybind11;

namespace {

// Live as long as the process does.
struct ErrorTypes {
  PyObject *error, *input, *scene, *spe, *cancelled;
};
ErrorTypes types;

PyObject* make_type(py::module_& module, const char* name, const char* doc, PyObject* base,
                    const py::dict& attributes = {}) {
  const std::string whole = std::string("celltrace.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(whole.c_str(), doc, base, attributes.ptr());
  if (!type) throw py::error_already_set();
  module.attr(name) = py::handle(type);
  return type;
}

/// Takes what is behind the last colon off `text`, if it is a number.
bool take_number(std::string_view& text, long& number) {
  const std::size_t colon = text.rfind(':');
  if (colon == text.npos) return false;
  const char *begin = text.data() + colon + 1, *end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(begin, end, number);
  if (fault != std::errc() || stop != end) return false;
  text = text.substr(0, colon);
  return true;
}

void raise(PyObject* type, const Error& error) {
  const py::object raised = py::reinterpret_borrow<py::object>(type)(error.what());
  std::string_view place = error.what();
  place = place.substr(0, place.find(": error: "));
  long line = 0, column = 0;
  if (type == types.scene && take_number(place, column) && take_number(place, line)) {
    raised.attr("file") = std::string(place);
    raised.attr("line") = line;
    raised.attr("column") = column;
  }
  PyErr_SetObject(type, raised.ptr());
}

} // namespace

void bind_errors(py::module_& module) {
  py::dict nowhere;
  for (const char* part : {"file", "line", "column"})
    nowhere[part] = py::none();
  types.error =
      make_type(module, "Error",
                "Base of the errors of celltrace. file, line and column say where a scene's text is\n"
                "wrong; elsewhere they are None.",
                PyExc_RuntimeError, nowhere);
  types.input =
      make_type(module, "InputError", "A picture, file, scene or option that cannot be used.", types.error);
  types.scene =
      make_type(module, "SceneError",
                "The text of a scene is wrong or uses what is not supported: \"file:line:column: error:\n"
                "text\", with the places that it was included from.",
                types.input);
  types.spe =
      make_type(module, "SpeError", "A kernel broke a rule of the machine that it ran on.", types.error);
  types.cancelled = make_type(module, "Cancelled", "The work was cancelled by its caller.", types.error);

  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const SceneError& error) {
      raise(types.scene, error);
    } catch (const InputError& error) {
      raise(types.input, error);
    } catch (const SpeError& error) {
      raise(types.spe, error);
    } catch (const Cancelled& error) {
      raise(types.cancelled, error);
    } catch (const Error& error) {
      raise(types.error, error);
    }
  });
}

} // namespace celltrace

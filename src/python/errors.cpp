#include "python/bindings.hpp"
#include "python/fields.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace celltrace {

namespace py = pybind11;

namespace {

// Exception types, which live as long as the process.
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

void raise(PyObject* type, const Error& error) {
  const py::object raised = py::reinterpret_borrow<py::object>(type)(error.what());
  PyErr_SetObject(type, raised.ptr());
}

/// Raises a scene error, with the place of the error that ended reading.
void raise(const SceneError& error) {
  const py::object raised = py::reinterpret_borrow<py::object>(types.scene)(error.what());
  const std::vector<Finding>& findings = error.findings();
  raised.attr("findings") = findings;
  const auto first = std::find_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.severity == Finding::Severity::error;
  });
  if (first != findings.end()) {
    raised.attr("file") = first->file;
    if (first->line != 0) { // else the error is about the file as a whole
      raised.attr("line") = first->line;
      raised.attr("column") = first->column;
    }
  }
  PyErr_SetObject(types.scene, raised.ptr());
}

} // namespace

void bind_errors(py::module_& module) {
  py::class_<Finding> made(module, "Finding", "Something that was found in the text of a scene.");
  bind_pickle<Finding>(made);
  made.def_property_readonly(
          "severity",
          [](const Finding& finding) {
            const bool is_note = finding.severity == Finding::Severity::note;
            return is_note ? "note" : finding.severity == Finding::Severity::warning ? "warning" : "error";
          },
          "note, warning or error")
      .def_readonly("file", &Finding::file)
      .def_readonly("line", &Finding::line, "from 1; 0: the file as a whole, which cannot be read")
      .def_readonly("column", &Finding::column, "from 1")
      .def_readonly("text", &Finding::text)
      .def_readonly("reached_by", &Finding::reached_by,
                    "the includes and macros on the way there, from the inside out");
  py::dict nowhere;
  for (const char* part : {"file", "line", "column"})
    nowhere[part] = py::none();
  nowhere["findings"] = py::tuple();
  types.error =
      make_type(module, "Error",
                "Base of the errors of celltrace. file, line and column say where a scene's text is\n"
                "wrong, and findings what else was found; elsewhere they are None and empty.",
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
      raise(error);
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

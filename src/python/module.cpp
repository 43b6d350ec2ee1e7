// The Python module celltrace._celltrace, whose names the package celltrace exports.
#include "python/bindings.hpp"

#include "celltrace/version.hpp"

PYBIND11_MODULE(_celltrace, module) {
  pybind11::options options;
  options.disable_function_signatures(); // docstrings have signatures that inspect.signature() can read
  module.doc() = "Ray-traces POV-Ray scenes.";
  module.attr("__version__") = celltrace::version();
  celltrace::bind_errors(module);
  celltrace::bind_mesh(module);
  celltrace::bind_geometry(module);
  celltrace::bind_surfaces(module);
  celltrace::bind_scene(module);
  celltrace::bind_rendering(module);
  celltrace::bind_pictures(module);

  // Users know the names as those of the package.
  pybind11::list names;
  for (const auto& [name, value] : module.attr("__dict__").cast<pybind11::dict>()) {
    if (name.cast<std::string>().front() == '_') continue;
    names.append(name);
    pybind11::setattr(value, "__module__", pybind11::str("celltrace"));
  }
  names.append("__version__");
  module.attr("__all__") = names;
}

// The programming models, and options to render with them.
#pragma once

#include "render/backends.hpp"

namespace celltrace::test {

struct NamedModel {
  const char* name;
  Model model;
};
constexpr NamedModel kModels[] = {
    {"pipeline", Model::pipeline}, {"split pipeline", Model::pipeline_split}, {"offload", Model::offload}};

/// By the grid, as every model can.
inline RenderOptions model_options(Model model, Backend backend, unsigned spes, int width, int height) {
  RenderOptions options;
  options.model = model;
  options.backend = backend;
  options.spes = spes;
  options.width = width;
  options.height = height;
  options.accelerator = Accelerator::grid;
  return options;
}

} // namespace celltrace::test

// celltrace's native machine, through the library's public API.
#pragma once

#include "celltrace/render.hpp"
#include "side.hpp"

namespace celltrace::compare {

class CelltraceSide : public Side {
public:
  /// Square pictures of `size` pixels a side.
  CelltraceSide(int size, unsigned threads);

  void take(const Model& model) override;
  Frame build_and_trace() override;
  /// As build_and_trace(), where only vertices and centres are elsewhere than in the model before.
  Frame refit_and_trace();
  Frame trace() override;
  const Image& picture() const override { return result_.image; }
  std::uint64_t accelerator_bytes() const override { return accelerator_bytes_; }

private:
  template <class... Input> Frame render(const Input&... input);

  Renderer renderer_;
  Scene scene_;
  RenderResult result_;
  std::uint64_t accelerator_bytes_ = 0;
};

} // namespace celltrace::compare

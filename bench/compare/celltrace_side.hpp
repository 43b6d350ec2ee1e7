// celltrace's native machine, through the library's public API.
#pragma once

#include "celltrace/render.hpp"
#include "query_side.hpp"
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
  RayQueries queries() const { return renderer_.ray_queries(); }
  const Image& picture() const override { return result_.image; }
  std::uint64_t accelerator_bytes() const override { return accelerator_bytes_; }

private:
  template <class... Input> Frame render(const Input&... input);

  Renderer renderer_;
  Scene scene_;
  RenderResult result_;
  std::uint64_t accelerator_bytes_ = 0;
};

/// RayQueries of a renderer, by single rays or by the stream.
class CelltraceQueries : public QuerySide {
public:
  enum class Kind { single, stream };
  CelltraceQueries(const Model& model, Kind kind);
  void closest_hits(std::span<const Ray> rays, std::span<float> distances) override;

private:
  CelltraceSide side_;
  RayQueries queries_;
  Kind kind_;
  std::vector<RayHit> hits_;
};

} // namespace celltrace::compare

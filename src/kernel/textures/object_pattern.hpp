// The object pattern: tests points against an object. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/modules.hpp"
#include "kernel/primitives/list.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/pattern_traits.hpp"

namespace celltrace::kernel {

/// The table is a CsgRecord without skipped steps, whose program decides which points are in the object.
struct ObjectPattern : RarePattern {
  static constexpr const char* kName = "object";
  static constexpr bool kIsList = true;

  /// Returns the points inside a solid, as module_shapes::inside() does. This copy is in the module of rare
  /// patterns, which shares its region with that of shapes.
  template <class Spu>
  CELLTRACE_ONE_COPY [[gnu::flatten]] static uint32_t lanes_in(Spu& spu, const SolidRecord& solid,
                                                               const V3<typename Spu::rare_simd>& points) {
    using S = typename Spu::rare_simd;
    spu.run_in_module(modules::kRarePatterns);
    const uint32_t kind = solid.object.kind_and_flags & object_flag::kind_mask;
    if (kind == kPrimitiveKind<SpherePrimitive>)
      return SpherePrimitive::inside<S>(points, solid.object, solid.extra).bits();
    const V3<S> local = to_local<S>(solid.object.geometry, points, 1.0f);
    const LocalParameters<S> parameters = local_parameters<S>(solid.object, solid.extra);
    uint32_t lanes = 0;
    Primitives::dispatch(kind, [&](auto shape) {
      using Shape = decltype(shape);
      if constexpr (Shape::kIsLocal) lanes = Shape::template inside_local<S>(local, parameters).bits();
    });
    return lanes;
  }

  /// Runs the program; each lane has its own place in it, which only advances.
  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    using S = typename Spu::rare_simd;
    using I = typename S::I;
    const auto word = [](uint32_t value) { return I::splat(static_cast<int32_t>(value)); };
    Kept<Spu, CsgRecord> program = *scene.csg(r.table);
    I place = word(0);
    for (uint32_t i = 0; i < program.count; ++i) {
      const uint32_t here = (place == word(i)).bits();
      if (here == 0) continue;
      Kept<Spu, CsgStep> step = *scene.csg_step(program.steps + i * static_cast<uint32_t>(sizeof(CsgStep)));
      const SolidRecord& solid = *scene.solid(step.solid);
      const uint32_t inside = lanes_in(scene.spu(), solid, p);
      place = S::select(S::M::from_bits(here & inside), word(step.if_inside), place);
      place = S::select(S::M::from_bits(here & ~inside), word(step.if_outside), place);
    }
    return S::select(place == word(kCsgAccept), typename S::F(1.0f), typename S::F(0.0f));
  }
};

} // namespace celltrace::kernel

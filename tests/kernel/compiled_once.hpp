// What tests of kernels instantiate most, and compile longest: for all of them in compiled_once.cpp.
#pragma once

#include "direct_spu.hpp"
#include "kernel/accel/traversal.hpp"
#include "kernel/textures/pattern_value.hpp"

namespace celltrace::kernel {

extern template class ObjectTests<test::DirectSpu>;
extern template class PacketTraversal<test::DirectSpu>;
extern template class BvhTraversal<test::DirectSpu>;
extern template class Traversal<test::DirectSpu>;

extern template test::DirectSpu::rare_simd::F pattern_value(SceneAccess<test::DirectSpu>&,
                                                            const PatternRecord&,
                                                            const PatternPoints<test::DirectSpu::rare_simd>&);

} // namespace celltrace::kernel

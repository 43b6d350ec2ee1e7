#include "compiled_once.hpp"

namespace celltrace::kernel {

template class ObjectTests<test::DirectSpu>;
template class PacketTraversal<test::DirectSpu>;
template class BvhTraversal<test::DirectSpu>;
template class Traversal<test::DirectSpu>;

template test::DirectSpu::rare_simd::F pattern_value(SceneAccess<test::DirectSpu>&, const PatternRecord&,
                                                     const PatternPoints<test::DirectSpu::rare_simd>&);

} // namespace celltrace::kernel

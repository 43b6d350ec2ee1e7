// The cache's replay and the balancer, without a tracer.
#include <celltrace/balance.hpp>
#include <celltrace/cache.hpp>
#include <celltrace/cache/replay.hpp>

#include <cstdio>

int main() {
  celltrace::CacheTrace trace;
  const auto result = celltrace::replay(trace, celltrace::CacheConfig{});
  const auto graph = celltrace::chain_graph(4);
  std::printf("hit rate %g, degree %u\n", result.hit_rate(), graph.degree());
  return graph.degree() == 2 ? 0 : 1;
}

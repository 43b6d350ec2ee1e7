// Sweeps of generalized dimension exchange by SPEs, each a node with a load: on every SPU type, and as
// machine code, they leave the loads that the sequential sweeps leave.
#include "load_sweeps.hpp"
#include "spe/machine_kinds.hpp"

#include "celltrace/balance.hpp"
#include "celltrace/spe/shared_records.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace celltrace {

SpeProgram load_sweeps_program();

namespace test {

FieldList<&PartnerRecord::partner> fields_of(const PartnerRecord&);
FieldList<&LoadRecord::load, &LoadRecord::unused> fields_of(const LoadRecord&);
FieldList<&SweepTask::partners, &SweepTask::loads, &SweepTask::colours, &SweepTask::sweeps,
          &SweepTask::exchange_parameter, &SweepTask::unused>
fields_of(const SweepTask&);

} // namespace test
} // namespace celltrace

using namespace celltrace;
using namespace celltrace::test;

namespace {

using Loads = std::vector<std::int64_t>;

struct Case {
  std::string name;
  SystemGraph graph;
  double lambda;
};
std::vector<Case> cases() {
  const auto box = [](std::vector<std::uint32_t> sides, bool torus) {
    return torus ? torus_graph(sides) : mesh_graph(sides);
  };
  return {{"chain of 1", chain_graph(1), 0.5},
          {"chain of 2", chain_graph(2), 0.5},
          {"chain of 8", chain_graph(8), optimal_chain_parameter(8)},
          {"ring of 5", ring_graph(5), 0.6},
          {"ring of 8", ring_graph(8), optimal_ring_parameter(8)},
          {"mesh 2x4", box({2, 4}, false), 0.3},
          {"torus 2x4", box({2, 4}, true), 0.6},
          {"hypercube 3", hypercube_graph(3), optimal_hypercube_parameter()},
          {"complete graph of 4", complete_graph(4), 0.4}};
}

Loads random_loads(std::uint32_t nodes) {
  std::mt19937 random(nodes);
  Loads loads(nodes);
  for (std::int64_t& load : loads)
    load = static_cast<std::int64_t>(random() % 3 == 0 ? random() % (1u << kLoadBits) : random() % 100);
  return loads;
}

struct Swept {
  std::vector<Loads> loads; ///< after each sweep
  ProgramRun run;
};

Swept sweep(const MachineKind& kind, const SystemGraph& graph, const Loads& loads, std::uint32_t parameter,
            std::uint32_t sweeps) {
  const std::unique_ptr<Machine> machine = kind.machine(graph.nodes);
  const std::endian order = machine->byte_order();
  SharedRecords<PartnerRecord> partners(graph.nodes, order);
  for (PartnerRecord& node : partners.all())
    std::fill(std::begin(node.partner), std::end(node.partner), kNoPartner);
  for (const SystemGraph::Edge& edge : graph.edges) {
    partners[edge.a].partner[edge.colour] = edge.b;
    partners[edge.b].partner[edge.colour] = edge.a;
  }
  partners.publish();
  SharedRecords<LoadRecord> records((sweeps + 1) * graph.nodes, order);
  for (std::uint32_t node = 0; node < graph.nodes; ++node)
    records[node].load = static_cast<std::uint32_t>(loads[node]);
  records.publish();
  SharedRecords<SweepTask> task(1, order);
  task[0] = {partners.ea(), records.ea(), graph.colours, sweeps, parameter, 0};
  task.publish();

  Swept swept;
  swept.run = run_program(*machine, load_sweeps_program(), task.ea());
  records.fetch();
  for (std::uint32_t sweep = 1; sweep <= sweeps; ++sweep) {
    swept.loads.emplace_back();
    for (std::uint32_t node = 0; node < graph.nodes; ++node)
      swept.loads.back().push_back(records[sweep * graph.nodes + node].load);
  }
  return swept;
}

} // namespace

TEST_CASE("loads are the same after every sweep as those of the sequential sweeps") {
  const auto kind = GENERATE(from_range(kinds_for(load_sweeps_program())));
  constexpr std::uint32_t kSweeps = 12;
  for (const Case& each : cases()) {
    CAPTURE(kind, each.name);
    REQUIRE(each.graph.degree() < kInboundMailboxEntries);
    const std::uint32_t parameter = fixed_point_parameter(each.lambda);
    Loads loads = random_loads(each.graph.nodes);
    const Swept swept = sweep(kind, each.graph, loads, parameter, kSweeps);
    check_clean(swept.run);
    for (const Loads& after : swept.loads) {
      gde_sweep(each.graph, loads, parameter / 65536.0);
      CHECK(after == loads);
    }
    std::vector<std::uint64_t> degrees(each.graph.nodes);
    for (const SystemGraph::Edge& edge : each.graph.edges) {
      ++degrees[edge.a];
      ++degrees[edge.b];
    }
    for (std::uint32_t node = 0; node < each.graph.nodes; ++node)
      CHECK(swept.run.spes[node].mailbox_words_sent == kSweeps * degrees[node]);
  }
}

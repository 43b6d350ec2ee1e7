// When instructions issue: the rules of issue_model.hpp, one by one.
#include "backends/cell_emu/simulator/issue_model.hpp"
#include "simulator/machine_code.hpp"

#include <catch2/catch.hpp>

using namespace celltrace;
using namespace celltrace::test;
using cell_emu::IssueModel;

namespace {

/// Issues instructions one after the other from an address on.
class Stream {
public:
  explicit Stream(std::uint32_t pc = 8) : model(TimingParameters()), pc_(pc) {}

  Stream& operator()(std::string_view mnemonic, const Fields& fields = {}) {
    model.issue(isa::decode(encode(mnemonic, fields)), pc_);
    pc_ += 4;
    return *this;
  }
  std::uint32_t pc() const { return pc_; }
  void branch(std::uint32_t to) {
    (*this)("br");
    model.branched(pc_ - 4, to, true);
    pc_ = to;
  }
  SpuCycles take() { return model.take(); }

  IssueModel model;

private:
  std::uint32_t pc_;
};

std::uint64_t parts_of(const SpuCycles& c) {
  return c.single_cycle + c.dual_cycle + c.nop_cycle + c.stall_due_to_dependency +
         c.stall_due_to_branch_miss + c.stall_due_to_prefetch_miss + c.stall_due_to_hint_target +
         c.stall_due_to_fp_resource + c.stall_due_to_ls_contention;
}

} // namespace

TEST_CASE("issue: a fetch group issues together, even pipe first") {
  Stream stream;
  stream("a", {.rt = 10, .ra = 1, .rb = 2})("lqd", {.rt = 11, .ra = 3});
  const SpuCycles together = stream.take();
  CHECK(together.dual_cycle == 1);
  CHECK(together.total_cycle == 1);
  stream("lqd", {.rt = 12, .ra = 3})("a", {.rt = 13, .ra = 1, .rb = 2});
  CHECK(stream.take().single_cycle == 2); // the wrong way round
  Stream odd(12);
  odd("a", {.rt = 10, .ra = 1, .rb = 2})("lqd", {.rt = 11, .ra = 3});
  CHECK(odd.take().dual_cycle == 0); // of two groups
}

TEST_CASE("issue: nothing of a group passes what waits for an operand") {
  Stream stream;
  stream("lqd", {.rt = 10, .ra = 3});
  stream("lnop");
  stream("a", {.rt = 11, .ra = 10, .rb = 2})("lqd", {.rt = 12, .ra = 3});
  const SpuCycles cycles = stream.take();
  CHECK(cycles.stall_due_to_dependency == 4); // six cycles of latency, two of them used
  CHECK(cycles.dependency_ls == 4);
  CHECK(cycles.dual_cycle == 1);
  CHECK(cycles.total_cycle == parts_of(cycles));
}

TEST_CASE("issue: latencies by unit") {
  const auto latency = [](std::string_view producer, const Fields& fields) {
    Stream stream(12);
    stream(producer, fields);
    stream.take();
    stream("a", {.rt = 50, .ra = 10, .rb = 10});
    return stream.take().total_cycle;
  };
  CHECK(latency("a", {.rt = 10, .ra = 1, .rb = 2}) == 2);
  CHECK(latency("shli", {.rt = 10, .ra = 1, .immediate = 2}) == 4);
  CHECK(latency("cntb", {.rt = 10, .ra = 1}) == 4);
  CHECK(latency("fa", {.rt = 10, .ra = 1, .rb = 2}) == 6);
  CHECK(latency("mpy", {.rt = 10, .ra = 1, .rb = 2}) == 7);
  CHECK(latency("dfa", {.rt = 10, .ra = 1, .rb = 2}) == 13);
  CHECK(latency("lqd", {.rt = 10, .ra = 1}) == 6);
  CHECK(latency("shufb", {.rt = 10, .ra = 1, .rb = 2, .rc = 3}) == 4);
  CHECK(latency("rdch", {.rt = 10, .ra = 24}) == 6);
}

TEST_CASE("issue: double precision keeps both pipes") {
  Stream stream;
  stream("dfa", {.rt = 10, .ra = 1, .rb = 2})("lqd", {.rt = 11, .ra = 3});
  stream.take();
  stream("a", {.rt = 12, .ra = 1, .rb = 2});
  CHECK(stream.take().stall_due_to_fp_resource == 6);
}

TEST_CASE("issue: branches that nothing foretells") {
  Stream stream;
  stream.branch(0x400);
  const SpuCycles cycles = stream.take();
  CHECK(cycles.stall_due_to_branch_miss == 18);
  CHECK(cycles.branch_taken_miss == 1);
  CHECK(cycles.branch_taken == 1);
  stream("br");
  stream.model.branched(stream.pc() - 4, stream.pc(), false);
  CHECK(stream.take().stall_due_to_branch_miss == 0); // falls through
}

TEST_CASE("issue: hints, early, late and too late") {
  const auto hinted = [](unsigned instructions, std::uint32_t target) {
    Stream stream(0);
    stream("hbrr");
    stream.model.hint(4 + 4 * instructions, target);
    for (unsigned i = 0; i < instructions; ++i)
      stream("a", {.rt = 10 + i, .ra = 1, .rb = 2});
    stream.branch(0x400);
    return stream.take();
  };
  const SpuCycles early = hinted(20, 0x400);
  CHECK(early.hint_hit == 1);
  CHECK(early.stall_due_to_branch_miss == 0);
  CHECK(early.stall_due_to_hint_target == 0);
  const SpuCycles late = hinted(9, 0x400);
  CHECK(late.hint_hit == 1);
  CHECK(late.stall_due_to_hint_target == 5); // fifteen cycles from the hint, ten have passed
  const SpuCycles too_late = hinted(6, 0x400);
  CHECK(too_late.hint_hit == 0);
  CHECK(too_late.stall_due_to_branch_miss == 18);
  const SpuCycles elsewhere = hinted(20, 0x800);
  CHECK(elsewhere.hint_hit == 0);
  CHECK(elsewhere.branch_taken_miss == 1);
}

TEST_CASE("issue: loads in every cycle keep instructions from being fetched") {
  const auto fetch_stalls = [](bool room) {
    Stream stream(0);
    for (unsigned i = 0; i < 64; ++i)
      stream(room && i % 8 == 0 ? "hbr" : "lqd", {.rt = 10 + i, .ra = 3});
    return stream.take().stall_due_to_prefetch_miss;
  };
  CHECK(fetch_stalls(false) == 9);
  CHECK(fetch_stalls(true) == 0);
}

TEST_CASE("issue: DMA takes the port of the local store from loads and stores") {
  Stream stream(0);
  for (unsigned i = 0; i < 20; ++i)
    stream(i % 2 == 0 ? "lqd" : "hbr", {.rt = 10 + i, .ra = 3});
  stream.model.contend(4);
  const SpuCycles cycles = stream.take();
  CHECK(cycles.stall_due_to_ls_contention == 2); // every second cycle has a load
  CHECK(cycles.total_cycle == parts_of(cycles));
}

// The tracer with caches that watch over their pointers: it uses none too late. This test program brings a
// tracer_program() of its own, which the renderer starts in place of the usual one.
#include "backends/native/spu.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/emulated_spu.hpp"
#include "kernel/entry/tracer.hpp"
#include "render/scenes.hpp"
#include "render/tracer_program.hpp"

#include <catch2/catch.hpp>

#include <atomic>

namespace celltrace {

// Of the usual program: where the PPE's side builds the accelerator.
void CELLTRACE_HOST_TRACER(void* spu, ea_t argument);

namespace {

/// cell_emu's SPU, with other options for the caches of its kernels.
class CheckedSpu : public SpuBase<CheckedSpu> {
public:
  using cache_options = CheckedCacheOptions;
  using simd = cell_emu::Spu::simd;
  using rare_simd = simd;
  static constexpr bool direct_memory = cell_emu::Spu::direct_memory;

  explicit CheckedSpu(cell_emu::Spu& spu) : spu_(spu) { initialise_base(); }

  std::uint32_t id() const { return spu_.id(); }
  std::uint32_t count() const { return spu_.count(); }
  SpeAddresses addresses(std::uint32_t spe) const { return spu_.addresses(spe); }
  ArenaState& arena() { return spu_.arena(); }
  [[noreturn]] void halt(HaltCode code) { spu_.halt(code); }
  template <std::uint32_t code> void stop() { spu_.stop<code>(); }

  template <Channel c> std::uint32_t read_channel() { return spu_.read_channel<c>(); }
  template <Channel c> void write_channel(std::uint32_t value) { spu_.write_channel<c>(value); }
  template <Channel c> std::uint32_t channel_count() { return spu_.channel_count<c>(); }
  template <MfcOpcode op> void mfc_command(void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag) {
    spu_.mfc_command<op>(ls, ea, size, tag);
  }
  template <MfcOpcode op>
  void mfc_list_command(void* ls, ea_t ea, const ListElement* list, std::uint32_t bytes, std::uint32_t tag) {
    spu_.mfc_list_command<op>(ls, ea, list, bytes, tag);
  }

  void compute(const ScalarWork& work) { spu_.compute(work); }
  void note(const char* what, std::uint32_t value) { spu_.note(what, value); }
  void at(CallSite site) { spu_.at(site); }

private:
  cell_emu::Spu& spu_;
};

std::atomic<bool> checked = false;
std::atomic<unsigned> checked_runs = 0;

} // namespace

namespace {

/// `kernel(spu, argument)` on a watched or on a plain SPU.
template <class Kernel> SpeProgram watched_program(const char* name, Kernel kernel) {
  SpeProgram program(name);
  program.add(native::Spu<BaselineArch>::kKey, CELLTRACE_HOST_TRACER);
  program.add(cell_emu::Spu::kKey, [kernel](void* spu, ea_t argument) {
    cell_emu::Spu& real = *static_cast<cell_emu::Spu*>(spu);
    if (checked) {
      ++checked_runs;
      CheckedSpu watched(real);
      kernel(watched, argument);
    } else {
      kernel(real, argument);
    }
  });
  return program;
}

} // namespace

SpeProgram tracer_program() {
  return watched_program("tracer", [](auto& spu, ea_t argument) { kernel::tracer(spu, argument); });
}
SpeProgram grid_tracer_program() {
  return watched_program("grid_tracer", [](auto& spu, ea_t argument) { kernel::grid_tracer(spu, argument); });
}

} // namespace celltrace

using namespace celltrace;
using namespace celltrace::test;

TEST_CASE("the tracer uses no pointer into its cache too late") {
  RenderOptions options;
  options.width = 32;
  options.height = 24;
  options.backend = Backend::cell_emu;
  options.spes = 2;
  options.emulation.schedule = Schedule::lockstep;
  options.accelerator = GENERATE(Accelerator::grid, Accelerator::bvh);
  options.cache.sets = GENERATE(1u, 128u);
  for (const NamedScene& named : scenes()) {
    CAPTURE(named.name, options.accelerator, options.cache.sets);
    checked = false;
    const Image expected = render(named.make(), options).image;
    checked = true;
    const unsigned before = checked_runs;
    CHECK(render(named.make(), options).image == expected);
    CHECK(checked_runs == before + options.spes);
  }
}

#include "backends/cell_emu/machine.hpp"
#include "backends/native/machine.hpp"
#include "celltrace/spe/machine.hpp"

namespace celltrace {

std::unique_ptr<Machine> make_machine(const MachineConfig& config) {
  switch (config.backend) {
  case Backend::native:
    return native::make_machine(config);
  case Backend::cell_emu:
  case Backend::cell_sim:
    return cell_emu::make_machine(config);
  }
  throw InputError("MachineConfig::backend: unknown backend " +
                   std::to_string(static_cast<int>(config.backend)));
}

} // namespace celltrace

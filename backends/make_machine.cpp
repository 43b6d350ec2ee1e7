#include "backends/cell_emu/machine.hpp"
#include "backends/native/machine.hpp"
#include "celltrace/spe/machine.hpp"

namespace celltrace {

namespace {

struct Backend {
  const char* name;
  std::unique_ptr<Machine> (*make)(const MachineConfig& config);
};

constexpr Backend kBackends[] = {
    {"native", native::make_machine},
    {"cell_emu", cell_emu::make_machine},
    {"cell_sim", cell_emu::make_machine},
};

std::string names() {
  std::string list;
  for (const Backend& backend : kBackends)
    list += (list.empty() ? "" : ", ") + std::string(backend.name);
  return list;
}

} // namespace

std::vector<std::string> machine_backends() {
  std::vector<std::string> backends;
  for (const Backend& backend : kBackends)
    backends.emplace_back(backend.name);
  return backends;
}

std::unique_ptr<Machine> make_machine(const MachineConfig& config) {
  for (const Backend& backend : kBackends)
    if (config.backend == backend.name) return backend.make(config);
  throw InputError("unknown backend \"" + config.backend + "\"; this build has " + names());
}

} // namespace celltrace

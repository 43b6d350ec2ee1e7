// OpenedLocalStore permits the emulator's own accesses to local store that is forbidden to the program.
#pragma once

#include "backends/cell_emu/mfc.hpp"

namespace celltrace::cell_emu {

/// Permits accesses to a transfer's part of local store until this object is destroyed.
class Mfc::OpenedLocalStore {
public:
  OpenedLocalStore(const Mfc& mfc, const MfcCommand& transfer);
  ~OpenedLocalStore();
  OpenedLocalStore(const OpenedLocalStore&) = delete;
  OpenedLocalStore& operator=(const OpenedLocalStore&) = delete;

private:
  template <class Do> void for_each(Do action) const;

  const Mfc& mfc_;
  std::uint32_t begin_, end_;
};

} // namespace celltrace::cell_emu

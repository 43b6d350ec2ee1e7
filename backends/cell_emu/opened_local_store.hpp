// Opens a part of local store for the emulator itself while the program's accesses are forbidden.
#pragma once

#include "backends/cell_emu/mfc.hpp"

namespace celltrace::cell_emu {

/// Opens the target of a transfer until this is destroyed.
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

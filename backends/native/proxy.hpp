// Proxy commands: DMA commands that the PPE issues to an SPE's memory flow controller.
#pragma once

#include "backends/native/registers.hpp"
#include "backends/native/reservations.hpp"
#include "backends/native/spe.hpp"

namespace celltrace::native {

/// Runs a proxy command. The command is complete when the call returns, so that fences and barriers have no
/// effect and every tag group is always complete. `lsa` is an offset in the SPE's arena. Sizes, alignments
/// and effective addresses are not checked. Throws SpeError for an opcode that is no proxy command's, a tag
/// above 15, and a range outside of the arena.
void run_proxy_command(const Spe& spe, const RegisterMap& registers, Reservations& reservations,
                       MfcOpcode opcode, std::uint32_t lsa, ea_t ea, std::uint32_t size, std::uint32_t tag);

} // namespace celltrace::native

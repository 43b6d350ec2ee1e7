// The PPE's side of an SPE's memory flow controller: commands run at the call.
#pragma once

#include "backends/native/registers.hpp"
#include "backends/native/reservations.hpp"
#include "backends/native/spe.hpp"

namespace celltrace::native {

/// Runs a command of the proxy queue; it is complete when the call returns, so that fences and barriers have
/// nothing to do and every tag group is always complete. `lsa` counts from the beginning of the SPE's arena.
/// Sizes, alignments and effective addresses are not checked, as for the SPE's own commands. Throws SpeError
/// for an opcode that is not a proxy's, a tag above 15 and a range outside the arena.
void run_proxy_command(const Spe& spe, const RegisterMap& registers, Reservations& reservations,
                       MfcOpcode opcode, std::uint32_t lsa, ea_t ea, std::uint32_t size, std::uint32_t tag);

} // namespace celltrace::native

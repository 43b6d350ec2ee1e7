// execute() computes SPU instructions on the host, with exactly the SPU's results. The intrinsics of
// spu_specific.hpp and spu_generic.hpp call it.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/spe/quadword.hpp"

#include <cstdint>

namespace celltrace::isa {

/// All instructions, named as in assembly, in the order of opcodes.def. Names that are words of C++ end in an
/// underscore.
enum class Opcode : std::uint8_t {
#define SPU_OPCODE(name, mnemonic, format, code, unit, syntax, operands) name,
#include "celltrace/spe/opcodes.def"
#undef SPU_OPCODE
};

} // namespace celltrace::isa

namespace celltrace::sdk {

using isa::Opcode;
using isa::Quadword;

/// Returns the value of register rt after the instruction; `a` and `b` are ra and rb; `c` is rc, or the old
/// value of rt if the instruction reads rt. `immediate` is the number as in assembly; for conversions the
/// scale 0..127. Throws InputError for loads, stores, branches and channels.
///
/// If an SPE program runs on this thread, the instruction uses the program's floating-point status and
/// advances its virtual time, and a halt instruction ends the program (Rule::halted). Otherwise every thread
/// has a floating-point status of its own, and a halt throws SpeError. Thread-safe.
CELLTRACE_EXPORT Quadword execute(Opcode opcode, const Quadword& a, const Quadword& b, const Quadword& c,
                                  std::int32_t immediate);

/// Returns a pointer to the 16 bytes of the running SPE's local store at an address, whose low four bits and
/// bits beyond 256 KB are ignored. Throws SpeError if no SPE program runs.
CELLTRACE_EXPORT void* local_quadword(std::uint32_t lsa);

} // namespace celltrace::sdk

// The SPU's instructions as functions of the host: what they compute, exactly as on the SPU. The intrinsics
// of spu_specific.hpp and spu_generic.hpp are made of them.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/spe/quadword.hpp"

#include <cstdint>

namespace celltrace::isa {

/// Every instruction, named as in assembly, in the order of opcodes.def; with an underscore behind the words
/// of C++.
enum class Opcode : std::uint8_t {
#define SPU_OPCODE(name, mnemonic, format, code, unit, syntax, operands) name,
#include "celltrace/spe/opcodes.def"
#undef SPU_OPCODE
};

} // namespace celltrace::isa

namespace celltrace::sdk {

using isa::Opcode;
using isa::Quadword;

/// What register rt holds after the instruction; `c` is rc, or rt before where the instruction reads that.
/// `immediate` is the number that assembly has, of conversions the scale 0..127. Not for loads, stores,
/// branches and channels: InputError.
///
/// Where an SPE program runs on this thread, its floating-point status is used, its virtual time goes on, and
/// a halt ends it (Rule::halted). Elsewhere every thread has a status of its own, and a halt throws SpeError.
/// Thread-safe.
CELLTRACE_EXPORT Quadword execute(Opcode opcode, const Quadword& a, const Quadword& b, const Quadword& c,
                                  std::int32_t immediate);

/// The 16 bytes of the running SPE's local store at an address, of which the low four bits and those beyond
/// 256 KB do not count. Throws SpeError where no SPE program runs.
CELLTRACE_EXPORT void* local_quadword(std::uint32_t lsa);

} // namespace celltrace::sdk

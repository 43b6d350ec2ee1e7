#include "backends/native/proxy.hpp"

#include "celltrace/error.hpp"

#include <cstring>
#include <string>

namespace celltrace::native {

namespace {

constexpr std::uint32_t kProxyTags = 16; ///< the other tags are the operating system's

bool is_plain_get(MfcOpcode opcode) {
  return opcode == MfcOpcode::get || opcode == MfcOpcode::getb || opcode == MfcOpcode::getf;
}
bool is_plain_put(MfcOpcode opcode) {
  return opcode == MfcOpcode::put || opcode == MfcOpcode::putb || opcode == MfcOpcode::putf;
}

void check(MfcOpcode opcode, std::uint32_t lsa, std::uint32_t size, std::uint32_t tag) {
  if (!is_plain_get(opcode) && !is_plain_put(opcode))
    throw SpeError("a proxy command is a get or a put without a list");
  if (tag >= kProxyTags) throw SpeError("the tag of a proxy command is 0..15, not " + std::to_string(tag));
  if (lsa > kArenaBytes || size > kArenaBytes - lsa)
    throw SpeError("a proxy command leaves local store: " + std::to_string(size) + " bytes at " +
                   std::to_string(lsa));
}

} // namespace

void run_proxy_command(const Spe& spe, const RegisterMap& registers, Reservations& reservations,
                       MfcOpcode opcode, std::uint32_t lsa, ea_t ea, std::uint32_t size, std::uint32_t tag) {
  check(opcode, lsa, size, tag);
  std::uint8_t* const ls = spe.arena.begin + lsa;
  if (is_plain_get(opcode)) {
    std::memmove(ls, reinterpret_cast<const void*>(static_cast<std::uintptr_t>(ea)), size);
  } else if (registers.contains(ea)) {
    registers.write(ea, ls, size);
  } else {
    reservations.put(spe.id, ls, ea, size);
  }
}

} // namespace celltrace::native

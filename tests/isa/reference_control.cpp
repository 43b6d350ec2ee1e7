// Opcodes of 11 bits: loads and stores by registers, indirect branches, stops, channels, what changes
// nothing.
#include "isa/fields.hpp"
#include "isa/reference.hpp"

namespace celltrace::test {

bool Reference::execute_control(std::uint32_t word) {
  const Register a = gpr[ra_of(word)], b = gpr[rb_of(word)];
  Register& t = gpr[rt_of(word)];
  const std::uint32_t target = a.preferred();
  const std::uint32_t preferred_half = t.preferred() & 0xFFFF;
  const unsigned channel = ra_of(word);
  switch (word >> 21) {
  case 0x1C4: // lqx
    t = load(a.preferred() + b.preferred());
    return true;
  case 0x144: // stqx
    store(a.preferred() + b.preferred(), t);
    return true;

  case 0x1A8: // bi
    branch_indirect(word, target);
    return true;
  case 0x1A9: // bisl
    t = link();
    branch_indirect(word, target);
    return true;
  case 0x1AA: // iret
    branch_indirect(word, answers.srr0);
    return true;
  case 0x1AB: // bisled: the link is set whether the branch is taken or not
    t = link();
    if (answers.event) branch_indirect(word, target);
    return true;
  case 0x128: // biz
    if (t.preferred() == 0) branch_indirect(word, target);
    return true;
  case 0x129: // binz
    if (t.preferred() != 0) branch_indirect(word, target);
    return true;
  case 0x12A: // bihz
    if (preferred_half == 0) branch_indirect(word, target);
    return true;
  case 0x12B: // bihnz
    if (preferred_half != 0) branch_indirect(word, target);
    return true;

  case 0x000: // stop
    effects.push_back({Effect::stop, word & 0x3FFF});
    return true;
  case 0x140: // stopd
    effects.push_back({Effect::stop, 0x3FFF});
    return true;

  case 0x00D: // rdch
    effects.push_back({Effect::read_channel, channel});
    t = Register::of_preferred(answers.channel_value);
    return true;
  case 0x00F: // rchcnt
    effects.push_back({Effect::count_channel, channel});
    t = Register::of_preferred(answers.channel_count);
    return true;
  case 0x10D: // wrch
    effects.push_back({Effect::write_channel, channel, t.preferred()});
    return true;
  case 0x00C: // mfspr: the SPU of the Cell has no special register that it reads; others read as zero
    t = Register{};
    return true;

  case 0x001: // lnop
  case 0x002: // sync
  case 0x003: // dsync
  case 0x10C: // mtspr
  case 0x1AC: // hbr
  case 0x201: // nop
    return true;
  default:
    return false;
  }
}

} // namespace celltrace::test

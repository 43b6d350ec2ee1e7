// Conformance: the commands of the PPE to an SPE's MFC.
//
// Covers of the facts: what the proxy queue accepts (spufs_check_valid_dma), its tags, its order, its own
// eight entries, and what the PPE may do to a program's local store.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

/// A row whose SPE offers a line of local store and waits for a word; `act` is the PPE's, and gets the line's
/// address. What it leaves in stage.shared[0], if not 0, is what the SPE has to find in the line's first
/// word.
Row by_proxy(Row row, std::function<void(Machine&, Stage&, std::uint32_t)> act) {
  row.program = [](Spu& spu, Stage& stage) {
    auto* lines = spu.allocate<std::uint32_t>(64);
    for (std::uint32_t i = 0; i < 64; ++i)
      lines[i] = 100 + i;
    spu.write_out_mailbox(lsa_of(spu, lines));
    spu.read_in_mailbox();
    if (stage.shared[0] != 0) stage.is(lines[0], stage.shared[0]);
  };
  row.ppe_part = [act](Machine& machine, Stage& stage) {
    std::optional<std::uint32_t> lsa;
    while (!(lsa = machine.read_out_mailbox(0)))
      machine.wait_for_mail(std::chrono::seconds(60));
    try {
      act(machine, stage, *lsa);
    } catch (const SpeError&) {
      // It is a diagnostic, too; the SPE is to end as usual.
    }
    machine.write_in_mailbox(0, 1);
  };
  row.culprit_spe = row.is_broken ? Diagnostic::kPpe : 0;
  return row;
}

Row refused(Rule rule, const char* what, MfcOpcode opcode, std::uint32_t size, std::uint32_t tag,
            std::vector<std::string> says) {
  return by_proxy(broken(rule, what, {}, std::move(says)),
                  [=](Machine& machine, Stage& stage, std::uint32_t lsa) {
                    machine.proxy_command(0, opcode, lsa, to_ea(stage.from), size, tag);
                    stage.is(1, 0); // it throws
                  });
}

const Rows kProxy = {
    by_proxy(kept(Rule::proxy_command, "gets and puts move data both ways", {}),
             [](Machine& machine, Stage& stage, std::uint32_t lsa) {
               machine.proxy_command(0, MfcOpcode::put, lsa, to_ea(stage.to), 128, 1);
               stage.is(machine.proxy_tag_status(0, 2, TagUpdate::all), 2);
               stage.is(stage.to[31], 131);
               machine.proxy_command(0, MfcOpcode::get, lsa, to_ea(stage.from), 128, 1);
               stage.is(machine.proxy_tag_status(0, 2, TagUpdate::any), 2);
               machine.proxy_command(0, MfcOpcode::putr, lsa, to_ea(stage.to), 128, 1);
               machine.proxy_tag_status(0, 2, TagUpdate::all);
               stage.is(stage.to[31], 32);
               stage.shared[0] = 1; // what the SPE is to find
             }),
    by_proxy(kept(Rule::proxy_command, "fences and barriers order them by tag", {}),
             [](Machine& machine, Stage& stage, std::uint32_t lsa) {
               machine.proxy_command(0, MfcOpcode::get, lsa, to_ea(stage.from), 128, 1);
               machine.proxy_command(0, MfcOpcode::putf, lsa, to_ea(stage.to), 128, 1);
               machine.proxy_command(0, MfcOpcode::getb, lsa, to_ea(stage.from + 32), 128, 1);
               machine.proxy_command(0, MfcOpcode::putf, lsa, to_ea(stage.to + 32), 128, 1);
               machine.proxy_tag_status(0, 2, TagUpdate::all);
               stage.is(stage.to[0] * 100 + stage.to[32], 133);
             }),
    refused(Rule::proxy_command, "a list is none", MfcOpcode::getl, 8, 1, {"PPE: getl of 8 bytes"}),
    refused(Rule::proxy_command, "nor is a signal", MfcOpcode::sndsig, 4, 1, {"PPE: sndsig 4 bytes"}),
    refused(Rule::proxy_command, "nor a lock line", MfcOpcode::getllar, 128, 1, {"PPE: getllar 128 bytes"}),
    refused(Rule::proxy_command, "nor a barrier", MfcOpcode::barrier, 0, 1, {"PPE: barrier"}),
    by_proxy(kept(Rule::proxy_tag_range, "tags 0 to 15 are the program's", {}),
             [](Machine& machine, Stage& stage, std::uint32_t lsa) {
               for (std::uint32_t tag = 0; tag < 16; ++tag)
                 machine.proxy_command(0, MfcOpcode::put, lsa, to_ea(stage.to + 32 * tag), 128, tag);
               stage.is(machine.proxy_tag_status(0, 0xFFFF, TagUpdate::all), 0xFFFF);
               stage.is(stage.to[32 * 15], 100);
             }),
    refused(Rule::proxy_tag_range, "tag 16 is the system's", MfcOpcode::get, 128, 16,
            {"get 128 bytes", "tag 16"}),
    refused(Rule::transfer_size, "the rules of transfers hold", MfcOpcode::get, 20, 1, {"get 20 bytes"}),
    refused(Rule::tag_range, "there is no tag 32", MfcOpcode::get, 128, 32, {"tag 32"}),
    by_proxy(broken(Rule::program_overwritten, "a get into the program's code hits it", {}),
             [](Machine& machine, Stage& stage, std::uint32_t) {
               machine.proxy_command(0, MfcOpcode::get, 0x100, to_ea(stage.from), 128, 1);
             }),
    by_proxy(fact("the ninth command waits for room in the queue of eight", {}),
             [](Machine& machine, Stage& stage, std::uint32_t lsa) {
               for (std::uint32_t i = 0; i < 40; ++i)
                 machine.proxy_command(0, MfcOpcode::put, lsa, to_ea(stage.to + 32 * i), 128, 3);
               stage.is(machine.proxy_tag_status(0, 1u << 3, TagUpdate::all), 1u << 3);
               stage.is(stage.to[32 * 39], 100);
             }),
    by_proxy(fact("the status of tags without commands is complete", {}),
             [](Machine& machine, Stage& stage, std::uint32_t) {
               stage.is(machine.proxy_tag_status(0, 0xF0, TagUpdate::immediate), 0xF0);
               stage.is(machine.proxy_tag_status(0, 0, TagUpdate::all), 0);
             }),
    by_proxy(broken(Rule::local_store_race, "two gets of one place race", {},
                    {"PPE: get 128 bytes", "meets command"}),
             [](Machine& machine, Stage& stage, std::uint32_t lsa) {
               machine.proxy_command(0, MfcOpcode::get, lsa, to_ea(stage.from), 128, 1);
               machine.proxy_command(0, MfcOpcode::get, lsa, to_ea(stage.from + 32), 128, 2);
             })
        .lockstep_only(),
    broken(Rule::local_store_race, "the PPE must not take what the SPE is still to get",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             spu.get(line, to_ea(stage.from), 128, 1);
             spu.write_out_mailbox(lsa_of(spu, line));
             spu.read_in_mailbox();
             spu.wait_all(2);
           },
           {"PPE: put 128 bytes", "meets command 1 of SPE 0 (get 128 bytes", "emu_conformance_proxy.cpp:"})
        .by(Diagnostic::kPpe)
        .ppe([](Machine& machine, Stage& stage) {
          std::optional<std::uint32_t> lsa;
          while (!(lsa = machine.read_out_mailbox(0)))
            machine.wait_for_mail(std::chrono::seconds(60));
          try {
            machine.proxy_command(0, MfcOpcode::put, *lsa, to_ea(stage.to), 128, 1);
          } catch (const SpeError&) {
            // It is a diagnostic, too.
          }
          machine.write_in_mailbox(0, 1);
        })
        .lockstep_only(),
};

TEST_CASE("conformance: proxy commands") {
  run_rows(kProxy);
}

} // namespace
} // namespace celltrace::test

// The SDK's names: every one does what the operation behind it does, on the SPE that runs.
#include "celltrace/emulator.hpp"
#include "celltrace/spe/spu_mfcio.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace celltrace::test {
namespace {

struct alignas(128) Lines {
  std::array<std::uint32_t, 256> from;
  std::array<std::uint32_t, 256> to{};

  Lines() {
    for (std::uint32_t i = 0; i < from.size(); ++i)
      from[i] = i + 1;
  }
};

LocalStore<std::array<std::uint32_t, 256>> buffer;
LocalStore<std::array<mfc_list_element_t, 4>> list;
LocalStore<std::array<std::uint32_t, 4>> word;

void wait_for(unsigned tags) {
  mfc_write_tag_mask(tags);
  mfc_read_tag_status_all();
}

/// Runs on a machine of either schedule, and expects that no rule is broken.
template <class Program>
EmulatedRun run_clean(const MachineConfig& config, Program program, const EmulatedPpe& ppe = {}) {
  const EmulatedRun run = emulate(config, program, 0, ppe);
  INFO(run.report());
  CHECK(run.ok());
  return run;
}

MachineConfig machine_of(Schedule schedule, unsigned spes) {
  return schedule == Schedule::lockstep ? lockstep(spes) : free_running(spes);
}

TEST_CASE("spu_mfcio: every DMA function issues its command") {
  struct Issued {
    MfcOpcode opcode;
    std::uint32_t constant;
    std::uint32_t bytes;
    std::function<void(void*, ea_t)> issue; // with a tag that does not exist, so that the command is reported
  };
  constexpr unsigned t = 32;
  const Issued commands[] = {
      {MfcOpcode::put, MFC_PUT_CMD, 64, [](void* ls, ea_t ea) { mfc_put(ls, ea, 64, t, 0, 0); }},
      {MfcOpcode::putf, MFC_PUTF_CMD, 64, [](void* ls, ea_t ea) { mfc_putf(ls, ea, 64, t, 0, 0); }},
      {MfcOpcode::putb, MFC_PUTB_CMD, 64, [](void* ls, ea_t ea) { mfc_putb(ls, ea, 64, t, 0, 0); }},
      {MfcOpcode::get, MFC_GET_CMD, 64, [](void* ls, ea_t ea) { mfc_get(ls, ea, 64, t, 0, 0); }},
      {MfcOpcode::getf, MFC_GETF_CMD, 64, [](void* ls, ea_t ea) { mfc_getf(ls, ea, 64, t, 0, 0); }},
      {MfcOpcode::getb, MFC_GETB_CMD, 64, [](void* ls, ea_t ea) { mfc_getb(ls, ea, 64, t, 0, 0); }},
      {MfcOpcode::putl, MFC_PUTL_CMD, 8, [](void* ls, ea_t ea) { mfc_putl(ls, ea, &*list, 8, t, 0, 0); }},
      {MfcOpcode::putlf, MFC_PUTLF_CMD, 8, [](void* ls, ea_t ea) { mfc_putlf(ls, ea, &*list, 8, t, 0, 0); }},
      {MfcOpcode::putlb, MFC_PUTLB_CMD, 8, [](void* ls, ea_t ea) { mfc_putlb(ls, ea, &*list, 8, t, 0, 0); }},
      {MfcOpcode::getl, MFC_GETL_CMD, 8, [](void* ls, ea_t ea) { mfc_getl(ls, ea, &*list, 8, t, 0, 0); }},
      {MfcOpcode::getlf, MFC_GETLF_CMD, 8, [](void* ls, ea_t ea) { mfc_getlf(ls, ea, &*list, 8, t, 0, 0); }},
      {MfcOpcode::getlb, MFC_GETLB_CMD, 8, [](void* ls, ea_t ea) { mfc_getlb(ls, ea, &*list, 8, t, 0, 0); }},
      {MfcOpcode::putqlluc, MFC_PUTQLLUC_CMD, 128, [](void* ls, ea_t ea) { mfc_putqlluc(ls, ea, t, 0, 0); }},
      {MfcOpcode::sndsig, MFC_SNDSIG_CMD, 4, [](void* ls, ea_t ea) { mfc_sndsig(ls, ea, t, 0, 0); }},
      {MfcOpcode::sndsigf, MFC_SNDSIGF_CMD, 4, [](void* ls, ea_t ea) { mfc_sndsigf(ls, ea, t, 0, 0); }},
      {MfcOpcode::sndsigb, MFC_SNDSIGB_CMD, 4, [](void* ls, ea_t ea) { mfc_sndsigb(ls, ea, t, 0, 0); }},
      {MfcOpcode::barrier, MFC_BARRIER_CMD, 0, [](void*, ea_t) { mfc_barrier(t); }},
      {MfcOpcode::mfceieio, MFC_EIEIO_CMD, 0, [](void*, ea_t) { mfc_eieio(t, 0, 0); }},
      {MfcOpcode::mfcsync, MFC_SYNC_CMD, 0, [](void*, ea_t) { mfc_sync(t); }},
      {MfcOpcode::sdcrt, MFC_SDCRT_CMD, 128, [](void*, ea_t ea) { mfc_sdcrt(ea, 128, t, 0, 0); }},
      {MfcOpcode::sdcrtst, MFC_SDCRTST_CMD, 128, [](void*, ea_t ea) { mfc_sdcrtst(ea, 128, t, 0, 0); }},
      {MfcOpcode::sdcrz, MFC_SDCRZ_CMD, 128, [](void*, ea_t ea) { mfc_sdcrz(ea, 128, t, 0, 0); }},
      {MfcOpcode::sdcrst, MFC_SDCRST_CMD, 128, [](void*, ea_t ea) { mfc_sdcrst(ea, 128, t, 0, 0); }},
      {MfcOpcode::sdcrf, MFC_SDCRF_CMD, 128, [](void*, ea_t ea) { mfc_sdcrf(ea, 128, t, 0, 0); }},
  };
  Lines lines;
  for (const Issued& command : commands) {
    CAPTURE(command.constant);
    CHECK(command.constant == static_cast<std::uint32_t>(command.opcode));
    const EmulatedRun run =
        emulate(lockstep(1), [&](EmulatedSpu&) { command.issue(buffer->data(), to_ea(&lines)); });
    REQUIRE(run.diagnostics.size() == 1);
    CHECK(run.diagnostics[0].rule == Rule::tag_range);
    CHECK(run.diagnostics[0].opcode == command.constant);
    CHECK(run.diagnostics[0].tag == t);
    CHECK(run.diagnostics[0].size == command.bytes);
    CHECK(run.diagnostics[0].site.file == std::string(__FILE__));
  }
}

TEST_CASE("spu_mfcio: what a command is told, and where it stands in the source") {
  Lines lines;
  unsigned line = 0;
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu&) {
    line = __LINE__ + 1;
    mfc_get(&(*buffer)[4], &lines.from[8], 20, 5, 0, 0);
  });
  const Diagnostic* const broken = run.find(Rule::transfer_size);
  REQUIRE(broken != nullptr);
  CHECK(broken->ea == to_ea(&lines.from[8]));
  CHECK(broken->tag == 5);
  CHECK(broken->lsa % 128 == 16);
  CHECK(broken->site.line == line);
}

TEST_CASE("spu_mfcio: gets, puts and the waits for them") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  Lines lines;
  std::vector<unsigned> seen;
  run_clean(machine_of(schedule, 1), [&](EmulatedSpu&) {
    CHECK(mfc_stat_cmd_queue() == 16);
    mfc_get(buffer->data(), to_ea(lines.from.data()), 512, 3, 0, 0);
    mfc_write_tag_mask(1 << 3);
    seen.push_back(mfc_read_tag_mask());
    seen.push_back(mfc_read_tag_status_any());
    (*buffer)[0] = 1000;
    mfc_put(buffer->data(), to_ea(lines.to.data()), 512, 4, 0, 0);
    mfc_getf(buffer->data(), to_ea(lines.to.data()), 512, 4, 0, 0);
    mfc_barrier(4);
    mfc_write_tag_mask(1 << 4);
    mfc_write_tag_update_all();
    seen.push_back(mfc_stat_tag_update());
    seen.push_back(mfc_read_tag_status());
    mfc_write_tag_update(MFC_TAG_UPDATE_IMMEDIATE);
    seen.push_back(mfc_stat_tag_status());
    seen.push_back(mfc_read_tag_status());
    seen.push_back(mfc_read_tag_status_immediate());
    mfc_sdcrz(to_ea(lines.from.data()), 128, 4, 0, 0);
    wait_for(1 << 4);
  });
  CHECK(seen == std::vector<unsigned>{8, 8, 1, 16, 1, 16, 16});
  CHECK(lines.to[0] == 1000);
  CHECK(lines.to[127] == 128);
  CHECK(lines.from[31] == 0);
  CHECK(lines.from[32] == 33);
}

TEST_CASE("spu_mfcio: lists, with the SDK's fields, stop and go on") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  Lines lines;
  unsigned stalled = 0;
  std::array<unsigned, 3> before{}, after{};
  run_clean(machine_of(schedule, 1), [&](EmulatedSpu&) {
    const ea_t from = to_ea(lines.from.data());
    (*list)[0].notify = 1;
    (*list)[0].size = 32;
    (*list)[0].eal = mfc_ea2l(from);
    (*list)[1] = {0, 0, 16, mfc_ea2l(from + 128)};
    mfc_getl(buffer->data(), from, &*list, 2 * sizeof(mfc_list_element_t), 7, 0, 0);
    stalled = mfc_read_list_stall_status();
    before = {(*buffer)[0], (*buffer)[7], mfc_stat_list_stall_status()};
    mfc_write_list_stall_ack(7);
    wait_for(1 << 7);
    after = {(*buffer)[8], (*buffer)[11], 0};
    (*list)[0] = {0, 0, 16, mfc_ea2l(to_ea(lines.to.data()))};
    mfc_putl(buffer->data(), from, &*list, sizeof(mfc_list_element_t), 7, 0, 0);
    wait_for(1 << 7);
  });
  CHECK(stalled == 1 << 7);
  CHECK(before == std::array<unsigned, 3>{1, 8, 0});
  CHECK(after == std::array<unsigned, 3>{33, 36, 0});
  CHECK(lines.to[3] == 4);
}

TEST_CASE("spu_mfcio: lock lines count up together") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  constexpr unsigned kSpes = 3, kTimes = 20;
  Lines lines;
  std::array<unsigned, kSpes> reads{}; // Catch's assertions are for one thread
  run_clean(machine_of(schedule, kSpes), [&](EmulatedSpu& spu) {
    for (unsigned i = 0; i < kTimes; ++i) {
      do {
        mfc_getllar(buffer->data(), to_ea(lines.to.data()), 0, 0);
        reads[spu.id()] |= mfc_read_atomic_status();
        ++(*buffer)[0];
        mfc_putllc(buffer->data(), to_ea(lines.to.data()), 0, 0);
      } while ((mfc_read_atomic_status() & MFC_PUTLLC_STATUS) != 0);
    }
  });
  CHECK(lines.to[0] == kSpes * kTimes);
  CHECK(reads == std::array{MFC_GETLLAR_STATUS, MFC_GETLLAR_STATUS, MFC_GETLLAR_STATUS});

  run_clean(machine_of(schedule, 1), [&](EmulatedSpu&) {
    (*buffer)[0] = 7;
    mfc_putlluc(buffer->data(), to_ea(lines.to.data()), 0, 0);
    while (mfc_stat_atomic_status() == 0) {
    }
    CHECK(mfc_read_atomic_status() == MFC_PUTLLUC_STATUS);
    (*buffer)[0] = 8;
    mfc_putqlluc(buffer->data(), to_ea(lines.to.data() + 32), 2, 0, 0);
    wait_for(1 << 2);
  });
  CHECK(lines.to[0] == 7);
  CHECK(lines.to[32] == 8);
}

TEST_CASE("spu_mfcio: mailboxes and signals") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  std::vector<unsigned> counts;
  const EmulatedPpe ppe = [](Machine& machine) {
    machine.write_in_mailbox(0, 11);
    machine.write_signal(0, Signal::one, 21);
    machine.write_signal(0, Signal::two, 22);
    std::optional<std::uint32_t> out, interrupt;
    while (!out || !interrupt) {
      machine.wait_for_mail(std::chrono::milliseconds(1000));
      if (!out) out = machine.read_out_mailbox(0);
      if (!interrupt) interrupt = machine.read_out_interrupt_mailbox(0);
    }
    CHECK(*out == 11 + 21 + 22);
    CHECK(*interrupt == 99);
  };
  run_clean(
      machine_of(schedule, 1),
      [&](EmulatedSpu&) {
        counts = {spu_stat_out_mbox(), spu_stat_out_intr_mbox()};
        while (spu_stat_in_mbox() == 0 || spu_stat_signal1() == 0 || spu_stat_signal2() == 0) {
        }
        const unsigned sum = spu_read_in_mbox() + spu_read_signal1() + spu_read_signal2();
        spu_write_out_mbox(sum);
        spu_write_out_intr_mbox(99);
      },
      ppe);
  CHECK(counts == std::vector<unsigned>{1, 1});
}

TEST_CASE("spu_mfcio: a signal to another SPE") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  unsigned got = 0;
  run_clean(machine_of(schedule, 2), [&](EmulatedSpu& spu) {
    if (spu.id() == 1) {
      got = spu_read_signal2();
      return;
    }
    (*word)[3] = 5;
    mfc_sndsig(&(*word)[3], spu.addresses(1).signal_2, 1, 0, 0);
    wait_for(1 << 1);
  });
  CHECK(got == 5);
}

TEST_CASE("spu_mfcio: events and the decrementer") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  run_clean(machine_of(schedule, 1), [](EmulatedSpu&) {
    spu_write_event_mask(MFC_DECREMENTER_EVENT);
    CHECK(spu_read_event_mask() == MFC_DECREMENTER_EVENT);
    CHECK(spu_stat_event_status() == 0);
    spu_write_decrementer(1000);
    CHECK(spu_read_decrementer() <= 1000);
    CHECK(spu_read_event_status() == MFC_DECREMENTER_EVENT);
    spu_write_event_ack(MFC_DECREMENTER_EVENT);
    spu_write_event_mask(MFC_MULTI_SRC_SYNC_EVENT);
    CHECK(mfc_stat_multi_src_sync_request() == 1);
    mfc_write_multi_src_sync_request();
    CHECK(spu_read_event_status() == MFC_MULTI_SRC_SYNC_EVENT);
    spu_write_event_ack(MFC_MULTI_SRC_SYNC_EVENT);
    spu_write_srr0(0x100);
    CHECK(spu_read_srr0() == 0x100);
    CHECK(spu_read_machine_status() == 0);
  });
}

TEST_CASE("spu_mfcio: the event bits are the architecture's") {
  CHECK(MFC_TAG_STATUS_UPDATE_EVENT == event::tag_status);
  CHECK(MFC_LIST_STALL_NOTIFY_EVENT == event::list_stall);
  CHECK(MFC_COMMAND_QUEUE_AVAILABLE_EVENT == event::command_queue);
  CHECK(MFC_IN_MBOX_AVAILABLE_EVENT == event::in_mailbox);
  CHECK(MFC_DECREMENTER_EVENT == event::decrementer);
  CHECK(MFC_OUT_INTR_MBOX_AVAILABLE_EVENT == event::out_intr_mailbox);
  CHECK(MFC_OUT_MBOX_AVAILABLE_EVENT == event::out_mailbox);
  CHECK(MFC_SIGNAL_NOTIFY_1_EVENT == event::signal_1);
  CHECK(MFC_SIGNAL_NOTIFY_2_EVENT == event::signal_2);
  CHECK(MFC_LLR_LOST_EVENT == event::reservation_lost);
  CHECK(MFC_PRIV_ATTN_EVENT == event::privileged_attention);
  CHECK(MFC_MULTI_SRC_SYNC_EVENT == event::multi_source_sync);
}

TEST_CASE("spu_mfcio: commands and channels by number") {
  const Schedule schedule = GENERATE(Schedule::lockstep, Schedule::free);
  Lines lines;
  run_clean(machine_of(schedule, 1), [&](EmulatedSpu&) {
    const ea_t from = to_ea(lines.from.data()), to = to_ea(lines.to.data());
    spu_mfcdma64(buffer->data(), mfc_ea2h(from), mfc_ea2l(from), 128, 1, MFC_CMD_WORD(1, 2, MFC_GET_CMD));
    spu_writech(MFC_WrTagMask, 1 << 1);
    spu_writech(MFC_WrTagUpdate, MFC_TAG_UPDATE_ALL);
    CHECK(spu_readch(MFC_RdTagStat) == 1 << 1);
    CHECK(spu_readchcnt(MFC_Cmd) == 16);
    // The high half is still that of `from`.
    if (mfc_ea2h(from) == mfc_ea2h(to)) spu_mfcdma32(buffer->data(), mfc_ea2l(to), 128, 1, MFC_PUT_CMD);
    (*list)[0] = {0, 0, 16, mfc_ea2l(to + 256)};
    spu_mfcdma64(buffer->data(), mfc_ea2h(to), spu_ls_address(&*list), 8, 1, MFC_PUTLF_CMD);
    wait_for(1 << 1);
  });
  CHECK(lines.to[31] == 32);
  CHECK(lines.to[64] == 1);
}

TEST_CASE("spu_mfcio: addresses in halves and lines") {
  constexpr unsigned long long ea = 0x123456789ABCDEF0;
  CHECK(mfc_ea2h(ea) == 0x12345678);
  CHECK(mfc_ea2l(ea) == 0x9ABCDEF0);
  CHECK(mfc_hl2ea(0x12345678, 0x9ABCDEF0) == ea);
  CHECK(mfc_ceil128(1) == 128);
  CHECK(mfc_ceil128(128u) == 128);
  CHECK(MFC_MAX_DMA_SIZE == 16384);
  CHECK(MFC_MAX_DMA_LIST_SIZE == 16384);
  constexpr mfc_list_element_t element{1, 0, 16384, 0x1000};
  ListElement same;
  std::memcpy(&same, &element, sizeof same);
  CHECK(same.notify_and_size == (ListElement::kNotify | 16384));
  CHECK(same.ea_low == 0x1000);
}

TEST_CASE("spu_mfcio: tags are reserved one by one or in sequence, by each SPE for itself") {
  run_clean(lockstep(2), [](EmulatedSpu&) {
    for (unsigned tag = 0; tag < 32; ++tag)
      CHECK(mfc_tag_reserve() == tag);
    CHECK(mfc_tag_reserve() == MFC_TAG_INVALID);
    CHECK(mfc_tag_release(32) == MFC_TAG_INVALID);
    for (unsigned tag : {1, 2, 9, 10, 11, 31})
      CHECK(mfc_tag_release(tag) == MFC_TAG_VALID);
    CHECK(mfc_tag_release(9) == MFC_TAG_INVALID);
    CHECK(mfc_multi_tag_release(8, 2) == MFC_TAG_INVALID);
    CHECK(mfc_multi_tag_release(31, 2) == MFC_TAG_INVALID);
    CHECK(mfc_multi_tag_reserve(4) == MFC_TAG_INVALID);
    CHECK(mfc_multi_tag_reserve(3) == 9);
    CHECK(mfc_multi_tag_release(9, 3) == MFC_TAG_VALID);
    CHECK(mfc_tag_reserve() == 1);
    CHECK(mfc_multi_tag_reserve(33) == MFC_TAG_INVALID);
    CHECK(mfc_multi_tag_reserve(0) == MFC_TAG_INVALID);
  });
}

TEST_CASE("spu_mfcio: every SPE has its own static objects, also where SPEs take turns") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    run_clean(exploring(3, seed), [](EmulatedSpu& spu) {
      CHECK((*buffer)[0] == 0);
      (*buffer)[0] = spu.id() + 1;
      for (unsigned i = 0; i < 50; ++i) {
        spu_read_decrementer();
        CHECK(spu_stat_out_mbox() == 1);
        REQUIRE((*buffer)[0] == spu.id() + 1);
        REQUIRE(&EmulatedSpu::running() == &spu);
      }
    });
  }
}

TEST_CASE("spu_mfcio: a static object of the host is not local store, and the report says so") {
  alignas(128) static std::array<std::uint32_t, 32> elsewhere;
  Lines lines;
  const EmulatedRun run = emulate(lockstep(1), [&](EmulatedSpu&) {
    mfc_get(elsewhere.data(), to_ea(&lines), 128, 0, 0, 0);
    wait_for(1);
  });
  CHECK(run.broke(Rule::in_local_store));
}

TEST_CASE("spu_mfcio: without a running SPE program there is nothing to act on") {
  CHECK_THROWS_AS(spu_read_in_mbox(), SpeError);
  CHECK_THROWS_AS(*buffer, SpeError);
  // Nor is there one left behind, or between the turns of one.
  emulate(
      lockstep(2), [](EmulatedSpu&) { (void)spu_read_in_mbox(); }, 0,
      [](Machine& machine) {
        machine.write_in_mailbox(0, 1);
        machine.write_in_mailbox(1, 1);
        CHECK_THROWS_AS(spu_stat_in_mbox(), SpeError);
      });
  CHECK_THROWS_AS(spu_stat_in_mbox(), SpeError);
}

int full_main(unsigned long long speid, unsigned long long argp, unsigned long long envp) {
  return static_cast<int>(100 * speid + argp + envp);
}
int short_main(unsigned long long, ea_t argp) {
  return static_cast<int>(argp);
}
int stopping_main() {
  spu_stop(0x2042);
  return 1;
}

TEST_CASE("spu_mfcio: main() and its exit code") {
  CHECK(emulate(lockstep(2), spe_main(full_main, 2), 40).exit_codes == std::vector<std::uint32_t>{42, 142});
  CHECK(emulate(lockstep(1), spe_main(short_main), 0x1FF).exit_codes == std::vector<std::uint32_t>{0xFF});
  CHECK(emulate(free_running(1), spe_main(stopping_main)).exit_codes == std::vector<std::uint32_t>{0x42});
}

} // namespace
} // namespace celltrace::test

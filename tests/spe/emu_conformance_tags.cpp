// Conformance: tag groups and their status.
//
// Covers of the facts: "Tag status" (channels 12 and 22 to 24) with the hardware tests of MFC_WrTagUpdate and
// of the zero mask, the tag status event, and the hygiene of tags among the checks.
#include "spe/emu_conformance.hpp"

namespace celltrace::test {
namespace {

std::uint32_t status_count(Spu& spu) {
  return spu.channel_count<Channel::rd_tag_stat>();
}
std::uint32_t read_status(Spu& spu, CallSite site = CallSite::here()) {
  spu.at(site);
  return spu.read_channel<Channel::rd_tag_stat>();
}
void write_mask(Spu& spu, std::uint32_t mask) {
  spu.write_channel<Channel::wr_tag_mask>(mask);
}
void request(Spu& spu, std::uint32_t update, CallSite site = CallSite::here()) {
  spu.at(site);
  spu.write_channel<Channel::wr_tag_update>(update);
}
constexpr std::uint32_t kImmediate = 0, kAny = 1, kAll = 2;

/// A list of tag 3 that stands still until it is acknowledged, so that the tag is known to be incomplete.
void hold_tag_3(Spu& spu, Stage& stage) {
  auto* line = line_of(spu);
  auto* list = spu.allocate<ListElement>(2);
  list[0] = ListElement::make(16, to_ea(stage.from), true);
  list[1] = ListElement::make(16, to_ea(stage.from));
  spu.getl(line, to_ea(stage.from), list, 2, 3);
  spu.read_list_stall_status();
}
void release_tag_3(Spu& spu) {
  spu.acknowledge_list_stall(3);
}

const Rows kTags = {
    fact("immediate tells which tags of the mask are complete",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           stage.is(spu.completed(1u << 3 | 1u << 4), 1u << 4);
           release_tag_3(spu);
           spu.wait_all(1u << 3);
           stage.is(spu.completed(1u << 3 | 1u << 4), 1u << 3 | 1u << 4);
           stage.is(spu.read_channel<Channel::rd_tag_mask>(), 1u << 3 | 1u << 4);
         }),
    fact("any is answered when one tag is complete",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           auto* line = line_of(spu);
           spu.get(line, to_ea(stage.from), 128, 5);
           stage.is(spu.wait_any(1u << 3 | 1u << 5), 1u << 5);
           stage.is(line[0], 1);
           release_tag_3(spu);
           spu.wait_all(1u << 3);
         }),
    fact("all is answered when all are",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           write_mask(spu, 1u << 3 | 1u << 5);
           request(spu, kAll);
           stage.is(status_count(spu), 0);
           release_tag_3(spu);
           stage.is(read_status(spu), 1u << 3 | 1u << 5);
         }),
    fact("all of no tag is answered at once, with 0",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           stage.is(spu.wait_all(0), 0);
           release_tag_3(spu);
           spu.wait_all(1u << 3);
         }),
    fact("any of no tag is answered when the mask names one",
         [](Spu& spu, Stage& stage) {
           write_mask(spu, 0);
           request(spu, kAny);
           stage.is(status_count(spu), 0);
           write_mask(spu, 1u << 9);
           stage.is(status_count(spu), 1);
           stage.is(read_status(spu), 1u << 9);
         }),
    fact("a new mask judges a request that waits again",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           write_mask(spu, 1u << 3);
           request(spu, kAll);
           stage.is(status_count(spu), 0);
           write_mask(spu, 1u << 4);
           stage.is(read_status(spu), 1u << 4);
           release_tag_3(spu);
           spu.wait_all(1u << 3);
         }),
    fact("the count of channel 23 is 1 even while a request waits",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           write_mask(spu, 1u << 3);
           stage.is(spu.channel_count<Channel::wr_tag_update>(), 1);
           request(spu, kAll);
           stage.is(spu.channel_count<Channel::wr_tag_update>(), 1);
           release_tag_3(spu);
           stage.is(read_status(spu), 1u << 3);
           stage.is(spu.channel_count<Channel::wr_tag_update>(), 1);
         }),
    fact("a request that has to wait leaves the last answer where it is",
         [](Spu& spu, Stage& stage) {
           hold_tag_3(spu, stage);
           write_mask(spu, 1u << 4);
           request(spu, kImmediate);
           stage.is(status_count(spu), 1);
           write_mask(spu, 1u << 3);
           request(spu, kAll);
           stage.is(status_count(spu), 1);
           stage.is(read_status(spu), 1u << 4);
           stage.is(status_count(spu), 0);
           release_tag_3(spu);
           stage.is(read_status(spu), 1u << 3);
         }),
    fact("one that is answered replaces it",
         [](Spu& spu, Stage& stage) {
           write_mask(spu, 1u << 4);
           request(spu, kImmediate);
           write_mask(spu, 1u << 6);
           request(spu, kImmediate);
           stage.is(read_status(spu), 1u << 6);
           stage.is(status_count(spu), 0);
         }),
    fact("an answer to a request is an event",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::tag_status);
           stage.is(spu.completed(1u << 4), 1u << 4);
           stage.is(spu.read_event_status(), event::tag_status);
           spu.acknowledge_events(event::tag_status);
           spu.get(line_of(spu), to_ea(stage.from), 128, 1);
           write_mask(spu, 1u << 1);
           request(spu, kAll);
           stage.is(spu.read_event_status(), event::tag_status);
           stage.is(read_status(spu), 1u << 1);
         }),
    fact("a tag is complete when its last command is",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(32 * 12);
           for (std::uint32_t i = 0; i < 12; ++i)
             spu.get(lines + 32 * i, to_ea(stage.from + 32 * i), 128, 1);
           spu.wait_all(1u << 1);
           for (std::uint32_t i = 0; i < 12; ++i)
             stage.is(lines[32 * i], 32 * i + 1);
         }),

    kept(Rule::tag_update_request, "0, 1 and 2 are requests",
         [](Spu& spu, Stage& stage) {
           write_mask(spu, 1);
           for (const std::uint32_t update : {kImmediate, kAny, kAll}) {
             request(spu, update);
             stage.is(read_status(spu), 1);
           }
         }),
    broken(Rule::tag_update_request, "3 is none",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             request(spu, 3);
           },
           {"MFC_WrTagUpdate 3"}),
    kept(Rule::stalls_for_ever, "a status that was requested can be read, once",
         [](Spu& spu, Stage& stage) {
           write_mask(spu, 2);
           request(spu, kImmediate);
           stage.is(read_status(spu), 2);
         }),
    broken(Rule::stalls_for_ever, "without a request there is no status",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             read_status(spu);
           },
           {"MFC_RdTagStat would stall for ever: no tag status update has been requested"}),
    broken(Rule::stalls_for_ever, "nor is there a second one",
           [](Spu& spu, Stage& stage) {
             write_mask(spu, 2);
             request(spu, kImmediate);
             read_status(spu);
             stage.next_line();
             read_status(spu);
           }),
    broken(Rule::stalls_for_ever, "any of no tag never is",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.wait_any(0);
           },
           {"no tag group is enabled"}),

    kept(Rule::tag_reused, "a tag may be used again when its status has been read",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           for (int i = 0; i < 2; ++i) {
             spu.get(line, to_ea(stage.from), 128, 1);
             write_mask(spu, 1u << 1);
             request(spu, kAll);
             read_status(spu);
           }
         }),
    kept(Rule::tag_reused, "other tags may be used while a status is on its way",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(64);
           spu.get(lines, to_ea(stage.from), 128, 1);
           write_mask(spu, 1u << 1);
           request(spu, kAll);
           spu.get(lines + 32, to_ea(stage.from), 128, 2);
           read_status(spu);
           spu.wait_all(1u << 2);
         }),
    broken(Rule::tag_reused,
           "a command that joins a tag while its status is on its way: which does it speak of?",
           [](Spu& spu, Stage& stage) {
             auto* lines = spu.allocate<std::uint32_t>(64);
             spu.get(lines, to_ea(stage.from), 128, 1);
             write_mask(spu, 1u << 1);
             request(spu, kAll);
             stage.next_line();
             spu.get(lines + 32, to_ea(stage.from), 128, 1);
             read_status(spu);
             spu.wait_all(1u << 1);
           },
           {"get 128 bytes"}),

    kept(Rule::wait_without_command, "a wait for a tag without commands does not stall, and does no harm",
         [](Spu& spu, Stage& stage) { stage.is(spu.wait_all(1u << 7), 1u << 7); }),
    broken(Rule::wait_without_command, "but next to commands that nobody waits for it is the wrong tag",
           [](Spu& spu, Stage& stage) {
             spu.get(line_of(spu), to_ea(stage.from), 128, 1);
             stage.next_line();
             spu.wait_all(1u << 7);
           },
           {"tag groups 0x80"})
        .then({Rule::in_flight_at_exit}),

    kept(Rule::tag_status_unread, "a status that was requested and read",
         [](Spu& spu, Stage&) {
           write_mask(spu, 1);
           request(spu, kAll);
           read_status(spu);
         }),
    broken(Rule::tag_status_unread, "a status that was requested and never read",
           [](Spu& spu, Stage& stage) {
             write_mask(spu, 1);
             stage.next_line();
             request(spu, kAll);
           }),
    broken(Rule::tag_status_unread, "nor is it a wait",
           [](Spu& spu, Stage& stage) {
             spu.get(line_of(spu), to_ea(stage.from), 128, 1);
             write_mask(spu, 2);
             stage.next_line();
             request(spu, kAll);
           })
        .then({Rule::in_flight_at_exit}),
};

TEST_CASE("conformance: tag groups") {
  run_rows(kTags);
}

} // namespace
} // namespace celltrace::test

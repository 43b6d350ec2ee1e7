// Conformance: DMA lists.
//
// Covers of the facts: "List commands" - where the list lies, its elements, how local-store addresses
// advance, the order of elements, stall-and-notify with the hardware tests of stopped lists.
#include "spe/emu_conformance.hpp"

#include <sys/mman.h>

namespace celltrace::test {
namespace {

constexpr std::uint32_t kGetl = 0x44;

/// A list command spelled channel by channel: `list` is an address in local store.
void spell_list(Spu& spu, std::uint32_t opcode, const void* local, ea_t ea, std::uint32_t list,
                std::uint32_t bytes, CallSite site = CallSite::here()) {
  spell(spu, opcode, lsa_of(spu, local), (ea & ~ea_t{0xFFFFFFFF}) | list, bytes, 3, site);
}

/// Two pages of main memory, one on each side of a multiple of 4 GB.
class RegionBoundary {
public:
  RegionBoundary()
      : reserved_(::mmap(nullptr, kReserved, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {
    if (reserved_ == MAP_FAILED) return;
    boundary_ = (to_ea(reserved_) + kPage + 0xFFFFFFFF) & ~ea_t{0xFFFFFFFF};
    ::mprotect(reinterpret_cast<void*>(boundary_ - kPage), 2 * kPage, PROT_READ | PROT_WRITE);
  }
  ~RegionBoundary() {
    if (reserved_ != MAP_FAILED) ::munmap(reserved_, kReserved);
  }
  RegionBoundary(const RegionBoundary&) = delete;
  RegionBoundary& operator=(const RegionBoundary&) = delete;

  /// 0 if the host has no room for it.
  ea_t address() const { return boundary_; }

private:
  static constexpr std::size_t kPage = 4096;
  static constexpr std::size_t kReserved = 0x100000000 + 4 * kPage;
  void* reserved_;
  ea_t boundary_ = 0;
};

/// A list of two lines whose first element notifies, under tag 3.
struct StoppingList {
  std::uint32_t* buffer;
  ListElement* elements;

  StoppingList(Spu& spu, Stage& stage, CallSite site = CallSite::here())
      : buffer(spu.allocate<std::uint32_t>(64)), elements(spu.allocate<ListElement>(2)) {
    elements[0] = ListElement::make(128, to_ea(stage.from), true);
    elements[1] = ListElement::make(128, to_ea(stage.from + 32));
    spu.getl(buffer, to_ea(stage.from), elements, 2, 3, site);
  }
};

const Rows kLists = {
    kept(Rule::list_in_local_store, "a list lies in local store",
         [](Spu& spu, Stage& stage) {
           auto* buffer = spu.allocate<std::uint32_t>(64);
           auto* list = spu.allocate<ListElement>(2);
           list[0] = ListElement::make(128, to_ea(stage.from + 32));
           list[1] = ListElement::make(128, to_ea(stage.from));
           spu.getl(buffer, to_ea(stage.from), list, 2, 3);
           spu.wait_all(1u << 3);
           stage.is(buffer[0], 33);
           stage.is(buffer[32], 1);
         }),
    broken(Rule::list_in_local_store, "it does not lie on the host's stack",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             const ListElement element = ListElement::make(128, to_ea(stage.from));
             stage.next_line();
             spu.getl(line, to_ea(stage.from), &element, 1, 3);
           },
           {"getl of 8 bytes of list"}),
    broken(Rule::list_in_local_store, "nor behind the end of local store",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spell_list(spu, kGetl, line, to_ea(stage.from), 0x40000, 8);
           }),
    kept(Rule::list_alignment, "8 bytes are enough of an alignment",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(3, 16);
           list[1] = ListElement::make(16, to_ea(stage.from));
           spu.getl(line, to_ea(stage.from), list + 1, 1, 3);
           spu.wait_all(1u << 3);
           stage.is(line[3], 4);
         }),
    broken(Rule::list_alignment, "4 are not",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<std::uint32_t>(4, 16);
             stage.next_line();
             spell_list(spu, kGetl, line, to_ea(stage.from), lsa_of(spu, list + 1), 8);
           }),
    kept(Rule::list_length, "2048 elements are a list",
         [](Spu& spu, Stage& stage) {
           auto* buffer = spu.allocate<std::uint32_t>(4 * 2048);
           auto* list = spu.allocate<ListElement>(2048);
           for (std::uint32_t i = 0; i < 2048; ++i)
             list[i] = ListElement::make(8, to_ea(stage.from + 2 * i));
           spu.getl(buffer, to_ea(stage.from), list, 2048, 3);
           spu.wait_all(1u << 3);
           stage.is(buffer[4 * 2046 + 1], 4094);
           stage.is(buffer[4 * 2047 + 2], 4095);
         }),
    broken(Rule::list_length, "2049 are too many",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<ListElement>(2049);
             stage.next_line();
             spu.getl(line, to_ea(stage.from), list, 2049, 3);
           },
           {"getl of 16392 bytes of list at LS 0x"}),
    broken(Rule::list_length, "one and a half are not",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<ListElement>(2);
             stage.next_line();
             spell_list(spu, kGetl, line, to_ea(stage.from), lsa_of(spu, list), 12);
           }),
    kept(Rule::list_end, "a list may end with local store",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* last = reinterpret_cast<ListElement*>(spu.arena().end) - 1;
           *last = ListElement::make(16, to_ea(stage.from));
           stage.is(lsa_of(spu, last), 0x3FFF8);
           spu.getl(line, to_ea(stage.from), last, 1, 3);
           spu.wait_all(1u << 3);
           stage.is(line[0], 1);
         })
        .configured([](MachineConfig& config) { config.stack_bytes = 0; }),
    broken(Rule::list_end, "it may not go on behind it",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             stage.next_line();
             spell_list(spu, kGetl, line, to_ea(stage.from), 0x3FFF8, 16);
           }),
    kept(Rule::element_region, "an element may end with its 4 GB",
         [](Spu& spu, Stage& stage) {
           const RegionBoundary boundary;
           if (boundary.address() == 0) return;
           auto* word = reinterpret_cast<std::uint32_t*>(boundary.address() - 16);
           word[3] = 99;
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(1);
           list[0] = ListElement::make(16, to_ea(word));
           spu.getl(line, to_ea(word), list, 1, 3);
           spu.wait_all(1u << 3);
           stage.is(line[3], 99);
         }),
    broken(Rule::element_region, "it may not go on in the next",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<ListElement>(1);
             list[0] = ListElement::make(32, 0xFFFFFFF0);
             stage.next_line();
             spu.getl(line, to_ea(stage.from), list, 1, 3);
           },
           {"element 0 of getl of 8 bytes"}),

    broken(Rule::transfer_size, "an element obeys the rules of a transfer, and is named by its number",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<ListElement>(3);
             for (std::uint32_t i = 0; i < 3; ++i)
               list[i] = ListElement::make(i == 2 ? 24 : 16, to_ea(stage.from + 4 * i));
             stage.next_line();
             spu.getl(line, to_ea(stage.from), list, 3, 3);
           },
           {"element 2 of getl of 24 bytes of list at LS 0x", "get 24 bytes, LS 0x1a0a0 <- EA 0x", "tag 3"}),
    kept(Rule::zero_size, "an element of 0 bytes is legal",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(3);
           list[0] = ListElement::make(0, to_ea(stage.from));
           list[1] = ListElement::make(16, to_ea(stage.from + 4));
           list[2] = ListElement::make(0, to_ea(stage.from));
           spu.getl(line, to_ea(stage.from), list, 3, 3);
           spu.wait_all(1u << 3);
           stage.is(line[0], 5);
         }),
    fact("bit 15 of an element's size is ignored, and so are the reserved bits",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(1);
           list[0] = ListElement::make(0x7FFF8000u | 16, to_ea(stage.from));
           spu.getl(line, to_ea(stage.from), list, 1, 3);
           spu.wait_all(1u << 3);
           stage.is(line[3], 4);
           stage.is(line[4], 0);
         }),
    fact("each element starts in the next quadword, at the low bits of its effective address",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(4);
           list[0] = ListElement::make(4, to_ea(stage.from + 1));
           list[1] = ListElement::make(8, to_ea(stage.from + 6));
           list[2] = ListElement::make(16, to_ea(stage.from + 8));
           list[3] = ListElement::make(1, to_ea(stage.from + 15) + kLowByte);
           // The command's own low bits do not count.
           spu.getl(line + 3, to_ea(stage.from), list, 4, 3);
           spu.wait_all(1u << 3);
           const std::uint32_t expected[16] = {0, 2, 0, 0, 0, 0, 7, 8, 9, 10, 11, 12, 0, 0, 0, 16};
           for (std::uint32_t i = 0; i < 16; ++i)
             stage.is(line[i], expected[i]);
         }),
    kept(Rule::main_storage_race, "the elements of a list are taken in order",
         [](Spu& spu, Stage& stage) {
           auto* lines = spu.allocate<std::uint32_t>(64);
           lines[0] = 1;
           lines[32] = 2;
           auto* list = spu.allocate<ListElement>(2);
           list[0] = list[1] = ListElement::make(128, to_ea(stage.to));
           spu.putl(lines, to_ea(stage.to), list, 2, 3);
           spu.wait_all(1u << 3);
           stage.is(stage.to[0], 2);
         }),
    fact("elements reach registers word by word",
         [](Spu& spu, Stage& stage) {
           auto* words = spu.allocate<std::uint32_t>(8);
           words[3] = 0x11;
           words[7] = 0x22;
           auto* list = spu.allocate<ListElement>(2);
           const SpeAddresses me = spu.addresses(spu.id());
           list[0] = ListElement::make(4, me.signal_1);
           list[1] = ListElement::make(4, me.in_mailbox);
           spu.putl(words, me.signal_1, list, 2, 0);
           spu.wait_all(1);
           stage.is(spu.read_signal_1() * 0x100 + spu.read_in_mailbox(), 0x1122);
         }),

    kept(Rule::list_changed, "a list is the program's again when its tag is complete",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(1);
           for (std::uint32_t i = 0; i < 2; ++i) {
             list[0] = ListElement::make(16, to_ea(stage.from + 4 * i));
             spu.getl(line, to_ea(stage.from), list, 1, 3);
             spu.wait_all(1u << 3);
             stage.is(line[0], 4 * i + 1);
           }
         }),
    broken(Rule::list_changed, "to change it behind the MFC's back is a race",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<ListElement>(1);
             list[0] = ListElement::make(16, to_ea(stage.from));
             stage.next_line();
             spu.getl(line, to_ea(stage.from), list, 1, 3);
             list[0] = ListElement::make(32, to_ea(stage.from));
             spu.wait_all(1u << 3);
           }),
};

const Rows kStops = {
    kept(Rule::list_changed, "what lies behind a stop may be written while the list is stopped",
         [](Spu& spu, Stage& stage) {
           const StoppingList list(spu, stage);
           stage.is(spu.read_list_stall_status(), 1u << 3);
           stage.is(list.buffer[31], 32); // the first part is the program's
           list.elements[1] = ListElement::make(128, to_ea(stage.from + 64));
           spu.acknowledge_list_stall(3);
           spu.wait_all(1u << 3);
           stage.is(list.buffer[32], 65);
         }),
    fact("a stop raises the list stall event and the count of channel 25",
         [](Spu& spu, Stage& stage) {
           spu.write_event_mask(event::list_stall);
           const StoppingList list(spu, stage);
           stage.is(spu.read_event_status(), event::list_stall);
           stage.is(spu.channel_count<Channel::rd_list_stall_stat>(), 1);
           stage.is(spu.read_list_stall_status(), 1u << 3);
           stage.is(spu.channel_count<Channel::rd_list_stall_stat>(), 0);
           spu.acknowledge_list_stall(3);
           stage.is(spu.wait_all(1u << 3), 1u << 3);
         }),
    fact("stops of several tags are or-ed in channel 25",
         [](Spu& spu, Stage& stage) {
           const StoppingList list(spu, stage);
           auto* line = line_of(spu);
           auto* other = spu.allocate<ListElement>(2);
           other[0] = ListElement::make(16, to_ea(stage.from), true);
           other[1] = ListElement::make(16, to_ea(stage.from));
           spu.getl(line, to_ea(stage.from), other, 2, 7);
           // Either may come first; a poll for both.
           std::uint32_t tags = 0;
           while (tags != (1u << 3 | 1u << 7))
             tags |= spu.read_list_stall_status();
           spu.acknowledge_list_stall(7);
           stage.is(spu.wait_all(1u << 7), 1u << 7);
           spu.acknowledge_list_stall(3);
           stage.is(spu.wait_all(1u << 3), 1u << 3);
         }),
    fact("while a list is stopped other commands of its tag go on",
         [](Spu& spu, Stage& stage) {
           const StoppingList list(spu, stage);
           auto* line = line_of(spu);
           line[0] = 5;
           spu.put(line, to_ea(stage.to), 128, 3);
           // Seen through another agent's eyes, for the tag does not complete.
           auto* seen = line_of(spu);
           do
             spu.getllar(seen, to_ea(stage.to));
           while (seen[0] != 5);
           spu.read_list_stall_status();
           spu.acknowledge_list_stall(3);
           spu.wait_all(1u << 3);
         }),
    fact("one acknowledge sets all stopped lists of a tag going",
         [](Spu& spu, Stage& stage) {
           const StoppingList one(spu, stage), two(spu, stage);
           while (spu.cycles() < 200000) // until both have stopped
             spu.event_count();
           stage.is(spu.read_list_stall_status(), 1u << 3);
           stage.is(spu.channel_count<Channel::rd_list_stall_stat>(), 0);
           spu.acknowledge_list_stall(3);
           stage.is(spu.wait_all(1u << 3), 1u << 3);
           stage.is(one.buffer[32] + two.buffer[32], 66);
         }),
    fact("a barrier of the tag waits for a stopped list, another tag does not",
         [](Spu& spu, Stage& stage) {
           const StoppingList list(spu, stage);
           auto* lines = spu.allocate<std::uint32_t>(64);
           lines[0] = 1;
           lines[32] = 2;
           spu.putb(lines, to_ea(stage.to), 128, 3);
           spu.put(lines + 32, to_ea(stage.to + 32), 128, 4);
           stage.is(spu.wait_all(1u << 4), 1u << 4);
           stage.is(stage.to[32], 2);
           while (spu.cycles() < 200000)
             spu.channel_count<Channel::rd_tag_stat>();
           stage.is(stage.to[0], 0);
           stage.is(spu.completed(1u << 3), 0);
           spu.read_list_stall_status();
           spu.acknowledge_list_stall(3);
           spu.wait_all(1u << 3);
           stage.is(stage.to[0], 1);
         }),
    kept(Rule::local_store_race, "a fenced command behind a stopped list comes behind all of it",
         [](Spu& spu, Stage& stage) {
           const StoppingList list(spu, stage);
           spu.getf(list.buffer + 32, to_ea(stage.from + 64), 128, 3);
           spu.read_list_stall_status();
           spu.acknowledge_list_stall(3);
           spu.wait_all(1u << 3);
           stage.is(list.buffer[32], 65);
         }),
    broken(Rule::local_store_race, "one without a fence meets what the list still has to do",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             const StoppingList list(spu, stage);
             spu.get(list.buffer + 32, to_ea(stage.from + 64), 128, 3);
             spu.read_list_stall_status();
             spu.acknowledge_list_stall(3);
           },
           {"meets command 2 of SPE 0 (get 128 bytes"}),
    fact("a notify bit in the last element stops nothing",
         [](Spu& spu, Stage& stage) {
           auto* line = line_of(spu);
           auto* list = spu.allocate<ListElement>(1);
           list[0] = ListElement::make(128, to_ea(stage.from), true);
           spu.getl(line, to_ea(stage.from), list, 1, 3);
           stage.is(spu.wait_all(1u << 3), 1u << 3);
           stage.is(spu.channel_count<Channel::rd_list_stall_stat>(), 0);
         }),
    kept(Rule::list_stall_tag, "a tag of which no list is stopped may be acknowledged",
         [](Spu& spu, Stage&) { spu.acknowledge_list_stall(31); }),
    broken(Rule::list_stall_tag, "there is no tag 32 to acknowledge",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.acknowledge_list_stall(32);
           },
           {"MFC_WrListStallAck 32"}),
    broken(Rule::list_stall_tag, "the acknowledge takes a tag's number, not its bit",
           [](Spu& spu, Stage& stage) {
             auto* line = line_of(spu);
             auto* list = spu.allocate<ListElement>(2);
             list[0] = ListElement::make(16, to_ea(stage.from), true);
             list[1] = ListElement::make(16, to_ea(stage.from));
             spu.getl(line, to_ea(stage.from), list, 2, 6);
             const std::uint32_t tags = spu.read_list_stall_status();
             stage.next_line();
             spu.acknowledge_list_stall(tags);
           },
           {"MFC_WrListStallAck 64"}),
    kept(Rule::in_flight_at_exit, "a list that was acknowledged and waited for is done",
         [](Spu& spu, Stage& stage) {
           const StoppingList list(spu, stage);
           spu.read_list_stall_status();
           spu.acknowledge_list_stall(3);
           spu.wait_all(1u << 3);
         }),
    broken(Rule::in_flight_at_exit, "one that nobody acknowledged is not",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             const StoppingList list(spu, stage);
             spu.read_list_stall_status();
           },
           {"getl of 16 bytes of list", "still stopped at a notify element"}),
    broken(Rule::stalls_for_ever, "a wait for a stopped list never ends",
           [](Spu& spu, Stage& stage) {
             const StoppingList list(spu, stage);
             stage.next_line();
             spu.wait_all(1u << 3);
           },
           {"MFC_RdTagStat would stall for ever: a list of the tag group is stopped"}),
    broken(Rule::stalls_for_ever, "there is no stop to read of without a notify bit",
           [](Spu& spu, Stage& stage) {
             stage.next_line();
             spu.read_list_stall_status();
           },
           {"MFC_RdListStallStat would stall for ever"}),
};

TEST_CASE("conformance: lists") {
  run_rows(kLists);
}

TEST_CASE("conformance: stall and notify") {
  run_rows(kStops);
}

} // namespace
} // namespace celltrace::test

// A table of facts about the Cell: small programs that keep or break a rule, and what the emulator has to
// say.
//
//   const Rows kRows = {
//       kept(Rule::transfer_size, "8 bytes are a transfer", [](Spu& spu, Stage& stage) { ... }),
//       broken(Rule::transfer_size, "20 bytes are none", [](Spu& spu, Stage& stage) {
//         stage.next_line();
//         spu.get(...);
//       }, {"get 20 bytes"}),
//   };
//   TEST_CASE("conformance: transfers") { run_rows(kRows); }
//
// A row runs in lockstep, on threads and exploring with faults, for each TransferTime; one whose program is a
// kernel of hardware_rows.hpp, also as machine code where the build has a compiler for it. Rows of Rule::none
// are facts that no rule speaks of. The rows of all files together cover all rules both ways:
// emu_conformance.cpp.
#pragma once

#include "celltrace/emulator.hpp"
#include "spe/emu_peek.hpp"
#include "spe/hardware_rows.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <functional>
#include <initializer_list>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace celltrace::test {

using Spu = EmulatedSpu;

// Numbers in main storage, in the byte order of a machine's SPUs.
constexpr std::uint32_t in_order(std::endian order, std::uint32_t value) {
  return order == std::endian::native ? value : __builtin_bswap32(value);
}
// Where the lowest byte of one of this machine's words lies in it.
constexpr std::uint32_t kLowByte = std::endian::native == std::endian::big ? 3 : 0;
inline std::uint32_t load_word(std::endian order, const std::uint32_t* from) {
  return in_order(order, *from);
}
inline void store_word(std::endian order, std::uint32_t* to, std::uint32_t value) {
  *to = in_order(order, value);
}

/// What the programs of a row share: main memory, and the book of what they found. Thread-safe.
class Stage {
public:
  Stage() {
    for (std::uint32_t i = 0; i < 4096; ++i)
      from[i] = i + 1;
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  alignas(128) std::uint32_t from[4096]; ///< 1, 2, 3, ...
  alignas(128) std::uint32_t to[4096] = {};
  /// Written by one SPE or the PPE, read by another after they have met.
  std::uint32_t shared[8] = {};

  /// The operation on the next line is what the diagnostic has to name.
  void next_line(CallSite site = CallSite::here()) {
    const std::lock_guard lock(mutex_);
    culprit_ = {site.file, site.line + 1};
  }
  /// As CHECK(found == expected), from any thread.
  template <class Found, class Expected>
  void is(const Found& found, const Expected& expected, CallSite site = CallSite::here()) {
    if (found == static_cast<Found>(expected)) return;
    std::ostringstream text;
    text << "line " << site.line << ": 0x" << std::hex << static_cast<std::uint64_t>(found) << ", not 0x"
         << static_cast<std::uint64_t>(expected);
    const std::lock_guard lock(mutex_);
    failures_ += text.str() + "\n";
  }

  void fail(const std::string& text) { failures_ += text + "\n"; }

  CallSite culprit() const { return culprit_; }
  void set_culprit(CallSite site) { culprit_ = site; }
  const std::string& failures() const { return failures_; }

private:
  std::mutex mutex_;
  CallSite culprit_;
  std::string failures_;
};

/// What a hardware row finds in its block.
struct Given {
  ea_t address = 0;
  std::uint32_t value = 0;
};

struct Row {
  Rule rule;
  bool is_broken;
  const char* fact;
  std::function<void(Spu&, Stage&)> program;
  std::vector<std::string> says{}; ///< the text of the diagnostic
  unsigned spe_count = 1;
  unsigned culprit_spe = 0;         ///< Diagnostic::kPpe: the PPE
  std::vector<Rule> consequences{}; ///< may be reported as well
  std::function<void(Machine&, Stage&)> ppe_part{};
  std::function<void(MachineConfig&)> configuration{};
  bool in_lockstep_only = false;
  bool at_issue_too = true;
  /// Instead of `program`: a kernel that also exists as machine code.
  HardwareRow kernel = HardwareRow::none;
  unsigned more_seeds = 0;
  bool machine_code_breaks_it = false; ///< and host code cannot be seen to
  std::function<Given(Stage&)> given_part{};
  std::function<void(Stage&, std::endian)> after_part{};

  Row&& spes(unsigned count) && { return spe_count = count, std::move(*this); }
  /// Whose mistake it is.
  Row&& by(unsigned spe) && { return culprit_spe = spe, std::move(*this); }
  Row&& then(std::vector<Rule> rules) && { return consequences = std::move(rules), std::move(*this); }
  Row&& ppe(std::function<void(Machine&, Stage&)> part) && {
    return ppe_part = std::move(part), std::move(*this);
  }
  Row&& configured(std::function<void(MachineConfig&)> change) && {
    return configuration = std::move(change), std::move(*this);
  }
  /// What virtual time decides, or what only the queue of a machine in lockstep shows.
  Row&& lockstep_only() && { return in_lockstep_only = true, std::move(*this); }
  /// Orders that few seeds bring about.
  Row&& seeds(unsigned more) && { return more_seeds = more, std::move(*this); }
  Row&& given(std::function<Given(Stage&)> make) && { return given_part = std::move(make), std::move(*this); }
  /// Loads, which host code does unseen: there the row has to be a legal program.
  Row&& of_machine_code() && { return machine_code_breaks_it = true, std::move(*this); }
  /// What main storage holds in the end.
  Row&& after(std::function<void(Stage&, std::endian)> check) && {
    return after_part = std::move(check), std::move(*this);
  }
  /// Data that are already there cannot be missed.
  Row&& not_at_issue() && { return at_issue_too = false, std::move(*this); }
};

inline Row kept(Rule rule, const char* fact, std::function<void(Spu&, Stage&)> program) {
  return {rule, false, fact, std::move(program)};
}
/// A fact that no rule speaks of.
inline Row fact(const char* fact, std::function<void(Spu&, Stage&)> program) {
  return kept(Rule::none, fact, std::move(program));
}
inline Row broken(Rule rule, const char* fact, std::function<void(Spu&, Stage&)> program,
                  std::vector<std::string> says = {}) {
  return {rule, true, fact, std::move(program), std::move(says)};
}

// The same for kernels that run on host code and as machine code.
inline Row kept(Rule rule, const char* fact, HardwareRow kernel) {
  Row row = kept(rule, fact, std::function<void(Spu&, Stage&)>());
  row.kernel = kernel;
  return row;
}
inline Row fact(const char* fact, HardwareRow kernel) {
  return kept(Rule::none, fact, kernel);
}
inline Row broken(Rule rule, const char* fact, HardwareRow kernel, std::vector<std::string> says = {}) {
  Row row = broken(rule, fact, std::function<void(Spu&, Stage&)>(), std::move(says));
  row.kernel = kernel;
  return row;
}

/// The rows of one subject; all of them together are all_rows().
class Rows {
public:
  Rows(std::initializer_list<Row> rows);
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  const std::vector<Row>& all() const { return rows_; }

private:
  std::vector<Row> rows_;
};

const std::vector<const Rows*>& all_rows();

/// Runs each row as a section of the present test case.
void run_rows(const Rows& rows);

// --- for programs ---

inline std::uint32_t lsa_of(Spu& spu, const void* local) {
  return static_cast<std::uint32_t>(to_ea(local) - spu.addresses(spu.id()).local_store);
}

/// A line of local store, all 0.
inline std::uint32_t* line_of(Spu& spu) {
  return spu.allocate<std::uint32_t>(32);
}

/// Spells a command channel by channel; for what SpuBase has no name for.
inline void spell(Spu& spu, std::uint32_t opcode, std::uint32_t lsa, ea_t ea, std::uint32_t size,
                  std::uint32_t tag, CallSite site = CallSite::here()) {
  spu.at(site);
  spu.write_channel<Channel::mfc_lsa>(lsa);
  spu.write_channel<Channel::mfc_eah>(static_cast<std::uint32_t>(ea >> 32));
  spu.write_channel<Channel::mfc_eal>(static_cast<std::uint32_t>(ea));
  spu.write_channel<Channel::mfc_size>(size);
  spu.write_channel<Channel::mfc_tag_id>(tag);
  spu.write_channel<Channel::mfc_cmd>(opcode);
}

} // namespace celltrace::test

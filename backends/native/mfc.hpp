// Mfc: the memory flow controller of one SPE, which executes commands when they are issued.
#pragma once

#include "backends/native/channels.hpp"
#include "backends/native/counters.hpp"
#include "backends/native/registers.hpp"
#include "backends/native/reservations.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <vector>

namespace celltrace::native {

/// Executes commands at once, so that tag groups are complete when a call returns. Only lists that stopped at
/// a notify element (other than their last element), and commands that are ordered behind such lists, wait in
/// the queue until the stop is acknowledged. Sizes, alignments and addresses are not checked. Sizes of list
/// elements have 15 bits, as on the hardware.
///
/// Thread safety: belongs to the SPE's thread.
class Mfc {
public:
  Mfc(unsigned spe, Channels& channels, const RegisterMap& registers, Reservations& reservations,
      Counters& counters);
  Mfc(const Mfc&) = delete;
  Mfc& operator=(const Mfc&) = delete;

  void command(MfcOpcode opcode, void* ls, ea_t ea, std::uint32_t size, std::uint32_t tag);
  void list_command(MfcOpcode opcode, void* ls, ea_t ea, const ListElement* list, std::uint32_t bytes,
                    std::uint32_t tag);
  /// Returns the number of free entries of the command queue.
  std::uint32_t queue_space() const noexcept;

  void write_tag_mask(std::uint32_t mask);
  std::uint32_t read_tag_mask() const noexcept { return tag_mask_; }
  void write_tag_update(TagUpdate request);
  std::uint32_t read_tag_status();
  std::uint32_t tag_status_count() const noexcept { return tag_status_ready_ ? 1 : 0; }

  std::uint32_t read_list_stall_status();
  std::uint32_t list_stall_count() const noexcept { return stalled_tags_ != 0 ? 1 : 0; }
  void acknowledge_list_stall(std::uint32_t tag);

  std::uint32_t read_atomic_status();
  std::uint32_t atomic_status_count() const noexcept { return atomic_status_ready_ ? 1 : 0; }

  /// Resets the MFC, when a kernel begins or has ended.
  void reset();

private:
  struct Command {
    MfcOpcode opcode;
    std::uint8_t* ls;
    ea_t ea;
    std::uint32_t size;
    std::uint32_t tag;
    const ListElement* list; ///< remaining elements; null unless a list command
    const ListElement* list_end;
    bool stalled;
  };

  void issue(const Command& command);
  bool must_wait(std::size_t position) const;
  void advance();
  bool run(Command& command);
  bool walk(Command& command);
  void transfer(bool to_main_storage, std::uint8_t* ls, ea_t ea, std::uint32_t size);
  void write_register(const std::uint8_t* ls, ea_t ea, std::uint32_t size);
  bool run_atomic(const Command& command);
  void finish_atomic(std::uint32_t status);
  void update_tag_status();

  const unsigned spe_;
  Channels& channels_;
  const RegisterMap& registers_;
  Reservations& reservations_;
  Counters& counters_;

  std::vector<Command> waiting_; ///< commands in order of issue; empty unless a list has stalled
  std::uint32_t stalled_tags_ = 0;

  std::uint32_t tag_mask_ = 0;
  TagUpdate tag_request_ = TagUpdate::immediate;
  bool tag_requested_ = false;
  bool tag_status_ready_ = false;
  std::uint32_t tag_status_ = 0;

  bool atomic_status_ready_ = false;
  std::uint32_t atomic_status_ = 0;
};

} // namespace celltrace::native

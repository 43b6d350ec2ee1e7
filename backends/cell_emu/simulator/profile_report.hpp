// ProfileReport shows a profile by function and instruction: it implements profile_text() and profile_json()
// of simulator.hpp.
//
// The report shows for a whole run what IBM's spu_timing shows for straight-line code: for each instruction,
// the pipe that it issues to, whether it issues together with its neighbour, and the causes of its delays.
#pragma once

#include "backends/cell_emu/simulator/code_places.hpp"
#include "celltrace/spe/simulation.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace celltrace::cell_emu {

/// The counts of a word, a function or a whole program.
struct ProfileSum {
  SpuProfile::Word word; ///< sums of all members except `instruction`, which is meaningless
  ProfileSum& operator+=(const SpuProfile::Word& more);

  /// Returns cycles per instruction; 0 if no instruction was executed.
  double cycles_per_instruction() const;
  /// Returns the share of instructions, 0..1, that issued in pairs; both instructions of a pair count.
  double paired() const;
};

/// One function that was executed.
struct ProfiledFunction {
  std::string name; ///< name as in the source; an address if the function has no symbol
  std::uint32_t lsa = 0;
  ProfileSum sum;
  std::vector<std::uint32_t> words; ///< executed addresses, ascending
};

/// Thread safety: all members are const.
class ProfileReport {
public:
  /// Makes the report; copies the profile's words.
  ProfileReport(const SpuProfile& profile, const SpuElf& elf);

  const ProfileSum& total() const { return total_; }
  /// Returns the functions, those with the most cycles first.
  const std::vector<ProfiledFunction>& functions() const { return functions_; }

  std::string text(double listed) const;
  std::string json() const;

private:
  const SpuProfile::Word& word_at(std::uint32_t lsa) const { return words_[lsa / 4]; }
  std::string name_of(const FunctionSymbol* function, std::uint32_t lsa) const;
  void sort_into_functions();
  /// Returns how often the instruction issued together with its neighbour.
  std::uint64_t pairs_of(std::uint32_t lsa) const;
  void append_table(std::string& text) const;
  void append_listing(std::string& text, const ProfiledFunction& function) const;
  void append_instruction(std::string& text, std::uint32_t lsa) const;

  std::vector<SpuProfile::Word> words_; ///< index: word of local store
  CodePlaces places_;
  ProfileSum total_;
  std::vector<ProfiledFunction> functions_;
};

} // namespace celltrace::cell_emu

// A profile by function and instruction, and its words: profile_text() and profile_json() of simulator.hpp.
//
// What IBM's spu_timing shows of straight lines, for a whole run: instruction by instruction, in which pipe
// it issues, whether with its neighbour, and for what it waited.
#pragma once

#include "backends/cell_emu/simulator/code_places.hpp"
#include "celltrace/spe/simulation.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace celltrace::cell_emu {

/// What a word, a function or a whole program did.
struct ProfileSum {
  SpuProfile::Word word; ///< its sums; `instruction` means nothing
  ProfileSum& operator+=(const SpuProfile::Word& more);

  /// Cycles an instruction; 0 if none was executed.
  double cycles_per_instruction() const;
  /// Instructions that issued in pairs, both of each counted, of all; 0..1.
  double paired() const;
};

/// One function that was entered.
struct ProfiledFunction {
  std::string name; ///< as in the source; an address where no symbol says it
  std::uint32_t lsa = 0;
  ProfileSum sum;
  std::vector<std::uint32_t> words; ///< the addresses that were executed, rising
};

/// Thread safety: all members are const.
class ProfileReport {
public:
  /// The profile's words are copied.
  ProfileReport(const SpuProfile& profile, const SpuElf& elf);

  const ProfileSum& total() const { return total_; }
  /// By falling cycles.
  const std::vector<ProfiledFunction>& functions() const { return functions_; }

  std::string text(double listed) const;
  std::string json() const;

private:
  const SpuProfile::Word& word_at(std::uint32_t lsa) const { return words_[lsa / 4]; }
  std::string name_of(const FunctionSymbol* function, std::uint32_t lsa) const;
  void sort_into_functions();
  /// How often the instruction issued together with its neighbour.
  std::uint64_t pairs_of(std::uint32_t lsa) const;
  void append_table(std::string& text) const;
  void append_listing(std::string& text, const ProfiledFunction& function) const;
  void append_instruction(std::string& text, std::uint32_t lsa) const;

  std::vector<SpuProfile::Word> words_; ///< by word of local store
  CodePlaces places_;
  ProfileSum total_;
  std::vector<ProfiledFunction> functions_;
};

} // namespace celltrace::cell_emu

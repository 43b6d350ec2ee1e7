// Calls for help laid out by hand in a local store, as the SPU's C library lays them out.
#pragma once

#include "backends/cell_emu/simulator/big_endian.hpp"
#include "backends/cell_emu/simulator/ppe_calls.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <stdlib.h>

namespace celltrace::test {

/// One argument, 16 bytes: its first eight.
struct Slot {
  Slot(std::uint32_t word) : doubleword(std::uint64_t{word} << 32) {}
  Slot(int word) : Slot(static_cast<std::uint32_t>(word)) {}
  Slot(double value) : doubleword(std::bit_cast<std::uint64_t>(value)) {}
  static Slot wide(std::uint64_t value) {
    Slot slot(0);
    slot.doubleword = value;
    return slot;
  }
  std::uint64_t doubleword;
};

struct Answer {
  std::int32_t value = 0; ///< of 32 bits
  std::uint64_t wide = 0; ///< of 64 bits
  std::uint32_t spu_errno = 0;
};

/// 256 KB of local store and a PPE.
class FakeSpe {
public:
  static constexpr std::uint32_t kBytes = 256 * 1024;
  static constexpr std::uint32_t kWord = 0x100, kBlock = 0x200, kRegisters = 0x1000, kFrame = 0x1400,
                                 kStrings = 0x4000;

  explicit FakeSpe(cell_emu::PpeCallsConfig config = {})
      : local_store_(kBytes, 0xEE), ppe_(with_output(std::move(config))) {}

  std::uint8_t* local_store() { return local_store_.data(); }
  const std::string& out() const { return *out_; }
  const std::string& err() const { return *err_; }
  std::string take_out() { return std::exchange(*out_, {}); }

  /// Puts a string somewhere and returns its address.
  std::uint32_t text(const std::string& text) {
    const std::uint32_t at = next_text_;
    set_bytes(at, text + '\0');
    next_text_ += (static_cast<std::uint32_t>(text.size()) + 16) & ~15u;
    return at;
  }
  void set_bytes(std::uint32_t at, const std::string& bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      local_store_[at + i] = static_cast<std::uint8_t>(bytes[i]);
  }
  std::string text_at(std::uint32_t at) const {
    std::string text;
    for (; local_store_.at(at) != 0; ++at)
      text += static_cast<char>(local_store_[at]);
    return text;
  }
  template <class Integer> Integer load(std::uint32_t at) const {
    return cell_emu::load_big_endian<Integer>(local_store_.data() + at);
  }
  template <class Integer> void store(std::uint32_t at, Integer value) {
    cell_emu::store_big_endian<Integer>(local_store_.data() + at, value);
  }

  Answer call(unsigned code, unsigned operation, const std::vector<Slot>& arguments,
              std::uint32_t block = kBlock) {
    for (std::size_t i = 0; i < arguments.size(); ++i)
      store<std::uint64_t>(block + static_cast<std::uint32_t>(16 * i), arguments[i].doubleword);
    store<std::uint32_t>(kWord, operation << 24 | block);
    known_ = ppe_->handle(code, local_store(), kWord);
    return {static_cast<std::int32_t>(load<std::uint32_t>(block)), load<std::uint64_t>(block),
            load<std::uint32_t>(block + 12)};
  }
  /// With the word and what it points to as they are.
  bool handle(unsigned code) { return ppe_->handle(code, local_store(), kWord); }
  bool known() const { return known_; } ///< whether the last call was
  Answer c99(unsigned operation, const std::vector<Slot>& arguments) {
    return call(0x2100, operation, arguments);
  }
  Answer posix(unsigned operation, const std::vector<Slot>& arguments) {
    return call(0x2101, operation, arguments);
  }
  Answer memory(unsigned operation, const std::vector<Slot>& arguments) {
    return call(0x2105, operation, arguments);
  }

  /// The two slots of a va_list of these arguments: `registers` of them where registers are saved, the others
  /// behind the caller's frame.
  std::vector<Slot> variable(const std::vector<Slot>& arguments, std::size_t registers = 60) {
    const auto saved = static_cast<std::uint32_t>(std::min(registers, arguments.size()));
    const std::uint32_t first = kFrame - saved * 16;
    for (std::uint32_t i = 0; i < arguments.size(); ++i)
      store<std::uint64_t>(i < saved ? first + i * 16 : kFrame + 32 + (i - saved) * 16,
                           arguments[i].doubleword);
    return {first, kFrame};
  }
  Answer c99_variable(unsigned operation, std::vector<Slot> arguments,
                      const std::vector<Slot>& variable_arguments, std::size_t registers = 60) {
    for (const Slot& slot : variable(variable_arguments, registers))
      arguments.push_back(slot);
    return c99(operation, arguments);
  }

  /// What printf() prints.
  std::string printed(const std::string& format, const std::vector<Slot>& arguments) {
    take_out();
    next_text_ = kStrings + 0x8000;
    const Answer answer = c99_variable(37, {text(format)}, arguments);
    std::string result = take_out();
    if (answer.value != static_cast<std::int32_t>(result.size())) result += " and a wrong length";
    return result;
  }

private:
  std::unique_ptr<cell_emu::PpeCalls> with_output(cell_emu::PpeCallsConfig config) {
    if (!config.standard_output)
      config.standard_output = [out = out_](std::string_view text) { *out += text; };
    if (!config.standard_error) config.standard_error = [err = err_](std::string_view text) { *err += text; };
    return std::make_unique<cell_emu::PpeCalls>(std::move(config));
  }

  std::shared_ptr<std::string> out_ = std::make_shared<std::string>(), err_ = std::make_shared<std::string>();
  std::vector<std::uint8_t> local_store_;
  std::unique_ptr<cell_emu::PpeCalls> ppe_;
  std::uint32_t next_text_ = kStrings;
  bool known_ = false;
};

/// A folder that is gone afterwards.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "celltrace-XXXXXX").string();
    path_ = std::filesystem::canonical(::mkdtemp(name.data()));
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
  std::filesystem::path path_;
};

} // namespace celltrace::test

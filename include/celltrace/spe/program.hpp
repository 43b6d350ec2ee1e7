// SpeProgram, an SPE program as the PPE handles it: a name, an entry point for each SPU type that the program
// was compiled for, and machine code for SPUs that execute machine code.
#pragma once

#include "celltrace/export.hpp"
#include "celltrace/spe/types.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace celltrace {

/// Bytes of local store that a program takes on a real SPE besides its arena.
struct LocalStoreUse {
  unsigned code_bytes = 0; ///< code, constants and data
  unsigned stack_bytes = 0;
};

/// The exception that ends a program of host code on the emulated Cell, as if the program had returned with
/// this exit code.
struct CELLTRACE_EXPORT SpeExit {
  std::uint32_t code;
};

/// A kernel compiled for one or more backends. `Spu::kKey` names the SPU type ("cell_emu", "native.avx2",
/// ...); a machine picks the entry or the image whose key fits the machine best. Copyable; must not change
/// while a machine runs it.
class SpeProgram {
public:
  /// An entry point; `spu` is the address of the backend's Spu object.
  using Entry = std::function<void(void* spu, ea_t argument)>;

  explicit SpeProgram(std::string name) : name_(std::move(name)) {}

  /// Adds the kernel compiled for `Spu`. `kernel` is a captureless callable `void(Spu&, ea_t)`.
  template <class Spu, class Kernel> SpeProgram& add(Kernel) {
    static_assert(std::is_empty_v<Kernel>, "a kernel has no state of its own: pass it an argument ea");
    entries_[Spu::kKey] = [](void* spu, ea_t argument) { Kernel{}(*static_cast<Spu*>(spu), argument); };
    return *this;
  }
  /// Adds an entry point that was compiled elsewhere.
  SpeProgram& add(std::string key, Entry kernel) {
    entries_[std::move(key)] = kernel;
    return *this;
  }

  /// Adds machine code: the bytes of an ELF executable, which must outlive the program and its copies. Does
  /// not check the bytes. The key "cell_sim" stands for a kernel with the main() of backends/spu/main.cpp;
  /// "elf" for a stand-alone program, main(speid, argp, envp), whose argp is the argument of
  /// Machine::start().
  SpeProgram& add_image(std::string key, std::span<const std::uint8_t> elf) {
    images_[std::move(key)] = elf;
    return *this;
  }

  /// Sets the local store that the program takes in its build for the real SPU; by default the machine's
  /// configuration decides.
  SpeProgram& takes(LocalStoreUse use) {
    local_store_use_ = use;
    return *this;
  }

  const std::string& name() const noexcept { return name_; }
  const std::optional<LocalStoreUse>& local_store_use() const noexcept { return local_store_use_; }
  /// Returns the entry for an SPU type; empty if the program was not compiled for this type.
  Entry entry(const std::string& key) const noexcept {
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : found->second;
  }
  /// Returns the machine code for an SPU type, or no bytes if there is none.
  std::span<const std::uint8_t> image(const std::string& key) const noexcept {
    const auto found = images_.find(key);
    return found == images_.end() ? std::span<const std::uint8_t>() : found->second;
  }

private:
  std::string name_;
  std::optional<LocalStoreUse> local_store_use_;
  std::map<std::string, Entry> entries_;
  std::map<std::string, std::span<const std::uint8_t>> images_;
};

} // namespace celltrace

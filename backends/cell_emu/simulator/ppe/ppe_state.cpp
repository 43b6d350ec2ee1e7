#include "backends/cell_emu/simulator/ppe/ppe_state.hpp"

#include <array>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>

namespace celltrace::cell_emu {

namespace {

constexpr std::size_t kStandardFiles = 3;
constexpr unsigned kMostTries = 10000;

std::string numbered(std::string_view prefix, unsigned number) {
  std::array<char, 16> digits;
  std::snprintf(digits.data(), digits.size(), "%06u", number % 1000000);
  return std::string(prefix) + digits.data();
}

} // namespace

PpeState::PpeState(PpeCallsConfig c)
    : config(std::move(c)), folders(config.folders), files(config.max_open_files + kStandardFiles),
      streams(config.max_open_files + kStandardFiles), ea_heap(config.max_ea_bytes) {
  files.add(std::make_shared<InputText>(std::move(config.standard_input), config.more_input));
  files.add(std::make_shared<OutputText>(config.standard_output));
  files.add(std::make_shared<OutputText>(config.standard_error));
  streams.add(Stream(files, 0, true, false));
  streams.add(Stream(files, 1, false, true));
  streams.add(Stream(files, 2, false, true));
}

std::chrono::microseconds PpeState::now() const {
  using namespace std::chrono;
  if (config.clock) return config.clock();
  return sys_days(year(2007) / January / 1).time_since_epoch();
}

std::shared_ptr<HostFile> PpeState::open(std::string_view name, int host_flags, unsigned mode) const {
  const AllowedFolders::Place place = folders.locate(name);
  HostDescriptor file = folders.open(place, host_flags, mode & ~umask & 0777);
  return std::make_shared<HostFile>(std::move(file), place.path);
}

std::shared_ptr<HostFile> PpeState::make_temporary(std::string_view prefix, std::string& name) {
  for (unsigned i = 0; i < kMostTries; ++i) {
    name = numbered(prefix, temporary_files++);
    try {
      return open(name, O_RDWR | O_CREAT | O_EXCL, 0600);
    } catch (const CallFailed& failure) {
      if (failure.error != SpuErrno::exists) throw;
    }
  }
  throw CallFailed{SpuErrno::exists};
}

std::string PpeState::temporary_name(std::string_view prefix) {
  for (unsigned i = 0; i < kMostTries; ++i) {
    std::string name = numbered(prefix, temporary_files++);
    const AllowedFolders::Place place = folders.locate(name, AllowedFolders::SymlinkPolicy::keep);
    struct stat status;
    if (::fstatat(place.folder.get(), place.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return name;
  }
  throw CallFailed{SpuErrno::exists};
}

std::span<std::uint8_t> PpeState::effective_memory(std::uint64_t ea, std::uint64_t bytes) const {
  std::uint8_t* memory = ea_heap.at(ea, bytes);
  if (memory == nullptr && config.effective_memory) memory = config.effective_memory(ea, bytes);
  if (memory == nullptr) throw CallFailed{SpuErrno::fault};
  return {memory, static_cast<std::size_t>(bytes)};
}

} // namespace celltrace::cell_emu

// Work in parts, in threads of the host.
#pragma once

#include "scene/build_watch.hpp"

#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace celltrace {

/// Part `part` of `parts` of [0, count).
struct HostPart {
  std::uint32_t begin, end;

  HostPart(std::uint32_t count, unsigned part, unsigned parts)
      : begin(static_cast<std::uint32_t>(std::uint64_t{count} * part / parts)),
        end(static_cast<std::uint32_t>(std::uint64_t{count} * (part + 1) / parts)) {}
};

/// Calls work(part) for each part, in a thread each, and returns when all are done. What the first of them
/// that threw has thrown passes through. This thread's BuildWatch is theirs, too.
template <class Work> void for_each_part(unsigned parts, Work work) {
  std::vector<std::exception_ptr> failures(parts);
  BuildWatch* const watch = BuildWatch::current();
  const auto run = [&](unsigned part) noexcept {
    BuildWatch::follow(watch);
    try {
      work(part);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned part = 1; part < parts; ++part)
      others.emplace_back(run, part);
    run(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

} // namespace celltrace

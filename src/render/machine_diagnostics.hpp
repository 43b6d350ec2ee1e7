// Tells the caller what a machine finds wrong with its programs, as it is found.
#pragma once

#include "celltrace/error.hpp"
#include "celltrace/render.hpp"
#include "celltrace/spe/machine.hpp"

#include <new>
#include <type_traits>
#include <vector>

namespace celltrace {

class MachineDiagnostics {
public:
  /// `options` are asked at each call whom to tell.
  MachineDiagnostics(const Machine& machine, const RenderOptions& options)
      : machine_(machine), options_(options) {}

  /// Returns what the machine has found since the last call; the caller's function hears of it.
  std::vector<Diagnostic> take();

  /// Calls work(). Where it throws, what was found until then is told; memory that was missing becomes
  /// OutOfMemory.
  template <class Work> std::invoke_result_t<Work> reporting_failures(Work work) {
    try {
      return work();
    } catch (const std::bad_alloc&) {
      take();
      throw OutOfMemory();
    } catch (...) {
      take();
      throw;
    }
  }

private:
  const Machine& machine_;
  const RenderOptions& options_;
  std::size_t known_ = 0;
};

} // namespace celltrace

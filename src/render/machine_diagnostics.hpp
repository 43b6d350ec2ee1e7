// Reports to the caller the rules that programs break on a machine, as they are found.
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
  /// Refers to the options, which name the caller's function and are read at each call.
  MachineDiagnostics(const Machine& machine, const RenderOptions& options)
      : machine_(machine), options_(options) {}

  /// Returns the machine's diagnostics since the last call, after passing them to the caller's function.
  std::vector<Diagnostic> take();

  /// Calls work(). If it throws, reports the diagnostics so far; a failed allocation becomes OutOfMemory.
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

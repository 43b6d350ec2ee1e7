// Detects Ctrl-C, and the end of a run's time limit, for renders that ask.
#pragma once

namespace celltrace::cli {

/// Makes the first SIGINT or SIGTERM set interrupted() to true from now on; a later one ends the process.
void catch_interrupts();

/// Makes interrupted() true after this many seconds, too, and replaces an earlier limit; 0 removes the limit.
/// Call it while no other thread calls interrupted().
void interrupt_after(double seconds);

/// Returns whether the run was interrupted; safe from any thread.
bool interrupted() noexcept;

/// Returns the cause of the interrupt, for messages.
const char* interruption() noexcept;

} // namespace celltrace::cli

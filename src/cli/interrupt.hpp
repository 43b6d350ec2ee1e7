// Ctrl-C as a question that a render can ask.
#pragma once

namespace celltrace::cli {

/// From now on the first SIGINT or SIGTERM only makes interrupted() true; a later one ends the process.
void catch_interrupts();

/// Async-signal-safe and safe from any thread.
bool interrupted() noexcept;

} // namespace celltrace::cli

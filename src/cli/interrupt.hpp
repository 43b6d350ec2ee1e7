// Ctrl-C, and the end of the time that a run has, as a question that a render can ask.
#pragma once

namespace celltrace::cli {

/// From now on the first SIGINT or SIGTERM only makes interrupted() true; a later one ends the process.
void catch_interrupts();

/// Makes interrupted() true after so many seconds from now, too, in place of an earlier limit; 0: there is
/// none. To be called while no other thread asks.
void interrupt_after(double seconds);

/// Safe from any thread.
bool interrupted() noexcept;

/// Says what has made interrupted() true, for messages.
const char* interruption() noexcept;

} // namespace celltrace::cli

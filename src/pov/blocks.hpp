// What words and names are for the grammar in the blocks of the language.
#pragma once

#include "pov/block.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// The block that a brace behind a terminal opens.
Block block_behind(int terminal);
/// What a reserved word's token is in a block: a word for something that this block may have in POV-Ray only
/// is unsupported there, and what it can never have is misplaced.
int terminal_in(Block block, int token);
/// Whether the name of such a pigment, finish, fog or the like can stand in a block.
bool takes(Block block, const Value& named);

} // namespace celltrace::pov

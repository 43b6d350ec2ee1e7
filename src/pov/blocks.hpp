// Meanings of words and names in the blocks of the language, as the grammar sees them.
#pragma once

#include "pov/block.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

/// Returns the block that a brace behind a terminal opens.
Block block_behind(int terminal);
/// Returns a reserved word's token in a block: a word for something that the block has in POV-Ray only is
/// unsupported there, and a word that it never has is misplaced.
int terminal_in(Block block, int token);
/// Tells whether the name of such a pigment, finish, fog or the like can stand in a block.
bool takes(Block block, const Value& named);

} // namespace celltrace::pov

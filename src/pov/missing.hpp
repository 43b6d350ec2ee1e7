// Features that this program lacks, where the grammar comes upon them.
#pragma once

#include <string>

#include "pov/object.hpp"
#include "pov/session.hpp"
#include "pov/unsupported.hpp"

namespace celltrace::pov {

std::string quoted(Session& session, NameId name);
std::string quoted_pattern(int pattern);
UnsupportedPtr make_unsupported(const std::string& what, const Location& where);
/// Returns a feature that is not supported, and skips its arguments.
UnsupportedPtr unsupported_feature(Session& session, const std::string& what, const Location& where);
/// Returns whether the quality is one at which POV-Ray renders media, photons and radiosity: 9 and more.
bool renders_media(const Session& session);
/// Returns the feature of a word with a block in braces, which is not skipped; null if the word has no effect
/// at the picture's quality.
UnsupportedPtr unsupported_block(Session& session, NameId word, const Location& where);
/// Returns the feature if `value` is not 0, otherwise null.
UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where);
/// Returns an object that is left out, or is an error, where it is placed.
ObjectPtr unsupported_object(const std::string& what, const Location& where);

} // namespace celltrace::pov

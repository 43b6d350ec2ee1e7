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
/// Passes over what belongs to it, too.
UnsupportedPtr unsupported_feature(Session& session, const std::string& what, const Location& where);
/// Null for zero.
/// Whether the picture will have what POV-Ray renders from quality 9 on: media, photons and radiosity.
bool renders_media(const Session& session);
/// A word with a block in braces, which is not passed over; nothing if it means nothing at the picture's
/// quality.
UnsupportedPtr unsupported_block(Session& session, NameId word, const Location& where);
UnsupportedPtr unless_zero(const std::string& what, double value, const Location& where);
/// An object that is left out, or refused, where it is placed.
ObjectPtr unsupported_object(const std::string& what, const Location& where);

} // namespace celltrace::pov

// Text objects: one solid for each glyph of a font, in a row.
#pragma once

#include <memory>
#include <string>

#include "celltrace/scene.hpp"
#include "pov/location.hpp"

namespace celltrace::pov {

struct Session;
struct ObjectDefinition;

/// A text object as written.
struct WrittenText {
  std::string font; ///< name of its file
  std::string text;
  double depth = 1;
  Vec3 offset{0, 0, 0}; ///< added to the place of each next glyph, once more each time
};

/// Returns the name of the font file that POV-Ray knows by a number.
std::string internal_font(double number);

/// Returns a union of the glyphs. Fails if the font cannot be found or read.
std::shared_ptr<ObjectDefinition> text_object(Session& session, const WrittenText& written, const Location& where);

} // namespace celltrace::pov

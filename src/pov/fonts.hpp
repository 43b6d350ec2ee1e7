// Outlines of glyphs, by FreeType where the build has it.
#pragma once

#include "celltrace/scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace celltrace::pov {

/// A glyph in units of the font's em.
struct Glyph {
  std::vector<CurveSegment> outline; ///< closed loops; x to the right and y up, from the pen's place on the line
  double left = 0;                   ///< from the pen to the glyph's left edge
  double advance = 0;                ///< from the pen to the next glyph's pen
};

/// A font file that has been read. Not for several threads at once.
class Font {
public:
  /// Throws InputError, without a position, if the bytes are no font or the build has no FreeType.
  explicit Font(std::string bytes);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  /// Returns the number of the glyph for a character; 0, which stands for missing ones, if there is none.
  /// `is_unicode` says in which of the font's tables POV-Ray looks first.
  unsigned glyph_of(unsigned character, bool is_unicode);
  /// Throws InputError, without a position, if the glyph cannot be read.
  Glyph glyph(unsigned number);
  /// Returns by how much the second glyph moves to the right behind the first one.
  double kerning(unsigned first, unsigned second);

private:
  struct Face;
  std::unique_ptr<Face> face_;
};

} // namespace celltrace::pov

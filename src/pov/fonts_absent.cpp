#include "celltrace/error.hpp"
#include "pov/fonts.hpp"

namespace celltrace::pov {

struct Font::Face {};

Font::Font(std::string) {
  throw InputError("fonts cannot be read, as celltrace was built without FreeType; on Debian it is in the package "
                   "'libfreetype-dev'");
}
Font::~Font() = default;
unsigned Font::glyph_of(unsigned, bool) {
  return 0;
}
Glyph Font::glyph(unsigned) {
  return {};
}
double Font::kerning(unsigned, unsigned) {
  return 0;
}

} // namespace celltrace::pov

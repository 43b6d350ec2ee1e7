#include "pov/text_objects.hpp"

#include "celltrace/error.hpp"
#include "pov/actions.hpp"
#include "pov/fonts.hpp"
#include "pov/object.hpp"
#include "pov/session.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace celltrace::pov {

namespace {

/// Returns the characters of a text: its bytes, or the code points that they encode if they are UTF-8.
std::vector<unsigned> characters_of(const std::string& text, bool is_unicode) {
  std::vector<unsigned> characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u; };
    const unsigned lead = byte(i++);
    const unsigned more = !is_unicode || lead < 0xC0 ? 0 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    unsigned character = more == 0 ? lead : lead & (0x3Fu >> more);
    for (unsigned k = 0; k < more && (byte(i) & 0xC0u) == 0x80; ++k)
      character = character << 6 | (byte(i++) & 0x3Fu);
    characters.push_back(character);
  }
  return characters;
}

} // namespace

std::string internal_font(double number) {
  const char* const names[] = {"timrom.ttf", "cyrvetic.ttf", "crystal.ttf"};
  const double n = std::trunc(number);
  return n >= 1 && n <= 3 ? names[static_cast<int>(n) - 1] : "povlogo.ttf";
}

std::shared_ptr<ObjectDefinition> text_object(Session& session, const WrittenText& written,
                                              const Location& where) {
  Compound row;
  std::string bytes = session.tokens.read_font(written.font, where);
  try {
    Font font(std::move(bytes));
    std::map<unsigned, std::pair<Glyph, Shape>> known; // glyphs that occur again share their shape
    double pen = 0;
    unsigned before = 0;
    Vec3 offset(0);
    bool is_first = true;
    for (const unsigned character : characters_of(written.text, session.reads_utf8)) {
      const unsigned number = font.glyph_of(character, session.reads_utf8);
      auto place = known.find(number);
      if (place == known.end()) {
        Glyph glyph = font.glyph(number);
        auto prism = std::make_shared<Prism>();
        prism->outline = std::move(glyph.outline);
        prism->bottom = std::min(0.0, written.depth);
        prism->top = std::max(0.0, written.depth);
        place = known.emplace(number, std::pair(std::move(glyph), Shape(std::shared_ptr<const Prism>(prism)))).first;
      }
      const auto& [glyph, shape] = place->second;
      // The first glyph's left edge is at 0.
      const double kerning = is_first ? 0 : font.kerning(before, number);
      const double x = is_first ? -glyph.left : pen + kerning;
      pen = x + glyph.advance;
      if (!std::get<std::shared_ptr<const Prism>>(shape)->outline.empty()) {
        auto solid = std::make_shared<ObjectDefinition>();
        solid->shape = shape;
        // The prism's outline in x and z becomes the glyph's in x and y, and its height the depth.
        solid->transform.rows[1] = Vec3(0, 0, 1);
        solid->transform.rows[2] = Vec3(0, 1, 0);
        solid->transform.rows[3] = Vec3(x, 0, 0) + offset;
        solid->where = where;
        append(session, row.parts, ObjectPtr(solid), where);
      }
      offset += written.offset;
      before = number;
      is_first = false;
    }
  } catch (const InputError& error) {
    session.fail(where, "font '" + written.font + "': " + error.what());
  }
  auto object = std::make_shared<ObjectDefinition>();
  for (const ObjectPtr& part : row.parts)
    nest(session, *object, *part, where);
  object->shape = std::make_shared<const Compound>(std::move(row));
  // POV-Ray turns texts by a little.
  constexpr double kTurn = 0.001;
  object->transform = Transform::rotate(Vec3(kTurn));
  return object;
}

} // namespace celltrace::pov

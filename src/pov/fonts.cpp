#include "pov/fonts.hpp"

#include "celltrace/error.hpp"

#include <algorithm>
#include <utility>

#include <ft2build.h>

#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

namespace celltrace::pov {

/// FreeType's objects, and the bytes that they refer to.
struct Font::Face {
  std::string bytes;
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  double em = 1; ///< units per em

  ~Face() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
};

Font::Font(std::string bytes) : face_(std::make_unique<Face>()) {
  face_->bytes = std::move(bytes);
  if (FT_Init_FreeType(&face_->library) != 0) throw InputError("FreeType cannot be started");
  if (FT_New_Memory_Face(face_->library, reinterpret_cast<const FT_Byte*>(face_->bytes.data()),
                         static_cast<FT_Long>(face_->bytes.size()), 0, &face_->face) != 0 ||
      !FT_IS_SCALABLE(face_->face) || face_->face->units_per_EM == 0)
    throw InputError("this is no font with outlines");
  face_->em = face_->face->units_per_EM;
}

Font::~Font() = default;

unsigned Font::glyph_of(unsigned character, bool is_unicode) {
  constexpr int kUnicode = 0, kMacintosh = 1, kWindows = 3; // platforms of the font format
  constexpr int kAscii[] = {kMacintosh, kWindows, kUnicode}, kOther[] = {kUnicode, kWindows, kMacintosh};
  FT_Face face = face_->face;
  for (const int platform : is_unicode ? kOther : kAscii) {
    FT_CharMap* const end = face->charmaps + face->num_charmaps;
    FT_CharMap* const map = std::find_if(face->charmaps, end, [&](FT_CharMap m) {
      const FT_Long format = FT_Get_CMap_Format(m);
      return m->platform_id == platform && (format == 0 || format == 4 || format == 6);
    });
    if (map == end || FT_Set_Charmap(face, *map) != 0) continue;
    const FT_UInt glyph = FT_Get_Char_Index(face, character);
    constexpr unsigned kSymbols = 0xF000; // where fonts of symbols have their first 256 characters
    if (glyph == 0 && character < 256 && FT_Get_CMap_Format(*map) == 4)
      return FT_Get_Char_Index(face, kSymbols + character);
    return glyph;
  }
  return 0;
}

namespace {

/// Builds the outline from FreeType's moves, lines and curves.
class OutlineBuilder {
public:
  explicit OutlineBuilder(double scale) : scale_(scale) {}

  static int move(const FT_Vector* to, void* self) {
    static_cast<OutlineBuilder*>(self)->begin(*to);
    return 0;
  }
  static int line(const FT_Vector* to, void* self) {
    static_cast<OutlineBuilder*>(self)->add({}, {}, *to, 1);
    return 0;
  }
  static int conic(const FT_Vector* control, const FT_Vector* to, void* self) {
    static_cast<OutlineBuilder*>(self)->add(*control, {}, *to, 2);
    return 0;
  }
  static int cubic(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* self) {
    static_cast<OutlineBuilder*>(self)->add(*first, *second, *to, 3);
    return 0;
  }

  std::vector<CurveSegment> finish() {
    close();
    return std::move(outline_);
  }

private:
  struct Point {
    double x = 0, y = 0;
  };
  Point scaled(const FT_Vector& v) const {
    return {static_cast<double>(v.x) * scale_, static_cast<double>(v.y) * scale_};
  }
  void begin(const FT_Vector& at) {
    close();
    start_ = here_ = scaled(at);
  }
  void close() {
    if (here_.x != start_.x || here_.y != start_.y) add_segment({}, {}, start_, 1);
  }
  void add(const FT_Vector& first, const FT_Vector& second, const FT_Vector& to, int degree) {
    add_segment(scaled(first), scaled(second), scaled(to), degree);
  }
  void add_segment(const Point& b, const Point& c, const Point& to, int degree) {
    const auto of_axis = [&](double p, double q, double r, double s, std::array<double, 4>& k) {
      k[0] = p;
      k[1] = degree == 1 ? s - p : degree == 2 ? 2 * (q - p) : 3 * (q - p);
      k[2] = degree == 1 ? 0 : degree == 2 ? p - 2 * q + s : 3 * (p - 2 * q + r);
      k[3] = degree == 3 ? s - p + 3 * (q - r) : 0;
    };
    CurveSegment segment;
    of_axis(here_.x, b.x, c.x, to.x, segment.x);
    of_axis(here_.y, b.y, c.y, to.y, segment.y);
    if (here_.x != to.x || here_.y != to.y || degree > 1) outline_.push_back(segment);
    here_ = to;
  }

  double scale_;
  Point start_, here_;
  std::vector<CurveSegment> outline_;
};

} // namespace

Glyph Font::glyph(unsigned number) {
  FT_Face face = face_->face;
  if (FT_Load_Glyph(face, number, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0 ||
      face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
    throw InputError("a glyph of this font cannot be read");
  const double scale = 1 / face_->em;
  OutlineBuilder builder(scale);
  FT_Outline_Funcs functions = {};
  functions.move_to = OutlineBuilder::move;
  functions.line_to = OutlineBuilder::line;
  functions.conic_to = OutlineBuilder::conic;
  functions.cubic_to = OutlineBuilder::cubic;
  if (FT_Outline_Decompose(&face->glyph->outline, &functions, &builder) != 0)
    throw InputError("a glyph of this font cannot be read");
  Glyph glyph;
  glyph.outline = builder.finish();
  glyph.left = static_cast<double>(face->glyph->metrics.horiBearingX) * scale;
  glyph.advance = static_cast<double>(face->glyph->metrics.horiAdvance) * scale;
  return glyph;
}

double Font::kerning(unsigned first, unsigned second) {
  FT_Vector by = {0, 0};
  if (!FT_HAS_KERNING(face_->face) || FT_Get_Kerning(face_->face, first, second, FT_KERNING_UNSCALED, &by) != 0)
    return 0;
  return static_cast<double>(by.x) / face_->em;
}

} // namespace celltrace::pov

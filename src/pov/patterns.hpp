// The patterns of pigments, normals and textures, as written. Each of them is one entry of a table in
// patterns.cpp: its word, what stands behind it, the words that only it understands, its wave and its colours
// where the scene gives none. The language's words come from there too.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "celltrace/texture.hpp"
#include "pov/location.hpp"
#include "pov/quantity.hpp"
#include "pov/unsupported.hpp"

namespace celltrace::pov {

struct Session;

/// What stands behind a pattern's word.
enum class PatternForm {
  plain,    ///< nothing of its own
  argument, ///< a number or a vector
  list,     ///< one colour, pigment, normal or texture for each of its numbers
  special   ///< by a rule of the grammar that is for its word alone
};

struct PatternWord {
  const char* word;
  PatternForm form;
};
/// All of them; a word's place is the pattern's number.
std::vector<PatternWord> pattern_words();

struct PatternOption {
  const char* word;
  bool has_value;
};
/// The words that only some patterns understand; a word's place is the option's number.
std::vector<PatternOption> pattern_options();

inline constexpr int kNoPattern = -1;

/// A pattern and its modifiers.
struct PatternDefinition {
  int number = kNoPattern; ///< its place in pattern_words()
  UnsupportedPtr unsupported;
  int inner_depth = 0;                 ///< of the maps of a pigment that is the pattern, which is one itself
  bool inner_asks_for_surface = false; ///< what that asks of surfaces is more than points

  const Pattern& value() const;
  /// To change it.
  Pattern& own();
  bool exists() const { return number != kNoPattern; }
  bool is_average() const;
  bool is_for_normals_alone() const;
  /// How many entries its list has; 0 of others.
  std::size_t list_length() const;
  /// The colours it has without a map.
  std::vector<PatternMap<Pigment>::Entry> default_colours() const;

private:
  std::shared_ptr<Pattern> value_; ///< shared by copies until one of them changes; null: as patterns are made
};

/// Puts a pattern, if there is one, on surface coordinates. As it is done when all of it is said, nothing
/// moves or changes it any more.
void put_on_surface(PatternDefinition& pattern);
bool is_on_surface(const PatternDefinition& pattern);
/// Whether it depends on more of a surface than points.
bool asks_for_surface(const PatternDefinition& pattern);
/// Makes `pattern` the one with this number. What modifiers have done to it stays, but for the wave if the
/// new pattern has one of its own, and unless it was on surface coordinates.
void choose(PatternDefinition& pattern, int number);
void set_argument(Session& session, PatternDefinition& pattern, const Quantity& argument,
                  const Location& where);
/// Fails if the option is not the pattern's. `value` means nothing if the option has none.
void set_option(Session& session, PatternDefinition& pattern, int option, const Quantity& value,
                const Location& where);

/// Moves the pattern, after everything that was done to its space before. Fails if there is no way back.
void move(Session& session, PatternDefinition& pattern, const Transform& next, const Location& where);
void bend(Session& session, PatternDefinition& pattern, const SpaceStep& warp, const Location& where);
/// Whether normals of it do not come from values nearby.
bool has_own_slopes(const PatternDefinition& pattern);
/// Makes it one of a kind that only one word stands for.
void choose(PatternDefinition& pattern, const pattern::Kind& kind);
/// The number of the pattern of such a kind.
int number_of(const pattern::Kind& kind);
/// The number of `average`, whose kind means nothing.
int average_number();
/// What a pattern makes of space as a warp; nothing if it makes none.
std::optional<warp::Mapping::Shape> mapping_shape(int number);

/// Adds a transformation to what is done to a space.
void append(std::vector<SpaceStep>& space, const Transform& next);
bool is_singular(const Transform& transform);
/// Warns of a pattern that is moved to no finite place, and returns what moves it instead: one point of it is
/// everywhere then, nearly its origin.
Transform spread_point(Session& session, const Location& where);

} // namespace celltrace::pov

// The patterns of pigments, normals and textures, as written. Each pattern is one entry of a table in
// patterns.cpp: its word, its arguments, the words that only it understands, its wave, and its default
// colours. The language's words come from this table, too.
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

/// The arguments that follow a pattern's word.
enum class PatternForm {
  plain,    ///< none
  argument, ///< a number or a vector
  list,     ///< one colour, pigment, normal or texture for each value
  special   ///< read by a grammar rule for this word alone
};

struct PatternWord {
  const char* word;
  PatternForm form;
};
/// Returns all patterns; a word's index is the pattern's number.
std::vector<PatternWord> pattern_words();

struct PatternOption {
  const char* word;
  bool has_value;
};
/// Returns the words that only some patterns understand; a word's index is the option's number.
std::vector<PatternOption> pattern_options();

inline constexpr int kNoPattern = -1;

/// A pattern and its modifiers.
struct PatternDefinition {
  int number = kNoPattern; ///< index in pattern_words()
  UnsupportedPtr unsupported;
  int inner_depth = 0; ///< if a pigment is the pattern: depth of its maps, itself included
  bool inner_depends_on_surface =
      false; ///< if a pigment is the pattern: it depends on more of a surface than points

  const Pattern& value() const;
  /// Returns the pattern for changing.
  Pattern& own();
  bool exists() const { return number != kNoPattern; }
  bool is_average() const;
  bool is_for_normals_alone() const;
  /// Returns the number of entries in its list; 0 if it takes none.
  std::size_t list_length() const;
  /// Returns the colours that it has without a map.
  std::vector<PatternMap<Pigment>::Entry> default_colours() const;

private:
  std::shared_ptr<Pattern> value_; ///< shared by copies until one of them changes; null: a default pattern
};

/// Puts a pattern, if there is one, on surface coordinates. The pattern must be complete: nothing moves or
/// changes it afterwards.
void put_on_surface(PatternDefinition& pattern);
bool is_on_surface(const PatternDefinition& pattern);
/// Returns whether a pattern depends on more of a surface than points.
bool depends_on_surface(const PatternDefinition& pattern);
/// Makes `pattern` the one with this number. Earlier modifiers keep their effect, unless it was on surface
/// coordinates; but a new pattern with a wave or a frequency of its own sets that.
void choose(PatternDefinition& pattern, int number);
void set_argument(Session& session, PatternDefinition& pattern, const Quantity& argument,
                  const Location& where);
/// Sets an option; fails if it is not one of the pattern's. `value` is ignored if the option takes none.
void set_option(Session& session, PatternDefinition& pattern, int option, const Quantity& value,
                const Location& where);

/// Moves the pattern after all earlier changes to its space. Fails if the transformation is singular.
void move(Session& session, PatternDefinition& pattern, const Transform& next, const Location& where);
void bend(Session& session, PatternDefinition& pattern, const SpaceStep& warp, const Location& where);
/// Returns whether the pattern computes normals directly instead of from values nearby.
bool has_own_slopes(const PatternDefinition& pattern);
/// Makes it the pattern of a kind that only one word stands for.
void choose(PatternDefinition& pattern, const pattern::Kind& kind);
int number_of(const pattern::Kind& kind);
/// Returns the number of `average`, which has no kind of its own.
int average_number();
/// Returns the shape of a pattern's warp; nothing if the pattern is none.
std::optional<warp::Mapping::Shape> mapping_shape(int number);

/// Appends a transformation to the steps of a space.
void append(std::vector<SpaceStep>& space, const Transform& next);
bool is_singular(const Transform& transform);
/// Warns of a pattern that is moved to no finite place, and returns the transformation to use instead, which
/// spreads one point near the pattern's origin over all of space.
Transform spread_point(Session& session, const Location& where);

} // namespace celltrace::pov

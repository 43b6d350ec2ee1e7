// Textures in the style before version 3.0, in which parts of the pigment, the normal and the finish stand in
// the texture itself.
#include "pov/actions.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace celltrace::pov {

namespace {

/// Patterns that stand for normals in such textures; from version 3.0 on they may be pigments, too.
constexpr std::string_view kNormals[] = {"bumps", "dents", "ripples", "waves", "wrinkles"};

bool is_normal(int pattern) {
  const std::string_view word = pattern_words()[static_cast<std::size_t>(pattern)].word;
  return std::find(std::begin(kNormals), std::end(kNormals), word) != std::end(kNormals);
}

std::shared_ptr<NormalDefinition> normal_of(const TextureDefinition& texture) {
  return texture.normal ? std::make_shared<NormalDefinition>(*texture.normal)
                        : std::make_shared<NormalDefinition>();
}

TexturePtr with_grain(const TexturePtr& texture, double grain) {
  return with_old_finish(texture,
                         [grain](FinishDefinition& finish) { finish.value.crand = std::max(grain, 0.0); });
}

} // namespace

TexturePtr with_old_finish(const TexturePtr& texture, const std::function<void(FinishDefinition&)>& change) {
  FinishDefinition finish = texture->finish;
  change(finish);
  return with_finish(texture, finish);
}

TexturePtr with_old_colour(Session& session, const TexturePtr& texture, const Quantity& colour) {
  if (colour.is_float()) return with_grain(texture, colour.v[0]);
  PigmentDefinition pigment = texture->pigment;
  set_colour(pigment, session.surface(colour));
  return with_pigment(texture, pigment);
}

TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, int pattern,
                            std::optional<double> number) {
  if (!is_normal(pattern)) {
    const TexturePtr changed =
        with_old_pattern(session, texture, [pattern](Session&, PatternDefinition& own) {
          choose(own, pattern);
          own.own().wave = Pattern::Wave::ramp; // also replaces the wave of marble and wood
        });
    return number ? with_grain(changed, *number) : changed;
  }
  const auto normal = normal_of(*texture);
  choose(normal->pattern, pattern);
  normal->amount = number.value_or(normal->amount);
  return with_normal(texture, normal);
}

TexturePtr with_old_pattern(Session& session, const TexturePtr& texture, const PatternChange& change) {
  PigmentDefinition pigment = texture->pigment;
  change(session, pigment.pattern);
  return with_pigment(texture, pigment);
}

TexturePtr with_old_colours(Session& session, const TexturePtr& texture, int pattern, const PigmentMap& list,
                            const Location& where) {
  PigmentDefinition pigment = texture->pigment;
  set_colours(session, pigment, pattern, list, where);
  return with_pigment(texture, pigment);
}

TexturePtr with_old_map(Session& session, const TexturePtr& texture, const PigmentMap& map,
                        const Location& where) {
  PigmentDefinition pigment = texture->pigment;
  set_old_map(session, pigment, map, where);
  return with_pigment(texture, pigment);
}

TexturePtr with_old_waves(Session& session, const TexturePtr& texture, const PatternChange& change) {
  const auto normal = normal_of(*texture);
  change(session, normal->pattern);
  return with_normal(texture, normal);
}

} // namespace celltrace::pov

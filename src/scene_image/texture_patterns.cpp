// The records of patterns.
#include "geometry/pattern_tables.hpp"
#include "kernel/textures/list.hpp"
#include "scene_image/function_code.hpp"
#include "scene_image/pattern_offsets.hpp"
#include "scene_image/texture_room.hpp"
#include "scene_image/textures.hpp"

#include <algorithm>
#include <iterator>

namespace celltrace {

using namespace kernel;

namespace {

void set(const Transform& to_space, float (&m)[12]) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      m[row * 4 + column] = static_cast<float>(to_space.rows[column][row]);
}

/// Returns whether a pattern's values depend on more than the point.
bool depends_on_surface(const PatternRecord& r) {
  return (r.kind_and_flags & pattern_flag::uv_mapping) != 0 ||
         Patterns::kReadSurfaces[r.kind_and_flags & pattern_flag::kind_mask];
}

} // namespace

TextureTables::Known TextureTables::add_pattern(const Pattern& pattern, const PatternSpace& outer,
                                                const PatternSpace& inside, bool is_average,
                                                std::size_t entry_count) {
  PatternRecord r{};
  PatternSpace space = space_of(pattern, outer);
  PlacedPattern placed = {pattern.kind, {}, pattern.phase};
  if (!is_average && !space.uv_mapping) {
    placed = near_own_origin(pattern, space.steps);
    space.steps = std::move(placed.space);
  }
  const auto* grey = is_average ? nullptr : std::get_if<pattern::Grey>(&pattern.kind);
  Known of_grey{0, {}};
  if (grey != nullptr) of_grey = add_pigment(*grey->of, inside);
  r.entries = r.steps = 0;
  r.entry_count = static_cast<std::uint32_t>(entry_count);
  tables_.push_back(PatternTable::none);
  if (is_average) {
    r.kind_and_flags = pattern_flag::average;
  } else {
    const PatternWords words = pattern_words(placed.kind, scene_.number_of_waves);
    r.kind_and_flags = words.kind_and_flags;
    std::copy(std::begin(words.parameter), std::end(words.parameter), r.parameter);
    const std::uint32_t kind = r.kind_and_flags & pattern_flag::kind_mask;
    const PatternWave wave =
        Patterns::kAreLists[kind] ? PatternWave::none : static_cast<PatternWave>(pattern.wave);
    r.kind_and_flags |= static_cast<std::uint32_t>(wave) << pattern_flag::wave_shift;
    const int generator = pattern.noise_generator == 0 ? scene_.noise_generator : pattern.noise_generator;
    if (generator == 1) r.kind_and_flags |= pattern_flag::first_generator;
    const bool is_gradient_noise = generator == 3 && Patterns::kReadNoise[kind];
    if (is_gradient_noise) r.kind_and_flags |= pattern_flag::gradient_noise;
    if (!is_still(pattern.turbulence)) {
      if (is_moved_by_turbulence(pattern.kind)) r.kind_and_flags |= pattern_flag::turbulent;
      if (Patterns::kAreShifted[kind]) r.kind_and_flags |= pattern_flag::shifted;
    }
    r.table = words.fractal;
    tables_.back() = pattern_table(r.kind_and_flags);
    if (tables_.back() == PatternTable::slopes) {
      r.table = static_cast<std::uint32_t>(slopes.size());
      slopes.push_back(words.slope);
    }
    if (tables_.back() == PatternTable::pictures) {
      r.table = static_cast<std::uint32_t>(pictures.size());
      pictures.push_back(words.picture);
      const auto* const image = std::get_if<pattern::ImageMap>(&placed.kind);
      pictures.back().tiles = tiles_of(
          image != nullptr ? image->map.picture : std::get<pattern::ImageGrey>(placed.kind).map.picture);
    }
    if (const auto* function = std::get_if<pattern::Function>(&placed.kind)) {
      const std::vector<FunctionStepRecord> code = function_code(*function->code);
      make_room(function_steps, code.size(), "functions");
      r.table = static_cast<std::uint32_t>(function_steps.size());
      r.parameter[0] = static_cast<float>(code.size());
      function_steps.insert(function_steps.end(), code.begin(), code.end());
    }
    if (grey != nullptr) {
      r.table = of_grey.index;
      r.kind_and_flags |= pattern_flag::nested;
    }
    if (const auto* solid = std::get_if<pattern::Inside>(&placed.kind)) {
      r.table = static_cast<std::uint32_t>(objects.size());
      objects.push_back(solid->of);
    }
    add_table(tables_.back());
  }
  // A frequency of 0 leaves values as they are.
  const bool is_own = pattern.frequency == 0;
  if (is_own) r.kind_and_flags |= pattern_flag::never_repeats;
  r.frequency = static_cast<float>(is_own ? 1 : pattern.frequency);
  r.phase = static_cast<float>(is_own ? 0 : placed.phase);
  r.wave_exponent = static_cast<float>(pattern.wave_exponent);
  r.turbulence = words_of(pattern.turbulence);
  if (space.uv_mapping) r.kind_and_flags |= pattern_flag::uv_mapping;
  add_steps(r, space.steps);
  make_room(patterns, 1, "patterns");
  patterns.push_back(r);
  Traits traits;
  traits.by_surface = depends_on_surface(r) || of_grey.traits.by_surface;
  return {static_cast<std::uint32_t>(patterns.size() - 1), traits};
}

/// Returns the index of the first tile of a picture, which is added once for all patterns that read it.
std::uint32_t TextureTables::tiles_of(const std::shared_ptr<const Picture>& picture) {
  const auto [known, is_new] =
      known_pictures_.try_emplace(picture.get(), static_cast<std::uint32_t>(texel_tiles.size()));
  if (!is_new) return known->second;
  constexpr int kSide = TexelTileRecord::kSide;
  const int columns = (picture->width + kSide - 1) / kSide, rows = (picture->height + kSide - 1) / kSide;
  make_room(texel_tiles, static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), "pictures");
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      TexelTileRecord tile{};
      for (int i = 0; i < kSide * kSide; ++i) {
        const int x = std::min(column * kSide + i % kSide, picture->width - 1),
                  y = std::min(row * kSide + i / kSide, picture->height - 1);
        const auto& texel = picture->texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture->width) +
                                            static_cast<std::size_t>(x)];
        tile.word[2 * i] = std::uint32_t{texel[0]} << 16 | texel[1];
        tile.word[2 * i + 1] = std::uint32_t{texel[2]} << 16 | texel[3];
      }
      texel_tiles.push_back(tile);
    }
  return known->second;
}

void TextureTables::add_table(PatternTable table) {
  if (table == PatternTable::waves && waves.empty()) waves = make_waves(scene_.number_of_waves);
  if (table == PatternTable::gradients && gradients.empty()) gradients = make_gradients();
  const bool has_features = table == PatternTable::features || table == PatternTable::gradients;
  if (has_features && features.empty()) features = make_features();
}

/// Adds the steps of a space in the order in which points go through them; `space` has the reverse order.
void TextureTables::add_steps(PatternRecord& r, const std::vector<SpaceStep>& space) {
  const auto first_step = static_cast<std::uint32_t>(steps.size());
  r.steps = first_step;
  Transform map;
  const auto end_map = [&] {
    set(map, steps.size() == first_step ? r.to_space : steps.back().to_space);
    map = Transform();
  };
  for (auto step = space.rbegin(); step != space.rend(); ++step) {
    if (const auto* transform = std::get_if<Transform>(&*step)) {
      map = map.then(transform->inverse());
      continue;
    }
    if (const auto* moved = std::get_if<Turbulence>(&*step); moved && is_still(*moved)) continue;
    end_map();
    make_room(steps, 1, "warps of patterns");
    steps.push_back(record_of(*step));
    if (reads_features(steps.back())) add_table(PatternTable::features);
  }
  end_map();
  r.step_count = static_cast<std::uint32_t>(steps.size()) - first_step;
}

} // namespace celltrace

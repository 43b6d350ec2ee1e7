// Tables of the items of patterns, pigments, normals and warps.
#include <cmath>

#include "pov/item_tables.hpp"

namespace celltrace::pov {

namespace {

using Form = ItemForm;

template <Pattern::Wave wave> void set_wave(PatternChange& change, const ItemValues&) {
  change = set(&Pattern::wave, wave);
}

const ItemRow<PatternChange> kPatternItems[] = {
    {"frequency", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = set(&Pattern::frequency, values.number());
     }},
    {"phase", Form::value,
     [](PatternChange& change, const ItemValues& values) { change = set(&Pattern::phase, values.number()); }},
    {"turbulence", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = set(&Turbulence::amount, values.vector());
     }},
    {"octaves", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = set(&Turbulence::octaves, octaves(values.number()));
     }},
    {"omega", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = set(&Turbulence::omega, values.number());
     }},
    {"lambda", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = set(&Turbulence::lambda, values.number());
     }},
    {"ramp_wave", Form::word, set_wave<Pattern::Wave::ramp>},
    {"triangle_wave", Form::word, set_wave<Pattern::Wave::triangle>},
    {"sine_wave", Form::word, set_wave<Pattern::Wave::sine>},
    {"scallop_wave", Form::word, set_wave<Pattern::Wave::scallop>},
    {"cubic_wave", Form::word, set_wave<Pattern::Wave::cubic>},
    {"poly_wave", Form::option,
     [](PatternChange& change, const ItemValues& values) { change = poly_wave(values.option()); }},
    {"noise_generator", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = set(&Pattern::noise_generator,
                    noise_generator(values.session(), values.number(), values.value_where()));
     }},
    {"exponent", Form::value,
     [](PatternChange& change, const ItemValues& values) {
       change = fractal_exponent(values.number(), values.where());
     }},
    {"exterior", Form::pair,
     [](PatternChange& change, const ItemValues& values) {
       change = exterior(values.number(), values.second_number(), values.where());
     }},
    {"interior", Form::pair,
     [](PatternChange& change, const ItemValues& values) {
       change = interior(values.number(), values.second_number(), values.where());
     }},
};
constexpr std::size_t kOwnItems = std::size(kPatternItems); // the options of some patterns follow

void set_quick_colour(PigmentDefinition& pigment, const ItemValues& values) {
  set_quick_colour(values.session(), pigment, values.session().surface(values.quantity()));
}

const ItemRow<PigmentDefinition> kPigmentItems[] = {
    {"quick_colour", Form::colour_or_black, set_quick_colour},
    {"quick_color", Form::colour_or_black, set_quick_colour},
};

const ItemRow<NormalDefinition> kNormalItems[] = {
    {"bump_size", Form::value, store<&ItemValues::number, &NormalDefinition::amount>},
    {"accuracy", Form::value,
     [](NormalDefinition& normal, const ItemValues& values) {
       normal.accuracy = std::fabs(values.number());
     }},
};

// ---- Warps ----

/// Row of a warp's item: `start` makes a warp, `change` sets what it says of one. Either returns false where
/// the item means nothing.
struct WarpRow {
  const char* word;
  ItemForm form;
  bool (*start)(SpaceStep&, const ItemValues&);
  bool (*change)(SpaceStep&, const ItemValues&);
};

bool nothing(SpaceStep&, const ItemValues&) {
  return false;
}

/// Sets a member of a warp of one kind.
template <class Warp, class T> bool set_in(SpaceStep& step, T Warp::*member, const T& value) {
  auto* warp = std::get_if<Warp>(&step);
  if (warp != nullptr) warp->*member = value;
  return warp != nullptr;
}

bool start_black_hole(SpaceStep& step, const ItemValues& values) {
  warp::BlackHole hole;
  hole.centre = values.vector();
  hole.radius = values.second_number();
  step = hole;
  return true;
}

const WarpRow kWarpItems[] = {
    {"turbulence", Form::value,
     [](SpaceStep& step, const ItemValues& values) {
       step = Turbulence{values.vector()};
       return true;
     },
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::BlackHole::turbulence, values.vector());
     }},
    {"octaves", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &Turbulence::octaves, octaves(values.number()));
     }},
    {"omega", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &Turbulence::omega, values.number());
     }},
    {"lambda", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &Turbulence::lambda, values.number());
     }},
    {"repeat", Form::value,
     [](SpaceStep& step, const ItemValues& values) {
       step = repeat(values.session(), values.vector(), values.value_where());
       return true;
     },
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::BlackHole::repeat, values.vector());
     }},
    {"flip", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::Repeat::flip, values.vector());
     }},
    {"black_hole", Form::pair, start_black_hole, nothing},
    {"falloff", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::BlackHole::falloff, values.number());
     }},
    {"strength", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::BlackHole::strength, values.number());
     }},
    {"inverse", Form::word, nothing,
     [](SpaceStep& step, const ItemValues&) { return set_in(step, &warp::BlackHole::is_inverse, true); }},
    {"toroidal", Form::word,
     [](SpaceStep& step, const ItemValues&) {
       step = warp::Mapping{warp::Mapping::Shape::toroidal};
       return true;
     },
     nothing},
    {"orientation", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::Mapping::orientation, values.vector());
     }},
    {"dist_exp", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::Mapping::distance_exponent, values.number());
     }},
    {"major_radius", Form::value, nothing,
     [](SpaceStep& step, const ItemValues& values) {
       return set_in(step, &warp::Mapping::major_radius, values.number());
     }},
};
constexpr std::size_t kOwnWarpItems = std::size(kWarpItems); // the options of patterns follow

/// Appends the options of all patterns as items.
void append_options(std::vector<ItemWord>& words) {
  for (const PatternOption& option : pattern_options())
    words.push_back({option.word, option.has_value ? Form::value : Form::word, false});
}

[[noreturn]] void refuse(Session& session, const Item& item) {
  session.fail(item.where, std::string("unexpected '") + warp_items()[item.number()].word + '\'');
}

} // namespace

std::vector<ItemWord> pattern_items() {
  std::vector<ItemWord> words = words_of(kPatternItems);
  append_options(words);
  return words;
}

std::vector<ItemWord> pigment_items() {
  return words_of(kPigmentItems);
}

std::vector<ItemWord> normal_items() {
  return words_of(kNormalItems);
}

std::vector<ItemWord> warp_items() {
  std::vector<ItemWord> words;
  for (const WarpRow& row : kWarpItems)
    words.push_back({row.word, row.form, false});
  append_options(words);
  return words;
}

PatternChange pattern_change(Session& session, const Item& item) {
  if (item.number() >= kOwnItems)
    return option(static_cast<int>(item.number() - kOwnItems), item.value.value, item.where);
  PatternChange change;
  apply(kPatternItems, session, change, item);
  return change;
}

bool is_of_waves(const Item& item) {
  return item.block() == Block::pattern && item.number() < 2;
}

void apply(Session& session, PigmentDefinition& pigment, const Item& item) {
  if (item.block() == Block::pattern)
    change(session, pigment.pattern, pattern_change(session, item));
  else
    apply(kPigmentItems, session, pigment, item);
}

void apply(Session& session, NormalDefinition& normal, const Item& item) {
  if (item.block() == Block::pattern)
    change(session, normal.pattern, pattern_change(session, item));
  else
    apply(kNormalItems, session, normal, item);
}

SpaceStep warp_of(Session& session, const Item& item) {
  SpaceStep step;
  if (item.number() >= kOwnWarpItems || !kWarpItems[item.number()].start(step, ItemValues(session, item)))
    refuse(session, item);
  return step;
}

void apply(Session& session, SpaceStep& warp, const Item& item) {
  if (item.number() < kOwnWarpItems) {
    if (!kWarpItems[item.number()].change(warp, ItemValues(session, item))) refuse(session, item);
    return;
  }
  auto* repeat = std::get_if<warp::Repeat>(&warp);
  if (repeat == nullptr || !item.has_value) refuse(session, item);
  repeat->offset =
      offset(session, static_cast<int>(item.number() - kOwnWarpItems), item.value.value, item.where);
}

} // namespace celltrace::pov

// Tables of the items of fog { }, rainbow { }, sky_sphere { } and interior { }.
#include "pov/item_tables.hpp"

namespace celltrace::pov {

namespace {

using Form = ItemForm;

const ItemRow<FogDefinition> kFogItems[] = {
    {"fog_type", Form::value,
     [](FogDefinition& fog, const ItemValues& values) {
       fog.value.is_ground = is_ground_fog(values.session(), values.number(), values.value_where());
     }},
    {"distance", Form::value, store<&ItemValues::number_or_0, &FogDefinition::value, &Fog::distance>},
    {"fog_offset", Form::value, store<&ItemValues::number, &FogDefinition::value, &Fog::offset>},
    {"fog_alt", Form::value, store<&ItemValues::number, &FogDefinition::value, &Fog::altitude>},
    {"up", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { set_up(fog.value, values.vector()); }},
    {"turbulence", Form::value,
     store<&ItemValues::vector, &FogDefinition::value, &Fog::turbulence, &Turbulence::amount>},
    {"turb_depth", Form::value, store<&ItemValues::number, &FogDefinition::value, &Fog::turbulence_depth>},
    {"octaves", Form::value,
     [](FogDefinition& fog, const ItemValues& values) {
       fog.value.turbulence.octaves = octaves(values.number());
     }},
    {"omega", Form::value,
     store<&ItemValues::number, &FogDefinition::value, &Fog::turbulence, &Turbulence::omega>},
    {"lambda", Form::value,
     store<&ItemValues::number, &FogDefinition::value, &Fog::turbulence, &Turbulence::lambda>},
};

const ItemRow<RainbowDefinition> kRainbowItems[] = {
    {"direction", Form::value, store<&ItemValues::vector, &RainbowDefinition::value, &Rainbow::direction>},
    {"angle", Form::value, store<&ItemValues::number, &RainbowDefinition::value, &Rainbow::angle>},
    {"width", Form::value, store<&ItemValues::number, &RainbowDefinition::value, &Rainbow::width>},
    {"distance", Form::value, store<&ItemValues::number, &RainbowDefinition::value, &Rainbow::distance>},
    {"jitter", Form::value, store<&ItemValues::number, &RainbowDefinition::value, &Rainbow::jitter>},
    {"up", Form::value, store<&ItemValues::vector, &RainbowDefinition::value, &Rainbow::up>},
    {"arc_angle", Form::value, store<&ItemValues::number, &RainbowDefinition::value, &Rainbow::arc_angle>},
    {"falloff_angle", Form::value,
     store<&ItemValues::number, &RainbowDefinition::value, &Rainbow::falloff_angle>},
};

const ItemRow<SkySphereDefinition> kSkySphereItems[] = {
    {"emission", Form::colour,
     [](SkySphereDefinition& sky, const ItemValues& values) {
       sky.emission = values.colour();
       sky.emission_where = values.where();
     }},
};

const ItemRow<InteriorDefinition> kInteriorItems[] = {
    {"ior", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) {
       interior.ior = ior(values.session(), values.number(), values.value_where());
     }},
    {"caustics", Form::value, store<&ItemValues::number, &InteriorDefinition::caustics>},
    {"fade_distance", Form::value, store<&ItemValues::number, &InteriorDefinition::fade_distance>},
    {"fade_power", Form::value, store<&ItemValues::number, &InteriorDefinition::fade_power>},
    {"fade_colour", Form::colour_or_black, store<&ItemValues::colour, &InteriorDefinition::fade_colour>},
    {"fade_color", Form::colour_or_black, store<&ItemValues::colour, &InteriorDefinition::fade_colour>},
    {"dispersion", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) {
       mark(interior.unsupported, unless_zero("'dispersion'", values.number() - 1, values.where()));
     }},
    {"refraction", Form::value, // no more than a switch before version 3.1
     ignore_number},
    {"confidence", Form::colour, ignore},
    {"dispersion_samples", Form::colour, ignore},
    {"focal_point", Form::colour, ignore},
    {"mm_per_unit", Form::colour, ignore},
    {"variance", Form::colour, ignore},
};

} // namespace

std::vector<ItemWord> fog_items() {
  return words_of(kFogItems);
}

std::vector<ItemWord> rainbow_items() {
  return words_of(kRainbowItems);
}

std::vector<ItemWord> sky_sphere_items() {
  return words_of(kSkySphereItems);
}

std::vector<ItemWord> interior_items() {
  return words_of(kInteriorItems);
}

void apply(Session& session, FogDefinition& fog, const Item& item) {
  apply(kFogItems, session, fog, item);
}

void apply(Session& session, RainbowDefinition& rainbow, const Item& item) {
  apply(kRainbowItems, session, rainbow, item);
}

void apply(Session& session, SkySphereDefinition& sky, const Item& item) {
  apply(kSkySphereItems, session, sky, item);
}

void apply(Session& session, InteriorDefinition& interior, const Item& item) {
  apply(kInteriorItems, session, interior, item);
}

} // namespace celltrace::pov

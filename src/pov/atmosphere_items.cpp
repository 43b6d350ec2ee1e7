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
    {"distance", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.distance = values.number_or_0(); }},
    {"fog_offset", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.offset = values.number(); }},
    {"fog_alt", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.altitude = values.number(); }},
    {"up", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { set_up(fog.value, values.vector()); }},
    {"turbulence", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.turbulence.amount = values.vector(); }},
    {"turb_depth", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.turbulence_depth = values.number(); }},
    {"octaves", Form::value,
     [](FogDefinition& fog, const ItemValues& values) {
       fog.value.turbulence.octaves = octaves(values.number());
     }},
    {"omega", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.turbulence.omega = values.number(); }},
    {"lambda", Form::value,
     [](FogDefinition& fog, const ItemValues& values) { fog.value.turbulence.lambda = values.number(); }},
};

const ItemRow<RainbowDefinition> kRainbowItems[] = {
    {"direction", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.direction = values.vector(); }},
    {"angle", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.angle = values.number(); }},
    {"width", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.width = values.number(); }},
    {"distance", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.distance = values.number(); }},
    {"jitter", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.jitter = values.number(); }},
    {"up", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.up = values.vector(); }},
    {"arc_angle", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) { rainbow.value.arc_angle = values.number(); }},
    {"falloff_angle", Form::value,
     [](RainbowDefinition& rainbow, const ItemValues& values) {
       rainbow.value.falloff_angle = values.number();
     }},
};

const ItemRow<SkySphereDefinition> kSkySphereItems[] = {
    {"emission", Form::colour,
     [](SkySphereDefinition& sky, const ItemValues& values) {
       sky.emission = values.colour();
       sky.emission_where = values.where();
     }},
};

void set_fade_colour(InteriorDefinition& interior, const ItemValues& values) {
  interior.fade_colour = values.colour();
}

const ItemRow<InteriorDefinition> kInteriorItems[] = {
    {"ior", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) {
       interior.ior = ior(values.session(), values.number(), values.value_where());
     }},
    {"caustics", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) { interior.caustics = values.number(); }},
    {"fade_distance", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) {
       interior.fade_distance = values.number();
     }},
    {"fade_power", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) { interior.fade_power = values.number(); }},
    {"fade_colour", Form::colour_or_black, set_fade_colour},
    {"fade_color", Form::colour_or_black, set_fade_colour},
    {"dispersion", Form::value,
     [](InteriorDefinition& interior, const ItemValues& values) {
       mark(interior.unsupported, unless_zero("'dispersion'", values.number() - 1, values.where()));
     }},
    {"refraction", Form::value, // no more than a switch before version 3.1
     [](InteriorDefinition&, const ItemValues& values) { values.number(); }},
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

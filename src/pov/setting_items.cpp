// Tables of the items of global_settings { } and of the scene itself.
#include "pov/item_tables.hpp"

namespace celltrace::pov {

namespace {

using Form = ItemForm;

/// As before version 3.0.
const ItemRow<Session> kSceneItems[] = {
    {"max_trace_level", Form::value,
     [](Session& session, const ItemValues& values) {
       set_max_trace_level(session, values.number(), values.value_where());
     }},
    {"max_intersections", Form::value, ignore_number},
};

const ItemRow<Session> kSettings[] = {
    {"adc_bailout", Form::value,
     [](Session& session, const ItemValues& values) {
       set_adc_bailout(session, values.number(), values.value_where());
     }},
    {"ambient_light", Form::colour_or_black,
     [](Session& session, const ItemValues& values) { session.builder.set_ambient_light(values.light()); }},
    {"noise_generator", Form::value,
     [](Session& session, const ItemValues& values) {
       set_noise_generator(session, values.number(), values.value_where());
     }},
    {"irid_wavelength", Form::colour_or_black,
     [](Session& session, const ItemValues& values) {
       session.builder.set_irid_wavelength(values.colour());
     }},
    {"number_of_waves", Form::value,
     [](Session& session, const ItemValues& values) {
       set_number_of_waves(session, values.number(), values.value_where());
     }},
    {"confidence", Form::colour, ignore},
    {"dispersion_samples", Form::colour, ignore},
    {"focal_point", Form::colour, ignore},
    {"mm_per_unit", Form::colour, ignore},
    {"variance", Form::colour, ignore},
    {"hf_gray_16", Form::option, ignore_number},
    {"hierarchy", Form::option, ignore_number},
    {"no_radiosity", Form::option, ignore_number},
    {"split_union", Form::option, ignore_number},
    {"sturm", Form::option, ignore_number},
};

} // namespace

std::vector<ItemWord> scene_items() {
  return words_of(kSceneItems);
}

std::vector<ItemWord> setting_items() {
  return words_of(kSettings);
}

void apply_setting(Session& session, const Item& item) {
  if (item.block() == Block::scene)
    apply(kSceneItems, session, session, item);
  else
    apply(kSettings, session, session, item);
}

} // namespace celltrace::pov

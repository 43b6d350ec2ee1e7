// Tables of the items of finish { } and of textures before version 3.0.
#include <algorithm>

#include "pov/item_tables.hpp"

namespace celltrace::pov {

namespace {

using Form = ItemForm;

const ItemRow<FinishDefinition> kFinishItems[] = {
    {"ambient", Form::colour_or_black, store<&ItemValues::light, &FinishDefinition::value, &Finish::ambient>},
    {"emission", Form::colour_or_black,
     store<&ItemValues::light, &FinishDefinition::value, &Finish::emission>},
    {"brilliance", Form::value, store<&ItemValues::number, &FinishDefinition::value, &Finish::brilliance>},
    {"phong", Form::share,
     [](FinishDefinition& finish, const ItemValues& values) {
       finish.value.phong = values.number_or_0();
       finish.phong_is_albedo |= values.is_albedo();
     }},
    {"phong_size", Form::value, store<&ItemValues::number, &FinishDefinition::value, &Finish::phong_size>},
    {"specular", Form::share,
     [](FinishDefinition& finish, const ItemValues& values) {
       finish.value.specular = values.number_or_0();
       finish.specular_is_albedo |= values.is_albedo();
     }},
    {"roughness", Form::value,
     [](FinishDefinition& finish, const ItemValues& values) {
       finish.value.roughness = roughness(values.session(), values.number(), values.value_where());
     }},
    {"metallic", Form::option, store<&ItemValues::option, &FinishDefinition::value, &Finish::metallic>},
    {"conserve_energy", Form::option,
     store<&ItemValues::flag, &FinishDefinition::value, &Finish::conserve_energy>},
    {"reflection_exponent", Form::value,
     [](FinishDefinition& finish, const ItemValues& values) {
       finish.value.reflection_exponent = exponent(values.session(), values.number(), values.value_where());
     }},
    {"ior", Form::value,
     [](FinishDefinition& finish, const ItemValues& values) {
       finish.ior = ior_of_finish(values.session(), values.number(), values.value_where());
     }},
    {"refraction", Form::value, store<&ItemValues::number, &FinishDefinition::refraction>},
    {"crand", Form::value,
     [](FinishDefinition& finish, const ItemValues& values) {
       finish.value.crand = std::max(values.number(), 0.0);
     }},
    {"caustics", Form::value, store<&ItemValues::number, &FinishDefinition::caustics>},
    {"fade_distance", Form::value, store<&ItemValues::number, &FinishDefinition::fade_distance>},
    {"fade_power", Form::value, store<&ItemValues::number, &FinishDefinition::fade_power>},
};

const ItemRow<ReflectionDefinition> kReflectionItems[] = {
    {"falloff", Form::value, store<&ItemValues::number, &ReflectionDefinition::falloff>},
    {"exponent", Form::value,
     [](ReflectionDefinition& reflection, const ItemValues& values) {
       reflection.exponent = exponent(values.session(), values.number(), values.value_where());
     }},
    {"fresnel", Form::option, store<&ItemValues::flag, &ReflectionDefinition::is_fresnel>},
    {"metallic", Form::option, store<&ItemValues::option, &ReflectionDefinition::metallic>},
};

const ItemRow<Finish> kIridItems[] = {
    {"thickness", Form::value, store<&ItemValues::number, &Finish::irid_thickness>},
    {"turbulence", Form::value, store<&ItemValues::number, &Finish::irid_turbulence>},
};

/// Sets a number of the finish that an old texture has.
template <double Finish::*member> void set_old(TexturePtr& texture, const ItemValues& values) {
  const double number = values.number();
  texture = with_old_finish(texture, [&](FinishDefinition& finish) { finish.value.*member = number; });
}

void set_old_quick_colour(TexturePtr& texture, const ItemValues& values) {
  PigmentDefinition pigment = texture->pigment;
  set_quick_colour(values.session(), pigment, values.session().surface(values.quantity()));
  texture = with_pigment(texture, pigment);
}

const ItemRow<TexturePtr> kOldTextureItems[] = {
    {"ambient", Form::colour_or_black,
     [](TexturePtr& texture, const ItemValues& values) {
       const Vec3 light = values.light();
       texture = with_old_finish(texture, [&](FinishDefinition& finish) { finish.value.ambient = light; });
     }},
    {"reflection", Form::colour_or_black,
     [](TexturePtr& texture, const ItemValues& values) {
       const Vec3 light = values.colour();
       texture =
           with_old_finish(texture, [&](FinishDefinition& finish) { set_reflection(finish.value, light); });
     }},
    {"diffuse", Form::value, set_old<&Finish::diffuse>},
    {"brilliance", Form::value, set_old<&Finish::brilliance>},
    {"phong", Form::value, set_old<&Finish::phong>},
    {"phong_size", Form::value, set_old<&Finish::phong_size>},
    {"specular", Form::value, set_old<&Finish::specular>},
    {"crand", Form::value, set_old<&Finish::crand>},
    {"roughness", Form::value,
     [](TexturePtr& texture, const ItemValues& values) {
       const double value = roughness(values.session(), values.number(), values.value_where());
       texture = with_old_finish(texture, [&](FinishDefinition& finish) { finish.value.roughness = value; });
     }},
    {"metallic", Form::option,
     [](TexturePtr& texture, const ItemValues& values) {
       const double value = values.option();
       texture = with_old_finish(texture, [&](FinishDefinition& finish) { finish.value.metallic = value; });
     }},
    {"ior", Form::value,
     [](TexturePtr& texture, const ItemValues& values) {
       const auto value = ior_of_finish(values.session(), values.number(), values.value_where());
       texture = with_old_finish(texture, [&](FinishDefinition& finish) { finish.ior = value; });
     }},
    {"refraction", Form::value,
     [](TexturePtr& texture, const ItemValues& values) {
       const double value = values.number();
       texture = with_old_finish(texture, [&](FinishDefinition& finish) { finish.refraction = value; });
     }},
    {"quick_colour", Form::colour_or_black, set_old_quick_colour},
    {"quick_color", Form::colour_or_black, set_old_quick_colour},
};

} // namespace

std::vector<ItemWord> finish_items() {
  return words_of(kFinishItems);
}

std::vector<ItemWord> reflection_items() {
  return words_of(kReflectionItems);
}

std::vector<ItemWord> irid_items() {
  return words_of(kIridItems);
}

std::vector<ItemWord> old_texture_items() {
  return words_of(kOldTextureItems);
}

void apply(Session& session, FinishDefinition& finish, const Item& item) {
  apply(kFinishItems, session, finish, item);
}

void apply(Session& session, ReflectionDefinition& reflection, const Item& item) {
  apply(kReflectionItems, session, reflection, item);
}

void apply(Session& session, Finish& finish, const Item& item) {
  apply(kIridItems, session, finish, item);
}

TexturePtr with_old_item(Session& session, const TexturePtr& texture, const Item& item) {
  if (item.block() == Block::pattern) {
    const PatternChange change = pattern_change(session, item);
    return is_of_waves(item) ? with_old_waves(session, texture, change)
                             : with_old_pattern(session, texture, change);
  }
  TexturePtr result = texture;
  apply(kOldTextureItems, session, result, item);
  return result;
}

} // namespace celltrace::pov

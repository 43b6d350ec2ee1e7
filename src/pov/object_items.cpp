// Tables of the items of objects, light sources, light groups and meshes.
#include "pov/item_tables.hpp"
#include "pov/height_fields.hpp"
#include "pov/light.hpp"

namespace celltrace::pov {

namespace {

using Form = ItemForm;

const ItemRow<ObjectDefinition> kObjectItems[] = {
    {"strength", Form::value,
     [](ObjectDefinition& object, const ItemValues& values) {
       set_strength(values.session(), object, values.number(), values.where());
     }},
    {"no_image", Form::word, set_true<&ObjectDefinition::no_image>},
    {"no_reflection", Form::word, set_true<&ObjectDefinition::no_reflection>},
    {"no_shadow", Form::word, set_true<&ObjectDefinition::no_shadow>},
    {"inverse", Form::word,
     [](ObjectDefinition& object, const ItemValues&) { object.inverse = !object.inverse; }},
    {"hollow", Form::option, store<&ItemValues::flag, &ObjectDefinition::hollow>},
    {"double_illuminate", Form::option, store<&ItemValues::flag, &ObjectDefinition::is_lit_through>},
    {"uv_mapping", Form::word,
     [](ObjectDefinition& object, const ItemValues& values) {
       set_uv_mapping(values.session(), object, values.where());
     }},
    {"cutaway_textures", Form::option,
     [](ObjectDefinition& object, const ItemValues& values) {
       if (values.flag()) set_cutaway_textures(values.session(), object, values.where());
     }},
    {"hf_gray_16", Form::option, ignore_number},
    {"hierarchy", Form::option, ignore_number},
    {"no_radiosity", Form::option, ignore_number},
    {"split_union", Form::option, ignore_number},
    {"sturm", Form::option, ignore_number},
};

template <double Light::*number> void set_beam(ObjectDefinition& light, const ItemValues& values) {
  set_beam(values.session(), light, number, values.number(), values.where());
}

const ItemRow<ObjectDefinition> kLightSourceItems[] = {
    {"spotlight", Form::word,
     [](ObjectDefinition& light, const ItemValues&) { set_kind(light, Light::Kind::spotlight); }},
    {"parallel", Form::word,
     [](ObjectDefinition& light, const ItemValues&) { light_of(light).parallel = true; }},
    {"shadowless", Form::word, [](ObjectDefinition& light, const ItemValues&) { set_shadowless(light); }},
    {"point_at", Form::value,
     [](ObjectDefinition& light, const ItemValues& values) {
       set_point_at(values.session(), light, values.quantity(), values.where());
     }},
    {"radius", Form::value, set_beam<&Light::radius>},
    {"falloff", Form::value, set_beam<&Light::falloff>},
    {"tightness", Form::value, set_beam<&Light::tightness>},
    {"fade_distance", Form::value,
     [](ObjectDefinition& light, const ItemValues& values) {
       light_of(light).fade_distance = values.number_or_0();
     }},
    {"fade_power", Form::value,
     [](ObjectDefinition& light, const ItemValues& values) {
       light_of(light).fade_power = values.number_or_0();
     }},
    {"adaptive", Form::value,
     [](ObjectDefinition& light, const ItemValues& values) { set_adaptive(light, values.number()); }},
    {"area_illumination", Form::option,
     [](ObjectDefinition& light, const ItemValues& values) {
       definition_of(light).shines_from_places = values.flag();
     }},
    {"jitter", Form::word, [](ObjectDefinition& light, const ItemValues&) { area_of(light).jitter = true; }},
    {"circular", Form::word,
     [](ObjectDefinition& light, const ItemValues&) { area_of(light).circular = true; }},
    {"orient", Form::word, [](ObjectDefinition& light, const ItemValues&) { area_of(light).orient = true; }},
    {"media_attenuation", Form::option,
     [](ObjectDefinition& light, const ItemValues& values) {
       definition_of(light).media_attenuation = values.flag();
     }},
    {"media_interaction", Form::option,
     [](ObjectDefinition& light, const ItemValues& values) {
       definition_of(light).media_interaction = values.flag();
     }},
};

const ItemRow<ObjectDefinition> kLightGroupItems[] = {
    {"global_lights", Form::option,
     [](ObjectDefinition& group, const ItemValues& values) { set_global_lights(group, values.flag()); }},
};

const ItemRow<PhotonsDefinition> kPhotonsItems[] = {
    {"target", Form::option, store<&ItemValues::flag, &PhotonsDefinition::is_target>},
    {"refraction", Form::option, ignore_number},
    {"reflection", Form::option, ignore_number},
    {"collect", Form::option, ignore_number},
    {"pass_through", Form::option, ignore_number},
    {"area_light", Form::option, ignore_number},
};

struct ListRow {
  const char* word;
  void (*set)(Session&, Mesh2Definition&, std::vector<ListEntry>&, const Location&);
};

template <CountedList Mesh2Definition::*member,
          CountedList (*read)(Session&, std::vector<ListEntry>&, const Location&)>
void set_list(Session& session, Mesh2Definition& mesh, std::vector<ListEntry>& list, const Location& where) {
  mesh.*member = read(session, list, where);
}

const ListRow kMesh2Lists[] = {
    {"vertex_vectors", set_list<&Mesh2Definition::vertex_vectors, vectors>},
    {"normal_vectors", set_list<&Mesh2Definition::normal_vectors, vectors>},
    {"uv_vectors", set_list<&Mesh2Definition::uv_vectors, vectors>},
    {"face_indices", set_list<&Mesh2Definition::face_indices, faces>},
    {"normal_indices", set_list<&Mesh2Definition::normal_indices, counted>},
    {"uv_indices", set_list<&Mesh2Definition::uv_indices, counted>},
};

void ignore_picture_word(ObjectDefinition&, const ItemValues&) {
}

const ItemRow<ObjectDefinition> kHeightFieldItems[] = {
    {"bmp", Form::word, ignore_picture_word},
    {"exr", Form::word, ignore_picture_word},
    {"gif", Form::word, ignore_picture_word},
    {"hdr", Form::word, ignore_picture_word},
    {"iff", Form::word, ignore_picture_word},
    {"jpeg", Form::word, ignore_picture_word},
    {"pgm", Form::word, ignore_picture_word},
    {"png", Form::word, ignore_picture_word},
    {"pot", Form::word, ignore_picture_word},
    {"ppm", Form::word, ignore_picture_word},
    {"sys", Form::word, ignore_picture_word},
    {"tga", Form::word, ignore_picture_word},
    {"tiff", Form::word, ignore_picture_word},
    {"premultiplied", Form::option, ignore_picture_word},
    {"smooth", Form::word,
     [](ObjectDefinition& object, const ItemValues& values) {
       change_height_field(
           values.session(), object, [](HeightField& field) { field.is_smooth = true; }, values.where());
     }},
    {"water_level", Form::value,
     [](ObjectDefinition& object, const ItemValues& values) {
       const double level = values.number();
       change_height_field(
           values.session(), object, [level](HeightField& field) { field.water_level = level; }, values.where());
     }},
};

const ItemRow<PatchDefinition> kBicubicPatchItems[] = {
    {"type", Form::value,
     [](PatchDefinition& patch, const ItemValues& values) {
       if (values.number() != 0 && values.number() != 1)
         values.session().diagnostics.warn_once(values.where(),
                                                "a bicubic_patch has type 0 or 1: 1 is taken");
       patch.has_type = true;
     }},
    {"flatness", Form::value, store<&ItemValues::number, &PatchDefinition::patch, &BicubicPatch::flatness>},
    {"u_steps", Form::value,
     [](PatchDefinition& patch, const ItemValues& values) {
       patch.patch.s_steps = patch_steps(values.number());
     }},
    {"v_steps", Form::value,
     [](PatchDefinition& patch, const ItemValues& values) {
       patch.patch.q_steps = patch_steps(values.number());
     }},
    {"accuracy", Form::value, ignore_number},
};

} // namespace

std::vector<ItemWord> object_items() {
  return words_of(kObjectItems);
}

std::vector<ItemWord> light_source_items() {
  return words_of(kLightSourceItems);
}

std::vector<ItemWord> light_group_items() {
  return words_of(kLightGroupItems);
}

std::vector<ItemWord> photons_items() {
  return words_of(kPhotonsItems);
}

std::vector<ItemWord> mesh2_items() {
  std::vector<ItemWord> words;
  for (const ListRow& row : kMesh2Lists)
    words.push_back({row.word, Form::list, false});
  return words;
}

std::vector<ItemWord> height_field_items() {
  return words_of(kHeightFieldItems);
}

std::vector<ItemWord> bicubic_patch_items() {
  return words_of(kBicubicPatchItems);
}

void apply(Session& session, ObjectDefinition& object, const Item& item) {
  if (item.block() == Block::height_field) return apply(kHeightFieldItems, session, object, item);
  if (item.block() == Block::bicubic_patch)
    session.fail(item.where, "options of a bicubic_patch stand before its control points");
  if (item.block() == Block::light_source)
    apply(kLightSourceItems, session, object, item);
  else if (item.block() == Block::light_group)
    apply(kLightGroupItems, session, object, item);
  else
    apply(kObjectItems, session, object, item);
}

void apply(Session& session, PatchDefinition& patch, const Item& item) {
  if (item.block() != Block::bicubic_patch)
    session.fail(item.where, "expected an option or a control point of this bicubic_patch");
  apply(kBicubicPatchItems, session, patch, item);
}

void apply(Session& session, PhotonsDefinition& photons, const Item& item) {
  apply(kPhotonsItems, session, photons, item);
}

void apply(Session& session, Mesh2Definition& mesh, int row, std::vector<ListEntry> list,
           const Location& where) {
  kMesh2Lists[item(row, where).number()].set(session, mesh, list, where);
}

} // namespace celltrace::pov

// Table of the items of camera { }.
#include "pov/camera.hpp"
#include "pov/item_tables.hpp"

namespace celltrace::pov {

namespace {

using Form = ItemForm;

const ItemRow<CameraDefinition> kCameraItems[] = {
    {"location", Form::value,
     [](CameraDefinition& camera, const ItemValues& values) { camera.location = values.quantity().vec3(); }},
    {"direction", Form::value,
     [](CameraDefinition& camera, const ItemValues& values) { camera.direction = values.quantity().vec3(); }},
    {"right", Form::value,
     [](CameraDefinition& camera, const ItemValues& values) { camera.right = values.quantity().vec3(); }},
    {"up", Form::value,
     [](CameraDefinition& camera, const ItemValues& values) { camera.up = values.quantity().vec3(); }},
    {"sky", Form::value, store<&ItemValues::vector, &CameraDefinition::sky>},
    {"look_at", Form::value,
     [](CameraDefinition& camera, const ItemValues& values) {
       set_look_at(values.session(), camera, values.quantity().vec3(), values.where());
     }},
    {"aperture", Form::value,
     [](CameraDefinition& camera, const ItemValues& values) {
       camera.aperture = values.number();
       camera.aperture_where = values.where();
     }},
    {"confidence", Form::value, ignore},
    {"dispersion_samples", Form::value, ignore},
    {"focal_point", Form::value, ignore},
    {"mm_per_unit", Form::value, ignore},
    {"variance", Form::value, ignore},
};

} // namespace

std::vector<ItemWord> camera_items() {
  return words_of(kCameraItems);
}

void apply(Session& session, CameraDefinition& camera, const Item& item) {
  apply(kCameraItems, session, camera, item);
}

} // namespace celltrace::pov

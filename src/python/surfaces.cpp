// Binds cameras, lights, and the materials and interiors of objects.
#include "python/bindings.hpp"
#include "python/misfit.hpp"
#include "python/python_scene.hpp"

#include "celltrace/error.hpp"
#include "celltrace/pov.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <optional>
#include <string_view>

namespace celltrace {

namespace {

/// Returns the material of a sphere with `text`, in a scene like Scene(). The text is a file of its
/// own, so that the places in messages refer to it.
Material material_from_pov(const std::string& text) {
  constexpr std::string_view kName = "<material>";
  ParseOptions options;
  options.version = Scene().version;
  options.file = [&](const std::string& name) { return name == kName ? std::optional(text) : std::nullopt; };
  const Scene scene = parse_string("global_settings { assumed_gamma 1 } sphere { 0, 1\n#include \"" +
                                       std::string(kName) + "\"\n}",
                                   options, "<from_pov>");
  if (scene.objects.size() != 1) throw InputError("from_pov: that is not the texture of one object");
  return scene.materials[scene.objects[0].material];
}

Camera look_at(const Vec3& from, const Vec3& to, double angle, std::optional<double> aspect, const Vec3& sky,
               bool is_right_handed) {
  Camera camera = Camera::look_at(from, to, angle, aspect, sky);
  if (is_right_handed) camera.right = -camera.right;
  return camera;
}

/// Returns access to a field of Material::finish.
template <class T> auto of_finish(T Finish::*member) {
  return [member](Material& material) -> T& { return material.finish.*member; };
}
template <class T> auto of_pigment(T Pigment::*member) {
  return [member](Material& material) -> T& { return material.pigment.*member; };
}

void bind_camera(py::module_& module) {
  const char* const parameters =
      "location, target, angle=67.38, aspect=None, sky=(0, 1, 0), *, right_handed=False";
  auto camera = bind_values<Camera>(
      module, "Camera", "POV-Ray's cameras, finished: after sky, look_at, angle and transformations.",
      Fields<Camera>()
          .add("kind", &Camera::kind, "perspective, orthographic, spherical, ...")
          .add("location", &Camera::location, "where it is")
          .add("direction", &Camera::direction, "where it looks")
          .add("right", &Camera::right, "across the picture")
          .add("up", &Camera::up, "from the bottom of the picture to its top")
          .add("angle", &Camera::angle, "in degrees; perspective ones have it in direction")
          .add("vertical_angle", &Camera::vertical_angle, "in degrees")
          .add("framing", &Camera::framing,
               "in a picture of another shape than right by up: 'fixed' squeezes, 'width' shows more or less "
               "above\nand below, 'whole' shows more at the sides, or above and below"));
  camera.def_static(
      "look_at", &look_at, py::arg("location"), py::arg("target"), py::arg("angle") = 67.38,
      py::arg("aspect") = py::none(), py::arg("sky") = Vec3(0, 1, 0), py::kw_only(),
      py::arg("right_handed") = false,
      signed_doc("look_at", parameters,
                 "A perspective camera. angle: that the picture is wide, in degrees. aspect: width by "
                 "height of\nthe pictures that it is for; None: of whatever picture it is used for. sky: "
                 "what is up.\nright_handed: the axes are those of mathematics, as matplotlib's, and not "
                 "POV-Ray's.")
          .c_str());
  add_misfit([&](auto... last) { camera.def_static("look_at", last...); }, {"look_at", parameters});
}

void bind_lights(py::module_& module) {
  bind_values<LightArea>(module, "LightArea", "A grid of places around a light, for soft shadows.",
                         Fields<LightArea>()
                             .add("across", &LightArea::across, "from the first column to the last")
                             .add("along", &LightArea::along, "from the first row to the last")
                             .add("columns", &LightArea::columns, "")
                             .add("rows", &LightArea::rows, "")
                             .add("adaptive", &LightArea::adaptive, "")
                             .add("jitter", &LightArea::jitter, "")
                             .add("circular", &LightArea::circular, "")
                             .add("orient", &LightArea::orient, ""));
  bind_values<Light>(module, "Light", "A light source with POV-Ray's formulas and defaults.",
                     Fields<Light>()
                         .add("location", &Light::location, "")
                         .add("colour", &Light::colour, "")
                         .add("kind", &Light::kind, "point, spotlight or cylinder")
                         .add("point_at", &Light::point_at, "where the axis of all but points goes to")
                         .add("radius", &Light::radius, "where the edge begins, in degrees for spotlights")
                         .add("falloff", &Light::falloff, "where it ends")
                         .add("tightness", &Light::tightness, "")
                         .add("parallel", &Light::parallel, "")
                         .add("fade_distance", &Light::fade_distance, "")
                         .add("fade_power", &Light::fade_power, "")
                         .add("shadowless", &Light::shadowless, "")
                         .add("area", &Light::area, "None: shadows are those of a point"));
}

void bind_materials(py::module_& module) {
  Fields<Material> fields;
  fields.add("colour", of_pigment(&Pigment::rgb), "red, green and blue, linear in the scene's working space")
      .add("filter", of_pigment(&Pigment::filter), "share of light that passes and takes the colour")
      .add("transmit", of_pigment(&Pigment::transmit), "share of light that passes as it is")
      .add("ambient", of_finish(&Finish::ambient), "")
      .add("emission", of_finish(&Finish::emission), "")
      .add("diffuse", of_finish(&Finish::diffuse), "")
      .add("brilliance", of_finish(&Finish::brilliance), "")
      .add("phong", of_finish(&Finish::phong), "")
      .add("phong_size", of_finish(&Finish::phong_size), "")
      .add("specular", of_finish(&Finish::specular), "")
      .add("roughness", of_finish(&Finish::roughness), "")
      .add("metallic", of_finish(&Finish::metallic), "of the highlights")
      .add("reflection_min", of_finish(&Finish::reflection_min), "where surfaces are seen straight on")
      .add("reflection_max", of_finish(&Finish::reflection_max), "where they are seen from the side")
      .add("reflection_falloff", of_finish(&Finish::reflection_falloff), "")
      .add("reflection_exponent", of_finish(&Finish::reflection_exponent), "")
      .add("reflection_metallic", of_finish(&Finish::reflection_metallic), "")
      .add("reflection_fresnel", of_finish(&Finish::reflection_fresnel), "")
      .add("conserve_energy", of_finish(&Finish::conserve_energy), "");
  bind_values<Material>(module, "Material",
                        "A texture of one colour, with POV-Ray's finish and its defaults.", fields)
      .def_static(
          "from_pov", &material_from_pov, py::arg("text"), py::call_guard<py::gil_scoped_release>(),
          signed_doc(
              "from_pov", "text",
              "Reads what stands in an object of POV-Ray's language, as \"pigment { checker rgb 1, rgb 0 "
              "}\" or\n\"texture { ... }\", in a scene of version 3.7 with assumed_gamma 1: `rgb` is "
              "linear, and `srgb` is\nwhat colour pickers say. Patterns, layers and normals stay whatever "
              "replace() changes.")
              .c_str());
  bind_values<Interior>(module, "Interior", "The inside of an object.",
                        Fields<Interior>()
                            .add("ior", &Interior::ior, "")
                            .add("fade_distance", &Interior::fade_distance, "")
                            .add("fade_power", &Interior::fade_power, "")
                            .add("fade_colour", &Interior::fade_colour, "")
                            .add("caustics", &Interior::caustics, "")
                            .add("hollow", &Interior::hollow, ""));
}

} // namespace

void bind_surfaces(py::module_& module) {
  bind_camera(module);
  bind_lights(module);
  bind_materials(module);
}

} // namespace celltrace

// Conversions of the library's values to Python: vectors as tuples, enumerators as strings, shared immutable
// values as objects without setters.
#pragma once

#include "celltrace/render.hpp"
#include "celltrace/scene.hpp"
#include "python/mesh.hpp"
#include "python/python_scene.hpp"

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace celltrace {

/// The strings of an enumeration: a specialisation has `values`, an array of pairs. An enumerator is shown
/// by the first string that it has.
template <class E> struct EnumStrings;

template <class E> using EnumString = std::pair<const char*, E>;

template <> struct EnumStrings<Backend> {
  static constexpr EnumString<Backend> values[] = {{name_of(Backend::native), Backend::native},
                                                   {name_of(Backend::cell_emu), Backend::cell_emu},
                                                   {name_of(Backend::cell_sim), Backend::cell_sim}};
};
template <> struct EnumStrings<SimdLevel> {
  static constexpr EnumString<SimdLevel> values[] = {{name_of(SimdLevel::automatic), SimdLevel::automatic},
                                                     {name_of(SimdLevel::sse2), SimdLevel::sse2},
                                                     {name_of(SimdLevel::avx2), SimdLevel::avx2},
                                                     {name_of(SimdLevel::avx512), SimdLevel::avx512},
                                                     {name_of(SimdLevel::neon64), SimdLevel::neon64},
                                                     {name_of(SimdLevel::generic), SimdLevel::generic}};
};
template <> struct EnumStrings<Balance> {
  static constexpr EnumString<Balance> values[] = {
      {"gde", Balance::gde},     {"diffusion", Balance::diffusion},
      {"fixed", Balance::fixed}, {"scatter", Balance::scatter},
      {"tiles", Balance::tiles}, {"static", Balance::fixed}}; // name in the command-line program
};
template <> struct EnumStrings<Accelerator> {
  static constexpr EnumString<Accelerator> values[] = {
      {"automatic", Accelerator::automatic},
      {"grid", Accelerator::grid},
      {"bvh", Accelerator::bvh},
      {"auto", Accelerator::automatic}}; // name in the command-line program
};
template <> struct EnumStrings<Model> {
  static constexpr EnumString<Model> values[] = {{"shared", Model::shared},
                                                 {"pipeline", Model::pipeline},
                                                 {"pipeline-split", Model::pipeline_split},
                                                 {"offload", Model::offload}};
};
template <> struct EnumStrings<Antialiasing::Method> {
  static constexpr EnumString<Antialiasing::Method> values[] = {{"fixed", Antialiasing::Method::fixed},
                                                                {"adaptive", Antialiasing::Method::adaptive}};
};
template <> struct EnumStrings<Schedule> {
  static constexpr EnumString<Schedule> values[] = {{"free", Schedule::free},
                                                    {"lockstep", Schedule::lockstep}};
};
template <> struct EnumStrings<CacheReplacement> {
  static constexpr EnumString<CacheReplacement> values[] = {
      {"random", CacheReplacement::random}, {"fifo", CacheReplacement::fifo}, {"lru", CacheReplacement::lru}};
};
template <> struct EnumStrings<Light::Kind> {
  static constexpr EnumString<Light::Kind> values[] = {{"point", Light::Kind::point},
                                                       {"spotlight", Light::Kind::spotlight},
                                                       {"cylinder", Light::Kind::cylinder}};
};
template <> struct EnumStrings<Camera::Kind> {
  using K = Camera::Kind;
  static constexpr EnumString<K> values[] = {
      {"perspective", K::perspective}, {"orthographic", K::orthographic},
      {"spherical", K::spherical},     {"ultra_wide_angle", K::ultra_wide_angle},
      {"omnimax", K::omnimax},         {"panoramic", K::panoramic},
      {"cylinder_1", K::cylinder_1},   {"cylinder_2", K::cylinder_2},
      {"cylinder_3", K::cylinder_3},   {"cylinder_4", K::cylinder_4},
      {"fisheye", K::fisheye}};
};
template <> struct EnumStrings<Camera::Framing> {
  static constexpr EnumString<Camera::Framing> values[] = {{"fixed", Camera::Framing::fixed},
                                                           {"width", Camera::Framing::width},
                                                           {"whole", Camera::Framing::whole}};
};
template <> struct EnumStrings<Csg::Operation> {
  static constexpr EnumString<Csg::Operation> values[] = {{"union", Csg::Operation::union_},
                                                          {"merge", Csg::Operation::merge},
                                                          {"intersection", Csg::Operation::intersection},
                                                          {"difference", Csg::Operation::difference}};
};

} // namespace celltrace

namespace pybind11::detail {

template <class E> struct type_caster<E, std::enable_if_t<(sizeof(celltrace::EnumStrings<E>::values) > 0)>> {
  PYBIND11_TYPE_CASTER(E, const_name("str"));

  bool load(handle source, bool) {
    if (!isinstance<str>(source)) return false;
    const std::string text = source.cast<std::string>();
    std::string known;
    for (const auto& [string, enumerator] : celltrace::EnumStrings<E>::values) {
      if (text == string) {
        value = enumerator;
        return true;
      }
      known += (known.empty() ? "" : ", ") + std::string(string);
    }
    throw value_error("'" + text + "' is none of " + known);
  }
  static handle cast(E enumerator, return_value_policy, handle) {
    for (const auto& [string, candidate] : celltrace::EnumStrings<E>::values)
      if (candidate == enumerator) return str(string).release();
    throw value_error("an enumerator without a string");
  }
};

/// Converts a sequence or array of numbers, or one number, which stands for all coordinates as in POV-Ray's
/// language.
template <glm::length_t N, class T, glm::qualifier Q> struct type_caster<glm::vec<N, T, Q>> {
  using Vector = glm::vec<N, T, Q>;
  PYBIND11_TYPE_CASTER(Vector, const_name("tuple"));

  bool load(handle source, bool) {
    if (PyFloat_Check(source.ptr()) || PyLong_Check(source.ptr())) {
      value = Vector(number(source));
      return true;
    }
    if (!PySequence_Check(source.ptr()) || isinstance<str>(source) || len(source) != N) return false;
    const auto items = reinterpret_borrow<sequence>(source);
    for (glm::length_t i = 0; i < N; ++i) {
      const object item = items[static_cast<std::size_t>(i)];
      if (!PyNumber_Check(item.ptr()) || isinstance<sequence>(item)) return false;
      value[i] = number(item);
    }
    return true;
  }
  static handle cast(const Vector& vector, return_value_policy, handle) {
    tuple result(N);
    for (glm::length_t i = 0; i < N; ++i)
      result[static_cast<std::size_t>(i)] = static_cast<double>(vector[i]);
    return result.release();
  }

private:
  static T number(handle source) {
    const double result = PyFloat_AsDouble(source.ptr());
    if (PyErr_Occurred()) throw error_already_set();
    return static_cast<T>(result);
  }
};

/// Converts values that a Scene shares and never changes. Their Python classes have no setters.
template <class T> struct type_caster<std::shared_ptr<const T>> {
  PYBIND11_TYPE_CASTER(std::shared_ptr<const T>, make_caster<T>::name);

  bool load(handle source, bool convert) {
    if (source.is_none()) return false; // left to std::optional's caster
    make_caster<std::shared_ptr<T>> caster;
    if (!caster.load(source, convert)) return false;
    value = cast_op<std::shared_ptr<T>>(caster);
    return true;
  }
  static handle cast(const std::shared_ptr<const T>& shared, return_value_policy policy, handle parent) {
    return make_caster<std::shared_ptr<T>>::cast(std::const_pointer_cast<T>(shared), policy, parent);
  }
};

/// Converts meshes in objects, which must be without colours: these would not be seen.
template <> struct type_caster<std::shared_ptr<const celltrace::Mesh>> {
  PYBIND11_TYPE_CASTER(std::shared_ptr<const celltrace::Mesh>, const_name("Mesh"));

  bool load(handle source, bool convert) {
    make_caster<celltrace::PythonMesh> caster;
    if (source.is_none() || !caster.load(source, convert)) return false;
    const auto& mesh = cast_op<const celltrace::PythonMesh&>(caster);
    if (mesh.colours)
      throw value_error("a Mesh with colours has to be added by Scene.add(), which makes materials of them");
    value = mesh.mesh;
    return true;
  }
  static handle cast(const std::shared_ptr<const celltrace::Mesh>& mesh, return_value_policy, handle parent) {
    return make_caster<std::shared_ptr<celltrace::PythonMesh>>::cast(
        std::make_shared<celltrace::PythonMesh>(celltrace::PythonMesh{mesh}), return_value_policy::automatic,
        parent);
  }
};

} // namespace pybind11::detail

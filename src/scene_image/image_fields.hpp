// Lists the fields of a scene image's records, so that celltrace/spe/byte_order.hpp can convert them for SPEs
// of another byte order.
#pragma once

#include "celltrace/spe/byte_order.hpp"
#include "records/accelerator.hpp"
#include "records/atmosphere.hpp"
#include "records/csg.hpp"
#include "records/image.hpp"
#include "records/instance.hpp"
#include "records/light.hpp"
#include "records/material.hpp"
#include "records/mesh.hpp"
#include "records/object.hpp"
#include "records/function.hpp"
#include "records/pattern.hpp"
#include "records/picture.hpp"
#include "records/random_tables.hpp"

namespace celltrace::kernel {

FieldList<&ImageHeader::magic, &ImageHeader::version, &ImageHeader::bytes, &ImageHeader::checksum,
          &ImageHeader::object_offset, &ImageHeader::object_count, &ImageHeader::material_offset,
          &ImageHeader::material_count, &ImageHeader::interior_offset, &ImageHeader::interior_count,
          &ImageHeader::light_offset, &ImageHeader::light_count, &ImageHeader::extra_offset,
          &ImageHeader::extra_count, &ImageHeader::blend_offset, &ImageHeader::blend_count,
          &ImageHeader::bounds_min, &ImageHeader::bounds_max, &ImageHeader::group_offset,
          &ImageHeader::group_count, &ImageHeader::longest_group, &ImageHeader::prototype_offset,
          &ImageHeader::prototype_count, &ImageHeader::unbounded_count, &ImageHeader::csg_offset,
          &ImageHeader::csg_count, &ImageHeader::csg_step_offset, &ImageHeader::csg_step_count,
          &ImageHeader::solid_offset, &ImageHeader::solid_count, &ImageHeader::pattern_offset,
          &ImageHeader::pattern_count, &ImageHeader::space_step_offset, &ImageHeader::space_step_count,
          &ImageHeader::map_entry_offset, &ImageHeader::map_entry_count, &ImageHeader::normal_offset,
          &ImageHeader::normal_count, &ImageHeader::sky, &ImageHeader::mesh_grid_offset,
          &ImageHeader::mesh_grid_count, &ImageHeader::mesh_word_offset, &ImageHeader::mesh_word_count,
          &ImageHeader::mesh_triangle_offset, &ImageHeader::mesh_triangle_count, &ImageHeader::fog_offset,
          &ImageHeader::fog_count, &ImageHeader::finish_offset, &ImageHeader::finish_count,
          &ImageHeader::light_features, &ImageHeader::feature_offset, &ImageHeader::feature_count,
          &ImageHeader::gradient_offset, &ImageHeader::gradient_count, &ImageHeader::wave_offset,
          &ImageHeader::wave_count, &ImageHeader::light_set_count, &ImageHeader::light_word_offset,
          &ImageHeader::light_word_count, &ImageHeader::shape_data_offset, &ImageHeader::shape_data_count,
          &ImageHeader::rainbow_offset, &ImageHeader::rainbow_count, &ImageHeader::slope_offset,
          &ImageHeader::slope_count, &ImageHeader::projector_count, &ImageHeader::surface_nodes,
          &ImageHeader::instance_offset, &ImageHeader::instance_count, &ImageHeader::mesh_object_offset,
          &ImageHeader::mesh_object_count, &ImageHeader::mesh_node_offset, &ImageHeader::mesh_node_count,
          &ImageHeader::crossed_mesh_offset, &ImageHeader::crossed_mesh_count, &ImageHeader::picture_offset,
          &ImageHeader::picture_count, &ImageHeader::texel_tile_offset, &ImageHeader::texel_tile_count,
          &ImageHeader::function_step_offset, &ImageHeader::function_step_count,
          &ImageHeader::unused>
fields_of(const ImageHeader&);

FieldList<&ObjectRecord::kind_and_flags, &ObjectRecord::material, &ObjectRecord::interior,
          &ObjectRecord::extra, &ObjectRecord::geometry>
fields_of(const ObjectRecord&);

FieldList<&ExtraRecord::value, &ExtraRecord::csg, &ExtraRecord::bounds> fields_of(const ExtraRecord&);

FieldList<&ShapeDataRecord::value> fields_of(const ShapeDataRecord&);

FieldList<&PictureRecord::tiles, &PictureRecord::width, &PictureRecord::height,
          &PictureRecord::tile_columns, &PictureRecord::mapping, &PictureRecord::interpolation,
          &PictureRecord::once, &PictureRecord::reads_transmit, &PictureRecord::repeat,
          &PictureRecord::offset, &PictureRecord::scale, &PictureRecord::filter, &PictureRecord::transmit,
          &PictureRecord::unused>
fields_of(const PictureRecord&);

FieldList<&TexelTileRecord::word> fields_of(const TexelTileRecord&);

FieldList<&FunctionStepRecord::operation_and_result, &FunctionStepRecord::a_and_b, &FunctionStepRecord::c,
          &FunctionStepRecord::constant>
fields_of(const FunctionStepRecord&);

FieldList<&CsgRecord::next, &CsgRecord::steps, &CsgRecord::count, &CsgRecord::skip_begin,
          &CsgRecord::skip_end, &CsgRecord::unused>
fields_of(const CsgRecord&);

FieldList<&CsgStep::solid, &CsgStep::if_inside, &CsgStep::if_outside, &CsgStep::unseen_by>
fields_of(const CsgStep&);

FieldList<&SolidRecord::object, &SolidRecord::extra> fields_of(const SolidRecord&);

FieldList<&MeshGridRecord::starts, &MeshGridRecord::columns, &MeshGridRecord::rows, &MeshGridRecord::unused>
fields_of(const MeshGridRecord&);

FieldList<&MeshTriangleRecord::row, &MeshTriangleRecord::column, &MeshTriangleRecord::slope,
          &MeshTriangleRecord::height, &MeshTriangleRecord::gradient, &MeshTriangleRecord::least_height,
          &MeshTriangleRecord::greatest_height, &MeshTriangleRecord::unused>
fields_of(const MeshTriangleRecord&);

FieldList<&CrossedMeshRecord::corner, &CrossedMeshRecord::next, &CrossedMeshRecord::is_triangle,
          &CrossedMeshRecord::unused>
fields_of(const CrossedMeshRecord&);

FieldList<&InstanceRecord::to_world, &InstanceRecord::normal_to_world, &InstanceRecord::first_number,
          &InstanceRecord::triangle_count, &InstanceRecord::first_triangle, &InstanceRecord::root,
          &InstanceRecord::kind_and_flags, &InstanceRecord::material, &InstanceRecord::interior,
          &InstanceRecord::owner, &InstanceRecord::unused>
fields_of(const InstanceRecord&);

FieldList<&BlendRecord::material, &BlendRecord::unused> fields_of(const BlendRecord&);

FieldList<&MaterialRecord::pigment, &MaterialRecord::filter, &MaterialRecord::transmit,
          &MaterialRecord::opacity, &MaterialRecord::ambient, &MaterialRecord::diffuse,
          &MaterialRecord::brilliance, &MaterialRecord::phong, &MaterialRecord::phong_size,
          &MaterialRecord::specular, &MaterialRecord::inverse_roughness, &MaterialRecord::metallic,
          &MaterialRecord::reflection_min, &MaterialRecord::reflection_max,
          &MaterialRecord::reflection_falloff, &MaterialRecord::reflection_metallic,
          &MaterialRecord::inverse_reflection_exponent, &MaterialRecord::flags, &MaterialRecord::pattern,
          &MaterialRecord::normal, &MaterialRecord::below, &MaterialRecord::finish, &MaterialRecord::inside,
          &MaterialRecord::diffuse_behind>
fields_of(const MaterialRecord&);

FieldList<&TurbulenceWords::amount, &TurbulenceWords::lambda, &TurbulenceWords::omega,
          &TurbulenceWords::octaves>
fields_of(const TurbulenceWords&);

FieldList<&PatternRecord::kind_and_flags, &PatternRecord::entries, &PatternRecord::entry_count,
          &PatternRecord::steps, &PatternRecord::step_count, &PatternRecord::to_space,
          &PatternRecord::frequency, &PatternRecord::phase, &PatternRecord::wave_exponent,
          &PatternRecord::turbulence, &PatternRecord::parameter, &PatternRecord::table>
fields_of(const PatternRecord&);

FieldList<&SlopeRecord::direction, &SlopeRecord::factor, &SlopeRecord::altitude, &SlopeRecord::offset>
fields_of(const SlopeRecord&);

FieldList<&SpaceStepRecord::turbulence, &SpaceStepRecord::to_space, &SpaceStepRecord::kind_and_flags,
          &SpaceStepRecord::table, &SpaceStepRecord::value>
fields_of(const SpaceStepRecord&);

FieldList<&FeatureRecord::place, &FeatureRecord::hash> fields_of(const FeatureRecord&);

FieldList<&GradientRecord::gradient, &GradientRecord::next> fields_of(const GradientRecord&);

FieldList<&WaveRecord::source, &WaveRecord::frequency> fields_of(const WaveRecord&);

FieldList<&MapEntryRecord::position, &MapEntryRecord::inverse_width, &MapEntryRecord::rgb,
          &MapEntryRecord::filter, &MapEntryRecord::transmit, &MapEntryRecord::child>
fields_of(const MapEntryRecord&);

FieldList<&NormalRecord::pattern, &NormalRecord::is_mapped, &NormalRecord::amount, &NormalRecord::accuracy,
          &NormalRecord::linear, &NormalRecord::unused>
fields_of(const NormalRecord&);

FieldList<&FinishRecord::crand, &FinishRecord::irid, &FinishRecord::irid_thickness,
          &FinishRecord::irid_turbulence, &FinishRecord::inverse_wavelength, &FinishRecord::first_generator,
          &FinishRecord::unused>
fields_of(const FinishRecord&);

FieldList<&InteriorRecord::ior, &InteriorRecord::signed_refraction, &InteriorRecord::inverse_fade_distance,
          &InteriorRecord::fade_power, &InteriorRecord::fade_colour, &InteriorRecord::caustics>
fields_of(const InteriorRecord&);

FieldList<&FogRecord::colour, &FogRecord::least, &FogRecord::tint, &FogRecord::inverse_distance,
          &FogRecord::up, &FogRecord::offset, &FogRecord::flags, &FogRecord::turbulence_depth,
          &FogRecord::turbulence, &FogRecord::turbulence_offset, &FogRecord::unused>
fields_of(const FogRecord&);

FieldList<&RainbowRecord::direction, &RainbowRecord::angle, &RainbowRecord::up, &RainbowRecord::inverse_width,
          &RainbowRecord::right, &RainbowRecord::inverse_distance, &RainbowRecord::jitter,
          &RainbowRecord::falloff, &RainbowRecord::arc, &RainbowRecord::inverse_fade, &RainbowRecord::entries,
          &RainbowRecord::entry_count, &RainbowRecord::unused>
fields_of(const RainbowRecord&);

FieldList<&LightRecord::location, &LightRecord::kind_and_flags, &LightRecord::colour, &LightRecord::tightness,
          &LightRecord::axis, &LightRecord::inverse_width, &LightRecord::inner, &LightRecord::inverse_edge,
          &LightRecord::inverse_fade_distance, &LightRecord::fade_power, &LightRecord::across,
          &LightRecord::columns, &LightRecord::along, &LightRecord::rows, &LightRecord::inverse_columns,
          &LightRecord::inverse_rows, &LightRecord::adaptive, &LightRecord::axis_length,
          &LightRecord::lit_sets, &LightRecord::projector, &LightRecord::projector_count,
          &LightRecord::fade_behind>
fields_of(const LightRecord&);

FieldList<&GroupRecord::min, &GroupRecord::first, &GroupRecord::max, &GroupRecord::count>
fields_of(const GroupRecord&);

FieldList<&CellRecord::list, &CellRecord::count> fields_of(const CellRecord&);

FieldList<&NodeRecord::bounds, &NodeRecord::child, &NodeRecord::leaf> fields_of(const NodeRecord&);

} // namespace celltrace::kernel

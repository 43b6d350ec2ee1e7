// The tracer's code modules, in three regions of local store. Modules of one region replace each other: they
// never run together. Kernel dialect.
//
// The comment below each module lists its functions. cmake/celltrace_modules.cmake makes the SPU's linker
// script from these lists. A class stands for all of its functions, a namespace for all of its contents;
// `Name<>` is a template with any arguments; `Name<Type>`, `Name<3u>` and `Name<Enumeration(2)>` are
// templates with at least the given argument; `*Name` ends in Name; `data:` begins the list of functions and
// classes whose constants belong to the module. A function that two modules name belongs to the first of
// them, so that a module with a part of another module's functions comes before the other module. A module
// may call resident code, itself, and modules of other regions that do not call back into its region. The
// tests of the programs' budgets check that each module has a number of its own, takes at most its `bytes`,
// and calls no other module of its region.
#pragma once

#include "celltrace/spe/code_module.hpp"

namespace celltrace::kernel::modules {

// The first region: modules that call no other module.

/// Intersections with shapes other than spheres, triangles, planes and heavy shapes, and the tests of points
/// against solids for CSG.
constexpr CodeModule kShapes = {"shapes", 1, 0, 14592};
//   module_shapes, inside_local, drop_start, *SlabInterval, LocalPrimitive<BoxPrimitive>,
//   LocalPrimitive<ConePrimitive>, LocalPrimitive<CylinderPrimitive>, LocalPrimitive<DiscPrimitive>,
//   LocalPrimitive<EllipsoidPrimitive>, LocalPrimitive<PolygonPrimitive>, BoxPrimitive::intersect_local,
//   ConePrimitive::intersect_local, CylinderPrimitive::intersect_local, DiscPrimitive::intersect_local,
//   EllipsoidPrimitive::intersect_local, PolygonPrimitive::intersect_local

/// Rare patterns, many of which read tables of the scene image.
constexpr CodeModule kRarePatterns = {"rare", 22, 0, 15360};
//   module_rare, CracklePattern, ObjectPattern, *GradientNoise; data: *GradientNoise, CracklePattern.cst16,
//   module_rare

/// Functions of the scene language.
constexpr CodeModule kFunctions = {"functions", 41, 0, 6144};
//   module_functions, FunctionPattern, FunctionInterpreter<>

/// All warps but turbulence.
constexpr CodeModule kWarps = {"warps", 23, 0, 3456};
//   module_warps

/// Surface coordinates and normals for patterns that need them.
constexpr CodeModule kSurfaces = {"surfaces", 25, 0, 3968};
//   find_surface_lanes, surface_coordinates_of; data: find_surface_lanes, surface_coordinates_of

/// Patterns without noise, and patterns of noise with its tables.
constexpr CodeModule kPatterns = {"patterns", 7, 0, 3200};
//   module_patterns, value_of<PatternCode(1)>, *Pattern::value

constexpr CodeModule kNoise = {"noise", 8, 0, 14336};
//   module_noise, value_of<PatternCode(2)>, kernel::noise; data: kernel::noise

/// The light that interiors absorb, the alpha behind interiors, and reflections with an exponent.
constexpr CodeModule kFading = {"fading", 20, 0, 3968};
//   RayTree<>::gather, RayTree<>::redirect, RayTree<>::fade_child, kernel::fade<>, kernel::is_inside

/// The beginning and the end of a frame: construction of the program's objects, and reports.
constexpr CodeModule kStart = {"start", 3, 0, 12800};
//   Tracer<>::Tracer, Tracer<>::start_phase, Tracer<>::begin_frame, Tracer<>::end_frame,
//   Tracer<>::synchronize

/// Antialiasing: processing of the grid's points, and selection of further samples. One module each for the
/// fixed and the adaptive method, without and with alpha.
constexpr CodeModule kSampling = {"sampling", 18, 0, 13056};
//   PixelSampler<SamplingMethod(1), 3u>, FixedSampler<3u>

constexpr CodeModule kSquares = {"squares", 28, 0, 9984};
//   PixelSampler<SamplingMethod(2), 3u>, AdaptiveSampler<3u>

constexpr CodeModule kAlphaSampling = {"alphasampling", 29, 0, 13056};
//   PixelSampler<SamplingMethod(1), 4u>, FixedSampler<4u>

constexpr CodeModule kAlphaSquares = {"alphasquares", 30, 0, 10624};
//   PixelSampler<SamplingMethod(2), 4u>, AdaptiveSampler<4u>

/// First hits of primary rays, written to main memory.
constexpr CodeModule kFirstHits = {"firsthits", 31, 0, 1408};
//   BundleTracer<>::put_first_hits

/// Building of accelerators.
constexpr CodeModule kBuild = {"build", 16, 0, 22016};
//   Tracer<>::prepare, *build_grid, *emit_pairs, *write_lists, *RadixSort, *LocalSortTarget,
//   *for_each_voxel, kernel::bounding_box, *bounds_in_world, kernel::overlaps, *_overlaps, *StreamReader,
//   *StreamWriter

// The second region: shading and evaluation of textures.

/// Tori, quadrics and superellipsoids. In the second region, as rays test these and other shapes in turn.
constexpr CodeModule kHeavyShapes = {"heavy", 4, 1, 8960};
//   module_heavy, LocalPrimitive<TorusPrimitive>, TorusPrimitive::intersect_local, TorusPrimitive::Quartic,
//   LocalPrimitive<QuadricPrimitive>, QuadricPrimitive::intersect_local,
//   LocalPrimitive<SuperellipsoidPrimitive>, SuperellipsoidPrimitive::intersect_local,
//   SuperellipsoidPrimitive::Line

/// Tests of points against shapes with equations of higher degree, and the normals of these shapes.
constexpr CodeModule kHeavyPoints = {"heavypoints", 33, 1, 2688};
//   module_heavy_points

/// Tests of points against meshes, and the crossings of meshes without an inside vector in CSG. In the second
/// region, as CSG with meshes calls this module and kShapes in turn.
constexpr CodeModule kMeshes = {"meshes", 17, 1, 4864};
//   module_meshes

/// Crossings with polygons. In the second region, as rays test polygons and other shapes in turn.
constexpr CodeModule kPolygons = {"polygons", 26, 1, 1024};
//   module_polygons

/// Shapes made of any number of records, each with its tests of rays and of points. In the second region, as
/// rays test these and other shapes in turn.
constexpr CodeModule kPolynomials = {"polynomials", 36, 1, 8960};
//   intersect_data<PolynomialPrimitive>, inside_data<PolynomialPrimitive>, PolynomialPrimitive,
//   PolynomialRoots<PolynomialPrimitive>

constexpr CodeModule kPrisms = {"prisms", 37, 1, 8960};
//   intersect_data<PrismPrimitive>, inside_data<PrismPrimitive>, PrismPrimitive,
//   PolynomialRoots<PrismPrimitive>, is_within_curves<PrismPrimitive>

constexpr CodeModule kRevolved = {"revolved", 38, 1, 8960};
//   intersect_data<SorPrimitive>, inside_data<SorPrimitive>, SorPrimitive,
//   PolynomialRoots<SorPrimitive>

constexpr CodeModule kLathes = {"lathes", 39, 1, 8960};
//   intersect_data<LathePrimitive>, inside_data<LathePrimitive>, LathePrimitive,
//   PolynomialRoots<LathePrimitive>, is_within_curves<LathePrimitive>

constexpr CodeModule kBlobs = {"blobs", 40, 1, 8960};
//   intersect_data<BlobPrimitive>, inside_data<BlobPrimitive>, BlobPrimitive,
//   PolynomialRoots<BlobPrimitive>

/// Instances of meshes. In the second region, as rays test instances and other shapes in turn.
constexpr CodeModule kInstances = {"instances", 35, 1, 7808};
//   module_instances

/// Lights other than simple point lights.
constexpr CodeModule kLights = {"lights", 6, 1, 4864};
//   module_lights, SpotLight::off_axis, CylinderLight::off_axis, kernel::beam_share,
//   kernel::fade_share, kernel::make_parallel, kernel::aim_parallel

/// Sampling of area lights.
constexpr CodeModule kAreas = {"areas", 15, 1, 9472};
//   module_areas, kernel::AreaShadow; data: kJitterX, kJitterY

/// Rays of distant cameras and of cameras whose pictures are not flat.
constexpr CodeModule kCameras = {"cameras", 10, 1, 7808};
//   module_cameras, *Camera::bend, *Camera::turned, *RoundPicture, kernel::along_axes, kernel::sin_cos

constexpr CodeModule kNormals = {"normals", 11, 1, 9344};
//   disturb_normals, disturb_normal, detail::disturb_by, height_of, disturb_part, *slope_disturbance,
//   TextureStage(1)

/// Maps of textures: selection of the entries that count at each point.
constexpr CodeModule kMaps = {"maps", 27, 1, 7680};
//   TextureStage(2)

/// Pigments and normals, without the patterns themselves.
constexpr CodeModule kTextures = {"textures", 9, 1, 7680};
//   TextureStage(0), pigment_at, blend_colours, add_up_leaves, add_pigments, filter_of_texture,
//   filter_of_layers

/// Rare features of finishes, light from behind, and the materials of surfaces that look different from
/// inside.
constexpr CodeModule kFinishes = {"finishes", 19, 1, 5312};
//   *change_special, light_of_both_sides, film_factors, random_at, cosine_of_turns, take_inside_materials

/// Secondary rays.
constexpr CodeModule kSecondary = {"secondary", 2, 1, 8832};
//   RayTree<>::spawn, RayTree<>::transmit, RayTree<>::reflect, RayTree<>::prepare_child, *cross_surfaces,
//   *solid_crossing, kernel::refract, kernel::mirror, find_secondary_rays, secondary_rays_of,
//   kernel::reflectivity, *fresnel

// The third region: stages that run one at a time. Rays are not traced while surfaces are shaded.

/// Positions of hits on objects, and the normals there.
constexpr CodeModule kHits = {"hits", 5, 2, 8064};
//   kernel::find_hit_points, detail::surface_of, kernel::local_normal

/// Tests of objects with a shape of the first region, and of parts of CSG.
constexpr CodeModule kObjects = {"objects", 12, 2, 8960};
//   test_closest_of_other, occluded_by_other, occluded_by_instance, test_instance, ObjectTests<>::accept,
//   ObjectTests<>::accepted, ObjectTests<>::Other, csg_accepted

/// Shading of surfaces with textures or with several materials.
constexpr CodeModule kComposed = {"composed", 13, 2, 7168};
//   SurfaceShading<>::shade_composed, SurfaceShading<>::shade_share, SurfaceShading<>::shade_whole,
//   SurfaceShading<>::shade_layers

/// Atmosphere: the light that fogs and rainbows add to rays or take from rays.
constexpr CodeModule kAtmosphere = {"atmosphere", 24, 2, 7168};
//   light_along, PathRadiance<>, ShadowRadiance<>, through_fog, lanes_in_the_open, ground_density,
//   arc_share, cross_rainbows, see_rainbow, detail::dim_transparency, rainbow_colour

/// The sky that is seen by rays without a hit.
constexpr CodeModule kSky = {"sky", 34, 2, 2048};
//   kernel::add_sky, add_sky_layers, see_through

/// Shadow rays that go from surface to surface.
constexpr CodeModule kShadowWalk = {"walk", 21, 2, 5632};
//   begin_shadow_walk, hits_of_walk, step_shadow_walk, filter_light, add_caustics

/// Encoding of pixels as blocks of BC1.
constexpr CodeModule kEncoding = {"encoding", 32, 2, 6976};
//   PixelWriter<>::send_blocks, kernel::encode_block, kernel::block, kernel::extend_pixels

/// Exchange of units of work with other SPEs.
constexpr CodeModule kExchange = {"exchange", 14, 2, 4992};
//   WorkExchange<>::enter_domain, WorkExchange<>::wait_for_work, WorkExchange<>::act,
//   WorkExchange<>::drain_mailbox, WorkExchange<>::handle

} // namespace celltrace::kernel::modules

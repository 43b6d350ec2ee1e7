// Rendering: a Scene in, a picture out, every ray traced by the SPE program.
#pragma once

#include "celltrace/cache/config.hpp"
#include "celltrace/export.hpp"
#include "celltrace/image.hpp"
#include "celltrace/picture_limit.hpp"
#include "celltrace/ray_queries.hpp"
#include "celltrace/scene.hpp"
#include "celltrace/spe/backend.hpp"
#include "celltrace/spe/emulation.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace celltrace {

/// How the work of a frame is shared between the SPEs; docs/balancing.md compares them.
enum class Balance {
  gde, ///< strips that generalized dimension exchange adjusts while the frame is rendered, cut by what the
       ///< frame before has cost
  diffusion, ///< strips that stay during a frame; a step of first-order diffusion adjusts them between frames
  fixed,     ///< strips of equal size that stay as they are
  scatter,   ///< bundles of packets, dealt one by one in turn
  tiles,     ///< tiles of 4x4 bundles, dealt at random
};

/// How rays find the objects that they may meet.
enum class Accelerator {
  automatic, ///< the BVH
  grid,      ///< a uniform grid of voxels, which an SPE builds
  bvh ///< a bounding volume hierarchy, four wide; where SPEs have no direct memory, the PPE's side builds it
};

/// Called every few milliseconds by the thread that renders, with the finished fraction of the work: starts
/// at 0, never falls, ends at 1 if the work is completed. Return false to cancel.
using Progress = std::function<bool(double fraction)>;

/// Which part of a frame an SPE does (docs/programming-models.md). The picture is the same.
enum class Model {
  shared,   ///< everything: each SPE is a ray tracer of its own
  pipeline, ///< rays go through main memory from SPEs that make them to such that search, and that shade
  pipeline_split, ///< as pipeline, with walking the grid and testing objects on different SPEs
  offload ///< SPEs search for a PPE that does the rest; on a machine of `spes` + 1, the first is the PPE's
          ///< part
};

/// Antialiasing by POV-Ray's methods: pixels are sampled by more rays where colours differ. They are compared
/// by the sum over the channels of the differences of their powers of 1 / gamma, once they are linear: of
/// Scene::assumed_gamma / gamma.
struct Antialiasing {
  enum class Method {
    fixed,   ///< a pixel that differs from its left or upper neighbour, and that neighbour, get depth x depth
             ///< samples and keep the ray through their middle; POV-Ray's method 1
    adaptive ///< a pixel has rays at its corners, and is divided into four as long as the corners of a part
             ///< differ, depth - 1 times at most; POV-Ray's method 2
  };
  Method method = Method::fixed;
  double threshold = 0.3; ///< of differences that count, 0 or more
  int depth = 3;          ///< 1..9
  /// How far samples are moved, from a hash of where they are: 0 (not at all) to 1 (as far as to their
  /// neighbours' places). Another picture than POV-Ray's, whose jitter comes from random numbers.
  double jitter = 0;
  double gamma = 2.5; ///< above 0
};

/// Columns [left, right) and rows [top, bottom) of pixels.
struct PictureRegion {
  int left = 0, right = 0;
  int top = 0, bottom = 0;
};

/// Finished pixels of a frame that goes on.
struct PictureBlock {
  PictureRegion region; ///< where they are in the picture
  /// R, G, B, A of the pixel at its left and top, as those of the result's image.
  const std::uint8_t* first;
  std::size_t pitch; ///< bytes from one row of them to the next
  unsigned spe;      ///< that rendered it
};

/// Who rendered a part of a picture, and what that has cost.
struct WorkRecord {
  PictureRegion region;
  unsigned spe = 0;
  double ticks_per_pixel = 0; ///< of the decrementer, which counts virtual time on emulated machines
};

/// What of a scene is not as it was when the renderer saw it last, besides its camera. Only numbers may have
/// changed for that to be worth while: where there are more or fewer objects, materials or triangles than
/// before, or other shapes with more or less to them, all is made anew.
struct SceneChanges {
  bool objects = true; ///< shapes, places, materials by index, Object::is_hidden
  /// Materials, interiors, lights, fogs, rainbows, the sky, colours of the scene's own, limits.
  bool surfaces = true;
};

struct RenderOptions {
  int width = 640;  ///< pixels, 1..kMaxImageSide
  int height = 480; ///< pixels, 1..kMaxImageSide; kMaxImagePixels in all, unless `rows_at_once`
  Backend backend = Backend::native;
  /// Number of SPEs, up to 256; 0: on native one per CPU that the calling thread may use, on the
  /// others `emulation.timing.spes`. On native, as many SPEs as such CPUs keep to one each.
  unsigned spes = 0;
  /// Of native.
  SimdLevel simd = SimdLevel::automatic;
  /// The software cache of each SPE (native reads memory directly and has none).
  CacheConfig cache;
  Balance balance = Balance::gde;
  /// Pipelines take the grid for automatic, and the split one nothing else.
  Accelerator accelerator = Accelerator::automatic;
  /// Models other than `shared` need 2 SPEs; balance is for `shared` only.
  Model model = Model::shared;
  /// In place of the scene's own settings.
  std::optional<int> max_trace_level;
  std::optional<double> adc_bailout;
  /// POV-Ray's levels, 0 to 11. 0 and 1: colours of pigments alone; from 2 on light falls on surfaces; from 4
  /// on they have shadows; from 5 on those of lights with an area are soft; from 6 on rays go through
  /// transparent surfaces; from 8 on there are reflections and disturbed normals; from 9 on fog and rainbows.
  int quality = 9;
  /// The part of the picture that is rendered: at least a pixel, and all within the picture. The rest is
  /// opaque black, or clear if `alpha`.
  std::optional<PictureRegion> region;
  /// Model `shared` only. Takes 16 bytes of memory a pixel.
  std::optional<Antialiasing> antialiasing;
  /// RenderResult::colours is wanted, too. Model `shared` only. Takes 32 bytes of memory a pixel.
  bool colours = false;
  /// Pixels have alpha, as those of POV-Ray's +UA: they are clear where the camera sees what is behind the
  /// scene, directly or through transparent surfaces. Else they are opaque. Model `shared` only. Takes as
  /// much memory as colours.
  bool alpha = false;
  /// RenderResult::first_hits is wanted, too. Model `shared` only. Takes 20 bytes of memory a pixel besides
  /// those of colours. With the adaptive method of antialiasing they are those at the upper left corners of
  /// pixels, through which its rays go.
  bool first_hits = false;
  /// Pixels leave the SPEs in BC1: RenderResult::blocks. Model `shared` only, without `region`,
  /// `antialiasing`, `colours`, `alpha`, `first_hits` and `finished_block`. encode_blocks() is for other
  /// pictures.
  bool blocks = false;
  /// Most rows that Renderer::render_rows() is asked for at once, a multiple of Renderer::kRowStep or all of
  /// them: memory then has room for as many rows of the region and no more, and results have the pixels that
  /// were rendered alone, the first of them at (0, 0). So pictures of any number of pixels can be rendered.
  /// 0: memory has the whole picture, and so have results. Not with `blocks`.
  int rows_at_once = 0;
  /// Of cell_emu and cell_sim; native knows none of it, and nothing is recorded on cell_sim. The trace is
  /// complete when the renderer is gone.
  EmulationConfig emulation;
  /// Hears how far the image and the accelerator of a scene are, before its first frame and where changes are
  /// made. Where it cancels, or `progress` of render() does, which hears 0 meanwhile, the frame has no pixels
  /// and the renderer no scene.
  Progress build_progress;
  /// Called for every rule of the Cell that an emulated machine saw broken, by the thread that renders or
  /// destroys the renderer. Must not throw.
  std::function<void(const Diagnostic& diagnostic)> diagnostic;
  /// Watches the picture grow: called by the thread that renders for each part that is finished, in no order.
  /// With antialiasing a part may come again, better. The pixels, opaque, are there during the call. What it
  /// throws breaks the frame off and passes through. Of models other than `shared` the picture comes all at
  /// once.
  std::function<void(const PictureBlock& block)> finished_block;
  /// Renderer::ray_queries() is wanted. Takes 4 bytes of memory an object; none for grids.
  bool ray_queries = false;
  /// RenderResult::work is wanted. Model `shared` only.
  bool work_map = false;
  /// A call that renders ends after so many seconds as if its Progress had cancelled it, with the picture so
  /// far; what it has to prepare counts. 0: no limit.
  double most_seconds = 0;
  /// Bytes of the scene's image with its accelerator, and bytes of the picture: more is an InputError before
  /// they are taken. 0: no limit.
  std::uint64_t most_memory = 0;
};

/// What a frame cost. Sums over all SPEs unless said otherwise; what building the accelerator took is only in
/// the seconds and cycles of its own.
struct CELLTRACE_EXPORT RenderStatistics {
  struct Cache {
    std::uint64_t hits = 0, misses = 0;
    /// Hits per read, 0..1; 0 if nothing was read.
    double hit_rate() const;
  };
  struct Spe {
    std::uint64_t rays = 0;
    std::uint32_t packets = 0; ///< of 4x4 primary rays
    std::uint32_t exchanges = 0;
    std::uint32_t busy_ticks = 0;       ///< of the decrementer, in which it did not wait for work
    std::uint64_t local_store_peak = 0; ///< bytes of the arena, since the renderer was made
    SpuCycles cycles;                   ///< virtual time of the frame; all 0 on native
  };

  /// Of models other than `shared`; 0 there.
  struct Stages {
    std::uint32_t generators = 0, shaders = 0, searchers = 0, testers = 0; ///< SPEs by what they do
    std::uint64_t jobs = 0;         ///< of one or more searches, taken from main memory
    std::uint64_t searches = 0;     ///< of 16 rays, each time that one was taken up
    std::uint64_t primary_hits = 0; ///< primary rays that hit something
    /// Split: primary rays that were sent back for traversal at least once, and those of them that hit
    /// something in the end.
    std::uint64_t primary_reprocessed = 0, primary_hits_reprocessed = 0;
    std::uint64_t returns = 0; ///< split: times that a ray was sent back
  };

  Backend backend = Backend::native;
  Model model = Model::shared;
  Stages stages;
  std::string spu; ///< SPU type, e.g. "native.avx512"
  Schedule schedule = Schedule::free;
  std::uint64_t seed = 0;
  int width = 0, height = 0; ///< of the region that is rendered
  std::uint64_t objects = 0; ///< after unions and copies of meshes are taken apart; one for an instance

  /// Primary rays are also those of antialiasing.
  std::uint64_t primary_rays = 0, shadow_rays = 0, reflection_rays = 0, refraction_rays = 0;
  std::uint64_t dropped_rays = 0; ///< cut off by the limits of the SPE program; 0 in any but extreme scenes
  std::uint64_t spilled_packets = 0; ///< that the ray stacks put to main memory for want of local store
  std::map<std::string, std::uint64_t> packet_tests; ///< packet of 16 rays against object, by shape
  std::uint64_t accelerator_visits = 0; ///< voxels by rays, or nodes by bundles, packets and parts of packets

  Accelerator accelerator = Accelerator::grid; ///< never automatic
  std::uint32_t grid_cells[3] = {0, 0, 0};     ///< all 0 for a BVH
  std::uint32_t bvh_nodes = 0;                 ///< 0 for a grid
  std::uint64_t accelerator_list_entries = 0;  ///< object numbers in all lists
  std::uint64_t accelerator_bytes = 0;
  /// What was done about it and the scene image before this frame.
  enum class Preparation {
    built,    ///< all was made
    refitted, ///< records of the image were changed where they are, and the bounds of nodes with them
    updated,  ///< the same, but no object had changed
    kept      ///< only the camera moved, and no record depends on where it is
  };
  Preparation preparation = Preparation::built;
  /// Lines of the image that changed, and that SPEs were told to fetch again; 0 where memory is direct.
  std::uint64_t stale_lines = 0;

  Cache list_cache, object_cache, material_cache, light_cache; ///< all 0 where memory is direct
  std::uint64_t dma_commands = 0, dma_list_elements = 0, dma_bytes_read = 0, dma_bytes_written = 0;
  /// Of those written, pixels as they are traced, without what antialiasing adds.
  std::uint64_t pixel_bytes = 0;
  /// Of a picture in blocks: squared differences from the pixels that were encoded, summed over red, green
  /// and blue.
  std::optional<std::uint64_t> block_error;
  std::uint64_t signals = 0, mailbox_words = 0;
  /// Code modules that SPEs fetched, and waited for. Only cell_emu says so.
  std::uint64_t module_fetches = 0, module_bytes = 0, module_cycles = 0;
  double module_share = 0; ///< of all cycles of all SPEs

  std::uint64_t balance_exchanges = 0;   ///< that moved units of work
  std::uint64_t balance_units_moved = 0; ///< runs of bundles of packets
  /// Greatest over mean load of an SPE, minus 1. The load is its number of rays; in lockstep, its busy ticks.
  double imbalance = 0;

  // Virtual time, 0 on native: the greatest total_cycle of an SPE.
  std::uint64_t prepare_cycles = 0; ///< until the accelerator is built and every SPE knows it
  std::uint64_t render_cycles = 0;
  SpuCycles prepare; ///< where the cycles of building the accelerator went, summed over the SPEs

  double build_seconds = 0;   ///< scene image, on the host
  double prepare_seconds = 0; ///< accelerator, by the SPEs
  double render_seconds = 0;

  /// Corners of a box around all objects that are not infinite.
  Vec3 bounds[2] = {Vec3(0), Vec3(0)};

  std::vector<Spe> spes;
  /// Limits that the scene passes, or the camera: the picture may differ from POV-Ray's.
  std::set<PictureLimit> limits;
  /// Rules that were broken since the frame before.
  std::vector<Diagnostic> diagnostics;

  /// Of a picture in blocks: peak signal-to-noise ratio in dB; infinity if nothing differs.
  std::optional<double> block_psnr() const;
  std::uint64_t total_rays() const { return primary_rays + shadow_rays + reflection_rays + refraction_rays; }
};

/// Adds those of more rows of the same picture.
CELLTRACE_EXPORT void add_rows(RenderStatistics& sum, const RenderStatistics& rows);

/// A picture in blocks, and what they are worth.
struct EncodedPicture {
  BlockImage blocks;
  std::uint64_t error = 0; ///< as RenderStatistics::block_error
};
/// What SPEs would make of these pixels, whose alpha is left out. Throws InputError if the picture is empty
/// or too large.
CELLTRACE_EXPORT EncodedPicture encode_blocks(const Image& picture);

/// As in the statistics' JSON: "pipeline-split", "refitted".
CELLTRACE_EXPORT const char* name_of(Model model);
CELLTRACE_EXPORT const char* name_of(RenderStatistics::Preparation preparation);
/// The statistics as JSON text; docs/statistics.md describes the keys.
CELLTRACE_EXPORT std::string to_json(const RenderStatistics& statistics);

struct RenderResult {
  Image image;
  ColourImage colours;  ///< empty unless RenderOptions::colours
  FirstHits first_hits; ///< empty unless RenderOptions::first_hits
  BlockImage blocks;    ///< empty unless RenderOptions::blocks; `image` then is what they show
  /// Empty unless RenderOptions::work_map; of a broken-off frame what was finished. With antialiasing of the
  /// samples.
  std::vector<WorkRecord> work;
  RenderStatistics statistics;
  bool complete = true; ///< false: cancelled; pixels that were not reached are transparent black
};

/// A render context: a machine whose SPEs run the tracer, kept from frame to frame. After a cancelled frame
/// it renders the next one as usual. Thread safety: one thread at a time; different renderers are
/// independent.
class CELLTRACE_EXPORT Renderer {
public:
  /// Throws InputError for options out of range, Error where the system has no thread or no memory for it.
  explicit Renderer(const RenderOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Renders a frame; `progress` stays at 0 while the scene is made ready, and if it cancels then, there is
  /// none. What the frame before has cost decides which SPE starts where. Throws InputError if the scene is
  /// not valid, SpeError if a kernel failed, OutOfMemory; exceptions of `progress` pass through. After
  /// SpeError the renderer throws again at every call.
  RenderResult render(const Scene& scene, const Progress& progress = {});
  /// As above, with another camera and nothing else changed since the last render(): the accelerator is kept,
  /// or refitted where records depend on the camera's location. The picture is that of render(scene).
  RenderResult render(const Camera& camera, const Progress& progress = {});
  /// As the first one, at the cost of what has changed: `changes` says what of the scene is not as it was at
  /// the last render(), which may have been of another Scene object. Records are changed where they are, SPEs
  /// fetch only those again, and the BVH is refitted, unless it has become so much worse than a new one that
  /// this is cheaper. The picture is that of render(scene), to the bit. Grids and models other than `shared`
  /// are always made anew.
  RenderResult render(const Scene& scene, const SceneChanges& changes, const Progress& progress = {});

  /// From the next frame on pictures have the size, region, antialiasing, colours, alpha, first_hits, blocks,
  /// finished_block, rows_at_once and work_map of `options`, whose other members mean nothing. The scene and
  /// its accelerator stay. Throws InputError for options out of range; then nothing has changed.
  void set_picture(const RenderOptions& options);

  /// What render(scene) does before the first pixel. False: RenderOptions::build_progress cancelled, and
  /// there is no scene. Throws as render() does.
  bool prepare(const Scene& scene);
  /// Rows [top, bottom) of the picture, or of its region, as it would be rendered as a whole, by the scene
  /// and camera that were prepared or rendered last; the rest is opaque black, or left out by
  /// RenderOptions::rows_at_once. Both are multiples of kRowStep, or the last is the height. Pictures can so
  /// be rendered part by part; the statistics of the first part have what preparing took. Of models other
  /// than `shared` all rows at once. Throws InputError for other rows and where no scene is prepared, else as
  /// render() does.
  RenderResult render_rows(int top, int bottom, const Progress& progress = {});
  static constexpr int kRowStep = 32;

  /// Queries of the scene that was prepared or rendered last, with what RenderOptions::max_trace_level and
  /// the like do not change. They are retired when the scene changes, and when records are updated for a
  /// camera elsewhere. On every backend the host's CPU answers them. Throws InputError without
  /// RenderOptions::ray_queries, where no scene is prepared, and where its accelerator is a grid.
  RayQueries ray_queries() const;

private:
  friend RenderResult render(const Scene& scene, const RenderOptions& options, const Progress& progress);
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// One frame on a machine of its own. Safe to call from several threads at once.
CELLTRACE_EXPORT RenderResult render(const Scene& scene, const RenderOptions& options = {},
                                     const Progress& progress = {});

} // namespace celltrace

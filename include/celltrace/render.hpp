// Rendering: makes a picture of a Scene; every ray is traced by the SPE program.
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

/// Ways to share the work of a frame between the SPEs; docs/balancing.md compares them.
enum class Balance {
  gde, ///< strips that generalized dimension exchange adjusts while the frame is rendered; their first sizes
       ///< follow from the cost of the previous frame
  diffusion, ///< strips that stay during a frame; between frames first-order diffusion adjusts the strips by
             ///< one step
  fixed,     ///< strips of equal size that stay as they are
  scatter,   ///< bundles of packets, dealt to the SPEs in turn
  tiles,     ///< tiles of 4x4 bundles, dealt at random
};

/// Data structures by which rays find the objects that they may hit.
enum class Accelerator {
  automatic, ///< the BVH; for the pipeline models the grid
  grid,      ///< a uniform grid of voxels, which an SPE builds
  bvh        ///< a four-wide bounding volume hierarchy; the host builds it if SPEs have no direct memory
};

/// Function that the rendering thread calls every few milliseconds. `fraction` is the finished share of the
/// work: it starts at 0, never falls, and reaches 1 if the work is completed. Returns false to cancel.
using Progress = std::function<bool(double fraction)>;

/// The part of a frame that each SPE does (docs/programming-models.md). All models give the same picture.
enum class Model {
  shared,         ///< everything: each SPE is a whole ray tracer
  pipeline,       ///< stages of SPEs generate, search and shade rays, and pass rays on through main memory
  pipeline_split, ///< as pipeline, but different SPEs traverse the grid and test objects
  offload         ///< SPEs only search; a PPE does everything else, played by the first of `spes` + 1 SPEs
};

/// Antialiasing by POV-Ray's methods: pixels whose colours differ are sampled by more rays. The difference of
/// two linear colours a and b is the sum of |a^e - b^e| over the channels, with e = Scene::assumed_gamma /
/// gamma.
struct Antialiasing {
  enum class Method {
    fixed,   ///< a pixel that differs from its left or upper neighbour, and this neighbour, get depth x depth
             ///< samples besides the ray through the pixel's middle; POV-Ray's method 1
    adaptive ///< rays go through the corners of pixels; a pixel or part of one whose corners differ is
             ///< divided into four, at most depth - 1 times; POV-Ray's method 2
  };
  Method method = Method::fixed;
  double threshold = 0.3; ///< smallest difference that counts, 0 or more
  int depth = 3;          ///< 1..9
  /// Range of the displacement of samples, as a share of the distance between samples, 0 to 1. The
  /// displacement is a hash of the sample's position: the picture differs from POV-Ray's, whose jitter comes
  /// from random numbers.
  double jitter = 0;
  double gamma = 2.5; ///< exponent in the difference of colours, above 0
};

/// A rectangle of pixels: columns [left, right) and rows [top, bottom).
struct PictureRegion {
  int left = 0, right = 0;
  int top = 0, bottom = 0;
};

/// Finished pixels of a frame that is still rendered.
struct PictureBlock {
  PictureRegion region; ///< the pixels' place in the picture
  /// Bytes R, G, B, A of the upper left pixel, as in RenderResult::image.
  const std::uint8_t* first;
  std::size_t pitch; ///< bytes from one row of the block to the next
  unsigned spe;      ///< the SPE that rendered the block
};

/// The SPE that rendered a part of a picture, and the cost.
struct WorkRecord {
  PictureRegion region;
  unsigned spe = 0;
  double ticks_per_pixel = 0; ///< ticks of the decrementer, which counts virtual time on emulated machines
};

/// The parts of a scene that changed since the renderer last saw it; the camera is always read again.
/// Everything is built anew if the number of objects, materials or triangles changed, the kind of a shape, or
/// the size of a shape's data; updating is cheaper only if nothing but values changed.
struct SceneChanges {
  bool objects = true; ///< shapes, transformations, material indices, Object::is_hidden
  /// Materials, interiors, lights, fogs, rainbows, the sky, colours of the scene itself, max_trace_level and
  /// adc_bailout.
  bool surfaces = true;
};

struct RenderOptions {
  int width = 640;  ///< pixels, 1..kMaxImageSide
  int height = 480; ///< pixels, 1..kMaxImageSide; `width` * `height` is at most kMaxImagePixels, unless
                    ///< `rows_at_once` is set
  Backend backend = Backend::native;
  /// Number of SPEs, up to 256. 0: on native one per CPU that the calling thread may use, on the other
  /// backends `emulation.timing.spes`. If native has as many SPEs as the calling thread may use CPUs, each
  /// SPE keeps to one CPU.
  unsigned spes = 0;
  /// SIMD level of native; other backends ignore it.
  SimdLevel simd = SimdLevel::automatic;
  /// The software cache of each SPE (native reads memory directly and has none).
  CacheConfig cache;
  Balance balance = Balance::gde;
  /// The accelerator; `pipeline_split` takes only `automatic` and `grid`.
  Accelerator accelerator = Accelerator::automatic;
  /// Models other than `shared` need at least 2 SPEs and ignore `balance`.
  Model model = Model::shared;
  /// Values that replace Scene::max_trace_level and Scene::adc_bailout; none: the scene's own.
  std::optional<int> max_trace_level;
  std::optional<double> adc_bailout;
  /// POV-Ray's levels of quality, 0 to 11. 0 and 1: colours of pigments alone; from 2 on light falls on
  /// surfaces; from 4 on there are shadows; from 5 on lights with an area have soft shadows; from 6 on rays
  /// go through transparent surfaces; from 8 on there are reflections and disturbed normals; from 9 on fog
  /// and rainbows.
  int quality = 9;
  /// The part of the picture that is rendered: at least a pixel, and all of it within the picture. The rest
  /// of the picture is opaque black, or transparent if `alpha`.
  std::optional<PictureRegion> region;
  /// Antialiasing; none: one ray a pixel. Model `shared` only. Takes 16 bytes of memory a pixel.
  std::optional<Antialiasing> antialiasing;
  /// Fills RenderResult::colours, too. Model `shared` only. Takes 32 bytes of memory a pixel.
  bool colours = false;
  /// Gives pixels alpha, as POV-Ray's +UA does: they are transparent where the camera sees the background,
  /// directly or through transparent surfaces. False: pixels are opaque. Model `shared` only. Takes as much
  /// memory as `colours`.
  bool alpha = false;
  /// Fills RenderResult::first_hits, too. Model `shared` only. Takes 20 bytes of memory a pixel besides the
  /// memory that `colours` takes. With the adaptive method of antialiasing the hits are at the upper left
  /// corners of pixels, because its rays go through corners.
  bool first_hits = false;
  /// Encodes pixels in BC1 on the SPEs, into RenderResult::blocks. Model `shared` only; cannot be combined
  /// with `region`, `antialiasing`, `colours`, `alpha`, `first_hits` or `finished_block`. encode_blocks()
  /// encodes finished pictures.
  bool blocks = false;
  /// Largest number of rows that Renderer::render_rows() is called for at once: a multiple of
  /// Renderer::kRowStep, or all rows. Memory then has room for this number of rows of the region only, so
  /// that pictures of any number of pixels can be rendered. A result has only the rendered rows, with its
  /// first pixel at (0, 0). 0: memory and results hold the whole picture. Not with `blocks`.
  int rows_at_once = 0;
  /// Options of cell_emu and cell_sim; native ignores them, and cell_sim records no trace. The trace is
  /// complete when the renderer has been destroyed.
  EmulationConfig emulation;
  /// Called with the progress of building the scene image and the accelerator, before a scene's first frame
  /// and when changes are made. Meanwhile `progress` of render() is called with 0. If either function
  /// cancels, the frame has no pixels and the renderer no scene.
  Progress build_progress;
  /// Called for every rule of the Cell that a program breaks on an emulated machine, by the thread that
  /// renders or destroys the renderer. Must not throw.
  std::function<void(const Diagnostic& diagnostic)> diagnostic;
  /// Shows the picture while it grows: called by the thread that renders for each finished part, in no
  /// particular order. With antialiasing a part may come again, improved. The pixels are opaque, and valid
  /// during the call. An exception of this function breaks off the frame and passes through. Models other
  /// than `shared` deliver the picture all at once.
  std::function<void(const PictureBlock& block)> finished_block;
  /// Permits Renderer::ray_queries(). Takes 4 bytes of memory an object. Not with Accelerator::grid.
  bool ray_queries = false;
  /// Fills RenderResult::work. Model `shared` only.
  bool work_map = false;
  /// Time limit of a call that renders, in seconds, preparation included. After this time the call ends with
  /// the pixels so far, as if its Progress had cancelled it. 0: no limit.
  double most_seconds = 0;
  /// Limit in bytes of the scene image with its accelerator, and, separately, of the picture. InputError is
  /// thrown before more memory is allocated. 0: no limit.
  std::uint64_t most_memory = 0;
};

/// The cost of a frame: sums over all SPEs unless said otherwise. The cost of building the accelerator is
/// only in `prepare_seconds`, `prepare_cycles` and `prepare`.
struct CELLTRACE_EXPORT RenderStatistics {
  struct Cache {
    std::uint64_t hits = 0, misses = 0;
    /// Returns hits per read, 0..1; 0 if nothing was read.
    double hit_rate() const;
  };
  struct Spe {
    std::uint64_t rays = 0;
    std::uint32_t packets = 0; ///< packets of 4x4 primary rays
    std::uint32_t exchanges = 0;
    std::uint32_t busy_ticks = 0; ///< ticks of the decrementer in which the SPE did not wait for work
    /// Greatest number of bytes of the arena in use, since the renderer was made.
    std::uint64_t local_store_peak = 0;
    SpuCycles cycles; ///< virtual time of the frame; all 0 on native
  };

  /// Statistics of models other than `shared`; all 0 for `shared`.
  struct Stages {
    std::uint32_t generators = 0, shaders = 0, searchers = 0, testers = 0; ///< SPEs by their stage
    std::uint64_t jobs = 0;     ///< jobs of one or more searches that were taken from main memory
    std::uint64_t searches = 0; ///< searches of 16 rays; a search counts again each time that it is resumed
    std::uint64_t primary_hits = 0; ///< primary rays that hit something
    /// For pipeline_split: number of primary rays that were sent back for traversal at least once, and of
    /// such rays that hit something in the end.
    std::uint64_t primary_reprocessed = 0, primary_hits_reprocessed = 0;
    std::uint64_t returns = 0; ///< for pipeline_split: number of times that a ray was sent back
  };

  Backend backend = Backend::native;
  Model model = Model::shared;
  Stages stages;
  std::string spu; ///< SPU type, e.g. "native.avx512"
  Schedule schedule = Schedule::free;
  std::uint64_t seed = 0;
  int width = 0, height = 0; ///< size in pixels of the region that is rendered
  /// Number of objects after unions and copies of meshes are taken apart; an instance counts as one.
  std::uint64_t objects = 0;

  /// Rays by kind; primary rays include rays of antialiasing.
  std::uint64_t primary_rays = 0, shadow_rays = 0, reflection_rays = 0, refraction_rays = 0;
  /// Rays that limits of the SPE program cut off; above 0 only in extreme scenes.
  std::uint64_t dropped_rays = 0;
  /// Packets that the ray stacks moved to main memory because the local store was full.
  std::uint64_t spilled_packets = 0;
  /// Tests of a packet of 16 rays against an object, by shape.
  std::map<std::string, std::uint64_t> packet_tests;
  /// Visits of voxels by rays, or of nodes by bundles, packets and parts of packets.
  std::uint64_t accelerator_visits = 0;

  Accelerator accelerator = Accelerator::grid; ///< the accelerator that was used; never automatic
  std::uint32_t grid_cells[3] = {0, 0, 0};     ///< all 0 for a BVH
  std::uint32_t bvh_nodes = 0;                 ///< 0 for a grid
  std::uint64_t accelerator_list_entries = 0;  ///< object numbers in all lists of voxels or leaves
  std::uint64_t accelerator_bytes = 0;
  /// The work on the accelerator and the scene image before this frame.
  enum class Preparation {
    built,    ///< the scene image and the accelerator were built
    refitted, ///< records of the image were changed in place, and the nodes' bounds adjusted
    updated,  ///< as refitted, but no object had changed
    kept      ///< nothing was changed: only the camera moved, and no record depends on the camera's location
  };
  Preparation preparation = Preparation::built;
  /// Cache lines of the image that changed and that SPEs were told to fetch again; 0 where memory is direct.
  std::uint64_t stale_lines = 0;

  Cache list_cache, object_cache, material_cache, light_cache; ///< all 0 where memory is direct
  std::uint64_t dma_commands = 0, dma_list_elements = 0, dma_bytes_read = 0, dma_bytes_written = 0;
  /// The part of dma_bytes_written that is pixels of the first pass; the pass that samples antialiased pixels
  /// is not counted.
  std::uint64_t pixel_bytes = 0;
  /// Squared differences between a picture in blocks and the pixels before encoding, summed over red, green
  /// and blue. None for other pictures.
  std::optional<std::uint64_t> block_error;
  std::uint64_t signals = 0, mailbox_words = 0;
  /// Code modules that SPEs fetched: their number, their bytes, and the cycles that SPEs waited for them.
  /// Counted on cell_emu only.
  std::uint64_t module_fetches = 0, module_bytes = 0, module_cycles = 0;
  double module_share = 0; ///< share of module_cycles in all cycles of all SPEs

  std::uint64_t balance_exchanges = 0;   ///< exchanges that moved units of work
  std::uint64_t balance_units_moved = 0; ///< units are runs of bundles of packets
  /// Greatest load of an SPE divided by the mean load, minus 1. The load is the number of rays, or in
  /// lockstep the number of busy ticks.
  double imbalance = 0;

  // Virtual time of the SPE with the greatest total_cycle; 0 on native.
  std::uint64_t prepare_cycles = 0; ///< cycles until the accelerator is built and every SPE knows its address
  std::uint64_t render_cycles = 0;
  SpuCycles prepare; ///< cycles that SPEs spent building the accelerator, by use, summed over the SPEs

  double build_seconds = 0;   ///< time for the scene image, on the host
  double prepare_seconds = 0; ///< time for the accelerator
  double render_seconds = 0;

  /// Corners of the bounding box of all objects that are not infinite.
  Vec3 bounds[2] = {Vec3(0), Vec3(0)};

  std::vector<Spe> spes;
  /// Limits that the scene or the camera passes: the picture may differ from POV-Ray's.
  std::set<PictureLimit> limits;
  /// Rules of the Cell that were broken since the frame before.
  std::vector<Diagnostic> diagnostics;

  /// Returns the peak signal-to-noise ratio in dB of a picture in blocks, infinity if nothing differs;
  /// nothing for other pictures.
  std::optional<double> block_psnr() const;
  std::uint64_t total_rays() const { return primary_rays + shadow_rays + reflection_rays + refraction_rays; }
};

/// Adds the statistics of more rows of the same picture to `sum`.
CELLTRACE_EXPORT void add_rows(RenderStatistics& sum, const RenderStatistics& rows);

/// A picture in blocks, and its error.
struct EncodedPicture {
  BlockImage blocks;
  std::uint64_t error = 0; ///< as RenderStatistics::block_error
};
/// Encodes the pixels as SPEs would, without their alpha. Throws InputError if the picture is empty
/// or too large.
CELLTRACE_EXPORT EncodedPicture encode_blocks(const Image& picture);

/// Returns the name in the statistics' JSON, for example "pipeline-split" or "refitted".
CELLTRACE_EXPORT const char* name_of(Model model);
CELLTRACE_EXPORT const char* name_of(RenderStatistics::Preparation preparation);
/// Returns the statistics as JSON text; docs/statistics.md describes the keys.
CELLTRACE_EXPORT std::string to_json(const RenderStatistics& statistics);

struct RenderResult {
  Image image;
  ColourImage colours;  ///< empty unless RenderOptions::colours
  FirstHits first_hits; ///< empty unless RenderOptions::first_hits
  BlockImage blocks;    ///< empty unless RenderOptions::blocks; `image` then is the decoded blocks
  /// Empty unless RenderOptions::work_map. A cancelled frame has the parts that were finished. With
  /// antialiasing the cost is that of the second pass, which samples pixels.
  std::vector<WorkRecord> work;
  RenderStatistics statistics;
  bool complete = true; ///< false: the frame was cancelled; unfinished pixels are transparent black
};

/// A render context: a machine whose SPEs run the tracer, kept from frame to frame. The frame after a
/// cancelled frame is rendered as usual. Thread safety: one thread at a time; different renderers are
/// independent.
class CELLTRACE_EXPORT Renderer {
public:
  /// Makes the machine. Throws InputError for options out of range, Error if the system has no thread or no
  /// memory for the machine.
  explicit Renderer(const RenderOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Renders a frame. `progress` stays at 0 while the scene is prepared; if it cancels then, the frame has no
  /// pixels. The cost of the previous frame decides where in the picture each SPE starts. Throws InputError
  /// if the scene is not valid, SpeError if a kernel failed, and OutOfMemory. Exceptions of `progress` pass
  /// through. After SpeError the renderer throws again at every call.
  RenderResult render(const Scene& scene, const Progress& progress = {});
  /// As above, with another camera and nothing else changed since the last render(): the accelerator is kept,
  /// or refitted if records depend on the camera's location. The picture is the same as render(scene) makes.
  RenderResult render(const Camera& camera, const Progress& progress = {});
  /// As render(scene), but pays only for the changes since the last render(), whose scene may have been
  /// another object. Records are changed in place, and SPEs fetch only changed records again. The BVH is
  /// refitted, unless it has become so much worse than a new BVH that building is cheaper. The picture is the
  /// same to the bit as render(scene) makes. Grids, and everything of models other than `shared`, are always
  /// built anew.
  RenderResult render(const Scene& scene, const SceneChanges& changes, const Progress& progress = {});

  /// Takes over size, region, antialiasing, colours, alpha, first_hits, blocks, finished_block, rows_at_once
  /// and work_map of `options` from the next frame on; other members are ignored. The scene and its
  /// accelerator stay. Throws InputError for options out of range; then nothing has changed.
  void set_picture(const RenderOptions& options);

  /// Does everything that render(scene) does before the first pixel. Returns false if
  /// RenderOptions::build_progress cancelled; there is no scene then. Throws as render() does.
  bool prepare(const Scene& scene);
  /// Renders rows [top, bottom) of the picture, or of its region, with the scene and camera that were
  /// prepared or rendered last. The pixels are exactly those of a whole picture. The other rows are opaque
  /// black, or left out if RenderOptions::rows_at_once is set. `top` and `bottom` are multiples of kRowStep,
  /// but the last `bottom` is the height. The statistics of the first part include the preparation. Models
  /// other than `shared` take all rows at once. Throws InputError for other rows and if no scene is prepared,
  /// else as render() does.
  RenderResult render_rows(int top, int bottom, const Progress& progress = {});
  static constexpr int kRowStep = 32;

  /// Returns ray queries of the scene that was prepared or rendered last. The queries become invalid when the
  /// scene changes, and when records are updated for a camera at another location. The host's CPU answers
  /// them on every backend. Throws InputError without RenderOptions::ray_queries, if no scene is prepared,
  /// and if its accelerator is a grid.
  RayQueries ray_queries() const;

private:
  friend RenderResult render(const Scene& scene, const RenderOptions& options, const Progress& progress);
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Renders one frame on a machine of its own. Safe to call from several threads at once.
CELLTRACE_EXPORT RenderResult render(const Scene& scene, const RenderOptions& options = {},
                                     const Progress& progress = {});

} // namespace celltrace

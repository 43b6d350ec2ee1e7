// The SPE program: an autonomous ray tracer. Kernel dialect.
//
// Between frames only signal 1 (the PPE's commands) and the mailbox are enabled; inside a frame only signal 2
// and the mailbox (the neighbours' balancing, and the PPE's word that ends the frame).
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/program/bundle_tracer.hpp"
#include "kernel/program/frame_sampler.hpp"
#include "kernel/program/prepare_frame.hpp"
#include "kernel/program/work_exchange.hpp"
#include "kernel/program/work_units.hpp"

namespace celltrace::kernel {

template <class Spu, uint32_t kAccelerators> class Tracer {
public:
  /// Allocates memory. `frame_block` is the effective address of the FrameBlock, which stays there while the
  /// program runs.
  Tracer(Spu& spu, ea_t frame_block)
      : spu_(spu), frame_block_(frame_block), frame_(*spu.template allocate<FrameBlock>()),
        report_(*spu.template allocate<ReportRecord>()), strip_(*spu.template allocate<StripRecord>()),
        exchange_(spu), units_(spu), free_(spu.mark()) {}

  void run() {
    // The decrementer runs freely as a clock from here on; its event stays masked.
    spu_.write_decrementer(~0u);
    spu_.write_event_mask(kDomain);
    for (;;) {
      const uint32_t events = spu_.read_event_status();
      spu_.write_event_mask(0);
      spu_.acknowledge_events(events);
      if (spu_.signal_1_count() != 0) {
        const uint32_t commands = spu_.read_signal_1();
        if ((commands & command::quit) != 0) return;
        obey(commands);
      }
      spu_.write_event_mask(kDomain);
    }
  }

private:
  using Colours = V3<typename Spu::simd>;

  static constexpr uint32_t kDomain = event::signal_1;
  static constexpr uint32_t kTag = 0;

  template <class Object> struct alignas(128) Storage { uint8_t bytes[sizeof(Object)]; };
  static bool is_picture(const FrameBlock& frame) {
    const auto purpose = static_cast<FramePurpose>(frame.purpose);
    return purpose == FramePurpose::picture || purpose == FramePurpose::blocks;
  }

  /// The objects for rendering, which are kept from frame to frame, so that the software cache stays warm.
  struct Phase {
    using Sampler = FrameSampler<Spu>;

    Phase(Spu& spu, const FrameBlock& frame, const CacheConfig& config)
        : image(frame.image), ray_stack(frame.ray_stack), needs(needs_of(frame)),
          scene(spu, config, frame.image),
          samples(is_picture(frame) ? nullptr : spu.template allocate<SampleBundle<Spu>>()),
          bundles(spu, frame, scene,
                  frame.ray_stack + static_cast<ea_t>(spu.id() * frame.ray_stack_nodes) * kRayNodeBytes,
                  samples),
          pixels(spu, frame) {
      static_assert(Sampler::kScratchBytes <= BundleTracer<Spu, kAccelerators>::scratch_bytes(),
                    "lies where packets would");
      if (samples != nullptr)
        sampler = new (static_cast<void*>(spu.template allocate<Storage<Sampler>>()))
            Sampler(spu, frame, *samples, bundles.scratch());
    }

    /// Returns the features of frames that change the use of local store.
    static uint32_t needs_of(const FrameBlock& frame) {
      return has_areas(frame) + 2u * walks_shadows(frame) + 4u * has_surface_lanes(frame);
    }
    bool serves(const FrameBlock& frame) const {
      return image == frame.image && ray_stack == frame.ray_stack && needs == needs_of(frame) &&
             (is_picture(frame) || (sampler != nullptr && sampler->serves(frame)));
    }

    ea_t image, ray_stack;
    uint32_t needs;
    SceneAccess<Spu> scene;
    SampleBundle<Spu>* samples; ///< null, as is the sampler, if all frames are pictures
    BundleTracer<Spu, kAccelerators> bundles;
    PixelWriter<Spu, kBundleEdge<Spu>> pixels;
    Sampler* sampler = nullptr;
  };

  void obey(uint32_t commands) {
    fetch(&frame_, frame_block_, sizeof(FrameBlock));
    if ((commands & command::prepare_frame) != 0) {
      spu_.enter_module(modules::kBuild);
      prepare();
    }
    if ((commands & command::synchronize) != 0) {
      spu_.enter_module(modules::kStart);
      synchronize();
    }
    if ((commands & command::render_frame) != 0) render();
  }

  void fetch(void* ls, ea_t ea, uint32_t bytes) {
    spu_.get(ls, ea, bytes, kTag);
    spu_.wait_all(1u << kTag);
  }

  CELLTRACE_ONE_COPY void prepare() {
    spu_.run_in_module(modules::kBuild);
    drop_phase();
    const PrepareResult result = prepare_frame<Spu, kAccelerators>(spu_, frame_);
    report_ = ReportRecord();
    report_.list_entries = result.entries;
    send_report();
    spu_.write_out_mailbox(make_report(result.built ? ReportKind::prepared : ReportKind::needs_memory, 0));
  }

  /// Synchronises after data has changed in main memory or a frame was broken off: no received word is valid
  /// any more.
  CELLTRACE_ONE_COPY void synchronize() {
    spu_.run_in_module(modules::kStart);
    while (spu_.in_mailbox_count() != 0)
      spu_.read_in_mailbox();
    if (phase_ != nullptr && phase_->serves(frame_))
      mark_lines();
    else
      drop_phase();
    spu_.write_out_mailbox(make_report(ReportKind::synchronised, 0));
  }

  /// Marks the cache lines that the PPE has changed; each is fetched again when it is next used.
  void mark_lines() {
    auto& cache = phase_->scene.cache();
    if (frame_.work_entries == kAllLines) return cache.synchronize_all();
    struct alignas(kLineBytes) Lines {
      uint32_t offset[kLineBytes / sizeof(uint32_t)];
    };
    constexpr uint32_t kLines = sizeof(Lines) / sizeof(uint32_t);
    uint8_t* const marked = spu_.mark();
    Lines& lines = *spu_.template allocate<Lines>();
    for (uint32_t first = 0; first < frame_.work_entries; first += kLines) {
      fetch(&lines, frame_.work_memory[0] + first * sizeof(uint32_t), sizeof lines);
      for (uint32_t i = 0; i < kLines && first + i < frame_.work_entries; ++i)
        cache.synchronize_line(lines.offset[i]);
    }
    spu_.release(marked);
  }

  void render() {
    spu_.enter_module(modules::kStart);
    begin_frame();
    [[maybe_unused]] const typename Strategy<Spu>::template ScopedFractals<Spu> fractals(phase_->scene);
    const uint32_t start = spu_.read_decrementer();
    uint32_t idle = 0;
    exchange_.begin_frame(frame_, UnitRange{strip_.begin, strip_.end - strip_.begin});
    while (!exchange_.over()) {
      uint32_t unit = 0;
      if (exchange_.take_unit(unit))
        render_unit(unit);
      else
        idle += wait();
    }
    spu_.enter_module(modules::kStart);
    end_frame(start, idle);
  }
  CELLTRACE_ONE_COPY void begin_frame() {
    spu_.run_in_module(modules::kStart);
    if (phase_ == nullptr) start_phase();
    phase_->scene.cache().reset_counters();
    phase_->bundles.begin_frame();
    phase_->pixels.reset_counters();
    if (!is_picture(frame_)) phase_->sampler->begin_frame();
    fetch(&strip_, frame_.strips + spu_.id() * sizeof(StripRecord), sizeof(StripRecord));
    packets_ = 0;
    units_.begin_frame(frame_);
  }
  /// Ends a frame. `start`: the decrementer at the beginning of the frame. `idle`: ticks without work since
  /// then.
  CELLTRACE_ONE_COPY void end_frame(uint32_t start, uint32_t idle) {
    spu_.run_in_module(modules::kStart);
    phase_->pixels.flush();
    units_.flush();
    phase_->scene.cache().settle();
    exchange_.end_frame();
    report(start - spu_.read_decrementer() - idle);
    spu_.write_out_mailbox(make_report(ReportKind::finished, 0));
  }

  CELLTRACE_ONE_COPY void start_phase() {
    phase_ = new (static_cast<void*>(spu_.template allocate<Storage<Phase>>()))
        Phase(spu_, frame_, cache_config(frame_));
  }
  void drop_phase() {
    phase_ = nullptr;
    spu_.release(free_);
  }

  /// Stores the colours of the packet at (x, y).
  void put(uint32_t x, uint32_t y, const Colours& colours) {
    if (!is_picture(frame_)) {
      constexpr uint32_t kEdge = kBundleEdge<Spu>;
      phase_->samples->at[y % kEdge * kEdge + x % kEdge].store(colours);
      if (static_cast<FramePurpose>(frame_.purpose) == FramePurpose::samples) return;
    }
    phase_->pixels.put(x, y, colours);
  }
  /// Hands traced colours to the sampler. True: there are samples to trace. Not inlined, as local store is
  /// short.
  CELLTRACE_ONE_COPY bool sample(uint32_t column, uint32_t row) {
    return phase_->sampler->advance(column, row);
  }

  /// Renders a unit; breaks off if the frame is declared over meanwhile.
  void render_unit(uint32_t unit) {
    const uint32_t start = spu_.read_decrementer();
    const UnitRecord run = units_.at(unit);
    uint32_t column = run.column;
    uint32_t row = run.row;
    for (uint32_t bundle = 0; bundle < run.bundles; ++bundle) {
      bool more = static_cast<FramePurpose>(frame_.purpose) != FramePurpose::samples || sample(column, row);
      while (more) {
        phase_->bundles.trace(
            column, row,
            [&](uint32_t x, uint32_t y, const Colours& colours) {
              put(x, y, colours);
              ++packets_;
              exchange_.poll();
            },
            [&](uint32_t x, uint32_t y, const auto& colour) {
              if (!is_picture(frame_))
                for (SampleLanes& packet : phase_->samples->at)
                  packet.store(colour);
              phase_->pixels.fill(x, y, colour);
              packets_ += kBundlePackets<Spu>;
              exchange_.poll();
            },
            [this] { return exchange_.poll(); });
        if (exchange_.over()) return phase_->pixels.drop(column * kBundleEdge<Spu>, row * kBundleEdge<Spu>);
        more = !is_picture(frame_) && sample(column, row);
      }
      if (++column == frame_.bundle_columns) {
        column = 0;
        ++row;
      }
    }
    units_.write_cost(unit, start - spu_.read_decrementer());
    if (frame_.units_per_word == kEachUnit) phase_->pixels.flush();
    exchange_.complete_unit(unit);
  }
  /// Waits for work or for the end of the frame; returns the waiting time in ticks. Flushes first, as an SPE
  /// must not report that it is idle before its results are in main memory.
  uint32_t wait() {
    phase_->pixels.flush();
    units_.flush();
    const uint32_t start = spu_.read_decrementer();
    exchange_.wait();
    return start - spu_.read_decrementer();
  }

  void report(uint32_t busy_ticks) {
    report_ = ReportRecord();
    const RayCounters& rays = phase_->bundles.ray_counters();
    report_.primary_rays = rays.primary;
    report_.shadow_rays = rays.shadow;
    report_.reflection_rays = rays.reflection;
    report_.refraction_rays = rays.refraction;
    report_.dropped_rays = rays.dropped;
    const TraversalCounters& traversal = phase_->bundles.traversal_counters();
    for (uint32_t kind = 0; kind < kObjectKinds; ++kind)
      report_.tests[kind] = traversal.tests[kind];
    report_.accelerator_visits = traversal.visits;
    for (uint32_t kind = 0; kind < kDataKinds; ++kind) {
      const CacheCounters counters = phase_->scene.cache().counters(static_cast<DataKind>(kind));
      report_.cache_hits[kind] = counters.hits;
      report_.cache_misses[kind] = counters.misses;
    }
    report_.packets = packets_;
    report_.exchanges = exchange_.exchanges();
    report_.units_received = exchange_.units_received();
    report_.busy_ticks = busy_ticks;
    report_.spilled_nodes = phase_->bundles.spilled_nodes();
    report_.pixel_bytes = phase_->pixels.bytes();
    report_.block_error = phase_->pixels.error();
    send_report();
  }

  void send_report() {
    spu_.put(&report_, frame_.reports + spu_.id() * sizeof(ReportRecord), sizeof(ReportRecord), kTag);
    spu_.wait_all(1u << kTag);
  }

  Spu& spu_;
  ea_t frame_block_;
  FrameBlock& frame_;
  ReportRecord& report_;
  StripRecord& strip_;
  WorkExchange<Spu> exchange_;
  WorkUnits<Spu> units_;
  uint32_t packets_ = 0; ///< packets of the units completed in this frame
  Phase* phase_ = nullptr;
  uint8_t* free_; ///< beginning of the local store for PREPARE FRAME or the rendering phase
};

} // namespace celltrace::kernel

// The program of an SPE that shades: works on the ray trees of many packets at once, each of which waits for
// a search most of the time. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/entry/strategies.hpp"
#include "kernel/models/arrived_light.hpp"
#include "kernel/models/primary_feed.hpp"
#include "kernel/models/search_writer.hpp"
#include "kernel/models/stage.hpp"
#include "kernel/program/pixel_writer.hpp"
#include "kernel/shading/ray_tracer.hpp"

namespace celltrace::kernel::models {

template <class Spu> class Shader {
public:
  using S = typename Spu::simd;
  using F = typename S::F;

  Shader(Spu& spu, ea_t block)
      : spu_(spu), stage_(spu, block), orders_(stage_.orders()), frame_(stage_.frame()),
        doorbell_(spu, orders_), sender_(spu, orders_), feed_(spu, orders_, frame_, sender_),
        scene_(spu, cache_config(stage_.frame()), frame_.image), writer_(spu, sender_), pixels_(spu, frame_),
        light_(spu, frame_), scratch_(*spu.template allocate<RayNode>()),
        arrivals_(spu.template allocate<Arrival>(2)) {
    place_contexts();
  }

  void run() {
    announce();
    uint32_t context = 0;
    bool ahead = false; // true while the answer to `context` is being fetched
    while (ahead || wait_for_answer(context)) {
      if (!ahead) fetch(context);
      const uint32_t present = context;
      current_ ^= 1;
      doorbell_.poll();
      if (doorbell_.take(bell::stop)) stop();
      ahead = doorbell_.take_context(context);
      if (ahead) fetch(context);
      current_ ^= 1;
      spu_.wait_all(tag());
      take(present, arrivals_[current_]);
      current_ ^= 1;
    }
    pixels_.flush();
    spu_.wait_all(PrimaryFeed<Spu>::kTags | SearchWriter<Spu>::kTags);
    report();
  }

private:
  static constexpr uint32_t kFirstTag = 8;
  static constexpr uint32_t kResident = 1; // nodes of each stack in local store

  /// The answer that a context waits for.
  enum class Awaits : uint32_t { packet, hits, light };

  using Tracer = RayTracer<Spu, kResident>;

  struct Context {
    Context(Spu& spu, const FrameBlock& frame, SceneAccess<Spu>& scene, ea_t spill, uint32_t spill_nodes,
            RayNode& scratch)
        : tracer(spu, frame, scene, spill, spill_nodes, scratch) {}

    Tracer tracer;
    HitPoints<S> points;
    VectorLanes of_root; ///< light that has arrived at the root in the first round
    bool is_root = true; ///< true while the root of the tree is shaded
    uint32_t hit = 0;    ///< lanes with a hit
    Awaits awaits = Awaits::packet;
    uint32_t column = 0, row = 0;
    uint32_t searches = 0; ///< number of searches in progress
  };
  struct alignas(128) ContextStorage {
    uint8_t bytes[sizeof(Context)];
  };

  struct Arrival {
    JobRecord job;
    SearchRecord search;
    AnswerBlock lights;
  };

  uint32_t tag() const { return 1u << (kFirstTag + current_); }

  /// Creates as many of this SPE's contexts as local store has room for.
  void place_contexts() {
    constexpr uint32_t bytes = sizeof(ContextStorage) + (kResident + 1) * kRayNodeBytes;
    for (uint32_t context = 0; context < kMaxContexts; ++context) {
      if ((orders_.contexts >> context & 1) == 0) continue;
      if (placed_ != 0 && spu_.available() < bytes + kLineBytes) return;
      const ea_t spill = orders_.ray_stack + static_cast<ea_t>(context * orders_.stack_nodes) * kRayNodeBytes;
      void* const storage = spu_.template allocate<ContextStorage>();
      contexts_[context] = new (storage) Context(spu_, frame_, scene_, spill, orders_.stack_nodes, scratch_);
      placed_ |= 1u << context;
    }
  }
  void announce() {
    if (!stage_.has(task::generate)) {
      spu_.send_signal(orders_.generator, Signal::two, placed_);
      return;
    }
    for_each_lane(placed_, [&](uint32_t context) { feed_.release(context); });
  }

  /// Waits for the answer to a context. Returns false if the frame is over.
  bool wait_for_answer(uint32_t& context) {
    doorbell_.poll();
    while (!doorbell_.take_context(context)) {
      if (doorbell_.take(bell::stop))
        stop();
      else if (doorbell_.take(bell::quit))
        return false;
      else
        doorbell_.wait();
    }
    return true;
  }

  /// Gives up the trees in progress, as they may take minutes.
  void stop() {
    stopped_ = true;
    if (stage_.has(task::generate)) feed_.stop();
  }

  void fetch(uint32_t context) {
    Arrival& to = arrivals_[current_];
    sender_.wait_until_sent(context);
    const uint32_t tag = kFirstTag + current_;
    const ea_t search = sender_.search(context, 0);
    switch (contexts_[context]->awaits) {
    case Awaits::packet:
      spu_.get(&to.job, sender_.job(context), sizeof(JobRecord) + search_part::question, tag);
      return;
    case Awaits::hits:
      spu_.get(&to.search.hits, search + search_part::answer_offset, search_part::answer, tag);
      return;
    case Awaits::light:
      fetch_answers(spu_, search, 0, contexts_[context]->searches, to.lights, tag);
      return;
    }
  }

  void take(uint32_t number, Arrival& arrival) {
    Context& context = *contexts_[number];
    spu_.compute(model_work::kJob);
    sender_.answered(number, PrimaryFeed<Spu>::kTags | SearchWriter<Spu>::kTags);
    switch (context.awaits) {
    case Awaits::packet:
      context.column = arrival.job.column;
      context.row = arrival.job.row;
      context.tracer.begin(arrival.search.rays, arrival.search.lanes);
      context.is_root = true;
      context.of_root.template store<S>({F(0.0f), F(0.0f), F(0.0f)});
      take_hits(number, arrival.search.hits);
      return;
    case Awaits::hits:
      take_hits(number, arrival.search.hits);
      return;
    case Awaits::light:
      light_.arrive(sender_.search(number, 0), context.searches, arrival.lights, kFirstTag + current_);
      take_light(number);
      return;
    }
  }

  void take_hits(uint32_t number, const HitPacket& hits) {
    Context& context = *contexts_[number];
    spu_.compute(model_work::kCopy);
    context.tracer.hits() = hits;
    context.hit = context.tracer.take_hits();
    if (context.hit == 0) {
      go_on(number);
      return;
    }
    find_hit_points(scene_, context.tracer.node().rays, hits, context.hit, context.points);
    if (shade(number)) return;
    light_.arrive_nothing();
    take_light(number);
  }

  /// Shades the hits, and sends a shadow search for every light that counts. Returns false if no light
  /// counts.
  bool shade(uint32_t number) {
    Context& context = *contexts_[number];
    writer_.begin(number);
    for (uint32_t first = 0; first == 0 || first < frame_.light_count; first += kLightsARound) {
      LightRound round = LightRound::from(frame_, first, gathered_);
      round.clear<S>();
      // Pixels receive light in the order of the rounds, as in the other programs.
      round.only_gathers = first != 0;
      context.tracer.shade_hits(context.points, context.hit, round);
      request_light(context, round);
    }
    context.searches = writer_.count();
    if (context.searches == 0) return false;
    context.awaits = Awaits::light;
    writer_.send();
    return true;
  }
  /// Sends the shadow searches of a round. Not inlined, so that its surfaces are not on the stack while hits
  /// are shaded.
  CELLTRACE_ONE_COPY void request_light(Context& context, const LightRound& round) {
    const RayPacket& rays = context.tracer.node().rays;
    Surfaces<S> surfaces =
        context.points.surfaces(rays.direction.template load<S>(), context.tracer.hits().object);
    for_each_light(scene_, frame_, round.first, round.count, [&](uint32_t i, const LightRecord& light) {
      if (is_shadowless(light)) return; // no light is projected, as such scenes are rejected
      const VectorLanes& gathered = round.gathered[i - round.first];
      const uint32_t lanes = context.tracer.lanes_that_count(gathered, context.hit);
      if (lanes == 0) return;
      if (!has_area(light)) {
        IncidentLight<S> incident;
        aim(spu_, light, surfaces.point, incident);
        incident.facing = lanes;
        incident.colour = gathered.template load<S>();
        context.tracer.counters().shadow += static_cast<uint32_t>(__builtin_popcount(lanes));
        request_light_of(i, surfaces, incident);
        return;
      }
      surfaces.any_side = lanes;
      IncidentLight<S> incident(light.colour);
      illuminate(scene_, light, surfaces, lanes, incident);
      for (uint32_t row = 0; row < light.rows; ++row)
        for (uint32_t column = 0; column < light.columns; ++column) {
          IncidentLight<S> from_place(light.colour);
          spu_.enter_module(modules::kAreas);
          module_areas::aim_shadow_rays(spu_, light, surfaces, {column, row}, incident, from_place);
          request_light_of(i, surfaces, from_place);
        }
    });
  }

  void request_light_of(uint32_t number, const Surfaces<S>& surfaces, const IncidentLight<S>& incident) {
    spu_.compute(model_work::kCopy);
    SearchRecord& search = writer_.next();
    make_shadow_rays(surfaces.point, *surfaces.objects, incident, search.rays, search.light.distance);
    search.light.colour.template store<S>(incident.colour);
    search.kind = static_cast<uint32_t>(SearchKind::shadow);
    search.lanes = incident.facing;
    search.reflected = 0;
    search.primary = 0;
    search.number = number;
    writer_.put();
  }

  /// Adds the light that has arrived; the light of the first round at hits of primary rays is added when the
  /// tree is complete.
  void take_light(uint32_t number) {
    Context& context = *contexts_[number];
    for (uint32_t first = 0; first == 0 || first < frame_.light_count; first += kLightsARound) {
      LightRound round = LightRound::from(frame_, first, gathered_);
      round.clear<S>();
      // Answers for areas are the light of places, not the light that surfaces send on.
      round.only_gathers = first == 0;
      if (first != 0 || light_.has_areas()) context.tracer.shade_hits(context.points, context.hit, round);
      if (light_.has_areas())
        take_areas(context, round);
      else
        light_.take(round);
      if (context.is_root && first == 0)
        round.add_to<S>(context.of_root, context.hit);
      else
        context.tracer.add_gathered(round, context.hit);
    }
    go_on(number);
  }
  /// Samples the area lights of a round from the answers. Not inlined, so that its surfaces are not on the
  /// stack while hits are shaded.
  CELLTRACE_ONE_COPY void take_areas(Context& context, const LightRound& round) {
    const RayPacket& rays = context.tracer.node().rays;
    const WordLanes& objects = context.tracer.hits().object;
    Surfaces<S> surfaces = context.points.surfaces(rays.direction.template load<S>(), objects);
    context.tracer.counters().shadow +=
        light_.take(scene_, frame_, round, surfaces, [&](const VectorLanes& gathered) {
          return context.tracer.lanes_that_count(gathered, context.hit);
        });
  }

  /// Advances to the next node of the tree, or to the next packet.
  void go_on(uint32_t number) {
    Context& context = *contexts_[number];
    const bool more = context.tracer.advance();
    context.is_root = false;
    if (more && !stopped_) {
      request_hits(number);
      return;
    }
    if (!more)
      pixels_.put(context.column, context.row,
                  context.tracer.light().template load<S>() + context.of_root.template load<S>());
    context.awaits = Awaits::packet;
    if (stage_.has(task::generate))
      feed_.release(number);
    else
      spu_.send_signal(orders_.generator, Signal::two, 1u << number);
  }

  void request_hits(uint32_t number) {
    Context& context = *contexts_[number];
    const RayNode& node = context.tracer.node();
    writer_.begin(number);
    SearchRecord& search = writer_.next();
    spu_.compute(model_work::kCopy);
    search.rays = node.rays;
    search.kind = static_cast<uint32_t>(SearchKind::closest);
    search.lanes = node.lanes;
    search.reflected = node.reflected;
    search.primary = 0;
    writer_.put();
    context.awaits = Awaits::hits;
    writer_.send();
  }

  void report() {
    ReportRecord& report = stage_.report();
    for_each_lane(placed_, [&](uint32_t number) {
      const Tracer& tracer = contexts_[number]->tracer;
      const RayCounters& rays = tracer.counters();
      report.primary_rays += rays.primary;
      report.shadow_rays += rays.shadow;
      report.reflection_rays += rays.reflection;
      report.refraction_rays += rays.refraction;
      report.dropped_rays += rays.dropped;
      report.spilled_nodes += tracer.spilled_nodes();
    });
    stage_.stage_report().jobs = sender_.jobs();
    stage_.add_cache(scene_);
    stage_.send_reports();
  }

  Spu& spu_;
  Stage<Spu> stage_;
  const StageBlock& orders_;
  const FrameBlock& frame_;
  Doorbell<Spu> doorbell_;
  JobSender<Spu> sender_;
  PrimaryFeed<Spu> feed_;
  SceneAccess<Spu> scene_;
  SearchWriter<Spu> writer_;
  PixelWriter<Spu> pixels_;
  ArrivedLight<Spu> light_;
  VectorLanes gathered_[kLightsARound];
  RayNode& scratch_;
  Arrival* arrivals_;
  uint32_t current_ = 0;
  Context* contexts_[kMaxContexts] = {};
  bool stopped_ = false;
  uint32_t placed_ = 0; ///< contexts that were created
};

/// Runs the program; `argument` is the effective address of the SPE's StageBlock.
template <class Spu> void shader(Spu& spu, ea_t argument) {
  Shader<Spu>(spu, argument).run();
}

} // namespace celltrace::kernel::models

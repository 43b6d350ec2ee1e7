// The program of an SPE that only generates primary rays. Kernel dialect.
#pragma once

#include "kernel/entry/strategies.hpp"
#include "kernel/models/primary_feed.hpp"
#include "kernel/models/stage.hpp"

namespace celltrace::kernel::models {

/// Runs the program; `argument` is the effective address of the SPE's StageBlock.
template <class Spu> void generator(Spu& spu, ea_t argument) {
  Stage<Spu> stage(spu, argument);
  JobSender<Spu> sender(spu, stage.orders());
  PrimaryFeed<Spu> feed(spu, stage.orders(), stage.frame(), sender);
  Doorbell<Spu> doorbell(spu, stage.orders());
  while (!doorbell.take(bell::quit)) {
    uint32_t context = 0;
    if (doorbell.take(bell::stop)) feed.stop();
    while (doorbell.take_context(context))
      feed.release(context);
    doorbell.wait();
  }
  spu.wait_all(PrimaryFeed<Spu>::kTags);
  stage.stage_report().jobs = sender.jobs();
  stage.send_reports();
}

} // namespace celltrace::kernel::models

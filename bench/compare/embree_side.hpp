// Embree (Wald, Woop, Benthin, Johnson and Ernst, 2014), used as its manual recommends.
#pragma once

#include "side.hpp"

#include <memory>
#include <optional>
#include <string>

namespace celltrace::compare {

/// How Embree's rays are asked for, and how its accelerator is built.
struct EmbreeConfig {
  int packet = 16; ///< rays a call: 1, 8 or 16
  enum class Quality {
    high,   ///< static, the slowest builder and the fastest tracing
    medium, ///< static, the default builder
    low,    ///< a dynamic scene and the fastest builder
    refit   ///< a dynamic scene whose nodes get other bounds, after the default builder
  } quality = Quality::high;
};

/// "Embree 3.13.5"; none if the program was built without it, and then nothing below may be called.
std::optional<std::string> embree_version();

/// The widest packets that this processor has vectors for: 16 or 8.
int widest_embree_packet();

/// Square pictures of `size` pixels a side. Throws Error if Embree fails.
std::unique_ptr<Side> make_embree_side(int size, unsigned threads, const EmbreeConfig& config);

} // namespace celltrace::compare

// What a scene says about surfaces and insides, as declared: pigments, finishes, textures, interiors,
// materials.
//
// What POV-Ray has and this program lacks is kept, marked as unsupported, and only an error where an object
// uses it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "celltrace/scene.hpp"
#include "pov/location.hpp"

namespace celltrace::pov {

/// A construct this program does not support, and where it stands.
struct Unsupported {
  std::string what;
  Location where;
};
using UnsupportedPtr = std::shared_ptr<const Unsupported>;

/// Keeps the first of several.
inline void mark(UnsupportedPtr& mark, const UnsupportedPtr& unsupported) {
  if (!mark) mark = unsupported;
}

struct PigmentDefinition {
  Pigment value;
  UnsupportedPtr unsupported;
};

struct FinishDefinition {
  Finish value;
  std::optional<double> ior; ///< POV-Ray 3.1 had it here: it becomes the interior's
  UnsupportedPtr unsupported;
};

using FinishPtr = std::shared_ptr<const FinishDefinition>;

struct TextureDefinition {
  PigmentDefinition pigment;
  FinishDefinition finish;
  UnsupportedPtr unsupported;

  const UnsupportedPtr& first_unsupported() const;
  /// Nothing shines through, so that a layer below does not matter.
  bool is_opaque() const { return pigment.value.filter == 0 && pigment.value.transmit == 0; }
};

/// Equal pointers make equal materials: a texture that is only referred to is not copied.
using TexturePtr = std::shared_ptr<const TextureDefinition>;

TexturePtr with_pigment(const TexturePtr& texture, const PigmentDefinition& pigment);
TexturePtr with_finish(const TexturePtr& texture, const FinishDefinition& finish);
TexturePtr with_unsupported(const TexturePtr& texture, const UnsupportedPtr& unsupported);
/// `top` on `below`: the top alone if it is opaque, otherwise marked unsupported at `where`.
TexturePtr layered(const TexturePtr& below, const TexturePtr& top, const Location& where);

struct InteriorDefinition {
  double ior = 1;
  double fade_distance = 0;
  double fade_power = 0;
  UnsupportedPtr unsupported;
};
using InteriorPtr = std::shared_ptr<const InteriorDefinition>;

struct MaterialDefinition {
  TexturePtr texture; ///< null: none given
  InteriorPtr interior;
  UnsupportedPtr unsupported;
};

} // namespace celltrace::pov

#include "pov/texture.hpp"

namespace celltrace::pov {

const UnsupportedPtr& TextureDefinition::first_unsupported() const {
  if (pigment.unsupported) return pigment.unsupported;
  return finish.unsupported ? finish.unsupported : unsupported;
}

TexturePtr with_pigment(const TexturePtr& texture, const PigmentDefinition& pigment) {
  auto changed = std::make_shared<TextureDefinition>(*texture);
  changed->pigment = pigment;
  return changed;
}

TexturePtr with_finish(const TexturePtr& texture, const FinishDefinition& finish) {
  auto changed = std::make_shared<TextureDefinition>(*texture);
  changed->finish = finish;
  return changed;
}

TexturePtr with_unsupported(const TexturePtr& texture, const UnsupportedPtr& unsupported) {
  auto changed = std::make_shared<TextureDefinition>(*texture);
  mark(changed->unsupported, unsupported);
  return changed;
}

TexturePtr layered(const TexturePtr& below, const TexturePtr& top, const Location& where) {
  if (!below || (top->is_opaque() && !top->first_unsupported())) return top;
  return with_unsupported(top, std::make_shared<Unsupported>(Unsupported{"a layered texture", where}));
}

} // namespace celltrace::pov

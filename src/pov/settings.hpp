// Settings that global_settings { } and the scene itself make.
#pragma once

#include <optional>

#include "pov/texture_actions.hpp"

namespace celltrace::pov {

void set_assumed_gamma(Session& session, double gamma, const Location& where);
/// Without a gamma colours are encoded as sRGB. As in POV-Ray, the first one of a scene counts.
void set_assumed_gamma(Session& session, std::optional<double> gamma, const Location& where);
void set_max_trace_level(Session& session, double level, const Location& where);
void set_noise_generator(Session& session, double number, const Location& where);
void set_adc_bailout(Session& session, double share, const Location& where);
void set_number_of_waves(Session& session, double number, const Location& where);

void set_photons(Session& session, const Location& where);
/// Passes over radiosity { }, which is not supported at qualities that have it.
void refuse_radiosity(Session& session, const Location& where);
/// Passes over a block of the scene's that is not supported.
void refuse_block(Session& session, NameId word, const Location& where);

/// Has a pigment, normal or finish be that of the default texture.
template <class Part>
void set_default(Session& session, const std::shared_ptr<const Part>& part, const Location& where) {
  TexturePtr& texture = session.builder.default_texture;
  texture = with(session, texture, part, where);
}
/// Passes over a block that is not supported.
void set_unsupported_default(Session& session, NameId word, const Location& where);

} // namespace celltrace::pov

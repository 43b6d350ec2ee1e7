// Settings that global_settings { } and the scene itself make.
#pragma once

#include <optional>

#include "pov/texture_actions.hpp"

namespace celltrace::pov {

void set_assumed_gamma(Session& session, double gamma, const Location& where);
/// Sets the scene's gamma; without a value, colours are encoded as sRGB. As in POV-Ray, the first
/// assumed_gamma of a scene counts.
void set_assumed_gamma(Session& session, std::optional<double> gamma, const Location& where);
void set_max_trace_level(Session& session, double level, const Location& where);
void set_noise_generator(Session& session, double number, const Location& where);
void set_adc_bailout(Session& session, double share, const Location& where);
void set_number_of_waves(Session& session, double number, const Location& where);

void set_photons(Session& session, const Location& where);
/// Skips radiosity { }, which is an error at qualities that have radiosity: it is not supported.
void refuse_radiosity(Session& session, const Location& where);
/// Skips a block of the scene that is not supported.
void refuse_block(Session& session, NameId word, const Location& where);

/// Makes a pigment, normal or finish that of the default texture.
template <class Part>
void set_default(Session& session, const std::shared_ptr<const Part>& part, const Location& where) {
  TexturePtr& texture = session.builder.default_texture;
  texture = with(session, texture, part, where);
}
/// Skips a block that is not supported.
void set_unsupported_default(Session& session, NameId word, const Location& where);

} // namespace celltrace::pov

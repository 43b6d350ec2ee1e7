// Settings that global_settings { } and the scene itself make.
#include <algorithm>

#include "pov/actions.hpp"

namespace celltrace::pov {

void set_assumed_gamma(Session& session, double gamma, const Location& where) {
  set_assumed_gamma(session, std::optional(positive(session, gamma, "assumed_gamma", where)), where);
}

void set_assumed_gamma(Session& session, std::optional<double> gamma, const Location& where) {
  if (session.builder.gamma_is_given())
    session.diagnostics.warn_once(where,
                                  "this assumed_gamma is ignored: the first one of a scene is its gamma");
  else
    session.builder.set_assumed_gamma(gamma);
}

void set_max_trace_level(Session& session, double level, const Location& where) {
  constexpr double kMost = 256;
  if (level > kMost) session.diagnostics.warn(where, "max_trace_level is 256, which is the most there is");
  session.builder.set_max_trace_level(level >= 1 ? static_cast<int>(std::min(level, kMost)) : 1);
}

void set_adc_bailout(Session& session, double share, const Location& where) {
  if (share > 1)
    session.diagnostics.warn_once(where, "an adc_bailout above 1 cuts all rays: the picture is black");
  session.builder.set_adc_bailout(share);
}

void set_noise_generator(Session& session, double number, const Location& where) {
  if (!(number >= 1 && number < 4)) session.fail(where, "there are noise generators 1, 2 and 3");
  session.builder.set_noise_generator(static_cast<int>(number));
}

void set_number_of_waves(Session& session, double number, const Location& where) {
  constexpr double kMost = 1000;
  if (!(number < kMost + 1)) session.fail(where, "there are at most 1000 waves");
  session.builder.set_number_of_waves(static_cast<int>(std::max(number, 1.0)));
}

void set_photons(Session& session, const Location& where) {
  if (renders_media(session)) session.builder.set_photons(make_unsupported("'photons'", where));
  session.tokens.skip_group();
}

void refuse_radiosity(Session& session, const Location& where) {
  if (renders_media(session)) session.diagnostics.supports(make_unsupported("'radiosity'", where), where);
  session.tokens.skip_group();
}

void refuse_block(Session& session, NameId word, const Location& where) {
  session.diagnostics.supports(unsupported_block(session, word, where), where);
  session.tokens.skip_group();
}

void set_unsupported_default(Session& session, NameId word, const Location& where) {
  TexturePtr& texture = session.builder.default_texture;
  texture = with_unsupported(texture, unsupported_block(session, word, where));
  session.tokens.skip_group();
}

} // namespace celltrace::pov

#include "viewer/state_log.hpp"

#include "celltrace/error.hpp"

#include <nlohmann/json.hpp>

namespace celltrace::viewer {

namespace {

nlohmann::ordered_json json_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

} // namespace

StateLog::StateLog(const std::filesystem::path& file) {
  if (file.empty()) return;
  out_.open(file, std::ios::trunc);
  if (!out_) throw InputError(file.string() + ": cannot be written");
}

void StateLog::write(const State& state) {
  const Frame& frame = *state.frame;
  nlohmann::ordered_json json = {{"seconds", state.seconds},
                                 {"window", {state.width, state.height}},
                                 {"picture", {frame.image.width, frame.image.height}},
                                 {"scale", frame.scale},
                                 {"complete", frame.is_complete},
                                 {"final", state.is_final},
                                 {"antialiased", frame.is_antialiased},
                                 {"backend", state.backend},
                                 {"spu", frame.statistics.spu},
                                 {"model", static_cast<int>(frame.statistics.model)},
                                 {"wanted_model", static_cast<int>(state.model)},
                                 {"mode", state.situation.mode},
                                 {"view", state.situation.view},
                                 {"information", state.information},
                                 {"strips", state.strips},
                                 {"costs", state.costs},
                                 {"patches", frame.work.size()},
                                 {"help", state.help},
                                 {"help_pages", state.help_pages},
                                 {"hint", state.hint},
                                 {"full_screen", state.full_screen},
                                 {"antialiasing", state.antialiasing},
                                 {"paused", state.situation.is_paused},
                                 {"frames_per_second", state.situation.frames_per_second},
                                 {"still", state.situation.is_still},
                                 {"render_seconds", frame.statistics.render_seconds},
                                 {"virtual_cycles", frame.statistics.render_cycles},
                                 {"latency", state.latency},
                                 {"error", state.error},
                                 {"message", state.message},
                                 {"screenshot", state.screenshot}};
  if (state.camera)
    json["camera"] = {{"location", json_of(state.camera->location)},
                      {"direction", json_of(state.camera->direction)},
                      {"right", json_of(state.camera->right)},
                      {"up", json_of(state.camera->up)}};
  if (state.picked) {
    json["picked"] = {
        {"object", nullptr}, {"distance", state.picked->distance}, {"point", json_of(state.picked->point)}};
    if (const auto& object = state.picked->object) {
      json["picked"]["object"] = *object;
      if (state.names != nullptr && state.names->contains(*object)) {
        const ObjectNames::Place written = state.names->written(*object);
        json["picked"]["kind"] = state.names->kind(*object);
        json["picked"]["name"] = state.names->name(*object);
        json["picked"]["file"] = written.file;
        json["picked"]["line"] = written.line;
      }
    }
  }
  out_ << json.dump() << std::endl;
}

} // namespace celltrace::viewer

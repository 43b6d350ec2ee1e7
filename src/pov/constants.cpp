#include "pov/constants.hpp"

#include <algorithm>

#include "celltrace/error.hpp"
#include "pov/functions.hpp"

namespace celltrace::pov {

namespace {

Quantity unit(int count, std::size_t which) {
  Quantity result;
  result.count = count;
  result.v[which] = 1;
  return result;
}

} // namespace

Value value_of(Constant constant, const Session& session) {
  switch (constant) {
  case Constant::x:
    return unit(3, 0);
  case Constant::y:
    return unit(3, 1);
  case Constant::z:
    return unit(3, 2);
  case Constant::u:
    return unit(2, 0);
  case Constant::v:
    return unit(2, 1);
  case Constant::t:
    return unit(4, 3);
  case Constant::pi:
    return Quantity(3.14159265358979323846);
  case Constant::on:
    return Quantity(1);
  case Constant::off:
    return Quantity(0);
  case Constant::clock_delta:
    return Quantity(session.options.frame.clock_delta);
  case Constant::clock:
    return Quantity(session.options.clock);
  case Constant::now:
    return Quantity(days_now());
  case Constant::version:
    return Quantity(session.builder.version());
  }
  return Quantity(0);
}

void declare_predefined(Session& session) {
  const ParseOptions& options = session.options;
  const AnimationFrame& frame = options.frame;
  const std::pair<const char*, double> numbers[] = {
      {"image_width", options.width},      {"image_height", options.height},
      {"frame_number", frame.number},      {"initial_frame", frame.initial_number},
      {"final_frame", frame.final_number}, {"initial_clock", frame.initial_clock},
      {"final_clock", frame.final_clock},  {"clock_on", frame.clock_on ? 1 : 0},
  };
  for (const auto& [name, value] : numbers)
    session.symbols.declare(session.names.intern(name), Quantity(value));
  session.symbols.declare(session.names.intern("input_file_name"), session.sources.name(0));

  for (const auto& [name, value] : options.declares) {
    const auto is_word_character = [](char c) {
      return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_word_character) ||
        (name[0] >= '0' && name[0] <= '9') || session.names[session.names.intern(name)].token != 0)
      throw InputError("'" + name + "' cannot be declared: it is not a free name of the scene language");
    Value declared;
    if (const double* number = std::get_if<double>(&value))
      declared = Quantity(*number);
    else
      declared = std::get<std::string>(value);
    session.symbols.declare(session.names.intern(name), std::move(declared));
  }
}

} // namespace celltrace::pov

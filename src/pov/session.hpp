// The state of one parse.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "celltrace/pov.hpp"
#include "geometry/function_machine.hpp"
#include "image/source_image.hpp"
#include "pov/diagnostics.hpp"
#include "pov/input.hpp"
#include "pov/memory.hpp"
#include "pov/names.hpp"
#include "pov/scene_builder.hpp"
#include "pov/sources.hpp"
#include "pov/symbols.hpp"
#include "pov/token_stream.hpp"

namespace celltrace::pov {

class Parser;

struct Session {
  explicit Session(const ParseOptions& parse_options)
      : options(parse_options), sources(parse_options), diagnostics(sources, names, input, parse_options),
        tokens(*this), origins(parse_options, names, sources),
        builder(parse_options.limits, diagnostics, tokens, origins) {}

  const ParseOptions& options;
  MemoryCount memory{options.limits}; ///< first member, so that it outlives all that it counts
  Names names;
  Sources sources;
  Input input;
  Diagnostics diagnostics;
  Symbols symbols;
  TokenStream tokens;
  Origins origins;
  SceneBuilder builder;
  FunctionMachine functions;
  std::vector<std::uint32_t> random_streams; ///< states of seed()'s streams
  bool reads_utf8 = false; ///< texts are UTF-8, by `charset utf8`
  std::uint64_t text_bytes = 0;
  std::uint64_t written_bytes = 0;                   ///< bytes that #write has written
  std::vector<std::shared_ptr<DataFile>> data_files; ///< files that are open since an #fopen
  /// Pictures that have been read, by the names that the scene gives them.
  std::map<std::string, std::shared_ptr<const image::SourceImage>> pictures;
  MemoryShare picture_memory; ///< of all pictures together
  std::uint64_t shape_tests = 0;                     ///< tests of shapes by trace() and similar functions
  std::uint64_t bounds_tests = 0; ///< the same of objects that are compared with their bounds
  TexturePtr base_texture;        ///< what the pigment or finish being read starts from
  InteriorPtr base_interior;      ///< the same for an interior
  /// Textures, objects and the like whose braces are still open, from the outermost inwards.
  std::vector<std::variant<TexturePtr, std::shared_ptr<ObjectDefinition>, std::shared_ptr<FinishDefinition>,
                           MaterialDefinition>>
      unfinished;
  std::vector<std::shared_ptr<ObjectDefinition>> lights; ///< being read, in each other
  std::vector<std::shared_ptr<Parser>> parsers; ///< one for each entry of the grammar, made when first needed

  [[noreturn]] void fail(const Location& where, const std::string& what) const {
    diagnostics.fail(where, what);
  }

  // Checks what a number must be where it is used: finite, and a float, a small integer or a vector.
  double number(const Quantity& quantity, const Location& where) const;
  std::int64_t whole(const Quantity& quantity, const Location& where) const;
  Vec3 vector(const Quantity& quantity, const Location& where) const;
  Pigment colour(const Quantity& quantity, const Location& where) const;

  // Checks that accept numbers that are not finite, as POV-Ray does after a division by zero.
  /// Returns a float of a condition or a loop, finite or not.
  double any_number(const Quantity& quantity, const Location& where) const;
  /// Returns a corner; where it is infinite, it is as far away as boxes reach.
  Vec3 corner(const Quantity& quantity, const Location& where) const;
  /// Returns a colour of light: as bright as possible where it is infinite, and 0 where it is NaN.
  Pigment light(const Quantity& quantity, const Location& where);
  /// Returns a number; 0 if it is not finite.
  double number_or_0(const Quantity& quantity, const Location& where);
  /// Returns a colour of surfaces: 0 where it is not finite, and black if its filter or transmit is not.
  Pigment surface(const Quantity& quantity) const;

  [[noreturn]] void exceed(const Location& where, std::uint64_t ParseLimits::*limit, const std::string& who,
                           const std::string& unit) const {
    diagnostics.exceed(where, limit, who, unit);
  }

  /// Counts bytes towards the limit on text that is made or kept.
  void count_text(std::size_t bytes, const Location& where);
};

/// Runs the grammar on session.tokens from the start of the innermost entry; `depth` is the number of entries
/// around it.
void run_grammar(Session& session, std::size_t depth);

} // namespace celltrace::pov

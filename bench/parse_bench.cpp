// How fast scenes are read: a mesh2 of literals, the same behind an expression, objects, and language that
// loops.
#include "celltrace/pov.hpp"

#include <benchmark/benchmark.h>

#include <sstream>

namespace {

/// A square grid of side * side vertices as a mesh2. A `sign` in front of its counts leaves the lists to the
/// grammar.
std::string mesh_scene(int side, const char* sign) {
  std::ostringstream text;
  text << "#version 3.7;\nmesh2 {\nvertex_vectors { " << sign << side * side;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      text << ",\n<" << 0.125 * x << ", " << 0.001 * (x * y % 97) << ", " << 0.125 * y << ">";
  text << "}\nface_indices { " << sign << 2 * (side - 1) * (side - 1);
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      const int corner = y * side + x;
      text << ",\n<" << corner << ", " << corner + 1 << ", " << corner + side << ">,\n<" << corner + 1 << ", "
           << corner + side + 1 << ", " << corner + side << ">";
    }
  text << "}\n}\n";
  return text.str();
}

std::string sphere_scene(int spheres) {
  std::ostringstream text;
  text << "#version 3.7;\n#declare T = texture { pigment { rgb 1 } }\n";
  for (int i = 0; i < spheres; ++i)
    text << "sphere { <" << 0.125 * i << ", " << 0.001 * (i % 97) << ", -1.5>, 0.25 texture { T } }\n";
  return text.str();
}

std::string loop_scene(int spheres) {
  return "#version 3.7;\n#for (I, 1, " + std::to_string(spheres) +
         ")\n  sphere { <cos(I), sin(I), 0.01*I>*2, 0.1 pigment { color rgb <mod(I, 7)/7, 0.5, 1> } "
         "}\n#end\n";
}

/// A program that computes and places nothing.
std::string arithmetic_scene(int steps) {
  return "#version 3.7;\n#declare P = array[100];\n#for (I, 0, 99) #declare P[I] = <I, 2*I, sin(I)>; #end\n"
         "#declare S = 0;\n#declare J = 0;\n#while (J < " +
         std::to_string(steps) +
         ")\n  #local K = mod(J, 99);\n  #local A = P[K] + (P[K + 1] - P[K])*0.5;\n"
         "  #if (A.x > 50 & J != 3) #declare S = S + vlength(A); #end\n  #declare J = J + 1;\n#end\n";
}

/// Functions that each call the one before twice with the same arguments and twice with others, `depth` deep.
std::string function_nest_scene(int depth) {
  std::ostringstream text;
  text << "#version 3.7;\n#declare F0 = function(x, y) { x*y + 1 }\n";
  for (int i = 1; i <= depth; ++i)
    text << "#declare F" << i << " = function(x, y) { F" << i - 1 << "(x, y)*F" << i - 1 << "(x, y) - F"
         << i - 1 << "(x + 1, y)*F" << i - 1 << "(x, y/2) }\n";
  text << "#declare S = 0;\n#for (I, 1, 1000) #declare S = S + F" << depth << "(I/1000, 0.5); #end\n";
  return text.str();
}

/// A function that is called 1000 times.
std::string function_scene(const std::string& body) {
  return "#version 3.7;\n#declare F = function { " + body +
         " }\n#declare S = 0;\n#for (I, 1, 1000) #declare S = S + F(I/1000, 0.5, 7).x; #end\n";
}

void parse(benchmark::State& state, const std::string& text) {
  for (auto _ : state)
    benchmark::DoNotOptimize(celltrace::parse_string(text));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void parse_mesh2(benchmark::State& state) {
  parse(state, mesh_scene(static_cast<int>(state.range(0)), ""));
}
BENCHMARK(parse_mesh2)->Arg(16)->Arg(256)->Arg(1024)->Unit(benchmark::kMillisecond);

void parse_mesh2_by_grammar(benchmark::State& state) {
  parse(state, mesh_scene(static_cast<int>(state.range(0)), "+"));
}
BENCHMARK(parse_mesh2_by_grammar)->Arg(256)->Unit(benchmark::kMillisecond);

void parse_spheres(benchmark::State& state) {
  parse(state, sphere_scene(static_cast<int>(state.range(0))));
}
BENCHMARK(parse_spheres)->Arg(10000)->Unit(benchmark::kMillisecond);

void parse_loop(benchmark::State& state) {
  parse(state, loop_scene(static_cast<int>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(parse_loop)->Arg(100)->Arg(10000)->Unit(benchmark::kMillisecond);

void parse_arithmetic(benchmark::State& state) {
  parse(state, arithmetic_scene(static_cast<int>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(parse_arithmetic)->Arg(10000)->Unit(benchmark::kMillisecond);

void parse_function_nest(benchmark::State& state) {
  parse(state, function_nest_scene(static_cast<int>(state.range(0))));
}
BENCHMARK(parse_function_nest)->Arg(4)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);

void parse_pigment_function(benchmark::State& state) {
  parse(state, function_scene("pigment { bozo turbulence 0.5 color_map { [0 rgb 0] [1 rgb 1] } }"));
}
BENCHMARK(parse_pigment_function)->Unit(benchmark::kMillisecond);

} // namespace

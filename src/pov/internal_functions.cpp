// POV-Ray's internal functions, function { internal(n) }, which functions.inc gives names to. Most are graphs, so
// that functions inline them and the kernel knows them, too. Formulas are those that were measured.
#include "pov/internal_functions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/function_operations.hpp"
#include "geometry/noise.hpp"

namespace celltrace::pov {

namespace {

/// A value of a graph that is being built, with operators that add values to it.
struct Term {
  FunctionBuilder* graph;
  FunctionValue value;

  Term constant(double number) const { return {graph, graph->constant(number)}; }
  Term apply(FunctionOp op) const { return {graph, graph->apply(op, value)}; }
  Term apply(FunctionOp op, const Term& b) const { return {graph, graph->apply(op, value, b.value)}; }
  Term apply(FunctionOp op, const Term& b, const Term& c) const {
    return {graph, graph->apply(op, value, b.value, c.value)};
  }
};
Term operator+(const Term& a, const Term& b) {
  return a.apply(FunctionOp::add, b);
}
Term operator-(const Term& a, const Term& b) {
  return a.apply(FunctionOp::subtract, b);
}
Term operator*(const Term& a, const Term& b) {
  return a.apply(FunctionOp::multiply, b);
}
Term operator/(const Term& a, const Term& b) {
  return a.apply(FunctionOp::divide, b);
}
Term operator+(const Term& a, double b) {
  return a + a.constant(b);
}
Term operator-(const Term& a, double b) {
  return a - a.constant(b);
}
Term operator-(double a, const Term& b) {
  return b.constant(a) - b;
}
Term operator*(double a, const Term& b) {
  return b.constant(a) * b;
}
Term operator/(double a, const Term& b) {
  return b.constant(a) / b;
}
Term operator-(const Term& a) {
  return a.apply(FunctionOp::negate);
}
Term absolute(const Term& a) {
  return a.apply(FunctionOp::absolute);
}
Term root(const Term& a) {
  return a.apply(FunctionOp::square_root);
}
Term exponential(const Term& a) {
  return a.apply(FunctionOp::exp);
}
Term sine(const Term& a) {
  return a.apply(FunctionOp::sin);
}
Term cosine(const Term& a) {
  return a.apply(FunctionOp::cos);
}
Term power(const Term& a, const Term& b) {
  return a.apply(FunctionOp::power, b);
}
Term angle(const Term& y, const Term& x) {
  return y.apply(FunctionOp::atan2, x);
}
Term least(const Term& a, const Term& b) {
  return a.apply(FunctionOp::minimum, b);
}
Term greatest(const Term& a, const Term& b) {
  return a.apply(FunctionOp::maximum, b);
}
/// Returns the remainder of a division, with the sign of `a`.
Term remainder(const Term& a, const Term& b) {
  return a.apply(FunctionOp::modulo, b);
}
Term if_negative(const Term& a, const Term& then, const Term& otherwise) {
  return a.apply(FunctionOp::pick_negative, then, otherwise);
}
Term if_zero(const Term& a, const Term& then, const Term& otherwise) {
  return a.apply(FunctionOp::pick_zero, then, otherwise);
}
/// Returns the remainder of a division that is not negative, for b > 0.
Term wrapped(const Term& a, const Term& b) {
  const Term rest = remainder(a, b);
  return if_negative(rest, rest + b, rest);
}
Term length(const Term& a, const Term& b) {
  return root(a * a + b * b);
}
Term cube(const Term& a) {
  return a * a * a;
}
Term fourth(const Term& a) {
  return a * a * (a * a);
}

/// The arguments of a call: three coordinates, followed by the parameters p(0), p(1), ...
struct Call {
  FunctionBuilder* graph;
  Term x, y, z;

  Call(FunctionBuilder* builder)
      : graph(builder), x{builder, builder->parameter(0)}, y{builder, builder->parameter(1)},
        z{builder, builder->parameter(2)} {}
  Term p(std::uint32_t i) const { return {graph, graph->parameter(3 + i)}; }
  Term xx() const { return x * x; }
  Term yy() const { return y * y; }
  Term zz() const { return z * z; }
  Term square() const { return xx() + yy() + zz(); }
};

/// Limits values to -`most` to `most`, as POV-Ray does so that isosurfaces stay tame.
Term limited(const Term& v, const Term& most) {
  return least(greatest(v, -most), most);
}
Term limited(const Term& v) {
  return limited(v, v.constant(10));
}

/// Sets x and y to the distance from the y axis less `offset` and the height, turned by an angle in degrees, if
/// parameter `first` is above 0.
void revolve(Call& c, std::uint32_t first) {
  const Term is_on = c.p(first), offset = c.p(first + 1);
  const Term turn = (1 / kDegreesPerRadian) * c.p(first + 2);
  const Term away = root(c.xx() + c.zz()) - offset, cos = cosine(turn), sin = sine(turn);
  const Term x = away * cos - c.y * sin, y = away * sin + c.y * cos;
  c.x = if_negative(-is_on, x, c.x);
  c.y = if_negative(-is_on, y, c.y);
}

/// A norm of two lengths: their maximum for an exponent of 0, the usual length for 1.
Term rounded(const Term& p, const Term& q, const Term& e) {
  const Term a = absolute(p), b = absolute(q);
  const Term any = power(power(a, 2 / e) + power(b, 2 / e), 0.5 * e);
  return if_zero(e, greatest(a, b), if_zero(e - 1, length(a, b), any));
}

/// Three bells along the axes.
struct Bells {
  Term e[3];
  Bells(const Call& c, const Term& e_, const Term& k)
      : e{exponential(-(k * (e_ * c.xx() + e_ * c.yy() + c.zz()))),
          exponential(-(k * (e_ * c.xx() + c.yy() + e_ * c.zz()))),
          exponential(-(k * (c.xx() + e_ * c.yy() + e_ * c.zz())))} {}
};

Term torus_of(const Call& c, double xz, double yz, const Term& y_factor, const Term& z_factor) {
  const Term A = c.p(1) * c.p(1), B = c.p(2) * c.p(2), X = c.xx(), Y = c.yy(), Z = c.zz();
  const Term d = A - B;
  return limited(-(c.p(0) * (X * X + 2 * (X * Y) + xz * (X * Z) - 2 * ((A + B) * X) + Y * Y + yz * (Y * Z) +
                             y_factor * Y + Z * Z + z_factor * Z + d * d)));
}

Term cushion(Call& c) {
  const Term X = c.xx(), Y = c.yy(), Z = c.zz(), d = X - c.z;
  return limited(c.p(0) * (X * Z - Z * Z - 2 * (c.z * X) + 2 * cube(c.z) + X - Z - d * d - Y * Y -
                           2 * (X * Y) - Y * Z + 2 * (Y * c.z) + Y));
}

/// Distances within a pattern of hexagons, across or along their sides.
Term hexagons(const Call& c, bool is_along) {
  const double height = std::sqrt(3.0) / 2;
  const Term h = c.x.constant(height), side = c.x.constant(1.5), degrees30 = c.x.constant(std::acos(-1.0) / 6);
  const Term x = absolute(remainder(absolute(c.x), 2 * h) - h), y = absolute(remainder(absolute(c.y), 2 * side) - side);
  const Term other_x = h - x, other_y = side - y;
  const Term nearer = other_x * other_x + other_y * other_y - (x * x + y * y);
  const Term u = if_negative(nearer, other_x, x), v = if_negative(nearer, other_y, y);
  const Term is_near_x = angle(v, u) - degrees30;
  return is_along ? if_negative(is_near_x, v, absolute(0.5 * v - h * u))
                  : if_negative(is_near_x, u, 0.5 * u + h * v);
}

struct Internal {
  int parameters;          ///< besides the point; below 0: there is no such function
  Term (*value)(Call& c) = nullptr; ///< null: it is not a graph
};

#define CELLTRACE_TERM [](Call & c)->Term

/// The functions by number.
const Internal kInternals[] = {
    {5, CELLTRACE_TERM { // algbr_cyl1
       revolve(c, 2);
       return -limited(-(c.p(0) * (cube(absolute(c.x)) - c.xx() + c.yy())), c.p(1));
     }},
    {5, CELLTRACE_TERM { // algbr_cyl2
       revolve(c, 2);
       const Term X = c.xx(), Y = c.yy();
       return limited(-(c.p(0) * (2 * (X * X) - 3 * (X * c.y) + Y - 2 * (Y * c.y) + Y * Y)), c.p(1));
     }},
    {5, CELLTRACE_TERM { // algbr_cyl3
       revolve(c, 2);
       const Term X = c.xx(), Y = c.yy();
       return limited(-(c.p(0) * (X * X + X * Y - 2 * (X * c.y) - c.x * Y + Y)), c.p(1));
     }},
    {5, CELLTRACE_TERM { // algbr_cyl4
       revolve(c, 2);
       const Term X = c.xx(), Y = c.yy();
       return limited(-(c.p(0) * (X * X + Y * Y + 2 * (X * Y) + 3 * (X * c.y) - Y * c.y)), c.p(1));
     }},
    {2, CELLTRACE_TERM { // bicorn
       const Term s = c.p(1), flat = c.xx() + c.zz();
       const Term b = flat + 2 * (s * c.y) - s * s;
       return limited(c.p(0) * (c.yy() * (s * s - flat) - b * b));
     }},
    {2, CELLTRACE_TERM { // bifolia
       const Term all = c.square();
       return limited(-(c.p(0) * (all * all - c.p(1) * ((c.xx() + c.zz()) * c.y))));
     }},
    {5, CELLTRACE_TERM { // blob
       const Term half = 0.5 * c.p(0), one = c.x.constant(1);
       const auto part = [&](const Term& x, std::uint32_t i) {
         const Term k = c.p(i + 1), d = x * x + c.yy() + c.zz();
         const Term left = 1 - least(one, d * k * k);
         return c.p(i) * left * left;
       };
       return -(part(c.x + half, 1) + part(c.x - half, 3));
     }},
    {4, CELLTRACE_TERM { // blob2
       const Term moved = c.x - c.p(0), k = c.p(1);
       return c.p(3) - c.p(2) * (exponential(-(k * c.square())) +
                                 exponential(-(k * (moved * moved + c.yy() + c.zz()))));
     }},
    {2, CELLTRACE_TERM { // boy_surface
       const Term z = c.z, Z = c.zz(), q = 1 - z, p = c.xx() + c.yy(), root2 = c.x.constant(std::sqrt(2.0));
       const Term first = 64 * (cube(q) * cube(z)) - 48 * (q * q * Z * (3 * p + 2 * Z));
       const Term second = 12 * (q * z * (27 * (p * p) - 24 * (Z * p) +
                                          36 * (root2 * (c.y * z * (c.yy() - 3 * c.xx()))) + 4 * (Z * Z)));
       const Term third = (9 * p - 2 * Z) * (-(81 * (p * p)) - 72 * (Z * p) +
                                             108 * (root2 * (c.x * z * (c.xx() - 3 * c.yy()))) + 4 * (Z * Z));
       return limited(c.p(0) * c.p(1) * (first + second + third));
     }},
    {1, CELLTRACE_TERM { // comma
       const Term s = c.p(0), half = 0.5 * s, moved = c.x - half;
       const Term r = length(c.x + 0.25 * s, c.z), turn = 0.5 * angle(c.z, c.x);
       const Term head = cosine(turn) * half - length(r - 0.75 * s, c.y);
       return -greatest(least(c.z, head), half - root(moved * moved + c.yy() + c.zz()));
     }},
    {4, CELLTRACE_TERM { // cross_ellipsoids
       const Bells b(c, c.p(0), c.p(1));
       return c.p(3) - c.p(2) * greatest(b.e[0], greatest(b.e[1], b.e[2]));
     }},
    {1, CELLTRACE_TERM { return limited(c.p(0) * (c.xx() * c.zz() - c.y)); }}, // crossed_trough
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (cube(c.x) - cube(c.y) - c.z))); }}, // cubic_saddle
    {1, cushion}, // cushion
    {1, CELLTRACE_TERM { // devils_curve
       const Term X = c.xx(), Y = c.yy(), Z = c.zz();
       return limited(-(c.p(0) * (X * X + 2 * (X * Z) - 0.36 * X - Y * Y + 0.25 * Y + Z * Z)));
     }},
    {6, CELLTRACE_TERM { // devils_curve_2d
       revolve(c, 3);
       const Term X = c.xx(), Y = c.yy();
       return limited(-(c.p(0) * (X * (X - c.p(1) * c.p(1)) - Y * (Y - c.p(2) * c.p(2)))));
     }},
    {6, CELLTRACE_TERM { // dupin_cyclid
       const Term M = c.p(1), m = c.p(2), f = c.p(3), d = c.p(4), r = c.p(5), rr = r * r;
       const Term p1 = m * m - d * d - (f + M) * (f + M), p2 = m * m - d * d - (f - M) * (f - M);
       const Term S = c.square(), line = f * c.x + d * c.y, r4 = rr * rr;
       return limited(-(c.p(0) * (p1 * p2 * S * S +
                                  2 * (rr * ((m * m - d * d - f * f + M * M) * (2 * line - rr) - 4 * (d * m * m * c.y)) * S) +
                                  4 * (r4 * line * (line - rr)) + 4 * (r4 * M * M * c.yy()) + r4 * r4)));
     }},
    {3, CELLTRACE_TERM { // ellipsoid
       return root(c.xx() * c.p(0) * c.p(0) + c.yy() * c.p(1) * c.p(1) + c.zz() * c.p(2) * c.p(2));
     }},
    {1, CELLTRACE_TERM { // enneper
       const Term z = if_negative(absolute(c.z) - 0.2, c.z.constant(0.2), c.z);
       const Term d = c.yy() - c.xx(), u = d / (2 * z) + (2.0 / 9) * (z * z), w = d / (4 * z);
       return limited(-(c.p(0) * (cube(u) - 6 * (w * w))));
     }},
    {4, CELLTRACE_TERM { // flange_cover
       const Bells b(c, c.p(0), c.p(1));
       return c.p(3) - c.p(2) * (b.e[0] + b.e[1] + b.e[2]);
     }},
    {3, CELLTRACE_TERM { // folium_surface
       const Term a = c.p(1), b = c.p(2);
       return limited(c.p(0) * ((c.yy() + c.zz()) * (1 - (-((b - 4 * a) * c.x))) + c.xx() * (b + 1)));
     }},
    {6, CELLTRACE_TERM { // folium_surface_2d
       revolve(c, 3);
       const Term a = c.p(1), b = c.p(2);
       return limited(-(c.p(0) * (c.yy() * (1 - (-((b - 4 * a) * c.x))) + c.xx() * (b + 1))));
     }},
    {1, CELLTRACE_TERM { // glob
       const Term X = c.xx();
       return limited(c.p(0) * (0.5 * (X * X * c.x) + 0.5 * (X * X) - c.yy() - c.zz()));
     }},
    {1, CELLTRACE_TERM { // heart
       const Term s = 2 * c.xx() + c.yy() + c.zz() - 1, z3 = cube(c.z);
       return limited(-(c.p(0) * (cube(s) - 0.1 * (c.xx() * z3) - c.yy() * z3)));
     }},
    {10, CELLTRACE_TERM { // helical_torus
       const Term R = c.p(0), m = c.p(5), pi = c.x.constant(std::acos(-1.0));
       const Term q = length(c.x, c.z), ph = angle(c.x, c.z), r = length(q - R, c.y), d = r - m;
       const Term th = wrapped(ph * c.p(1) + angle(q - R, c.y) * c.p(2), 2 * pi) - pi;
       const Term wave = c.p(3) * cosine(c.p(7) * angle(th * c.p(8), d) + c.p(9) * ph);
       return -greatest(c.p(4) + m - R - q, c.p(4) + wave - least(root(d * d + c.p(6) * th * th), r + m));
     }},
    {7, CELLTRACE_TERM { // helix1
       const Term n = c.p(0), p = c.p(1), R = c.p(3), e = c.p(5), pi = c.x.constant(std::acos(-1.0));
       const Term q = length(c.x, c.z), th = wrapped(n * angle(c.z, c.x) + c.y * p * n, 2 * pi) - pi;
       const Term a = q - R, b = th / (c.p(4) * p * n), turn = (1 / kDegreesPerRadian) * c.p(6);
       const Term turned = rounded(a * cosine(turn) - b * sine(turn), a * sine(turn) + b * cosine(turn), e);
       return least(R + q, if_zero(e - 1, rounded(a, b, e), turned)) - c.p(2);
     }},
    {7, CELLTRACE_TERM { // helix2
       const Term t = c.y * c.p(1), R = c.p(3);
       const Term x = c.x - R * cosine(t), z = c.z - R * sine(t);
       return rounded(x * cosine(t) + z * sine(t), z * cosine(t) - x * sine(t), c.p(5)) - c.p(2);
     }},
    {1, CELLTRACE_TERM { return hexagons(c, false); }}, // hex_x
    {1, CELLTRACE_TERM { return hexagons(c, true); }},  // hex_y
    {6},  // hetero_mf
    {1, CELLTRACE_TERM { // hunt_surface
       const Term S = c.square() - 13, d = 3 * c.xx() + c.yy() - 4 * c.zz() - 12;
       return limited(-(c.p(0) * (4 * cube(S) + 27 * (d * d))));
     }},
    {3, CELLTRACE_TERM { // hyperbolic_torus
       const Term A = c.p(1) * c.p(1), B = c.p(2) * c.p(2);
       return torus_of(c, -2, -2, 2 * (A - B), 2 * (A + B));
     }},
    {4, CELLTRACE_TERM { // isect_ellipsoids
       const Bells b(c, c.p(0), c.p(1));
       return c.p(3) - c.p(2) * least(b.e[0], least(b.e[1], b.e[2]));
     }},
    {3, CELLTRACE_TERM { // kampyle_of_eudoxus
       const Term b = c.p(1), d = c.p(2), dd = d * d;
       return limited(-(c.p(0) * (c.yy() + c.zz() - dd * fourth(c.x) + dd * b * b * c.xx())));
     }},
    {6, CELLTRACE_TERM { // kampyle_of_eudoxus_2d
       revolve(c, 3);
       const Term b = c.p(1), d = c.p(2), dd = d * d;
       return limited(-(c.p(0) * (c.yy() - dd * fourth(c.x) + dd * d * b * c.xx())));
     }},
    {1, CELLTRACE_TERM { // klein_bottle
       const Term S = c.square(), m = S - 2 * c.y - 1;
       return limited(-(c.p(0) * ((S + 2 * c.y - 1) * (m * m - 8 * c.zz()) + 16 * (c.x * c.z * m))));
     }},
    {1, CELLTRACE_TERM { // kummer_surface_v1
       const Term X = c.xx(), Y = c.yy(), Z = c.zz();
       return limited(-(c.p(0) * (X * X + Y * Y + Z * Z - (X + Y + Z) - X * Y - X * Z - Y * Z + 1)));
     }},
    {4, CELLTRACE_TERM { // kummer_surface_v2
       const Term X = c.xx(), Y = c.yy(), Z = c.zz();
       return limited(-(c.p(0) * (X * X + Y * Y + Z * Z + c.p(1) * (X + Y + Z) +
                                  c.p(2) * (X * Y + X * Z + Y * Z) + c.p(3) * (c.x * c.y * c.z) - 1)));
     }},
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (fourth(c.x) - c.xx() + c.yy() + c.zz()))); }}, // lemniscate_of_gerono
    {6, CELLTRACE_TERM { // lemniscate_of_gerono_2d
       revolve(c, 3);
       const Term b = c.p(1), d = c.p(2), dd = d * d;
       return limited(-(c.p(0) * (c.yy() - dd * b * b * c.xx() + dd * fourth(c.x))));
     }},
    {5, CELLTRACE_TERM { // mesh1
       const Term p = c.p(0), q = c.p(1), k = c.p(2), A = c.p(3), j = c.p(4), pi = c.x.constant(std::acos(-1.0));
       const auto wave = [&](const Term& t, const Term& P) { return k * absolute(wrapped(t, 2 * P) - P); };
       const Term across = A * cosine(c.z * pi / q), along = A * cosine(c.x * pi / p);
       return least(least(length(j * (c.y - across), wave(c.x, p)), length(j * (c.y + across), wave(c.x - p, p))),
                    least(length(j * (c.y + along), wave(c.z, q)), length(j * (c.y - along), wave(c.z - q, q))));
     }},
    {1, CELLTRACE_TERM { // mitre
       return limited(-(c.p(0) * (4 * (c.xx() * c.square()) - c.yy() * (1 - c.yy() - c.zz()))));
     }},
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (cube(c.y) + cube(c.z) - 6 * (c.y * c.z)))); }}, // nodal_cubic
    {1, cushion}, // odd
    {4, CELLTRACE_TERM { // ovals_of_cassini
       const Term b = c.p(1) * c.p(1), s = c.square() + b;
       return limited(-(c.p(0) * (s * s - c.p(3) * b * (c.xx() + c.zz()) - c.p(2) * c.p(2))));
     }},
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (c.xx() - c.y + c.zz()))); }}, // paraboloid
    {3, CELLTRACE_TERM { // parabolic_torus
       const Term A = c.p(1) * c.p(1), B = c.p(2) * c.p(2), X = c.xx(), Y = c.yy(), z = c.z, d = A - B;
       return limited(-(c.p(0) * (X * X + 2 * (X * Y) - 2 * (X * z) - (A + B) * X + Y * Y - 2 * (Y * z) +
                                  (A - B) * Y + c.zz() + (A + B) * z + d * d)));
     }},
    {0, CELLTRACE_TERM { return angle(root(c.xx() + c.zz()), c.y); }}, // ph
    {1, CELLTRACE_TERM { // pillow
       const Term X = c.xx(), Y = c.yy(), Z = c.zz();
       return limited(c.p(0) * (X * X + Y * Y + Z * Z - (X + Y + Z)));
     }},
    {1, CELLTRACE_TERM { // piriform
       return -limited(-(c.p(0) * (fourth(c.x) - cube(c.x) + c.yy() + c.zz())));
     }},
    {7, CELLTRACE_TERM { // piriform_2d
       revolve(c, 4);
       const Term d = c.p(3), dd = d * d;
       return limited(-(c.p(0) * (c.yy() - c.p(1) * dd * cube(c.x) - c.p(2) * dd * fourth(c.x))));
     }},
    {5, CELLTRACE_TERM { // poly4
       const Term sum = (((c.p(4) * c.y + c.p(3)) * c.y + c.p(2)) * c.y + c.p(1)) * c.y + c.p(0);
       return root(c.xx() + c.zz()) - greatest(c.x.constant(-5), sum);
     }},
    {6}, // polytubes
    {1, CELLTRACE_TERM { // quantum
       const Term cos = cosine(angle(root(c.xx() + c.zz()), c.y)), r = 2 * root(c.square());
       const Term t = r * r * exponential(-0.33333333 * r) * (3 * (cos * cos) - 1);
       return -0.1 * (t * t - 12);
     }},
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (fourth(c.x) + fourth(c.z) - c.y))); }}, // quartic_paraboloid
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (fourth(c.x) - fourth(c.z) - c.y))); }}, // quartic_saddle
    {3, CELLTRACE_TERM { // quartic_cylinder
       const Term d = c.p(1), e = c.p(2), flat = c.xx() + c.zz();
       return limited(-(c.p(0) * (flat * c.yy() + e * e * flat - e * e * d * d)));
     }},
    {0, CELLTRACE_TERM { return root(c.square()); }}, // r
    {6}, // ridge
    {6}, // ridged_mf
    {4, CELLTRACE_TERM { // rounded_box
       const Term r = c.p(0), zero = c.x.constant(0);
       const Term a = greatest(absolute(c.x) - (c.p(1) - r), zero), b = greatest(absolute(c.y) - (c.p(2) - r), zero),
                  d = greatest(absolute(c.z) - (c.p(3) - r), zero);
       return root(a * a + b * b + d * d) - r - 1e-6;
     }},
    {1, CELLTRACE_TERM { return root(c.square()) - c.p(0); }}, // sphere
    {5, CELLTRACE_TERM { // spikes
       const Bells b(c, c.p(0), c.p(1));
       return -(c.p(2) * (c.p(4) * exponential(-(c.p(3) * c.square())) - b.e[0] - b.e[1] - b.e[2]));
     }},
    {4, CELLTRACE_TERM { // spikes_2d
       const Term waves = cosine(c.p(1) * c.x) * cosine(c.p(2) * c.z);
       return c.y - c.p(0) * waves * exponential(-(c.p(3) * (c.xx() + c.zz())));
     }},
    {6, CELLTRACE_TERM { // spiral
       const Term d = c.p(0), w = c.p(1), S = c.square();
       const Term r = length(c.x, c.z) + d * angle(c.z, c.x) / c.x.constant(2 * std::acos(-1.0));
       const Term q = rounded(remainder(r, d) - 0.5 * d, c.y, c.p(5));
       return -least(c.p(2) - root(S), w - least(q, root(S)));
     }},
    {1, CELLTRACE_TERM { // steiners_roman
       const Term X = c.xx(), Y = c.yy(), Z = c.zz();
       return limited(-(c.p(0) * (X * Y + X * Z + Y * Z + c.x * c.y * c.z)));
     }},
    {4, CELLTRACE_TERM { // strophoid
       const Term d = c.p(3) * c.p(3), X = c.xx();
       return limited(-(c.p(0) * ((c.p(2) - c.x) * (c.yy() + c.zz()) - d * c.p(1) * X - d * cube(c.x))));
     }},
    {7, CELLTRACE_TERM { // strophoid_2d
       revolve(c, 4);
       const Term d = c.p(3) * c.p(3), X = c.xx();
       return limited(-(c.p(0) * ((c.p(2) - c.x) * c.yy() - d * c.p(1) * X - d * cube(c.x))));
     }},
    {2, CELLTRACE_TERM { // superellipsoid
       const Term e = c.p(0), n = c.p(1);
       const Term around = power(absolute(c.x), 2 / e) + power(absolute(c.y), 2 / e);
       return 1 - power(power(around, e / n) + power(absolute(c.z), 2 / n), 0.5 * n);
     }},
    {0, CELLTRACE_TERM { return angle(c.x, c.z); }}, // th
    {2, CELLTRACE_TERM { return length(length(c.x, c.z) - c.p(0), c.y) - c.p(1); }}, // torus
    {3, CELLTRACE_TERM { // torus2
       const Term A = c.p(1) * c.p(1), B = c.p(2) * c.p(2), S = c.square(), d = A - B;
       return limited(-(c.p(0) * (S * S - 2 * ((A + B) * c.xx()) + 2 * ((A - B) * c.yy()) - 2 * ((A + B) * c.zz()) + d * d)));
     }},
    {1, CELLTRACE_TERM { // torus_gumdrop
       const Term flat = c.yy() + c.zz();
       return limited(-(c.p(0) * (4 * (fourth(c.x) + flat * flat) + 17 * (c.xx() * flat) - 20 * c.square() + 17)));
     }},
    {1, CELLTRACE_TERM { return limited(-(c.p(0) * (c.xx() - c.y * c.zz()))); }}, // umbrella
    {2, CELLTRACE_TERM { // witch_of_agnesi
       return limited(-(c.p(0) * (c.p(1) * (c.y - 1) + (c.xx() + c.zz()) * c.y)));
     }},
    {6, CELLTRACE_TERM { // witch_of_agnesi_2d
       revolve(c, 3);
       return limited(-(c.p(0) * (c.p(1) * c.p(1) * c.y + c.xx() * c.y - c.p(2))));
     }},
    {0}, // noise3d
    {-1},
    {1}, // noise_generator
};

#undef CELLTRACE_TERM

constexpr int kHeteroMf = 29, kPolytubes = 52, kRidge = 58, kRidgedMf = 59, kNoise = 76, kNoiseGenerator = 78;

/// Noise of a generator, at points that are scaled from octave to octave.
class Octaves {
public:
  Octaves(const double* arguments, double lacunarity, double generator)
      : at_(arguments[0], arguments[1], arguments[2]), lacunarity_(lacunarity),
        generator_(std::trunc(generator) == 2 ? 2 : std::trunc(generator) == 3 ? 3 : 1) {}

  /// Returns the noise at the present octave's points, and goes to the next octave.
  double next() {
    const double sum = at_.x + at_.y + at_.z;
    const double noise = std::isfinite(sum) ? noise_value(at_, generator_) : sum - sum;
    at_ *= lacunarity_;
    return noise;
  }

private:
  Vec3 at_;
  double lacunarity_;
  int generator_;
};
constexpr double kMostOctaves = 64;

double hetero_mf(const double* arguments) {
  const double* const p = arguments + 3;
  Octaves noise(arguments, p[1], p[5]);
  const double octaves = std::min(p[2], kMostOctaves), power = std::trunc(p[4]);
  const auto next = [&] { return 2 * noise.next() - 1 + p[3]; };
  double sum = next();
  int i = 1;
  for (; i < octaves; ++i)
    sum += next() * std::pow(p[1], -p[0] * i) * std::pow(sum, power);
  const double rest = octaves - std::floor(octaves);
  if (rest > 0) sum += rest * next() * std::pow(p[1], -p[0] * i) * sum;
  return sum;
}

/// Distance from the nearest of some tubes around the y axis, whose distance from the axis is a polynomial.
double polytubes(const double* arguments) {
  const double* const p = arguments + 3;
  const double y = arguments[1], away = (((p[5] * y + p[4]) * y + p[3]) * y + p[2]) * y + p[1];
  constexpr double kMostTubes = 10000, kFarthest = 10000;
  double nearest = kFarthest;
  for (int i = 0; i < std::min(p[0], kMostTubes); ++i) {
    const double turn = 2 * std::acos(-1.0) * i / p[0];
    nearest = std::min(nearest, std::hypot(arguments[0] - away * std::sin(turn), arguments[2] - away * std::cos(turn)));
  }
  return nearest;
}

double ridge(const double* arguments) {
  const double* const p = arguments + 3;
  Octaves noise(arguments, p[0], p[5]);
  const double octaves = std::min(p[1], kMostOctaves);
  double sum = 0, weights = 0, weight = 1;
  for (double left = octaves; left > 0; left -= 1, weight *= p[2]) {
    const double share = weight * std::min(left, 1.0);
    sum += share * (std::fabs(noise.next() - p[4]) / std::max(p[4], 1 - p[4]) - p[3]);
    weights += share;
  }
  return sum / weights / std::max(p[3], 1 - p[3]);
}

double ridged_mf(const double* arguments) {
  const double* const p = arguments + 3;
  Octaves noise(arguments, p[1], p[5]);
  const auto next = [&] {
    const double height = p[3] - std::fabs(2 * noise.next() - 1);
    return height * height;
  };
  double signal = next(), sum = signal;
  for (int i = 1; i < std::min(p[2], kMostOctaves); ++i) {
    const double weight = std::min(std::max(signal * p[4], 0.0), 1.0);
    signal = weight * next();
    sum += signal * std::pow(p[1], -p[0] * i);
  }
  return sum;
}

/// An internal function without a graph, mostly because it has noise.
class NativeInternal final : public NativeFunction {
public:
  explicit NativeInternal(int number)
      : NativeFunction(3 + static_cast<std::size_t>(kInternals[number].parameters), 1), number_(number) {}
  void evaluate(const double* arguments, const FunctionContext& context, double* results) const override {
    int generator = context.noise_generator;
    switch (number_) {
    case kHeteroMf:
      *results = hetero_mf(arguments);
      return;
    case kPolytubes:
      *results = polytubes(arguments);
      return;
    case kRidge:
      *results = ridge(arguments);
      return;
    case kRidgedMf:
      *results = ridged_mf(arguments);
      return;
    default:
      break;
    }
    if (number_ == kNoiseGenerator) {
      const double given = std::trunc(arguments[3]);
      generator = given == 2 ? 2 : given == 3 ? 3 : 1;
    }
    const double sum = arguments[0] + arguments[1] + arguments[2];
    *results = std::isfinite(sum) ? noise_value({arguments[0], arguments[1], arguments[2]}, generator) : sum - sum;
  }

private:
  int number_;
};

} // namespace

std::optional<InternalFunction> internal_function(int number) {
  const bool is_known =
      number >= 0 && number < static_cast<int>(std::size(kInternals)) && kInternals[number].parameters >= 0;
  if (!is_known) return std::nullopt;
  const Internal& internal = kInternals[number];
  const auto parameters = 3 + static_cast<std::size_t>(internal.parameters);
  if (internal.value == nullptr) return InternalFunction{std::make_shared<const NativeInternal>(number), parameters};
  FunctionBuilder builder(static_cast<std::uint32_t>(parameters));
  Call call(&builder);
  const Term value = internal.value(call);
  return InternalFunction{std::make_shared<const FunctionCode>(builder.finish(value.value)), parameters};
}

} // namespace celltrace::pov

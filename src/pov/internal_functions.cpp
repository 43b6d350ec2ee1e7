// POV-Ray's internal functions, function { internal(n) }, which functions.inc gives names to.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/noise.hpp"
#include "pov/user_function.hpp"

namespace celltrace::pov {

namespace {

/// The arguments of a call: three coordinates, followed by the parameters p[0], p[1], ...
struct InternalCall {
  const FunctionContext& context;
  double x, y, z;
  const double* p;

  double r2() const { return x * x + y * y + z * z; }
};

struct Internal {
  int parameters;
  double (*value)(const InternalCall&); ///< null if the function is not supported
};

double rounded_box(const InternalCall& c) {
  const double radius = c.p[0];
  double square = 0;
  const double coordinates[] = {c.x, c.y, c.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max(std::fabs(coordinates[axis]) - (c.p[1 + axis] - radius), 0.0);
    square += beyond * beyond;
  }
  return std::sqrt(square) - radius;
}

double superellipsoid(const InternalCall& c) {
  const double around = std::pow(std::fabs(c.x), 2 / c.p[0]) + std::pow(std::fabs(c.y), 2 / c.p[0]);
  const double all = std::pow(around, c.p[0] / c.p[1]) + std::pow(std::fabs(c.z), 2 / c.p[1]);
  return 1 - std::pow(all, c.p[1] / 2);
}

double noise_at(const InternalCall& c, int generator) {
  const double sum = c.x + c.y + c.z;
  return std::isfinite(sum) ? noise_value({c.x, c.y, c.z}, generator) : sum - sum;
}

/// The functions by number.
constexpr Internal kInternals[] = {
    {5, nullptr}, // f_algbr_cyl1
    {5, nullptr}, // f_algbr_cyl2
    {5, nullptr}, // f_algbr_cyl3
    {5, nullptr}, // f_algbr_cyl4
    {2, nullptr}, // f_bicorn
    {2, nullptr}, // f_bifolia
    {5, nullptr}, // f_blob
    {4, nullptr}, // f_blob2
    {2, nullptr}, // f_boy_surface
    {1, nullptr}, // f_comma
    {4, nullptr}, // f_cross_ellipsoids
    {1, nullptr}, // f_crossed_trough
    {1, nullptr}, // f_cubic_saddle
    {1, nullptr}, // f_cushion
    {1, nullptr}, // f_devils_curve
    {6, nullptr}, // f_devils_curve_2d
    {6, nullptr}, // f_dupin_cyclid
    // f_ellipsoid
    {3,
     [](const InternalCall& c) {
       return std::sqrt(c.x * c.x * c.p[0] * c.p[0] + c.y * c.y * c.p[1] * c.p[1] +
                        c.z * c.z * c.p[2] * c.p[2]);
     }},
    {1, nullptr},  // f_enneper
    {4, nullptr},  // f_flange_cover
    {3, nullptr},  // f_folium_surface
    {6, nullptr},  // f_folium_surface_2d
    {1, nullptr},  // f_glob
    {1, nullptr},  // f_heart
    {10, nullptr}, // f_helical_torus
    {7, nullptr},  // f_helix1
    {7, nullptr},  // f_helix2
    {1, nullptr},  // f_hex_x
    {1, nullptr},  // f_hex_y
    {6, nullptr},  // f_hetero_mf
    {1, nullptr},  // f_hunt_surface
    {3, nullptr},  // f_hyperbolic_torus
    {4, nullptr},  // f_isect_ellipsoids
    {3, nullptr},  // f_kampyle_of_eudoxus
    {6, nullptr},  // f_kampyle_of_eudoxus_2d
    {1, nullptr},  // f_klein_bottle
    {1, nullptr},  // f_kummer_surface_v1
    {4, nullptr},  // f_kummer_surface_v2
    {1, nullptr},  // f_lemniscate_of_gerono
    {6, nullptr},  // f_lemniscate_of_gerono_2d
    {5, nullptr},  // f_mesh1
    {1, nullptr},  // f_mitre
    {1, nullptr},  // f_nodal_cubic
    {1, nullptr},  // f_odd
    {4, nullptr},  // f_ovals_of_cassini
    {1, nullptr},  // f_paraboloid
    {3, nullptr},  // f_parabolic_torus
    // f_ph
    {0, [](const InternalCall& c) { return std::atan2(std::sqrt(c.x * c.x + c.z * c.z), c.y); }},
    {1, nullptr}, // f_pillow
    {1, nullptr}, // f_piriform
    {7, nullptr}, // f_piriform_2d
    // f_poly4
    {5,
     [](const InternalCall& c) {
       const double r = std::sqrt(c.x * c.x + c.z * c.z);
       return r - ((((c.p[4] * c.y + c.p[3]) * c.y + c.p[2]) * c.y + c.p[1]) * c.y + c.p[0]);
     }},
    {6, nullptr}, // f_polytubes
    {1, nullptr}, // f_quantum
    {1, nullptr}, // f_quartic_paraboloid
    {1, nullptr}, // f_quartic_saddle
    {3, nullptr}, // f_quartic_cylinder
    // f_r
    {0, [](const InternalCall& c) { return std::sqrt(c.r2()); }},
    {6, nullptr}, // f_ridge
    {6, nullptr}, // f_ridged_mf
    // f_rounded_box
    {4, rounded_box},
    // f_sphere
    {1, [](const InternalCall& c) { return std::sqrt(c.r2()) - c.p[0]; }},
    {5, nullptr}, // f_spikes
    {4, nullptr}, // f_spikes_2d
    {6, nullptr}, // f_spiral
    {1, nullptr}, // f_steiners_roman
    {4, nullptr}, // f_strophoid
    {7, nullptr}, // f_strophoid_2d
    // f_superellipsoid
    {2, superellipsoid},
    // f_th
    {0, [](const InternalCall& c) { return std::atan2(c.x, c.z); }},
    // f_torus
    {2, [](const InternalCall& c) { return std::hypot(std::hypot(c.x, c.z) - c.p[0], c.y) - c.p[1]; }},
    {3, nullptr}, // f_torus2
    {1, nullptr}, // f_torus_gumdrop
    {1, nullptr}, // f_umbrella
    {2, nullptr}, // f_witch_of_agnesi
    {6, nullptr}, // f_witch_of_agnesi_2d
    // f_noise3d
    {0, [](const InternalCall& c) { return noise_at(c, c.context.noise_generator); }},
    {-1, nullptr},
    // f_noise_generator
    {1,
     [](const InternalCall& c) {
       const double generator = std::trunc(c.p[0]);
       return noise_at(c, generator == 2 ? 2 : generator == 3 ? 3 : 1);
     }},
};

class InternalFunction final : public NativeFunction {
public:
  explicit InternalFunction(int number)
      : NativeFunction(3 + static_cast<std::size_t>(kInternals[number].parameters), 1), number_(number) {}
  void evaluate(const double* arguments, const FunctionContext& context, double* results) const override {
    const Internal& internal = kInternals[number_];
    if (!internal.value)
      throw FunctionFault{"'internal(" + std::to_string(number_) + ")' is not supported yet"};
    *results = internal.value({context, arguments[0], arguments[1], arguments[2], arguments + 3});
  }

private:
  int number_;
};

} // namespace

std::shared_ptr<const NativeFunction> internal_function(int number) {
  const bool is_known =
      number >= 0 && number < static_cast<int>(std::size(kInternals)) && kInternals[number].parameters >= 0;
  return is_known ? std::make_shared<InternalFunction>(number) : nullptr;
}

} // namespace celltrace::pov

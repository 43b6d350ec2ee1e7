// The pattern of a function of x, y and z. Kernel dialect.
#pragma once

#include "celltrace/spe/one_copy.hpp"
#include "kernel/angles.hpp"
#include "kernel/modules.hpp"
#include "kernel/scene_access.hpp"
#include "kernel/textures/pattern_traits.hpp"
#include "records/function.hpp"

namespace celltrace::kernel {

/// Runs the code of functions, for as many points at a time as S has lanes.
template <class S> class FunctionInterpreter {
public:
  using F = typename S::F;
  using M = typename S::M;

  explicit FunctionInterpreter(const V3<S>& p) {
    register_[0] = p.x;
    register_[1] = p.y;
    register_[2] = p.z;
  }

  /// Runs `count` steps from offset `first` on, and returns the last result.
  template <class Scene> F run(Scene& scene, uint32_t first, uint32_t count) {
    F result(0.0f);
    for (uint32_t i = 0; i < count; ++i) {
      const FunctionStepRecord step =
          *scene.function_step(first + i * static_cast<uint32_t>(sizeof(FunctionStepRecord)));
      result = result_of(step);
      register_[step.operation_and_result >> 16] = result;
    }
    return result;
  }

private:
  static F truth(const M& m) { return S::select(m, F(1.0f), F(0.0f)); }
  static F truncated(const F& x) { return S::select(x < F(0.0f), -S::floor(-x), S::floor(x)); }
  static F exponential(const F& x) { return exp2<S>(x * F(1.44269504f)); }
  /// Returns the natural logarithm; of what is not above 0 a large number below 0.
  static F logarithm(const F& x) { return log2<S>(S::max(x, F(1e-37f))) * F(0.693147181f); }
  static F arc_cosine(const F& x) {
    const F near = acos_unit<S>(S::min(S::abs(x), F(1.0f)));
    return S::select(x < F(0.0f), F(3.14159265f) - near, near);
  }
  /// Returns a to the power b; where a is below 0, b has to be whole.
  static F power(const F& a, const F& b) {
    const F size = pow<S>(S::abs(a), b);
    const F half = S::abs(truncated(b)) * F(0.5f);
    const M is_odd = half - S::floor(half) > F(0.25f);
    const F raised = S::select((a < F(0.0f)) & is_odd, -size, size);
    return S::select(b == F(0.0f), F(1.0f), raised);
  }

  F result_of(const FunctionStepRecord& step) const {
    constexpr float kTurn = 6.28318531f;
    const F &a = register_[step.a_and_b & 0xFFFF], &b = register_[step.a_and_b >> 16], &c = register_[step.c];
    const F zero(0.0f), one(1.0f), half(0.5f);
    switch (static_cast<FunctionOperation>(step.operation_and_result & 0xFFFF)) {
    case FunctionOperation::constant:
      return F(step.constant);
    case FunctionOperation::negate:
      return -a;
    case FunctionOperation::invert:
      return truth(a == zero);
    case FunctionOperation::absolute:
      return S::abs(a);
    case FunctionOperation::square_root:
      return S::sqrt(S::max(a, zero));
    case FunctionOperation::floor:
      return S::floor(a);
    case FunctionOperation::ceil:
      return -S::floor(-a);
    case FunctionOperation::whole:
      return truncated(a);
    case FunctionOperation::sin:
    case FunctionOperation::cos:
    case FunctionOperation::tan: {
      F sine, cosine;
      sin_cos_inline<S>(a, sine, cosine);
      const auto operation = static_cast<FunctionOperation>(step.operation_and_result & 0xFFFF);
      if (operation == FunctionOperation::sin) return sine;
      if (operation == FunctionOperation::cos) return cosine;
      return sine / cosine;
    }
    case FunctionOperation::asin:
      return F(0.25f * kTurn) - arc_cosine(a);
    case FunctionOperation::acos:
      return arc_cosine(a);
    case FunctionOperation::atan:
      return turns_inline<S>(a, one) * F(kTurn);
    case FunctionOperation::atan2:
      return turns_inline<S>(a, b) * F(kTurn);
    case FunctionOperation::sinh:
      return (exponential(a) - exponential(-a)) * half;
    case FunctionOperation::cosh:
      return (exponential(a) + exponential(-a)) * half;
    case FunctionOperation::tanh:
      return one - F(2.0f) / (exponential(a + a) + one);
    case FunctionOperation::asinh: {
      const F size = logarithm(S::abs(a) + S::sqrt(a * a + one));
      return S::select(a < zero, -size, size);
    }
    case FunctionOperation::acosh:
      return logarithm(a + S::sqrt(S::max(a * a - one, zero)));
    case FunctionOperation::atanh:
      return half * logarithm((one + a) / (one - a));
    case FunctionOperation::exp:
      return exponential(a);
    case FunctionOperation::ln:
      return logarithm(a);
    case FunctionOperation::log:
      return logarithm(a) * F(0.434294482f);
    case FunctionOperation::add:
      return a + b;
    case FunctionOperation::subtract:
      return a - b;
    case FunctionOperation::multiply:
      return a * b;
    case FunctionOperation::divide:
      return a / b;
    case FunctionOperation::less:
      return truth(a < b);
    case FunctionOperation::less_equal:
      return truth(a <= b);
    case FunctionOperation::equal:
      return truth(a == b);
    case FunctionOperation::not_equal:
      return truth(!(a == b));
    case FunctionOperation::greater_equal:
      return truth(!(a < b));
    case FunctionOperation::greater:
      return truth(!(a <= b));
    case FunctionOperation::both:
      return truth(!((a == zero) | (b == zero)));
    case FunctionOperation::either:
      return truth(!((a == zero) & (b == zero)));
    case FunctionOperation::maximum:
      return S::select(b > a, b, a);
    case FunctionOperation::minimum:
      return S::select(a <= b, a, b);
    case FunctionOperation::modulo:
      return a - b * truncated(a / b);
    case FunctionOperation::quotient:
      return truncated(a / b);
    case FunctionOperation::power:
      return power(a, b);
    case FunctionOperation::pick_negative:
      return S::select(a < zero, b, c);
    case FunctionOperation::pick_zero:
      return S::select(a == zero, b, c);
    }
    return zero;
  }

  F register_[kFunctionRegisters];
};

/// The table is the first step of the function's code; the first parameter is the number of steps.
struct FunctionPattern : BlendPattern {
  static constexpr const char* kName = "function";
  static constexpr PatternCode kCode = PatternCode::function;

  template <class Spu>
  [[gnu::always_inline]] static typename Spu::rare_simd::F
  value(SceneAccess<Spu>& scene, const V3<typename Spu::rare_simd>& p, const PatternRecord& r) {
    return FunctionInterpreter<typename Spu::rare_simd>(p).run(scene, r.table, static_cast<uint32_t>(r.parameter[0]));
  }
};

} // namespace celltrace::kernel

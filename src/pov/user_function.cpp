// Evaluates functions of the scene.
#include "pov/user_function.hpp"

#include <algorithm>

#include "pov/session.hpp"

namespace celltrace::pov {

namespace {

class SplineFunction final : public NativeFunction {
public:
  explicit SplineFunction(SplinePtr spline)
      : NativeFunction(1, static_cast<std::size_t>(spline->components())), spline_(std::move(spline)) {}
  void evaluate(const double* arguments, const FunctionContext&, double* results) const override {
    const Quantity value = spline_->value(arguments[0]);
    std::copy(value.v.begin(), value.v.end(), results);
  }

private:
  SplinePtr spline_;
};

class UnsupportedFunction final : public NativeFunction {
public:
  UnsupportedFunction(const std::string& what, std::size_t parameters, std::size_t results)
      : NativeFunction(parameters, results), what_(what) {}
  void evaluate(const double*, const FunctionContext&, double*) const override {
    throw FunctionFault{what_ + " is not supported yet"};
  }

private:
  std::string what_;
};

Quantity value_of(Session& session, const UserFunction& function, const double* arguments) {
  if (const auto* transform = std::get_if<Transform>(&function.body))
    return Quantity::vector(transform->point({arguments[0], arguments[1], arguments[2]}));
  const FunctionContext context{session.builder.noise_generator()};
  if (const auto* code = std::get_if<std::shared_ptr<const FunctionCode>>(&function.body))
    return session.functions.run(**code, arguments, context);
  const NativeFunction& native = *std::get<std::shared_ptr<const NativeFunction>>(function.body);
  Quantity result;
  native.evaluate(arguments, context, result.v.data());
  result.count = static_cast<int>(native.results());
  result.is_colour = function.returns_colour;
  return result;
}

} // namespace

std::shared_ptr<const NativeFunction> spline_function(SplinePtr spline) {
  return std::make_shared<SplineFunction>(std::move(spline));
}

std::shared_ptr<const NativeFunction> unsupported_function(const std::string& what, std::size_t parameters,
                                                           std::size_t results) {
  return std::make_shared<UnsupportedFunction>(what, parameters, results);
}

void check_argument_count(Session& session, const UserFunction& function, std::size_t count,
                          const Location& where) {
  if (count != function.parameters)
    session.fail(where, "this function takes " + std::to_string(function.parameters) +
                            (function.parameters == 1 ? " argument" : " arguments") + ", not " +
                            std::to_string(count));
}

Quantity call_function(Session& session, const UserFunction& function, const double* arguments,
                       std::size_t count, const Location& where) {
  check_argument_count(session, function, count, where);
  try {
    return value_of(session, function, arguments);
  } catch (const FunctionFault& fault) {
    session.fail(where, fault.what);
  }
}

} // namespace celltrace::pov

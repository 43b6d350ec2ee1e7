#include "pov/actions.hpp"

namespace celltrace::pov {

namespace {

constexpr std::size_t kMostDimensions = 5;
constexpr int kDeepestArray = 300; // more than brackets can be nested

const Array* as_array(const Value& value) {
  const auto* array = std::get_if<std::shared_ptr<Array>>(&value);
  return array ? array->get() : nullptr;
}

/// The depth and the number of elements that a copy may still have: arrays in arrays could grow without end.
struct Budget {
  int depth;
  std::uint64_t elements;
};

std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where, Budget& budget) {
  if (--budget.depth < 0 || array.elements.size() > budget.elements)
    session.fail(where, "this array is too large to be copied");
  budget.elements -= array.elements.size();
  session.tokens.spend(array.elements.size() / 8);
  auto result = std::make_shared<Array>(array);
  for (Value& element : result->elements) {
    if (const Array* inner = as_array(element))
      element = copy(session, *inner, where, budget);
    else if (const auto* text = std::get_if<std::string>(&element))
      session.count_text(text->size(), where);
  }
  ++budget.depth;
  return result;
}

} // namespace

std::shared_ptr<Array> copy(Session& session, const Array& array, const Location& where) {
  Budget budget{kDeepestArray, session.options.limits.array_elements};
  return copy(session, array, where, budget);
}

Array to_array(const std::vector<Quantity>& numbers) {
  return Array{{numbers.begin(), numbers.end()}};
}

std::size_t array_size(Session& session, double size, const Location& where) {
  if (!(size >= 1)) session.fail(where, "an array has at least one element");
  if (size > static_cast<double>(session.options.limits.array_elements))
    session.exceed(where, &ParseLimits::array_elements, "an array has", "elements");
  return static_cast<std::size_t>(size);
}

std::shared_ptr<Array> make_array(Session& session, const std::vector<std::size_t>& dimensions,
                                  std::size_t level, const Location& where) {
  if (level == 0) {
    if (dimensions.size() > kMostDimensions) session.fail(where, "an array has at most 5 dimensions");
    double total = 1;
    for (const std::size_t size : dimensions)
      total *= static_cast<double>(size);
    array_size(session, total, where);
  }
  auto array = std::make_shared<Array>();
  session.tokens.spend(dimensions[level] / 8);
  array->elements.resize(dimensions[level]);
  if (level + 1 < dimensions.size())
    for (Value& element : array->elements)
      element = make_array(session, dimensions, level + 1, where);
  return array;
}

namespace {

void fill(Session& session, Array& target, const Array& source, const Location& where) {
  if (source.elements.size() > target.elements.size())
    session.fail(where, "this array has " + std::to_string(target.elements.size()) + " elements, but " +
                            std::to_string(source.elements.size()) + " are given");
  for (std::size_t i = 0; i < source.elements.size(); ++i) {
    const Array* inner = as_array(source.elements[i]);
    const auto* target_inner = std::get_if<std::shared_ptr<Array>>(&target.elements[i]);
    if (target_inner && !inner) session.fail(where, "the elements given do not have the array's dimensions");
    if (target_inner)
      fill(session, **target_inner, *inner, where);
    else
      target.elements[i] = source.elements[i];
  }
}

} // namespace

std::shared_ptr<Array> filled_array(Session& session, const std::vector<std::size_t>& dimensions,
                                    const std::shared_ptr<Array>& elements, const Location& where) {
  auto array = make_array(session, dimensions, 0, where);
  fill(session, *array, *elements, where);
  return array;
}

int dimensions(const Array& array) {
  const Array* inner = as_array(array.elements.front());
  return 1 + (inner ? dimensions(*inner) : 0);
}

double dimension_size(const Array& array, double dimension) {
  const Array* level = &array;
  for (double i = 1; level && i < dimension; ++i)
    level = as_array(level->elements.front());
  if (!level || dimension < 1) return 0; // as in POV-Ray
  return static_cast<double>(level->elements.size());
}

} // namespace celltrace::pov

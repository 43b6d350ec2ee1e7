// Holders for large values that few of many objects have, or that many objects share, so that the objects
// stay small.
#pragma once

#include <memory>
#include <utility>

#include "celltrace/transform.hpp"

namespace celltrace::pov {

/// A value in memory of its own, which is copied with its owner. A moved-from holder has none.
template <class T> class HeapValue {
public:
  HeapValue(T value) : value_(std::make_unique<T>(std::move(value))) {}
  HeapValue(const HeapValue& other) : value_(std::make_unique<T>(*other.value_)) {}
  HeapValue(HeapValue&&) noexcept = default;
  HeapValue& operator=(const HeapValue& other) { return *this = HeapValue(other); }
  HeapValue& operator=(HeapValue&&) noexcept = default;

  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }

private:
  std::unique_ptr<T> value_;
};

/// A value that copies share until one of them changes it.
template <class T> class SharedValue {
public:
  SharedValue() = default;
  SharedValue(T value) : value_(std::make_shared<T>(std::move(value))) {}

  operator const T&() const { return **this; }
  const T& operator*() const {
    static const T kNew;
    return value_ ? *value_ : kNew;
  }
  const T* operator->() const { return &**this; }
  /// Returns the value for changing, after copying it if it is shared.
  T& own() {
    if (!value_ || value_.use_count() > 1) value_ = std::make_shared<T>(**this);
    return *value_;
  }

private:
  std::shared_ptr<T> value_; ///< null: a default value
};

/// A transformation that usually is the identity.
class RareTransform {
public:
  RareTransform& operator=(const Transform& transform) {
    value_ = transform.is_identity() ? nullptr : std::make_shared<const Transform>(transform);
    return *this;
  }
  const Transform& operator*() const {
    static const Transform kNothing;
    return value_ ? *value_ : kNothing;
  }

private:
  std::shared_ptr<const Transform> value_; ///< null: the identity
};

} // namespace celltrace::pov

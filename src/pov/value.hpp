// The values that a name of the scene language can have.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "pov/camera.hpp"
#include "pov/memory.hpp"
#include "pov/object.hpp"
#include "pov/quantity.hpp"
#include "pov/texture.hpp"
#include "pov/token.hpp"
#include "pov/user_function.hpp"

namespace celltrace::pov {

struct Array;
class DataFile;

struct Macro {
  NameId name = 0;
  std::vector<NameId> parameters;
  TokenRange body;
};

using Value = std::variant<std::monostate, Quantity, std::string, PigmentPtr, NormalPtr, FinishPtr,
                           TexturePtr, PigmentMapPtr, NormalMapPtr, TextureMapPtr, SlopeMapPtr, SkySpherePtr,
                           FogPtr, RainbowPtr, InteriorPtr, std::shared_ptr<const MaterialDefinition>,
                           std::shared_ptr<const CameraDefinition>, ObjectPtr, Transform,
                           std::shared_ptr<Array>, std::shared_ptr<const Macro>, UnsupportedPtr,
                           std::shared_ptr<DataFile>, FunctionPtr, SplinePtr>;

/// An array of values; assigning it copies it. Elements without a value hold std::monostate.
struct Array {
  std::vector<Value, ElementAllocator<Value>> elements;
};

/// The variable that a name is bound to; macro parameters may share the caller's.
struct Slot {
  Value value;
};

/// Returns the kind of a value for messages: "a float", "a texture".
const char* kind_name(const Value& value);

} // namespace celltrace::pov

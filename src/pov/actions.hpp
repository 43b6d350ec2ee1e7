// Functions that the grammar's rules call.
#pragma once

#include "pov/atmosphere.hpp"
#include "pov/expressions.hpp"
#include "pov/finishes.hpp"
#include "pov/height_fields.hpp"
#include "pov/mesh_actions.hpp"
#include "pov/missing.hpp"
#include "pov/object_actions.hpp"
#include "pov/patches.hpp"
#include "pov/pattern_changes.hpp"
#include "pov/pictures.hpp"
#include "pov/settings.hpp"
#include "pov/text_objects.hpp"
#include "pov/texture_actions.hpp"

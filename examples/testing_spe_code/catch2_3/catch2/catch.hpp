// Catch2 3 under the name that its main header had in version 2.
#include <catch2/catch_all.hpp>

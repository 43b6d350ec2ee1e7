// In place of embree_side.cpp where Embree is not installed.
#include "embree_side.hpp"

#include "celltrace/error.hpp"
#include "query_side.hpp"

namespace celltrace::compare {

std::optional<std::string> embree_version() {
  return std::nullopt;
}

int widest_embree_packet() {
  throw Error("built without Embree");
}

std::unique_ptr<Side> make_embree_side(int, unsigned, const EmbreeConfig&) {
  throw Error("built without Embree");
}

std::unique_ptr<QuerySide> make_embree_queries(const Model&) {
  throw Error("built without Embree");
}

} // namespace celltrace::compare

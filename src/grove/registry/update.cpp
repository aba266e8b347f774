#include "grove/registry/update.h"

#include <limits>
#include <string>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr UpdatePolicy kPolicies[] = {UpdatePolicy::automatic, UpdatePolicy::refit, UpdatePolicy::rotate, UpdatePolicy::rebuild};

}  // namespace

std::string_view name_of(UpdatePolicy policy) {
  switch (policy) {
    case UpdatePolicy::automatic:
      return "auto";
    case UpdatePolicy::refit:
      return "refit";
    case UpdatePolicy::rotate:
      return "rotate";
    case UpdatePolicy::rebuild:
      break;
  }
  return "rebuild";
}

std::string_view name_of(UpdateMethod method) {
  switch (method) {
    case UpdateMethod::refit:
      return "refit";
    case UpdateMethod::rotate:
      return "rotate";
    case UpdateMethod::partial_rebuild:
      return "partial rebuild";
    case UpdateMethod::local:
      return "local";
    case UpdateMethod::rebuild:
      break;
  }
  return "rebuild";
}

void check_primitive_count(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw InputError("a structure may have at most 2^31 - 1 primitives, not " + std::to_string(count) + "; split it into instances");
}

void check_update(std::size_t known, std::size_t count, const UpdateSettings& settings) {
  check_primitive_count(count);
  if (count < known)
    throw InputError("the geometry had " + std::to_string(known) + " primitives and now has " + std::to_string(count) +
                     "; make primitives unhittable to remove them, or build anew");
  for (const std::uint32_t i : settings.changed) {
    if (i >= count)
      throw InputError("primitive " + std::to_string(i) + " is said to have changed, but there are only " + std::to_string(count));
  }
}

UpdatePolicy parse_update_policy(std::string_view name) {
  std::string known;
  for (const UpdatePolicy policy : kPolicies) {
    if (name_of(policy) == name) return policy;
    known += (known.empty() ? "" : ", ") + std::string(name_of(policy));
  }
  throw UsageError("unknown way to update '" + std::string(name) + "'; there are: " + known);
}

}  // namespace grove

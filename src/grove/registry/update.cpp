#include "grove/registry/update.h"

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
    case UpdateMethod::rebuild:
      break;
  }
  return "rebuild";
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

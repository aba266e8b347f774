#pragma once

#include <map>
#include <string>
#include <string_view>

#include "grove/registry/registry.h"

namespace grove {

/// A checked spec: every key of its family has a value.
class Spec {
 public:
  /// Parses "family" or "family:key=value,key=value", where the family may be named by one of its short names. Throws UsageError that lists what is allowed for what is wrong.
  [[nodiscard]] static Spec parse(std::string_view text);

  [[nodiscard]] const StructureFamily& family() const { return *family_; }
  /// The value of a key that the family has.
  [[nodiscard]] const std::string& value(std::string_view key) const;
  [[nodiscard]] int number(std::string_view key) const;
  /// Family and the keys that differ from their defaults, in the family's order.
  [[nodiscard]] std::string canonical() const;

 private:
  const StructureFamily* family_ = nullptr;
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace grove

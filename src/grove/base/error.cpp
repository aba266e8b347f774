#include "grove/base/error.h"

namespace grove {
namespace {

std::string located(std::string_view file, std::string_view place, std::string_view problem) {
  std::string line(file);
  if (!place.empty()) {
    line += ':';
    line += place;
  }
  line += ": ";
  line += problem;
  return line;
}

}  // namespace

InputError::InputError(std::string_view file, std::string_view place, std::string_view problem) : Error(located(file, place, problem)) {}

}  // namespace grove

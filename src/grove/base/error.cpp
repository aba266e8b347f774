#include "grove/base/error.h"

#include <new>

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

std::string reason_of(const std::exception& exception) {
  return dynamic_cast<const std::bad_alloc*>(&exception) != nullptr ? "out of memory" : exception.what();
}

}  // namespace grove

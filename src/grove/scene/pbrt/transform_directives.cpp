#include "grove/scene/pbrt/directives.h"
#include "grove/scene/pbrt/numbers.h"

namespace grove::pbrt {

// So many numbers, in brackets or not.
template <std::size_t kCount>
std::array<double, kCount> DirectiveReader::number_arguments() {
  const bool bracketed = tokens_->peek().kind == TokenKind::open_bracket;
  if (bracketed) tokens_->next();
  std::array<double, kCount> numbers{};
  for (double& number : numbers) {
    const Token token = tokens_->next();
    const auto value = token.kind == TokenKind::word ? parse_float(token.text) : std::nullopt;
    if (!value) place_.fail(std::string(directive_.text) + " takes " + std::to_string(kCount) + " numbers");
    number = double{*value};
  }
  if (bracketed && tokens_->next().kind != TokenKind::close_bracket)
    place_.fail(std::string(directive_.text) + " takes " + std::to_string(kCount) + " numbers, then ]");
  return numbers;
}

namespace {

// The sixteen numbers are the columns of the matrix one after the other.
Matrix to_matrix(const std::array<double, 16>& numbers) {
  Matrix m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
  return m;
}

}  // namespace

void DirectiveReader::apply(const Matrix& matrix) {
  if (state_.changes_start) state_.transform = state_.transform * matrix;
}

void DirectiveReader::identity() {
  if (state_.changes_start) state_.transform = Matrix(1.0);
}

void DirectiveReader::translate() {
  const auto n = number_arguments<3>();
  apply(translation({n[0], n[1], n[2]}));
}

void DirectiveReader::scale() {
  const auto n = number_arguments<3>();
  apply(scaling({n[0], n[1], n[2]}));
}

void DirectiveReader::rotate() {
  const auto n = number_arguments<4>();
  apply(rotation(n[0], {n[1], n[2], n[3]}));
}

void DirectiveReader::look_at() {
  const auto n = number_arguments<9>();
  apply(look_at_matrix({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}));
}

void DirectiveReader::set_transform() {
  const Matrix matrix = to_matrix(number_arguments<16>());
  if (state_.changes_start) state_.transform = matrix;
}

void DirectiveReader::concatenate_transform() {
  apply(to_matrix(number_arguments<16>()));
}

void DirectiveReader::coordinate_system() {
  coordinate_systems_[quoted_argument("a name")] = state_.transform;
}

void DirectiveReader::coordinate_system_transform() {
  const std::string name = quoted_argument("the name of a coordinate system");
  const auto found = coordinate_systems_.find(name);
  if (found == coordinate_systems_.end()) {
    context_.warnings.add(place_, "no CoordinateSystem is called \"" + name + "\"; CoordSysTransform is left out");
  } else if (state_.changes_start) {
    state_.transform = found->second;
  }
}

void DirectiveReader::transform_times() {
  number_arguments<2>();
  context_.warnings.add(place_, "moving scenes are shown as they are when the shutter opens");
}

void DirectiveReader::active_transform() {
  const Token which = tokens_->next();
  if (which.text != "All" && which.text != "StartTime" && which.text != "EndTime")
    place_.fail("ActiveTransform takes All, StartTime or EndTime");
  state_.changes_start = which.text != "EndTime";
  if (which.text != "All") context_.warnings.add(place_, "moving scenes are shown as they are when the shutter opens");
}

}  // namespace grove::pbrt

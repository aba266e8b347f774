#include "grove/scene/formats/obj_parser.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "grove/base/error.h"
#include "grove/scene/formats/text.h"
#include "grove/scene/formats/triangulate.h"
#include "grove/scene/read_file.h"

namespace grove {
namespace {

std::string_view next_word(std::string_view& line) {
  std::size_t first = 0;
  while (first < line.size() && (line[first] == ' ' || line[first] == '\t')) ++first;
  std::size_t last = first;
  while (last < line.size() && line[last] != ' ' && line[last] != '\t') ++last;
  const std::string_view word = line.substr(first, last - first);
  line.remove_prefix(last);
  return word;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

class Parser {
 public:
  explicit Parser(const std::filesystem::path& file) : name_(file.string()), bytes_(read_file(file)) {
    text_ = {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }

  ObjFile run() {
    while (next_line()) parse_line(line_);
    return std::move(obj_);
  }

 private:
  [[noreturn]] void fail(std::string_view problem) const { throw InputError(name_, "line " + std::to_string(line_number_), problem); }

  // Sets line_ without its end; joins lines that end in a backslash.
  bool next_line() {
    if (text_.empty()) return false;
    line_number_ = next_number_;
    line_ = physical_line();
    if (!line_.ends_with('\\')) return true;
    joined_.clear();
    while (line_.ends_with('\\')) {
      joined_.append(line_.substr(0, line_.size() - 1)).append(" ");
      if (text_.empty()) {
        line_ = {};
        break;
      }
      line_ = physical_line();
    }
    joined_.append(line_);
    line_ = joined_;
    return true;
  }

  std::string_view physical_line() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++next_number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void parse_line(std::string_view line) {
    const std::string_view keyword = next_word(line);
    if (keyword.empty() || keyword.starts_with('#')) return;
    if (keyword == "v") return parse_position(line);
    if (keyword == "vt") return parse_uv(line);
    if (keyword == "vn") return parse_normal(line);
    if (keyword == "f" || keyword == "fo") return parse_face(line);
    if (keyword == "o" || keyword == "g") return begin_shape(line);
    if (keyword == "usemtl") {
      material_ = trimmed(line);
      current_part_ = nullptr;
    } else if (keyword == "mtllib") {
      obj_.material_libraries.emplace_back(trimmed(line));
    } else if (keyword != "s") {
      ignore(keyword);
    }
  }

  void ignore(std::string_view keyword) {
    const std::string text = quote(keyword);
    // A file of random bytes has very many "keywords".
    if (obj_.ignored.size() < 16 && std::find(obj_.ignored.begin(), obj_.ignored.end(), text) == obj_.ignored.end()) {
      obj_.ignored.push_back(text);
    }
  }

  // Reads up to `most` numbers; fails when there are fewer than `least`.
  std::size_t parse_numbers(std::string_view line, std::size_t least, std::size_t most, float* values) const {
    std::size_t count = 0;
    for (; count < most; ++count) {
      const std::string_view word = next_word(line);
      if (word.empty() || word.starts_with('#')) break;
      const std::optional<float> value = parse_float(word);
      if (!value) fail(quote(word) + " is not a number");
      values[count] = *value;
    }
    if (count < least) fail("expected " + std::to_string(least) + " numbers, found " + std::to_string(count));
    return count;
  }

  void parse_position(std::string_view line) {
    float n[7] = {};
    const std::size_t count = parse_numbers(line, 3, 7, n);
    obj_.positions.emplace_back(n[0], n[1], n[2]);
    const bool has_colour = count >= 6;
    if (has_colour && obj_.colours.empty()) obj_.colours.resize(obj_.positions.size() - 1, Vec4(1.0F));
    if (has_colour || !obj_.colours.empty()) {
      obj_.colours.push_back(has_colour ? Vec4(n[3], n[4], n[5], 1.0F) : Vec4(1.0F));
    }
  }

  void parse_uv(std::string_view line) {
    float n[2] = {};
    parse_numbers(line, 1, 2, n);
    obj_.uvs.emplace_back(n[0], n[1]);
  }

  void parse_normal(std::string_view line) {
    float n[3] = {};
    parse_numbers(line, 3, 3, n);
    obj_.normals.emplace_back(n[0], n[1], n[2]);
  }

  std::uint32_t parse_index(std::string_view word, std::size_t count, std::string_view what) const {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size()) fail(quote(word) + " is not an index");
    const auto signed_count = static_cast<std::int64_t>(count);
    if (index == 0) fail("a face names " + std::string(what) + " 0, but they count from 1");
    if (index > signed_count || index < -signed_count) {
      fail("a face names " + std::string(what) + " " + std::to_string(index) + ", but there are " + std::to_string(count) + " before it");
    }
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : signed_count + index);
  }

  // v, v/vt, v//vn or v/vt/vn
  ObjCorner parse_corner(std::string_view word) const {
    const std::size_t slash = std::min(word.find('/'), word.size());
    ObjCorner corner;
    corner.position = parse_index(word.substr(0, slash), obj_.positions.size(), "vertex");
    word.remove_prefix(std::min(slash + 1, word.size()));
    const std::size_t second = std::min(word.find('/'), word.size());
    if (second > 0) corner.uv = parse_index(word.substr(0, second), obj_.uvs.size(), "texture coordinate");
    word.remove_prefix(std::min(second + 1, word.size()));
    if (!word.empty()) corner.normal = parse_index(word, obj_.normals.size(), "normal");
    return corner;
  }

  void parse_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word = next_word(line); !word.empty() && !word.starts_with('#'); word = next_word(line)) {
      corners_.push_back(parse_corner(word));
    }
    if (corners_.size() < 3) fail("a face of " + std::to_string(corners_.size()) + " corners");
    std::vector<std::array<ObjCorner, 3>>& triangles = part().triangles;
    if (corners_.size() == 3) {
      triangles.push_back({corners_[0], corners_[1], corners_[2]});
      return;
    }
    points_.clear();
    for (const ObjCorner& corner : corners_) points_.push_back(obj_.positions[corner.position]);
    try {
      for (const auto& [a, b, c] : triangulator_.triangulate(points_)) {
        triangles.push_back({corners_[a], corners_[b], corners_[c]});
      }
    } catch (const InputError& error) {
      fail(error.what());
    }
  }

  void begin_shape(std::string_view line) {
    shape_ = trimmed(line);
    current_part_ = nullptr;
  }

  // The part for the current shape and material; found again when a file comes back to them.
  ObjPart& part() {
    if (current_part_ == nullptr) {
      const auto [entry, is_new] = part_ids_.try_emplace({shape_, material_}, obj_.parts.size());
      if (is_new) obj_.parts.push_back({.shape = shape_, .material = material_, .triangles = {}});
      current_part_ = &obj_.parts[entry->second];
    }
    return *current_part_;
  }

  std::string name_;
  std::vector<std::byte> bytes_;
  std::string_view text_;  // what is not read yet
  std::string_view line_;
  std::string joined_;
  std::uint64_t line_number_ = 0;
  std::uint64_t next_number_ = 1;

  ObjFile obj_;
  std::string shape_;
  std::string material_;
  std::map<std::pair<std::string, std::string>, std::size_t> part_ids_;
  // Valid until the next part is made, which resets it.
  ObjPart* current_part_ = nullptr;
  std::vector<ObjCorner> corners_;
  std::vector<Vec3> points_;
  Triangulator triangulator_;
};

}  // namespace

ObjFile parse_obj(const std::filesystem::path& file) {
  return Parser(file).run();
}

}  // namespace grove

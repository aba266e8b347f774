// The rooms' one-way street: a room includes only rooms above it (docs/architecture.md), and CMake knows of every include.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "architecture/source_tree.h"

namespace grove::architecture {
namespace {

using Rooms = std::set<std::string>;

// What each room may include besides itself. `traverse` and `build` meet in the data of `accel` and nowhere else.
const std::map<std::string, Rooms>& allowed_rooms() {
  static const std::map<std::string, Rooms> table = [] {
    std::map<std::string, Rooms> rooms;
    rooms["base"] = {};
    rooms["math"] = {"base"};
    rooms["geometry"] = {"base", "math"};
    rooms["accel"] = {"base", "math"};
    rooms["build"] = {"base", "math", "geometry", "accel"};
    rooms["traverse"] = {"base", "math", "geometry", "accel"};
    rooms["registry"] = {"base", "math", "geometry", "accel", "build", "traverse"};
    rooms["scene"] = {"base", "math", "geometry"};
    rooms["render"] = {"base", "math", "geometry", "accel", "build", "traverse", "registry", "scene"};
    rooms["lab"] = {"base", "math", "geometry", "accel", "build", "traverse", "registry", "scene", "render"};
    return rooms;
  }();
  return table;
}

// The rooms that a text includes.
Rooms included_rooms(const std::string& text) {
  static const std::regex ours(R"re("grove/([a-z_]+)/.*")re");
  Rooms rooms;
  for (const std::string& include : includes_of(text)) {
    std::smatch match;
    if (std::regex_match(include, match, ours)) rooms.insert(match[1]);
  }
  return rooms;
}

// Rooms that `text`, a file of `room`, includes and may not.
Rooms forbidden_includes(const std::string& room, const std::string& text) {
  Rooms forbidden;
  for (const std::string& included : included_rooms(text)) {
    if (included != room && !allowed_rooms().at(room).contains(included)) forbidden.insert(included);
  }
  return forbidden;
}

// The rooms that a room's CMakeLists.txt names: after DEPENDS, or as grove_NAME in a target_link_libraries.
Rooms declared_rooms(const std::string& cmake) {
  Rooms rooms;
  std::smatch match;
  static const std::regex depends(R"(DEPENDS\s+([a-z\s]+))");
  if (std::regex_search(cmake, match, depends)) {
    const std::string list = match[1];
    static const std::regex word("[a-z]+");
    for (auto it = std::sregex_iterator(list.begin(), list.end(), word); it != std::sregex_iterator(); ++it) rooms.insert(it->str());
  }
  static const std::regex target(R"(grove(?:_|::)([a-z]+))");
  for (auto it = std::sregex_iterator(cmake.begin(), cmake.end(), target); it != std::sregex_iterator(); ++it) {
    if (allowed_rooms().contains((*it)[1])) rooms.insert((*it)[1]);
  }
  return rooms;
}

// Everything that can be reached from a room through declared rooms.
Rooms reachable_rooms(const std::string& room, const std::map<std::string, Rooms>& declared) {
  Rooms reached;
  std::vector<std::string> open{room};
  while (!open.empty()) {
    const std::string current = open.back();
    open.pop_back();
    if (!declared.contains(current)) continue;
    for (const std::string& next : declared.at(current)) {
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  return reached;
}

std::map<std::string, Rooms> declared_in_repository() {
  std::map<std::string, Rooms> declared;
  for (const auto& [room, allowed] : allowed_rooms()) {
    const auto file = repository() / "src/grove" / room / "CMakeLists.txt";
    if (!std::filesystem::exists(file)) continue;
    declared[room] = declared_rooms(read(file));
    declared[room].erase(room);
  }
  return declared;
}

TEST(Rooms, IncludeOnlyRoomsAboveThem) {
  const auto files = files_below("src/grove", {".h", ".inc", ".cpp"});
  ASSERT_GT(files.size(), 20U);
  for (const auto& file : files) {
    const std::string room = room_of(file);
    ASSERT_TRUE(allowed_rooms().contains(room)) << place(file, 1) << ": no room named \"" << room << "\"; add it to the table of this test";
    EXPECT_THAT(forbidden_includes(room, read(file)), testing::IsEmpty()) << place(file, 1);
  }
}

TEST(Rooms, DeclareToCMakeOnlyRoomsAboveThem) {
  for (const auto& [room, declared] : declared_in_repository()) {
    for (const std::string& other : declared) EXPECT_TRUE(allowed_rooms().at(room).contains(other)) << room << " depends on " << other;
  }
}

TEST(Rooms, DeclareToCMakeEveryRoomTheyInclude) {
  const auto declared = declared_in_repository();
  for (const auto& file : files_below("src/grove", {".h", ".inc", ".cpp"})) {
    const std::string room = room_of(file);
    // A room without a CMakeLists.txt is not built.
    if (!declared.contains(room)) continue;
    const Rooms reachable = reachable_rooms(room, declared);
    for (const std::string& included : included_rooms(read(file))) {
      if (included == room) continue;
      EXPECT_TRUE(reachable.contains(included)) << place(file, 1) << " includes " << included << ", which DEPENDS does not name";
    }
  }
}

TEST(Rooms, HaveAReadme) {
  for (const auto& [room, declared] : declared_in_repository()) {
    EXPECT_TRUE(std::filesystem::exists(repository() / "src/grove" / room / "README.md")) << room;
  }
}

TEST(RoomCheck, FindsWhatIsForbidden) {
  EXPECT_THAT(forbidden_includes("traverse", "#include \"grove/build/top_down.h\"\n"), testing::ElementsAre("build"));
  EXPECT_THAT(forbidden_includes("base", "#include <vector>\n  # include \"grove/math/box.h\"\n"), testing::ElementsAre("math"));
  EXPECT_THAT(forbidden_includes("build", "#include \"grove/accel/bvh2.h\"\n#include \"grove/build/splits/binned.h\"\n"),
              testing::IsEmpty());
}

TEST(RoomCheck, ReadsWhatCMakeDeclares) {
  EXPECT_THAT(declared_rooms("grove_room(build\n  SOURCES a.cpp\n  DEPENDS accel geometry)\n"), testing::ElementsAre("accel", "geometry"));
  EXPECT_THAT(declared_rooms("grove_room(scene\n  DEPENDS geometry\n  LIBRARIES x::y)"), testing::ElementsAre("geometry"));
  EXPECT_THAT(declared_rooms("target_link_libraries(grove_traverse INTERFACE grove_accel)"), testing::ElementsAre("accel", "traverse"));
}

}  // namespace
}  // namespace grove::architecture

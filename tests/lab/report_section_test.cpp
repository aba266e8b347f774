#include "grove/lab/report_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "grove/base/error.h"

namespace grove {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ReportSection full_section() {
  return {
      "Speed", "By scene.", ReportTable{{"scene", "speed"}, {{"a|b", 1.5}, {"c", 2.0}}},
      ReportPlot{PlotKind::bar, {"scene", false, {"a", "c"}}, {"speed", true}, {{"one", {{0.0, 1.5, 1.0, 2.0}, {1.0, 2.0, 2.0, 2.0}}}}}};
}

TEST(ReportSection, ComesBackFromJson) {
  const nlohmann::ordered_json json = section_json(full_section());
  EXPECT_EQ(json.at("plot").at("series").at(0).at("points").dump(), "[[0.0,1.5,1.0,2.0],[1.0,2.0]]") << "a spread only where there is one";
  const ReportSection back = section_from_json(nlohmann::ordered_json::parse(json.dump()));
  EXPECT_EQ(section_json(back), json);
  ASSERT_TRUE(back.plot && back.table);
  EXPECT_EQ(back.plot->kind, PlotKind::bar);
  EXPECT_TRUE(back.plot->y.log);
  EXPECT_EQ(back.plot->x.categories.size(), 2U);
  EXPECT_EQ(back.plot->series.at(0).points.at(0).y_max, 2.0);
  EXPECT_EQ(std::get<std::string>(back.table->rows.at(0).at(0)), "a|b");
}

TEST(ReportSection, LeavesOutWhatItHasNot) {
  const nlohmann::ordered_json json = section_json({"Only words", "Words.", {}, {}});
  EXPECT_EQ(json.size(), 2U);
  const ReportSection back = section_from_json(json);
  EXPECT_FALSE(back.table || back.plot);
}

TEST(ReportSection, RefusesAnotherShape) {
  nlohmann::ordered_json json = section_json(full_section());
  json["plot"]["kind"] = "pie";
  EXPECT_THROW(static_cast<void>(section_from_json(json)), InputError);
  json.erase("title");
  EXPECT_THROW(static_cast<void>(section_from_json(json)), nlohmann::json::exception);
}

TEST(ReportSection, IsATableInMarkdown) {
  const std::string text = section_markdown(full_section(), 3);
  EXPECT_THAT(text, HasSubstr("### Speed\n\nBy scene.\n\n| scene | speed |\n| --- | ---: |\n| a\\|b | 1.5"));
  ReportSection plot_alone = full_section();
  plot_alone.table.reset();
  const std::string points = section_markdown(plot_alone, 3);
  EXPECT_THAT(points, HasSubstr("| one | a | 1.5"));
  EXPECT_THAT(points, Not(HasSubstr("a\\|b")));
}

}  // namespace
}  // namespace grove

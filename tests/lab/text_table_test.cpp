#include "grove/lab/text_table.h"

#include <gtest/gtest.h>

namespace grove {
namespace {

TEST(TextTable, AlignsColumnsByCharactersNotBytes) {
  TextTable table({{"name", TextTable::Align::left}, {"range", TextTable::Align::right}});
  table.add_row({"a", "1–2"});
  table.add_gap();
  table.add_row({"longer", "10–200"});
  EXPECT_EQ(table.text(),
            "name     range\n"
            "------  ------\n"
            "a          1–2\n"
            "\n"
            "longer  10–200\n");
}

TEST(TextTable, WritesNumbersForPeople) {
  EXPECT_EQ(with_separators(0), "0");
  EXPECT_EQ(with_separators(999), "999");
  EXPECT_EQ(with_separators(1000), "1,000");
  EXPECT_EQ(with_separators(1234567), "1,234,567");
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.01234), "0.0123");
  EXPECT_EQ(short_number(4.5678), "4.57");
  EXPECT_EQ(short_number(78.94), "78.9");
  EXPECT_EQ(short_number(123456.0), "123456");
  EXPECT_EQ(byte_size(512), "512 B");
  EXPECT_EQ(byte_size(1536), "1.50 KiB");
  EXPECT_EQ(byte_size(std::uint64_t{5} << 30), "5.00 GiB");
  EXPECT_EQ(duration(0.0123), "12.3 ms");
  EXPECT_EQ(duration(12.34), "12.3 s");
  EXPECT_EQ(duration(125.0), "2 min 5 s");
  EXPECT_EQ(duration(7320.0), "2 h 2 min");
}

}  // namespace
}  // namespace grove

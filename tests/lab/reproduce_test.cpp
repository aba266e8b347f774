#include "grove/lab/claims/reproduce.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "grove/base/error.h"
#include "grove/lab/claims/reproduce_report.h"

namespace grove {
namespace {

using ::testing::HasSubstr;

TEST(Claims, SayWhatTheyCheck) {
  std::set<std::string_view> ids;
  for (const Claim& claim : review_claims()) {
    EXPECT_TRUE(ids.insert(claim.id).second) << claim.id << " is there twice";
    EXPECT_TRUE(claim.statement.ends_with('.')) << claim.id;
    EXPECT_TRUE(claim.method.ends_with('.')) << claim.id;
    EXPECT_THAT(std::string(claim.method), HasSubstr("olds")) << claim.id << " does not say what makes it hold";
    EXPECT_NE(claim.check, nullptr) << claim.id;
  }
  EXPECT_GE(ids.size(), 24U);
}

/// Two claims that take about a second.
const ReproduceSettings kTwoClaims{true, {"octree-one-parent", "octree-deep-and-empty"}};

TEST(Reproduce, SavesAfterEachClaimAndGoesOnFromThere) {
  std::vector<Reproduction> saved;
  const Reproduction whole = reproduce(kTwoClaims, {}, {{}, [&](const Reproduction& so_far) { saved.push_back(so_far); }});
  ASSERT_EQ(saved.size(), 2U);
  EXPECT_FALSE(saved[0].is_complete);
  EXPECT_TRUE(whole.is_complete);
  ASSERT_EQ(whole.claims.size(), 2U);
  for (const CheckedClaim& claim : whole.claims) {
    ASSERT_TRUE(claim.finding) << claim.id << ": " << claim.error;
    EXPECT_FALSE(claim.finding->measured.empty());
    EXPECT_FALSE(claim.finding->sections.empty());
    EXPECT_GT(claim.seconds, 0.0);
  }

  // The first is taken over as it is, from the file's text, and only the second is checked again.
  const Reproduction half = reproduction_from_json(nlohmann::ordered_json::parse(reproduction_json(saved[0]).dump()), "half.json");
  EXPECT_TRUE(can_resume(half, kTwoClaims));
  std::vector<std::string_view> started;
  const Reproduction resumed =
      reproduce(kTwoClaims, half, {[&](const Claim& claim, std::size_t, std::size_t) { started.push_back(claim.id); }, {}});
  EXPECT_THAT(started, ::testing::ElementsAre("octree-deep-and-empty"));
  ASSERT_EQ(resumed.claims.size(), 2U);
  EXPECT_EQ(resumed.claims[0].seconds, whole.claims[0].seconds);
  EXPECT_EQ(reproduction_json(resumed).at("claims").at(0), reproduction_json(whole).at("claims").at(0));
  EXPECT_NE(resumed.claims[1].seconds, whole.claims[1].seconds);

  Reproduction other = half;
  other.machine.commit = "another";
  EXPECT_FALSE(can_resume(other, kTwoClaims));
  other = half;
  EXPECT_FALSE(can_resume(other, ReproduceSettings())) << "a quick run says nothing about a full one";
}

TEST(Reproduce, StopsBetweenExperiments) {
  std::stop_source stop;
  const ReproduceObserver stops_it{{}, [&](const Reproduction&) { stop.request_stop(); }};
  const Reproduction cut = reproduce(kTwoClaims, {}, stops_it, stop.get_token());
  EXPECT_EQ(cut.claims.size(), 1U);
  EXPECT_FALSE(cut.is_complete);
  EXPECT_TRUE(reproduce(kTwoClaims, {}, {}, stop.get_token()).claims.empty());
}

TEST(Reproduce, NamesTheClaimsThatThereAre) {
  try {
    static_cast<void>(reproduce({true, {"earth-is-flat"}}, {}));
    FAIL() << "no such claim";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("octree-ray-generator"));
  }
}

Reproduction small_reproduction() {
  const Finding finding{Verdict::mixed, "Half of 4 * 2.", "By 8 counts.", {{"Figures", "Text.", ReportTable{{"n"}, {{4.0}}}, {}}}};
  return {{"a processor", 2, 2, "a compiler", "0123456789abcdef", "an os"},
          true,
          "grove reproduce --quick",
          "2026-01-31T00:00:00Z",
          61.0,
          true,
          {{"one", "Trees grow.", "III.A.1", "Holds when they do.", finding, "", 60.0},
           {"two", "Trees fall.", "IV.A", "Holds.", {}, "out of memory", 1.0}}};
}

TEST(ReproduceReport, KeepsWhatFailedApart) {
  const nlohmann::ordered_json json = reproduction_json(small_reproduction());
  EXPECT_EQ(json.at("format"), "grove-reproduce");
  ASSERT_EQ(json.at("claims").size(), 1U);
  for (const char* key : {"id", "statement", "source", "measured", "verdict"}) EXPECT_TRUE(json.at("claims").at(0).contains(key)) << key;
  EXPECT_EQ(json.at("claims").at(0).at("verdict"), "mixed");
  EXPECT_EQ(json.at("failed").at(0).at("error"), "out of memory");
  EXPECT_THROW(static_cast<void>(reproduction_from_json({{"format", "grove-compare"}, {"version", 1}}, "x.json")), InputError);
  EXPECT_THROW(static_cast<void>(reproduction_from_json(nlohmann::ordered_json(), "x.json")), InputError);
}

TEST(ReproduceReport, IsTextAndADocument) {
  const std::string text = claim_text(small_reproduction().claims.at(0));
  EXPECT_THAT(text, HasSubstr("mixed   one (III.A.1, 60.0 s)\n        Trees grow.\n        → Half of 4 * 2.\n        Why: By 8 counts.\n"));
  EXPECT_THAT(tally_text(small_reproduction()), HasSubstr("2 claims: 0 hold, 1 is mixed, 0 fail; 1 could not be checked"));
  const std::string document = reproduction_markdown(small_reproduction());
  EXPECT_THAT(document, HasSubstr("commit 0123456789ab"));
  EXPECT_THAT(document, HasSubstr("### III.A: Octrees\n\n- **Trees grow.** (mixed) Half of 4 \\* 2. By 8 counts. [figures](#one)"));
  EXPECT_THAT(document, HasSubstr("### one\n"));
  EXPECT_THAT(document, HasSubstr("Could not be checked: out of memory"));
}

TEST(ReproduceReport, KeepsWhatIsWrittenByHand) {
  const std::string document = reproduction_markdown(small_reproduction());
  Reproduction later = small_reproduction();
  later.claims.pop_back();
  const std::string after = replace_generated("By hand.\n" + document + "By hand, too.\n", reproduction_markdown(later));
  EXPECT_TRUE(after.starts_with("By hand.\n# The review"));
  EXPECT_TRUE(after.ends_with("By hand, too.\n"));
  EXPECT_THAT(after, ::testing::Not(HasSubstr("out of memory")));
  EXPECT_THAT(after, HasSubstr("### one\n"));
  EXPECT_EQ(replace_generated("Another text.", document), document);
}

}  // namespace
}  // namespace grove

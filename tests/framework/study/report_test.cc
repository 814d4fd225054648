// What reports say, and that they need nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/study/report/comparison.h"
#include "framework/study/report/csv.h"
#include "framework/study/report/html.h"
#include "framework/study/report/report_files.h"
#include "framework/study/report/svg.h"
#include "framework/study/report/tables.h"

namespace plaza {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

AxisValue value(const std::string& label, std::optional<double> number = {}) {
  AxisValue v;
  v.label = label;
  v.number = number;
  return v;
}

/// Two gates by two finders by four seeds; figure: gate + finder + seed / 100, "b" failing at seed
/// 4 of gate 2.
PreparedStudy prepared_study() {
  PreparedStudy prepared;
  Study& study = prepared.study;
  study.name = "Gates <& \"finders\">";
  study.axes = {{"gate", {value("1", 1), value("2", 2)}}, {"finder", {value("a"), value("b,c")}}};
  study.seeds = {1, 2, 3, 4};
  study.baseline.values = {{"finder", "a"}};
  prepared.metrics = {{"tracking", "MOTA", "", Better::kHigher, "accuracy"},
                      {"tracking", "IDS", "", Better::kLower, "switches"},
                      {"tracking", "TP", "", Better::kHigher, "hits", true}};
  for (const auto& gate : study.axes[0].values) {
    for (const auto& finder : study.axes[1].values) {
      for (std::size_t r = 0; r < 4; ++r) {
        Job job;
        job.variant = prepared.expansion.variants.size();
        job.repetition = r;
        job.seed = study.seeds[r];
        prepared.expansion.jobs.push_back(std::move(job));
      }
      prepared.expansion.variants.push_back({{gate.label, finder.label}});
    }
  }
  return prepared;
}

StudyResults results_of(const PreparedStudy& prepared) {
  std::vector<JobOutcome> outcomes;
  for (const Job& job : prepared.expansion.jobs) {
    JobOutcome outcome;
    outcome.result = JobResult{};
    const double gate = job.variant >= 2 ? 0.2 : 0.1;
    const double finder = job.variant % 2 == 1 ? 0.5 : 0.25;
    const double seed = static_cast<double>(*job.seed) / 100;
    outcome.result->frames = 10;
    outcome.result->node_seconds = 0.02 + seed;
    outcome.result->evaluation["tracking"] = {
        {"MOTA", gate + finder + seed}, {"IDS", 3}, {"TP", 7}, {"overlap", 0.5}};
    if (job.variant == 3 && job.seed == 4U) outcome.result->error = "node 'x': <b>no</b>";
    outcomes.push_back(std::move(outcome));
  }
  return collect_results(prepared, std::move(outcomes));
}

class ReportTest : public ::testing::Test {
 protected:
  PreparedStudy prepared_ = prepared_study();
  StudyResults results_ = results_of(prepared_);
};

TEST_F(ReportTest, ColumnsAreTheDeclaredMetricsThatWereGiven) {
  ASSERT_EQ(results_.columns.size(), 3U);
  EXPECT_EQ(results_.columns[0].title(), "tracking.MOTA");
  EXPECT_FALSE(results_.columns[0].whole);
  EXPECT_TRUE(results_.columns[1].whole);
  EXPECT_THAT(results_.chosen(), ElementsAre(0U, 1U)) << "the third is a detail";
  EXPECT_EQ(results_.figures(3, 0).size(), 3U) << "one has failed";
}

TEST_F(ReportTest, TablesShowMediansAndTheirSpread) {
  const auto tables = result_tables(results_);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_THAT(tables[0].head, ElementsAre("gate", "finder", "MOTA ↑", "IDS ↓"));
  EXPECT_THAT(tables[0].rows[0], ElementsAre("1", "a", "0.375 ±0.008", "3 ±0"));
  EXPECT_THAT(tables[0].rows[3][2], HasSubstr("(3)"));
  EXPECT_THAT(failure_lines(results_),
              ElementsAre("gate=2, finder=b,c, seed 4: node 'x': <b>no</b>"));
}

TEST_F(ReportTest, DifferencesArePairedOverEverythingElse) {
  const auto comparisons = compare_with_baseline(results_);
  ASSERT_EQ(comparisons.size(), 1U);
  EXPECT_EQ(comparisons[0].label, "finder=b,c");
  EXPECT_EQ(comparisons[0].differences[0].size(), 7U) << "two gates, four seeds, one failed";
  for (const double difference : comparisons[0].differences[0])
    EXPECT_NEAR(difference, 0.25, 1e-12);
  EXPECT_EQ(verdict(*comparisons[0].estimates[0], Better::kHigher), 1);
  EXPECT_EQ(verdict(*comparisons[0].estimates[0], Better::kLower), -1);
  EXPECT_EQ(verdict(*comparisons[0].estimates[1], Better::kLower), 0) << "no difference at all";
  EXPECT_THAT(difference_tables(results_)[0].rows[0][2],
              HasSubstr("+0.250 [+0.250, +0.250] better"));
}

TEST_F(ReportTest, CsvHasARowForEveryFigure) {
  const std::string csv = results_csv(results_);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 15 * 3 + 1);
  EXPECT_THAT(csv, AllOf(HasSubstr("1,\"b,c\",2,2,done,,tracking,MOTA,,higher,0.62,"),
                         HasSubstr("2,\"b,c\",4,4,failed,,,,,,,node 'x': <b>no</b>")));
  EXPECT_THAT(csv, Not(HasSubstr("overlap"))) << "a setting is no metric";
  const std::string times = times_csv(results_);
  EXPECT_THAT(times, HasSubstr("1,a,1,1,10,0.030000,0.003000"));
}

TEST_F(ReportTest, ThePageNeedsNothingElseAndEscapesWhatIsWritten) {
  const std::string page = report_html(results_);
  EXPECT_THAT(page, AllOf(HasSubstr("<title>Gates &lt;&amp; &quot;finders&quot;&gt;</title>"),
                          HasSubstr("&lt;b&gt;no&lt;/b&gt;"), HasSubstr("tracking.MOTA along gate"),
                          HasSubstr("tracking.MOTA against time"),
                          HasSubstr("tracking.MOTA ↑, minus that of finder=a")));
  for (const char* external : {"http:", "https:", "src=", "href=", "@import", "url(", "<script"}) {
    EXPECT_THAT(page, Not(HasSubstr(external)));
  }
  for (const char* element : {"svg", "figure", "table", "details", "div", "p", "text", "circle"}) {
    const auto count = [&page](const std::string& mark) {
      std::size_t n = 0;
      for (std::size_t at = 0; (at = page.find(mark, at)) != std::string::npos; ++at) {
        const char next = page[at + mark.size()];
        n += next == ' ' || next == '>' ? 1 : 0;
      }
      return n;
    };
    EXPECT_EQ(count(std::string("<") + element), count(std::string("</") + element)) << element;
  }
  EXPECT_EQ(report_html(results_), page);
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST_F(ReportTest, OneVariantAndNoFiguresAreReportsToo) {
  for (JobOutcome& job : results_.jobs) job.result.reset();
  const StudyResults none = collect_results(prepared_, results_.jobs);
  EXPECT_TRUE(none.columns.empty());
  EXPECT_THAT(report_markdown(none), HasSubstr("## Without result"));
  EXPECT_THAT(report_html(none), HasSubstr("16 without result"));
}

TEST(TicksTest, AreRoundAndCoverTheRange) {
  EXPECT_THAT(nice_ticks(0.13, 0.87, 5),
              ElementsAre(0, 0.2, 0.4, testing::DoubleNear(0.6, 1e-12), 0.8, 1));
  EXPECT_EQ(nice_ticks(-3, 12, 4).front(), -5);
  const auto equal = nice_ticks(0.5, 0.5, 5);
  EXPECT_LT(equal.front(), 0.5);
  EXPECT_GT(equal.back(), 0.5);
  EXPECT_EQ(tick_text(0.25, 0.05), "0.25");
  EXPECT_EQ(tick_text(30, 10), "30");
}

}  // namespace
}  // namespace plaza

#include "plugins/sinks/error-pictures/episodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plaza::error_pictures {
namespace {

using testing::ElementsAre;

struct Script {
  EpisodeBook book{2, 3, 1.0};
  std::vector<std::int64_t> drawn;

  void of(std::optional<std::int64_t> id, std::int64_t frame, double x_m = 0) {
    FiledError error;
    error.frame = frame;
    error.id = id;
    error.position_m = {x_m, 0};
    book.add(error, [&] {
      drawn.push_back(frame);
      return Pictured{cv::Mat(1, 1, CV_8UC3), "here", "at " + std::to_string(frame)};
    });
  }
};

TEST(Episodes, GoOnOverSmallGapsAndAreDrawnWheneverTheyHaveDoubled) {
  Script s;
  for (const int frame : {0, 1, 2, 5, 6, 7, 8, 9}) s.of(7, frame);
  s.of(7, 13);
  EXPECT_EQ(s.book.episodes(), 2);
  EXPECT_EQ(s.book.errors(), 9);
  EXPECT_THAT(s.drawn, ElementsAre(0, 1, 5, 9, 13));
  const auto longest = s.book.longest();
  ASSERT_EQ(longest.size(), 2U);
  EXPECT_EQ(longest[0].count, 8);
  EXPECT_EQ(longest[0].first_frame, 0);
  EXPECT_EQ(longest[0].last_frame, 9);
  EXPECT_EQ(longest[0].pictured_frame, 9);
  EXPECT_EQ(longest[0].caption, "at 9");
  EXPECT_EQ(longest[0].who, "here");
}

TEST(Episodes, PeopleAreToldApartByWhoTheyAre) {
  Script s;
  s.of(1, 0, 0);
  s.of(2, 0, 0);
  s.of(1, 1, 50);
  EXPECT_EQ(s.book.episodes(), 2);
}

TEST(Episodes, NobodiesAreToldApartByPlace) {
  Script s;
  s.of({}, 0, 0);
  s.of({}, 0, 0.5);  // a second one in the same frame
  s.of({}, 1, 0.9);
  s.of({}, 1, 5);
  EXPECT_EQ(s.book.episodes(), 3);
}

TEST(Episodes, OnlyTheLongestAreKept) {
  Script s;
  for (int id = 0; id < 20; ++id) {
    for (int frame = 0; frame <= id % 5; ++frame) s.of(id, 100 * id + frame);
  }
  const auto longest = s.book.longest();
  ASSERT_EQ(longest.size(), 2U);
  EXPECT_EQ(longest[0].first_frame, 400) << "the earlier of equal ones";
  EXPECT_EQ(longest[1].first_frame, 900);
  EXPECT_EQ(s.book.episodes(), 20);
}

}  // namespace
}  // namespace plaza::error_pictures

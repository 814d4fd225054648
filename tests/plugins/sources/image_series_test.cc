#include "plugins/sources/images/image_series.h"

#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Key;

TEST(NumberPattern, FrameTakesAnyNumberOfDigits) {
  const NumberPattern pattern("view1_{frame}.png");
  EXPECT_EQ(pattern.number("view1_7.png"), 7);
  EXPECT_EQ(pattern.number("view1_000007.png"), 7);
  EXPECT_EQ(pattern.number("view1_.png"), std::nullopt);
  EXPECT_EQ(pattern.number("view1_-7.png"), std::nullopt);
  EXPECT_EQ(pattern.number("view1_7.png.bak"), std::nullopt);
  EXPECT_EQ(pattern.number("view2_7.png"), std::nullopt);
  EXPECT_EQ(pattern.number("view1_12345678901234567890.png"), std::nullopt) << "no 64-bit number";
}

TEST(NumberPattern, PrintfWidthsMeanWhatTheyWrite) {
  const NumberPattern padded("%03d.jpg");
  EXPECT_EQ(padded.number("007.jpg"), 7);
  EXPECT_EQ(padded.number("1234.jpg"), 1234);
  EXPECT_EQ(padded.number("7.jpg"), std::nullopt);
  EXPECT_EQ(padded.number("0007.jpg"), std::nullopt);
  const NumberPattern plain("100%%_%d");
  EXPECT_EQ(plain.number("100%_0"), 0);
  EXPECT_EQ(plain.number("100%_10"), 10);
  EXPECT_EQ(plain.number("100%_010"), std::nullopt);
}

TEST(NumberPattern, SaysWhatIsWrong) {
  const auto fault = [](const char* text) {
    return std::string(user_error([&] { NumberPattern pattern(text); }).what());
  };
  EXPECT_EQ(
      fault("image.png"),
      "pattern 'image.png' has no place for the frame's number; write {frame} where the number "
      "stands, or printf's %d or %06d");
  EXPECT_THAT(fault("{frame}_{frame}.png"), HasSubstr("has two places"));
  EXPECT_THAT(fault("%d_{frame}.png"), HasSubstr("has two places"));
  EXPECT_THAT(fault("%s.png"), HasSubstr("has a '%' that is no %d"));
  EXPECT_THAT(fault("%"), HasSubstr("has a '%' that is no %d"));
  EXPECT_THAT(fault("%6d.png"), HasSubstr("has '%6d', which is no zero-padded width"));
  EXPECT_THAT(fault("%0d.png"), HasSubstr("no zero-padded width"));
  EXPECT_THAT(fault("%099d.png"), HasSubstr("no zero-padded width"));
}

class ListImages : public ::testing::Test {
 protected:
  std::string fault(const std::string& pattern) {
    return user_error([&] { list_images(folder_ / pattern); }).what();
  }
  TemporaryFolder folder_;
};

TEST_F(ListImages, FindsWhatFits) {
  for (const char* name : {"a10.png", "a9.png", "a2.jpg", "b3.png", "notes.txt"}) {
    write_bytes(folder_ / name, "x");
  }
  const ImageSeries series = list_images(folder_ / "a{frame}.png");
  EXPECT_THAT(series.files, ElementsAre(Key(9), Key(10)));
  EXPECT_EQ(series.files.at(10), folder_ / "a10.png");
}

TEST_F(ListImages, SaysWhatTheFolderHasInstead) {
  EXPECT_THAT(fault("{frame}.png"), HasSubstr("fits '{frame}.png'; the folder is empty"));
  write_bytes(folder_ / "z.png", "x");
  write_bytes(folder_ / "img_1.png", "x");
  EXPECT_EQ(fault("{frame}.png"), "no file in " + folder_.path().string() +
                                      " fits '{frame}.png'; it has 'img_1.png', for example");
}

TEST_F(ListImages, RefusesTwoFilesWithOneNumber) {
  write_bytes(folder_ / "1.png", "x");
  write_bytes(folder_ / "01.png", "x");
  EXPECT_EQ(fault("{frame}.png"),
            "'01.png' and '1.png' in " + folder_.path().string() +
                " are both number 1; remove one, or write a pattern that only "
                "one fits");
  EXPECT_THAT(list_images(folder_ / "%d.png").files, ElementsAre(Key(1)));
}

TEST_F(ListImages, NamesAMissingFolder) {
  EXPECT_THAT(fault("nowhere/{frame}.png"),
              AllOf(HasSubstr((folder_ / "nowhere").string() + " cannot be listed"),
                    HasSubstr("No such file or directory"), HasSubstr("$PLAZA_DATA")));
  EXPECT_THAT(fault("{frame}/view1.png"), HasSubstr("has the number in a folder's name"));
}

}  // namespace
}  // namespace plaza::sources

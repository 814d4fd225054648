#include "plaza/io/mot_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// The texts of all faults, as the user sees them.
std::vector<std::string> faults_of(const std::string& text, const RowLimits& limits = {}) {
  try {
    parse_mot_rows(text, "rows.txt", limits);
  } catch (const UserError& error) {
    std::vector<std::string> out;
    for (const Diagnostic& d : error.diagnostics()) out.push_back(to_string(d));
    return out;
  }
  return {};
}

std::vector<std::string> ground_faults_of(const std::string& text, const RowLimits& limits = {}) {
  try {
    parse_ground_rows(text, "ground.csv", limits);
  } catch (const UserError& error) {
    std::vector<std::string> out;
    for (const Diagnostic& d : error.diagnostics()) out.push_back(to_string(d));
    return out;
  }
  return {};
}

TEST(MotRows, ReadsGroundTruthWithClassAndVisibility) {
  const auto rows = parse_mot_rows("3,7,1.5,-2,30,75.25,0,12,0.375\n", "gt.txt");
  ASSERT_THAT(rows, SizeIs(1));
  EXPECT_EQ(rows[0].frame, 3);
  EXPECT_EQ(rows[0].id, 7);
  EXPECT_EQ(rows[0].box, (Box{1.5, -2, 30, 75.25}));
  EXPECT_EQ(rows[0].confidence, 0);
  EXPECT_EQ(rows[0].class_id, 12);
  EXPECT_EQ(rows[0].visibility, 0.375);
  EXPECT_FALSE(rows[0].position_m);
  EXPECT_EQ(rows[0].line, 1);
}

TEST(MotRows, TenColumnsEndInAPosition) {
  const auto rows =
      parse_mot_rows("1,7,1,2,3,4,0.5,-4.1554,-7.3591,0\n2,7,1,2,3,4,0.5,-1,-1,-1\n", "gt.txt");
  ASSERT_THAT(rows, SizeIs(2));
  ASSERT_TRUE(rows[0].position_m);
  EXPECT_EQ(*rows[0].position_m, Eigen::Vector3d(-4.1554, -7.3591, 0));
  EXPECT_FALSE(rows[0].class_id);
  EXPECT_FALSE(rows[1].position_m) << "-1,-1,-1 means unknown";
}

TEST(MotRows, SixColumnsAreEnough) {
  const auto rows = parse_mot_rows("1,7,1,2,3,4\n", "r.txt");
  ASSERT_THAT(rows, SizeIs(1));
  EXPECT_EQ(rows[0].confidence, 1);
  EXPECT_FALSE(rows[0].class_id);
  EXPECT_FALSE(rows[0].visibility);
}

TEST(MotRows, KeepTheFilesOrder) {
  const auto rows = parse_mot_rows("2,1,0,0,1,1\n1,9,0,0,1,1\n1,3,0,0,1,1\n", "r.txt");
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_THAT((std::vector{rows[0].line, rows[1].line, rows[2].line}), ElementsAre(1, 2, 3));
  EXPECT_THAT((std::vector{rows[0].id, rows[1].id, rows[2].id}), ElementsAre(1, 9, 3));
}

TEST(MotRows, TolerateWhatEditorsAndPlatformsLeave) {
  const auto plain = parse_mot_rows("1,2,3,4,5,6,1\n2,2,3,4,5,6,1\n", "r.txt");
  for (const std::string text :
       {"\xEF\xBB\xBF"
        "1,2,3,4,5,6,1\r\n2,2,3,4,5,6,1\r\n",
        "1, 2,\t3 ,4,5,6,1\n\n2,2,3,4,5,6,1", "1,2,3,4,5,6,1,\n2,2,3,4,5,6,1,\n",
        "1 2 3 4 5 6 1\n2\t2 3  4 5 6 1 \n", "1.0,2.000,+3,4e0,5,6,1\n2,2,0.3E1,4,5,6,1\n\n\n"}) {
    const auto rows = parse_mot_rows(text, "r.txt");
    ASSERT_EQ(rows.size(), plain.size()) << text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].frame, plain[i].frame) << text;
      EXPECT_EQ(rows[i].id, plain[i].id) << text;
      EXPECT_EQ(rows[i].box, plain[i].box) << text;
    }
  }
}

TEST(MotRows, NumbersAreRoundedCorrectly) {
  const auto rows =
      parse_mot_rows("1,1,0.1,454.92999267578125,16777217.000000001,1e-320\n", "r.txt");
  EXPECT_EQ(rows[0].box.left, 0.1);
  EXPECT_EQ(rows[0].box.top, 454.92999267578125);
  EXPECT_EQ(rows[0].box.width, 16777217.0);
  EXPECT_EQ(rows[0].box.height, 1e-320);
}

TEST(MotRows, SayWhatIsNoNumber) {
  EXPECT_THAT(faults_of("1,1,0,0,1O,10,1\n"),
              ElementsAre("rows.txt:1:9: width '1O' is not a decimal number"));
  EXPECT_THAT(faults_of("1,1,0,,10,10,1\n"),
              ElementsAre("rows.txt:1:7: top is empty; write a decimal number"));
  EXPECT_THAT(faults_of("1,1,0,0,0x10,10,1\n"),
              ElementsAre("rows.txt:1:9: width '0x10' is not a decimal number"));
  EXPECT_THAT(faults_of("1,1,+-1,0,1,1\n"),
              ElementsAre("rows.txt:1:5: left '+-1' is not a decimal number"));
  EXPECT_THAT(faults_of("1,1,0,0,1 0,10,1\n"),
              ElementsAre("rows.txt:1:9: width '1 0' is not a decimal number"));
}

TEST(MotRows, RefuseWhatIsNotFinite) {
  EXPECT_THAT(faults_of("1,1,nan,0,10,10,1\n"),
              ElementsAre("rows.txt:1:5: left 'nan' is not finite; leave the row out"));
  EXPECT_THAT(faults_of("1,1,0,-inf,10,10,1\n"),
              ElementsAre("rows.txt:1:7: top '-inf' is not finite; leave the row out"));
  EXPECT_THAT(faults_of("1,1,0,0,1e999,10,1\n"),
              ElementsAre("rows.txt:1:9: width '1e999' is beyond the range of double precision"));
}

TEST(MotRows, PlacesAreInTheWorld) {
  EXPECT_THAT(faults_of("1,1,0,-2e9,10,10,1\n"),
              ElementsAre("rows.txt:1:7: top '-2e9' is beyond any image; at most 1e9 pixels"));
  EXPECT_THAT(ground_faults_of("1,1,1e200,0\n"),
              ElementsAre("ground.csv:1:5: position is beyond any place; at most 1e9 m"));
}

TEST(MotRows, FramesAndIdentitiesAreWhole) {
  EXPECT_THAT(faults_of("1.5,1,0,0,1,1\n"),
              ElementsAre("rows.txt:1:1: frame '1.5' is not a whole number"));
  EXPECT_THAT(faults_of("1,2e300,0,0,1,1\n"),
              ElementsAre("rows.txt:1:3: id '2e300' is too large; at most 2^53"));
  EXPECT_THAT(faults_of("1,99999999999999999999,0,0,1,1\n"),
              ElementsAre("rows.txt:1:3: id '99999999999999999999' is too large; at most 2^53"));
}

TEST(MotRows, ColumnsMustSufficeAndStayTheSame) {
  EXPECT_THAT(faults_of("1,1,0,0,10\n"),
              ElementsAre("rows.txt:1:11: 5 columns are too few; a row is "
                          "frame,id,left,top,width,height[,confidence[,...]]"));
  EXPECT_THAT(faults_of("1,1,0,0,10,10,1,-1,-1,-1\n2,1,0,0,10,10,1,-1\n"),
              ElementsAre("rows.txt:2:19: 8 columns, but line 1 has 10; is the row cut off?"));
  EXPECT_THAT(faults_of("1,1,0,0,10,10,1,-1,-1,-1,4\n"),
              ElementsAre(HasSubstr("rows.txt:1:26: 11 columns are too many")));
}

TEST(MotRows, SizesAreNotNegative) {
  EXPECT_THAT(
      faults_of("1,1,0,0,-10,10,1\n"),
      ElementsAre("rows.txt:1:9: width '-10' is negative; a box is left, top, width, height"));
  EXPECT_THAT(parse_mot_rows("1,1,0,0,0,0,1\n", "r.txt"), SizeIs(1)) << "a box without area is one";
}

TEST(MotRows, FramesStayWithinTheLimits) {
  EXPECT_THAT(faults_of("0,1,0,0,1,1\n"),
              ElementsAre("rows.txt:1:1: frame 0 comes before the first frame, 1"));
  EXPECT_THAT(faults_of("11,1,0,0,1,1\n", {.last_frame = 10}),
              ElementsAre("rows.txt:1:1: frame 11 comes after the last frame, 10"));
  EXPECT_THAT(faults_of("0,1,0,0,1,1\n10,1,0,0,1,1\n", {.first_frame = 0, .last_frame = 10}),
              ElementsAre());
}

TEST(MotRows, AnIdentityOccursOnceInAFrame) {
  EXPECT_THAT(faults_of("1,5,0,0,1,1\n2,5,0,0,1,1\n1,6,0,0,1,1\n1,5,9,9,1,1\n"),
              ElementsAre("rows.txt:4:1: id 5 a second time in frame 1 (first in line 1); "
                          "an identity occurs once in a frame"));
  EXPECT_THAT(faults_of("1,-1,0,0,1,1\n1,-1,0,0,1,1\n"), SizeIs(0)) << "nobody has an identity";
  EXPECT_THAT(faults_of("1,-1,0,0,1,1\n1,-1,0,0,1,1\n2,3,0,0,1,1\n"), SizeIs(1));
  EXPECT_THAT(
      faults_of("1,-1,0,0,1,1\n1,-1,0,0,1,1\n1,4,0,0,1,1\n1,4,0,0,1,1\n", {.unidentified = true}),
      ElementsAre(HasSubstr("rows.txt:4:1: id 4 a second time")));
}

TEST(MotRows, EmptyFilesAreErrors) {
  for (const std::string text : {"", "\n\n", "\xEF\xBB\xBF", " \r\n"}) {
    EXPECT_THAT(faults_of(text), ElementsAre(HasSubstr("rows.txt:1: the file has no rows")))
        << text;
  }
}

TEST(MotRows, RubbishIsNamedAsSuch) {
  EXPECT_THAT(
      faults_of(std::string("1,1,0,0,1,1\n\x7F"
                            "ELF\x02\x00\x00",
                            19)),
      ElementsAre("rows.txt:2:5: byte 0x02: not a text file; expected rows of decimal numbers"));
  EXPECT_THAT(faults_of("\xFF\xFE\x80\n"), ElementsAre(HasSubstr("1 columns are too few")));
  EXPECT_THAT(faults_of("\xFF,1,0,0,1,1\n"),
              ElementsAre("rows.txt:1:1: frame '\\xff' is not a decimal number"));
}

TEST(MotRows, ShowAllFaultsAtOnceUpToAPoint) {
  EXPECT_THAT(faults_of("0,1,0,0,1,1\n1,1,a,0,b,1\n"), SizeIs(3));
  std::string text;
  for (int i = 0; i < 100; ++i) text += "0,1,0,0,1,1\n";
  const auto faults = faults_of(text);
  ASSERT_THAT(faults, SizeIs(21));
  EXPECT_EQ(faults.back(), "rows.txt: and 179 more faults");  // 100 frames, 99 repetitions of id 1
}

TEST(MotRows, ClassesAreNumbers) {
  EXPECT_THAT(faults_of("1,1,0,0,1,1,1,1.5,1\n"),
              ElementsAre(HasSubstr("rows.txt:1:15: class '1.5'")));
  EXPECT_FALSE(parse_mot_rows("1,1,0,0,1,1,1,-1,-1\n", "r")[0].class_id);
}

TEST(GroundRows, WithAndWithoutIdentities) {
  const auto rows = parse_ground_rows("1,4,0.5,-2\n", "g.txt");
  EXPECT_EQ(rows[0].id, 4);
  EXPECT_EQ(rows[0].position_m, Eigen::Vector2d(0.5, -2));
  const auto cells =
      parse_ground_rows("0 346 951\n0 240 934\n", "g.txt", {.first_frame = 0}, 0.025);
  ASSERT_THAT(cells, SizeIs(2));
  EXPECT_EQ(cells[0].id, kNoIdentity);
  EXPECT_EQ(cells[1].position_m, 0.025 * Eigen::Vector2d(240, 934));
}

TEST(GroundRows, NamesSayWhichColumnIsWhich) {
  const auto rows =
      parse_ground_rows("frame,id,x_m,y_m,heading_deg,score\n1,4,0.5,-2,,0.75\n2,,1,1,90,\n",
                        "g.csv", {.unidentified = true}, 0.025);
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[0].position_m, Eigen::Vector2d(0.5, -2)) << "x_m is metres whatever the unit";
  EXPECT_FALSE(rows[0].heading_deg);
  EXPECT_EQ(rows[0].score, 0.75);
  EXPECT_EQ(rows[1].id, kNoIdentity);
  EXPECT_EQ(rows[1].heading_deg, 90);
  EXPECT_FALSE(rows[1].score);
  const auto observations = parse_ground_rows("y_m,frame,x_m,remark\n2,1,3,hello\n", "g.csv");
  EXPECT_EQ(observations[0].position_m, Eigen::Vector2d(3, 2));
  EXPECT_EQ(observations[0].id, kNoIdentity);
}

TEST(GroundRows, TenColumnsAreMotChallengeRowsWithAPosition) {
  const auto rows = parse_ground_rows("1,4,100,200,30,80,1,0.5,-2,0\n", "g.txt");
  EXPECT_EQ(rows[0].position_m, Eigen::Vector2d(0.5, -2));
  EXPECT_EQ(parse_ground_rows("1,4,-1,-1,-1,-1,1,5,6,-1\n", "g.txt")[0].position_m,
            Eigen::Vector2d(5, 6));
  EXPECT_THAT(ground_faults_of("1,4,100,200,30,80,1,-1,-1,-1\n"),
              ElementsAre("ground.csv:1:21: the row has no ground position (x, y, z are -1)"));
}

TEST(GroundRows, FaultsHavePlaces) {
  EXPECT_THAT(ground_faults_of("1,4,0.5\n1,5,zero,1\n"),
              ElementsAre("ground.csv:2:11: 4 columns, but line 1 has 3; is the row cut off?"));
  EXPECT_THAT(
      ground_faults_of("1,4,0.5,0\n1,5,zero,1\n1,4,0,0\n"),
      ElementsAre("ground.csv:2:5: x 'zero' is not a decimal number",
                  HasSubstr("ground.csv:3:1: id 4 a second time in frame 1 (first in line 1)")));
  EXPECT_THAT(ground_faults_of("1,4\n"), ElementsAre(HasSubstr("2 columns are too few")));
  EXPECT_THAT(
      ground_faults_of("frame,id,x_m\n1,2,3\n"),
      ElementsAre("ground.csv:1:1: the names of the columns must include frame, x_m and y_m"));
  EXPECT_THAT(ground_faults_of("frame,x_m,x_m,y_m\n1,2,3,4\n"),
              ElementsAre("ground.csv:1:11: column 'x_m' twice"));
  EXPECT_THAT(ground_faults_of("frame,id,x_m,y_m\n"),
              ElementsAre(HasSubstr("the file has no rows")));
  EXPECT_THAT(ground_faults_of("frame,id,x_m,y_m\n1,2,,3\n"),
              ElementsAre("ground.csv:2:5: x is empty; write a decimal number"));
  EXPECT_THAT(ground_faults_of("1,2,1,1,oops\n"),
              ElementsAre("ground.csv:1:9: column 'oops' is not a decimal number"));
}

TEST(RowFiles, AreReadFromDisk) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "plaza_rows.txt";
  std::ofstream(file) << "1,1,0,0,1,1\n";
  EXPECT_THAT(read_mot_rows(file), SizeIs(1));
  std::ofstream(file) << "1,1,0\n";
  try {
    read_mot_rows(file);
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.string() + ":1:6: "));
  }
  std::filesystem::remove(file);
  try {
    read_ground_rows(file);
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()), file.string() + ": no such file; check the path");
  }
  EXPECT_THROW(read_mot_rows(testing::TempDir()), UserError);
}

}  // namespace
}  // namespace plaza

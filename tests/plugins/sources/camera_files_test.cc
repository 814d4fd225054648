#include "plugins/sources/common/camera_files.h"

#include "tests/plugins/sources/source_harness.h"

namespace plaza::sources {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(CameraFiles, EscapesNamesInPointers) {
  EXPECT_EQ(entry_pointer("files", "view1"), "/files/view1");
  EXPECT_EQ(entry_pointer("files", "hall/~north"), "/files/hall~1~0north");
}

TEST(CameraFiles, EveryCameraHasAnEntryOrIsDeclaredMissing) {
  const auto scene = test_scene({"a", "b", "c"});
  EXPECT_THAT(check_cameras(*scene, "files", {{"a", "1"}, {"b", "2"}}, {"c"}), IsEmpty());
  EXPECT_THAT(
      texts(check_cameras(*scene, "files", {{"a", "1"}, {"x", "2"}}, {"c"})),
      ElementsAre("/files/x: the scene has no camera 'x'; it has 'a', 'b', 'c'",
                  "/files: camera 'b' of the scene has no entry; give it one, or name it in "
                  "\"missing_cameras\" to run without its images"));
}

TEST(CameraFiles, MissingCamerasMustExistAndHaveNoEntry) {
  const auto scene = test_scene({"a", "b"});
  EXPECT_THAT(texts(check_cameras(*scene, "files", {{"a", "1"}, {"b", "2"}}, {"b", "z"})),
              ElementsAre("/missing_cameras/0: camera 'b' is declared missing and has an entry in "
                          "\"files\"; remove one of the two",
                          "/missing_cameras/1: the scene has no camera 'z'; it has 'a', 'b'"));
}

TEST(CameraFiles, SayWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "there.txt", "text");
  EXPECT_EQ(file_fault(folder / "there.txt"), "");
  EXPECT_EQ(file_fault(folder / "gone.avi"),
            "there is no file " + (folder / "gone.avi").string() +
                "; the folder exists, the file does not: check the name");
  EXPECT_THAT(file_fault(folder / "data/pets/gone.avi"),
              AllOf(HasSubstr("there is no folder below " + folder.path().string() + ";"),
                    HasSubstr("$PLAZA_DATA")));
  EXPECT_EQ(file_fault(folder.path()), folder.path().string() + " is a folder; a file is needed");
}

TEST(CameraFiles, KnowThatMinimalImagesDropDocumentation) {
  EXPECT_EQ(
      file_fault("/usr/share/doc/opencv-doc/examples/data/no-such.avi"),
      "there is no file /usr/share/doc/opencv-doc/examples/data/no-such.avi; this file comes "
      "from the documentation of Debian's package opencv-doc: apt-get install opencv-doc; "
      "minimal images drop /usr/share/doc (path-exclude in /etc/dpkg/dpkg.cfg.d): remove that "
      "rule and apt-get install --reinstall opencv-doc");
}

TEST(CameraFiles, StampChangesWithTheFile) {
  const TemporaryFolder folder;
  write_bytes(folder / "a", "one");
  const std::string before = file_stamp(folder / "a");
  EXPECT_EQ(file_stamp(folder / "a"), before);
  write_bytes(folder / "a", "three");
  EXPECT_NE(file_stamp(folder / "a"), before);
  EXPECT_THAT(file_stamp(folder / "b"), HasSubstr("unreadable"));
}

}  // namespace
}  // namespace plaza::sources

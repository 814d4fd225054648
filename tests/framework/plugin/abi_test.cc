#include "framework/plugin/abi.h"

#include <gmock/gmock.h>

#include <cstring>
#include <functional>

#include "tests/framework/plugin/fixture_paths.h"

namespace plaza {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(AbiTest, EqualTagsFit) { EXPECT_THAT(abi_mismatch(current_abi(), current_abi()), IsEmpty()); }

TEST(AbiTest, VersionsReadAsPeopleWriteThem) {
  EXPECT_EQ(version_text(100), "0.1.0");
  EXPECT_EQ(version_text(120304), "12.3.4");
}

TEST(AbiTest, OlderAndNewerSdkAreToldApart) {
  AbiTag wanted = current_abi(), found = current_abi();
  wanted.sdk_version = 100;
  found.sdk_version = 200;
  EXPECT_EQ(abi_mismatch(found, wanted),
            "built against the newer SDK 0.2.0, this is SDK 0.1.0; rebuild the plugin against SDK "
            "0.1.0, or update plaza to 0.2.0");
  found.sdk_version = 9;
  EXPECT_EQ(abi_mismatch(found, wanted),
            "built against the older SDK 0.0.9, this is SDK 0.1.0; rebuild the plugin against SDK "
            "0.1.0");
}

TEST(AbiTest, AnotherVersionHidesWhatFollowsFromIt) {
  AbiTag found = current_abi();
  found.sdk_version += 1;
  found.size_observation += 8;
  EXPECT_THAT(abi_mismatch(found, current_abi()), Not(HasSubstr("Observation")));
}

struct FieldCase {
  const char* words;
  std::function<void(AbiTag&)> change;
};

TEST(AbiTest, EveryFieldIsComparedAndNamedInWords) {
  const FieldCase cases[] = {
      {"C++ standard", [](AbiTag& t) { t.cpp_standard = 201703; }},
      {"compiler ABI", [](AbiTag& t) { ++t.compiler_abi; }},
      {"_GLIBCXX_USE_CXX11_ABI", [](AbiTag& t) { t.cxx11_strings ^= 1; }},
      {"Eigen 3.3.9", [](AbiTag& t) { t.eigen_version = 30309; }},
      {"Eigen alignment (EIGEN_MAX_ALIGN_BYTES) 32, wanted 16",
       [](AbiTag& t) { t.eigen_align = 32; }},
      {"OpenCV 3.4.1", [](AbiTag& t) { t.opencv_version = 30401; }},
      {"nlohmann-json 3.10.5", [](AbiTag& t) { t.json_version = 31005; }},
      {"JSON_DIAGNOSTICS 1, wanted 0", [](AbiTag& t) { t.json_diagnostics = 1; }},
      {"size of Observation", [](AbiTag& t) { ++t.size_observation; }},
      {"alignment of Observation", [](AbiTag& t) { ++t.align_observation; }},
      {"size of TrackPoint", [](AbiTag& t) { ++t.size_track_point; }},
      {"alignment of TrackPoint", [](AbiTag& t) { ++t.align_track_point; }},
      {"size of ParameterSpec", [](AbiTag& t) { ++t.size_parameter_spec; }},
      {"size of BuildContext", [](AbiTag& t) { ++t.size_build_context; }},
      {"size of ComponentDeclaration", [](AbiTag& t) { ++t.size_declaration; }},
      {"size of Eigen::Vector4d", [](AbiTag& t) { ++t.size_vector4d; }},
      {"alignment of Eigen::Vector4d", [](AbiTag& t) { ++t.align_vector4d; }},
  };
  for (const FieldCase& c : cases) {
    AbiTag found = current_abi();
    c.change(found);
    EXPECT_THAT(abi_mismatch(found, current_abi()),
                AllOf(HasSubstr(c.words), HasSubstr("wanted"), HasSubstr("rebuild")))
        << c.words;
  }
}

TEST(AbiTest, AllDifferencesAreNamedAtOnce) {
  AbiTag found = current_abi();
  found.eigen_align = 32;
  found.align_vector4d = 32;
  EXPECT_THAT(abi_mismatch(found, current_abi()),
              AllOf(HasSubstr("EIGEN_MAX_ALIGN_BYTES"), HasSubstr("alignment of Eigen::Vector4d")));
}

TEST(DescriptorTest, OursFits) {
  EXPECT_THAT(descriptor_mismatch(make_plugin_descriptor(nullptr)), IsEmpty());
}

TEST(DescriptorTest, HeadIsCheckedBeforeTheTag) {
  PluginDescriptor d = make_plugin_descriptor(nullptr);
  d.abi.sdk_version = 77;
  d.size = 12;
  EXPECT_THAT(descriptor_mismatch(d), HasSubstr("has 12 bytes"));
  d.layout = 5;
  EXPECT_THAT(descriptor_mismatch(d), HasSubstr("layout 5, wanted 2"));
  d.magic[0] = 'X';
  EXPECT_THAT(descriptor_mismatch(d), HasSubstr("no descriptor of a Plaza plugin"));
}

TEST(DescriptorTest, IsFoundInTheFileWithoutLoadingIt) {
  const auto found = descriptors_in_file(fixture_library("old-version"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].abi.sdk_version, 9U);
  EXPECT_EQ(found[0].register_components, nullptr);
  EXPECT_EQ(descriptors_in_file(fixture_library("valid")).size(), 1U);
  EXPECT_THAT(descriptors_in_file(fixture_library("no-entry")), IsEmpty());
}

TEST(DescriptorTest, TextThatLooksLikeOneIsNone) {
  const TemporaryFolder folder;
  using std::string_literals::operator""s;
  // the magic alone; cut off after it; at an odd offset
  const std::string magic = "PLAZA\0\0\0"s;
  EXPECT_THAT(descriptors_in_file(folder.write("a", magic + std::string(500, '\xff'))), IsEmpty());
  EXPECT_THAT(descriptors_in_file(folder.write("b", magic)), IsEmpty());
  PluginDescriptor d = make_plugin_descriptor(nullptr);
  std::string bytes(sizeof(d), '\0');
  std::memcpy(bytes.data(), &d, sizeof(d));
  EXPECT_THAT(descriptors_in_file(folder.write("c", "x" + bytes)), IsEmpty());
  EXPECT_EQ(descriptors_in_file(folder.write("d", std::string(8, 'x') + bytes)).size(), 1U);
}

}  // namespace
}  // namespace plaza

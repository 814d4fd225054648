#include "framework/plugin/abi.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <type_traits>

namespace plaza {
namespace {

static_assert(std::is_trivially_copyable_v<PluginDescriptor>);
static_assert(std::is_standard_layout_v<PluginDescriptor>);

constexpr PluginDescriptor kOurs = make_plugin_descriptor(nullptr);

struct Differences {
  std::string text;

  template <class T>
  void compare(T found, T wanted, std::string_view what, std::string_view remedy) {
    if (found != wanted) add(what, std::to_string(found), std::to_string(wanted), remedy);
  }
  void compare_version(std::uint32_t found, std::uint32_t wanted, std::string_view what,
                       std::string_view remedy) {
    if (found != wanted) add(what, version_text(found), version_text(wanted), remedy);
  }

 private:
  void add(std::string_view what, const std::string& found, const std::string& wanted,
           std::string_view remedy) {
    if (!text.empty()) text += "; ";
    text.append(what).append(" ").append(found).append(", wanted ").append(wanted);
    text.append("; ").append(remedy);
  }
};

}  // namespace

std::string version_text(std::uint32_t number) {
  return std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." +
         std::to_string(number % 100);
}

std::string abi_mismatch(const AbiTag& found, const AbiTag& wanted) {
  if (found.sdk_version != wanted.sdk_version) {
    // whatever else differs follows from this
    const bool older = found.sdk_version < wanted.sdk_version;
    const std::string theirs = version_text(found.sdk_version);
    const std::string ours = version_text(wanted.sdk_version);
    return "built against the " + std::string(older ? "older" : "newer") + " SDK " + theirs +
           ", this is SDK " + ours + "; rebuild the plugin against SDK " + ours +
           (older ? "" : ", or update plaza to " + theirs);
  }
  Differences d;
  d.compare(found.cpp_standard, wanted.cpp_standard, "built as C++ standard",
            "rebuild the plugin with -std=c++20 (plaza_add_plugin() sets it)");
  d.compare(found.compiler_abi, wanted.compiler_abi, "built with compiler ABI",
            "rebuild the plugin without another -fabi-version, with the compiler of plaza");
  d.compare(found.cxx11_strings, wanted.cxx11_strings, "built with _GLIBCXX_USE_CXX11_ABI",
            "rebuild the plugin without changing this macro");
  d.compare_version(found.eigen_version, wanted.eigen_version, "built with Eigen",
                    "rebuild the plugin with the same Eigen");
  d.compare(found.eigen_align, wanted.eigen_align,
            "built with Eigen alignment (EIGEN_MAX_ALIGN_BYTES)",
            "rebuild the plugin with the value that Plaza::sdk sets");
  d.compare_version(found.opencv_version, wanted.opencv_version, "built with OpenCV",
                    "rebuild the plugin with the same OpenCV");
  d.compare_version(found.json_version, wanted.json_version, "built with nlohmann-json",
                    "rebuild the plugin with the same nlohmann-json");
  d.compare(found.json_diagnostics, wanted.json_diagnostics, "built with JSON_DIAGNOSTICS",
            "rebuild the plugin with the value that Plaza::sdk sets");
  const std::string_view headers = "rebuild the plugin against the SDK headers of this plaza";
  d.compare(found.size_observation, wanted.size_observation, "size of Observation", headers);
  d.compare(found.align_observation, wanted.align_observation, "alignment of Observation", headers);
  d.compare(found.size_track_point, wanted.size_track_point, "size of TrackPoint", headers);
  d.compare(found.align_track_point, wanted.align_track_point, "alignment of TrackPoint", headers);
  d.compare(found.size_parameter_spec, wanted.size_parameter_spec, "size of ParameterSpec",
            headers);
  d.compare(found.size_build_context, wanted.size_build_context, "size of BuildContext", headers);
  d.compare(found.size_declaration, wanted.size_declaration, "size of ComponentDeclaration",
            headers);
  d.compare(found.size_vector4d, wanted.size_vector4d, "size of Eigen::Vector4d", headers);
  d.compare(found.align_vector4d, wanted.align_vector4d, "alignment of Eigen::Vector4d",
            "rebuild the plugin without another EIGEN_MAX_ALIGN_BYTES");
  return d.text;
}

std::string descriptor_mismatch(const PluginDescriptor& found) {
  if (std::memcmp(found.magic, kOurs.magic, sizeof(kOurs.magic)) != 0) {
    return "its symbol plaza_plugin_descriptor is no descriptor of a Plaza plugin; define it with "
           "PLAZA_PLUGIN(registrar) { ... } of plaza/plugin.h";
  }
  if (found.layout != kOurs.layout) {
    return "its descriptor has layout " + std::to_string(found.layout) + ", wanted " +
           std::to_string(kOurs.layout) + "; rebuild the plugin against SDK " PLAZA_VERSION;
  }
  if (found.size != kOurs.size) {
    return "its descriptor has " + std::to_string(found.size) + " bytes, wanted " +
           std::to_string(kOurs.size) + "; rebuild the plugin against SDK " PLAZA_VERSION;
  }
  return abi_mismatch(found.abi, kOurs.abi);
}

std::vector<PluginDescriptor> descriptors_in_file(const std::filesystem::path& library) {
  std::ifstream in(library, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string_view magic(kOurs.magic, sizeof(kOurs.magic));
  std::vector<PluginDescriptor> out;
  for (std::size_t at = bytes.find(magic); at != std::string::npos;
       at = bytes.find(magic, at + 1)) {
    // the linker keeps offsets in the file aligned as addresses are
    if (at % alignof(PluginDescriptor) != 0 || bytes.size() - at < sizeof(PluginDescriptor))
      continue;
    PluginDescriptor descriptor = kOurs;
    std::memcpy(&descriptor, bytes.data() + at, sizeof(descriptor));
    // the name alone may stand in any text
    constexpr std::uint32_t kPlausibleLayouts = 1000;
    if (descriptor.layout == 0 || descriptor.layout > kPlausibleLayouts) continue;
    descriptor.register_components = nullptr;
    out.push_back(descriptor);
  }
  return out;
}

}  // namespace plaza

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include "plaza/component/build_context.h"
#include "plaza/component/declaration.h"
#include "plaza/component/parameter.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"
#include "plaza/version.h"

namespace plaza {

/// Everything about a build that must be equal on both sides of the plugin boundary. Plain data of
/// fixed layout: it is read before anything else of the library is trusted.
struct AbiTag {
  std::uint32_t sdk_version;    ///< major * 10000 + minor * 100 + patch
  std::int64_t cpp_standard;    ///< __cplusplus
  std::uint32_t compiler_abi;   ///< __GXX_ABI_VERSION
  std::uint32_t cxx11_strings;  ///< _GLIBCXX_USE_CXX11_ABI
  std::uint32_t eigen_version;  ///< world * 10000 + major * 100 + minor
  std::uint32_t eigen_align;    ///< EIGEN_MAX_ALIGN_BYTES
  std::uint32_t opencv_version;
  std::uint32_t json_version;
  std::uint32_t json_diagnostics;
  std::uint32_t size_observation, align_observation;
  std::uint32_t size_track_point, align_track_point;
  std::uint32_t size_parameter_spec;
  std::uint32_t size_build_context;
  std::uint32_t size_declaration;  ///< of ComponentDeclaration
  std::uint32_t size_vector4d, align_vector4d;
};

struct PluginDescriptor {
  char magic[8];         ///< "PLAZA\0\0\0"
  std::uint32_t layout;  ///< of this struct and of AbiTag; kPluginLayout
  std::uint32_t size;    ///< sizeof(PluginDescriptor)
  AbiTag abi;
  void (*register_components)(void* registrar);  ///< a ComponentRegistrar*; may throw
};

inline constexpr std::uint32_t kPluginLayout = 2;
inline constexpr const char* kPluginSymbol = "plaza_plugin_descriptor";

/// The tag of the code that this header is compiled into.
constexpr AbiTag current_abi() {
  return {
      .sdk_version = PLAZA_VERSION_NUMBER,
      .cpp_standard = __cplusplus,
      .compiler_abi = __GXX_ABI_VERSION,
      .cxx11_strings = _GLIBCXX_USE_CXX11_ABI,
      .eigen_version =
          EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION,
      .eigen_align = EIGEN_MAX_ALIGN_BYTES,
      .opencv_version = CV_VERSION_MAJOR * 10000 + CV_VERSION_MINOR * 100 + CV_VERSION_REVISION,
      .json_version = NLOHMANN_JSON_VERSION_MAJOR * 10000 + NLOHMANN_JSON_VERSION_MINOR * 100 +
                      NLOHMANN_JSON_VERSION_PATCH,
      .json_diagnostics = JSON_DIAGNOSTICS,
      .size_observation = sizeof(Observation),
      .align_observation = alignof(Observation),
      .size_track_point = sizeof(TrackPoint),
      .align_track_point = alignof(TrackPoint),
      .size_parameter_spec = sizeof(ParameterSpec),
      .size_build_context = sizeof(BuildContext),
      .size_declaration = sizeof(ComponentDeclaration),
      .size_vector4d = sizeof(Eigen::Vector4d),
      .align_vector4d = alignof(Eigen::Vector4d),
  };
}

constexpr PluginDescriptor make_plugin_descriptor(void (*register_components)(void*)) {
  return {.magic = {'P', 'L', 'A', 'Z', 'A', 0, 0, 0},
          .layout = kPluginLayout,
          .size = sizeof(PluginDescriptor),
          .abi = current_abi(),
          .register_components = register_components};
}

}  // namespace plaza

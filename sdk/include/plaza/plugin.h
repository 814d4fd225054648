#pragma once

#include "plaza/component/declaration.h"
#include "plaza/plugin_abi.h"

/// Defines the one entry of a plugin library: a plain descriptor that the kernel compares before
/// any C++ crosses, and the register function it names. Once per library:
///
///   PLAZA_PLUGIN(registrar) {
///     registrar.add<MyDetector>();
///   }
#define PLAZA_PLUGIN(registrar)                                                                   \
  static void plaza_register_components(::plaza::ComponentRegistrar& registrar);                  \
  static void plaza_register_trampoline(void* opaque) {                                           \
    plaza_register_components(*static_cast<::plaza::ComponentRegistrar*>(opaque));                \
  }                                                                                               \
  extern "C" __attribute__((                                                                      \
      visibility("default"))) constinit const ::plaza::PluginDescriptor plaza_plugin_descriptor = \
      ::plaza::make_plugin_descriptor(&plaza_register_trampoline);                                \
  static void plaza_register_components([[maybe_unused]] ::plaza::ComponentRegistrar& registrar)

# Settings of Plaza's own build: nothing here is exported.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# A build tree is laid out as an install tree is, so that the executable finds plugins in both.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(PLAZA_PLUGIN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/plaza/plugins)
set(PLAZA_PLUGIN_INSTALL_DIRECTORY ${CMAKE_INSTALL_LIBDIR}/plaza/plugins)

find_program(PLAZA_CCACHE ccache)
if(PLAZA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache asks for this word before it caches what uses a precompiled header: it trusts the header's
  # content then, which is right here, where no header depends on macros of its users
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${PLAZA_CCACHE})
endif()

add_library(plaza_warnings INTERFACE)
target_compile_options(plaza_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion)
if(PLAZA_SANITIZE)
  add_compile_options(-fsanitize=${PLAZA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${PLAZA_SANITIZE})
endif()

# With it a target's sources are compiled eight at a time, as one unit: what they share, mostly templates of the standard
# library, json and Eigen, is instantiated once, in half of the time or less. An edit compiles its whole unit, and clangd, which
# wants each source's own command, finds none: who edits a lot switches it off in a build of their own.
option(PLAZA_UNITY "Compile several sources of a target as one unit" ON)
set(CMAKE_UNITY_BUILD ${PLAZA_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

# What libraries and plugins precompile, half of the time of a clean build otherwise: the standard library and
# the packages of the public headers, nothing of our own, so that no edit touches it.
set(PLAZA_PRECOMPILED
  <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <iostream>
  <limits> <map> <memory> <mutex> <numbers> <numeric> <optional> <set> <span> <sstream> <stdexcept> <string>
  <string_view> <system_error> <thread> <unordered_map> <utility> <variant> <vector>
  <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <nlohmann/json.hpp> <opencv2/core.hpp>)

# plaza_precompile(TARGET...): for libraries of the tree, in which all code is position-independent in one way.
function(plaza_precompile)
  foreach(target IN LISTS ARGN)
    target_precompile_headers(${target} REUSE_FROM plaza_precompiled)
  endforeach()
endfunction()

# plaza_add_parts(TARGET SOURCES file... [LIBRARIES target...]): all of a plugin but its entry, as a static library, so
# that tests and benchmarks link the very code that the plugin has, compiled once.
function(plaza_add_parts TARGET)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;LIBRARIES")
  add_library(${TARGET} STATIC ${ARG_SOURCES})
  target_link_libraries(${TARGET} PUBLIC Plaza::sdk ${ARG_LIBRARIES} PRIVATE plaza_warnings)
  target_include_directories(${TARGET} PUBLIC ${PROJECT_SOURCE_DIR})  # "plugins/..."
  plaza_precompile(${TARGET})
endfunction()

include(PlazaOpenCV)
include(PlazaPlugin)

# plaza_add_rooms(DIR...): adds every folder below DIR, at any depth, that has a CMakeLists.txt.
function(plaza_add_rooms)
  foreach(room IN LISTS ARGN)
    file(GLOB_RECURSE lists CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/CMakeLists.txt)
    foreach(list IN LISTS lists)
      cmake_path(GET list PARENT_PATH folder)
      cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
      add_subdirectory(${folder} ${PROJECT_BINARY_DIR}/${name})
    endforeach()
  endforeach()
endfunction()

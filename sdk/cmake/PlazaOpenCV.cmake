# plaza_find_opencv([OPTIONAL] component...): imported targets opencv_<component>. Missing ones are an error; with
# OPTIONAL they just have no target.
#
# OpenCV's own CMake package where there is one (libopencv-dev); else headers and libraries by hand, since
# Debian's component packages (libopencv-core-dev, ...), a fraction of the full set, ship no CMake package.
function(plaza_find_opencv)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "OPTIONAL" "" "")
  set(components ${ARG_UNPARSED_ARGUMENTS})
  find_package(OpenCV 4.5 QUIET CONFIG COMPONENTS ${components})
  if(OpenCV_FOUND)
    return()
  endif()
  find_path(PLAZA_OPENCV_INCLUDE_DIR opencv2/core/version.hpp PATH_SUFFIXES opencv4)
  foreach(component IN LISTS components)
    if(TARGET opencv_${component})
      continue()
    endif()
    find_library(PLAZA_OPENCV_${component}_LIBRARY opencv_${component})
    if(NOT PLAZA_OPENCV_INCLUDE_DIR OR NOT PLAZA_OPENCV_${component}_LIBRARY)
      if(ARG_OPTIONAL)
        continue()
      endif()
      message(FATAL_ERROR "OpenCV's '${component}' was not found: apt-get install libopencv-${component}-dev")
    endif()
    add_library(opencv_${component} SHARED IMPORTED GLOBAL)
    set_target_properties(opencv_${component} PROPERTIES
      IMPORTED_LOCATION ${PLAZA_OPENCV_${component}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${PLAZA_OPENCV_INCLUDE_DIR})
  endforeach()
endfunction()

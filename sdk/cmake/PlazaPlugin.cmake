# plaza_add_plugin(NAME SOURCES file... [LIBRARIES target...])
#
# Adds the plugin library plaza_NAME (a module that `plaza` loads). Works in Plaza's own tree and, after
# find_package(Plaza), in any other. In another tree, load it with `--plugin-path` or PLAZA_PLUGIN_PATH.
function(plaza_add_plugin NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;LIBRARIES")
  if(NOT ARG_SOURCES)
    message(FATAL_ERROR "plaza_add_plugin(${NAME}): SOURCES is empty")
  endif()
  string(REPLACE "-" "_" target ${NAME})
  add_library(plaza_${target} MODULE ${ARG_SOURCES})
  if(NOT PLAZA_SANITIZE)  # a sanitizer's own symbols are the executable's
    # an undefined symbol is found at link time, not when a user loads the plugin
    target_link_options(plaza_${target} PRIVATE -Wl,-z,defs)
  endif()
  target_link_libraries(plaza_${target} PRIVATE Plaza::sdk ${ARG_LIBRARIES})
  if(TARGET plaza_warnings)
    target_link_libraries(plaza_${target} PRIVATE plaza_warnings)
  endif()
  set_target_properties(plaza_${target} PROPERTIES
    OUTPUT_NAME plaza_${target} PREFIX ""
    CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(COMMAND plaza_precompile)
    plaza_precompile(plaza_${target})
  endif()
  if(PLAZA_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(plaza_${target} PROPERTIES
      LIBRARY_OUTPUT_DIRECTORY ${PLAZA_PLUGIN_OUTPUT_DIRECTORY}
      INSTALL_RPATH "$ORIGIN/../..")
    set_property(GLOBAL APPEND PROPERTY PLAZA_PLUGINS plaza_${target})
    install(TARGETS plaza_${target} LIBRARY DESTINATION ${PLAZA_PLUGIN_INSTALL_DIRECTORY})
  endif()
endfunction()

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
    file(REMOVE ${PLAZA_PLUGIN_OUTPUT_DIRECTORY}/plaza_${target}.left-out)  # of an earlier configuration
    set_property(GLOBAL APPEND PROPERTY PLAZA_PLUGINS plaza_${target})
    install(TARGETS plaza_${target} LIBRARY DESTINATION ${PLAZA_PLUGIN_INSTALL_DIRECTORY})
  endif()
endfunction()

# plaza_leave_out_plugin(NAME REASON)
#
# Says that the plugin library plaza_NAME can't be built, and why, with the remedy: now, and to whoever asks `plaza` for
# its component.
function(plaza_leave_out_plugin NAME REASON)
  string(REPLACE "-" "_" target ${NAME})
  message(STATUS "plugin '${NAME}' is left out: ${REASON}")
  if(PLAZA_PLUGIN_OUTPUT_DIRECTORY)
    set(note ${PLAZA_PLUGIN_OUTPUT_DIRECTORY}/plaza_${target}.left-out)
    file(REMOVE ${PLAZA_PLUGIN_OUTPUT_DIRECTORY}/plaza_${target}.so)  # of an earlier configuration
    file(WRITE ${note} "${REASON}\n")
    install(FILES ${note} DESTINATION ${PLAZA_PLUGIN_INSTALL_DIRECTORY})
  endif()
endfunction()

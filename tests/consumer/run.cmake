# cmake -D BUILD=<Plaza's build tree> -D CONSUMER=<this folder> -D WORK=<scratch> ... -P run.cmake
#
# Installs, builds the consumer against the installation, and tracks with its plugin. The installed tree
# must work with no variable set.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(prefix ${WORK}/prefix)
unset(ENV{PLAZA_PLUGIN_PATH})
unset(ENV{LD_LIBRARY_PATH})

# run(OUT command...): stops the test when the command fails.
function(run OUT)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out ERROR_VARIABLE errors RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${out}${errors}")
  endif()
  set(${OUT} "${out}" PARENT_SCOPE)
endfunction()
function(expect TEXT PATTERN)
  if(NOT "${TEXT}" MATCHES "${PATTERN}")
    message(FATAL_ERROR "\"${PATTERN}\" is not in:\n${TEXT}")
  endif()
endfunction()

run(ignored ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(ignored ${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G Ninja
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -D CMAKE_BUILD_TYPE=${BUILD_TYPE})
run(ignored ${CMAKE_COMMAND} --build ${WORK}/build)
run(ignored ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build --output-on-failure)

# the installed program finds the installed plugins, and the consumer's when it is told where they are
set(plaza ${prefix}/bin/plaza)
run(table ${plaza} plugins)
expect("${table}" "${prefix}/${LIBDIR}/plaza/plugins")
expect("${table}" "associator +gnn")
# what this build left out, for want of a package, is told and isn't missing
string(REGEX REPLACE "[^\n]*\n[^\n]*it was left out of this build:[^\n]*\n" "" others "${table}")
if(others MATCHES "refused:[ \n]*[^\n]*[.]so")
  message(FATAL_ERROR "the installation refuses plugins of its own:\n${table}")
endif()
run(table ${plaza} plugins --plugin-path ${WORK}/build)
expect("${table}" "describer +walking-direction")

# two people cross each other in front of one camera; boxes as a detector would give them
set(rows "")
foreach(frame RANGE 1 40)
  math(EXPR first_left "40 + 8 * ${frame}")
  math(EXPR second_left "560 - 6 * ${frame}")
  string(APPEND rows "${frame},-1,${first_left},150,40,120,0.9\n${frame},-1,${second_left},190,48,146,0.8\n")
endforeach()
file(WRITE ${WORK}/boxes.txt "${rows}")
file(COPY ${CONSUMER}/scene.json ${CONSUMER}/pipeline.json DESTINATION ${WORK})
run(ignored ${plaza} run ${WORK}/pipeline.json --plugin-path ${WORK}/build --out ${WORK}/out --quiet)

file(READ ${WORK}/out/summary.json summary)
string(JSON frames GET "${summary}" frames)
string(JSON complete GET "${summary}" complete)
if(NOT frames EQUAL 40 OR NOT complete)
  message(FATAL_ERROR "40 complete frames were expected:\n${summary}")
endif()
file(STRINGS ${WORK}/out/observations.ground.csv observations)
list(LENGTH observations count)
if(count LESS 60)
  message(FATAL_ERROR "80 observations were expected, there are ${count} lines")
endif()
list(GET observations -1 last)
expect("${last}" "^40,[^,]+,[^,]+,-?[0-9.]+,")  # the heading is the plugin's work
file(STRINGS ${WORK}/out/tracks.ground.csv tracks)
list(LENGTH tracks count)
if(count LESS 40)
  message(FATAL_ERROR "two tracks over 40 frames were expected, there are ${count} lines")
endif()
run(resolved ${CMAKE_COMMAND} -E cat ${WORK}/out/resolved.json)
expect("${resolved}" "walking-direction")

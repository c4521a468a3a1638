# Install the project, then build and run doc/step and doc/plugins as a stranger
# would: outside of its tree, with find_package(Isochor). Called by ctest:
#   cmake -DBUILD=... -DDOC=... -DTYPE=Release -P test_installed_library.cmake
set(place ${BUILD}/doc/installed)
file(REMOVE_RECURSE ${place})
file(MAKE_DIRECTORY ${place})

function(run)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "IN;OUTPUT" "COMMAND")
  if(NOT arg_IN)
    set(arg_IN ${place})
  endif()
  execute_process(COMMAND ${arg_COMMAND} WORKING_DIRECTORY ${arg_IN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN arg_COMMAND " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  if(arg_OUTPUT)
    file(WRITE ${arg_OUTPUT} "${output}")
  endif()
endfunction()

run(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/usr)
set(type "") # for speed without being asked
if(NOT TYPE STREQUAL Release)
  set(type -D CMAKE_BUILD_TYPE=${TYPE})
endif()
foreach(example step plugins)
  # several files at once: most of the work of a compilation is deal.II's headers
  run(COMMAND ${CMAKE_COMMAND} -S ${DOC}/${example} -B ${place}/${example}
    -D CMAKE_PREFIX_PATH=${place}/usr -D CMAKE_UNITY_BUILD=ON
    -D CMAKE_UNITY_BUILD_BATCH_SIZE=5 ${type})
  run(COMMAND ${CMAKE_COMMAND} --build ${place}/${example})
endforeach()

run(COMMAND ./step_isochor IN ${place}/step OUTPUT ${place}/step/output)
# eight digits are printed: one unit of the last one
run(COMMAND ${NUMDIFF} -a 1e-6 -r 1e-7 ${place}/step/output
  ${DOC}/step/step_isochor.output)

# a library for the other one of deal.II's is refused, not loaded
file(WRITE ${place}/other.so "libdeal.ii.so.0 libdeal.ii.g.so.0")
file(WRITE ${place}/other.prm "set Additional shared libraries = ./other.so\n")
execute_process(COMMAND ${place}/usr/bin/isochor ${place}/other.prm
  WORKING_DIRECTORY ${place} RESULT_VARIABLE result ERROR_VARIABLE message
  OUTPUT_QUIET)
if(result EQUAL 0 OR NOT message MATCHES "-D CMAKE_BUILD_TYPE=")
  message(FATAL_ERROR "A library for the other deal.II: ${message}")
endif()

# scenes look for the library beside themselves
file(GLOB scenes ${DOC}/plugins/*.prm)
file(COPY ${scenes} DESTINATION ${place}/plugins)
run(COMMAND ${place}/usr/bin/isochor plugins.prm --quiet
  IN ${place}/plugins)
run(COMMAND tail -n 1 output/statistics.txt IN ${place}/plugins
  OUTPUT ${place}/plugins/last_step)
# force on the top, mean stretches: the closed form in plugins.prm for λ = 0.7
file(READ ${place}/plugins/last_step last_step)
if(NOT last_step MATCHES " -25544[0-9.]* .* 1[.]42857[0-9]* 0[.]70000[0-9]* ")
  message(FATAL_ERROR "the scene with plugins gives ${last_step}")
endif()
if(NOT EXISTS ${place}/plugins/output/deal_ii.vtu)
  message(FATAL_ERROR "deal.II's DataOut has not written the nodal unknowns")
endif()

# both probes: Lame's closed form in annulus.prm, within 0.2 %
run(COMMAND ${place}/usr/bin/isochor annulus.prm --quiet
  --output-directory tube IN ${place}/plugins)
file(READ ${place}/plugins/tube/statistics.txt statistics)
if(NOT statistics MATCHES "other side: Displacement y of inner wall")
  message(FATAL_ERROR "no column of the second post-processor: ${statistics}")
endif()
string(REGEX MATCHALL "(9[.]5[2-4][0-9]*e-04|0[.]00095[2-4][0-9]*)" walls "${statistics}")
list(LENGTH walls n)
if(NOT n EQUAL 2)
  message(FATAL_ERROR "the tube in an annulus gives ${statistics}")
endif()

# the same in an adaptive grid of two plugins, within 0.3 %, fine where it is told to be
run(COMMAND ${place}/usr/bin/isochor adaptive_annulus.prm --quiet
  --output-directory adaptive_tube IN ${place}/plugins)
run(COMMAND tail -n 1 adaptive_tube/statistics.txt IN ${place}/plugins
  OUTPUT ${place}/plugins/last_step_of_tube)
file(READ ${place}/plugins/last_step_of_tube last_step)
string(REGEX MATCHALL "(9[.]5[0-5][0-9]*e-04|0[.]00095[0-5][0-9]*)" walls "${last_step}")
list(LENGTH walls n)
# cells, leaves (384 coarse ones), all with material, coarsest and finest level, changes
if(NOT n EQUAL 2 OR NOT last_step MATCHES " 1824 864 864 0 1 [12] ")
  message(FATAL_ERROR "the tube in an adaptive annulus gives ${last_step}")
endif()

run(COMMAND ${place}/usr/bin/isochor backward_euler.prm --quiet
  --output-directory fall IN ${place}/plugins)
run(COMMAND tail -n 1 fall/statistics.txt IN ${place}/plugins
  OUTPUT ${place}/plugins/last_step_of_fall)
file(READ ${place}/plugins/last_step_of_fall last_step)
if(NOT last_step MATCHES " -0?[.]5(5|5000[0-9]*|49999[0-9]*) |-5[.](50000|49999)[0-9]*e-01 ")
  message(FATAL_ERROR "the fall with backward Euler gives ${last_step}")
endif()

run(COMMAND ${place}/usr/bin/isochor lever.prm --quiet
  --output-directory lever IN ${place}/plugins)
run(COMMAND tail -n 1 lever/statistics.txt IN ${place}/plugins
  OUTPUT ${place}/plugins/last_step_of_lever)
file(READ ${place}/plugins/last_step_of_lever last_step)
if(NOT last_step MATCHES " 81(8000|7999)[.0-9]* | 8[.]1(8000|7999)[0-9]*e[+]05 ")
  message(FATAL_ERROR "the scene with a lever gives ${last_step}")
endif()

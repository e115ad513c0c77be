# fsi_integration_test([QUICK] [STARTS] [TURNS] [CLASS...]): registers the tests of test_FOLDER.py in the calling folder as FOLDER, or those
# of each class as FOLDER.CLASS, so that they can run beside each other. QUICK: among the quick tests, which is for what
# takes a few seconds. STARTS: is about the environment in which programs start, and begins without their settings. TURNS:
# takes choices by turns, all of them only in scripts/test.sh --long (by_turns in programs.py).
function(fsi_integration_test)
  cmake_parse_arguments(arg "QUICK;STARTS;TURNS" "" "" ${ARGN})
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(tests ${folder})
  if(arg_UNPARSED_ARGUMENTS)
    list(TRANSFORM arg_UNPARSED_ARGUMENTS PREPEND ${folder}. OUTPUT_VARIABLE tests)
  endif()
  set(said_version ${PROJECT_VERSION})
  if(FSI_ARCH)
    string(APPEND said_version " (${FSI_ARCH})")
  endif()
  set(labels integration)
  if(arg_QUICK)
    list(APPEND labels quick)
  endif()
  set(settings ${FSI_WITH_SETTINGS})
  if(arg_STARTS)
    set(settings)
  endif()
  if(arg_TURNS)
    list(APPEND labels turns)
  endif()
  foreach(test IN LISTS tests)
    add_test(NAME ${test}
      COMMAND ${settings} ${FSI_PYTHON} -E -B ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/run_tests.py test_${test}
      WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    set(environment
      FSI_MESH=$<TARGET_FILE:fsi-mesh>
      FSI_MONOLITHIC=$<TARGET_FILE:fsi-monolithic>
      FSI_PARTITIONED=$<TARGET_FILE:fsi-partitioned>
      FSI_CASES=${PROJECT_SOURCE_DIR}/meshes/artery
      FSI_VTK_PYTHON=${FSI_VTK_PYTHON}
      FSI_VERSION=${PROJECT_VERSION}
      "FSI_SAID_VERSION=${said_version}")  # by the programs in C++
    set_tests_properties(${test} PROPERTIES LABELS "${labels}" TIMEOUT 600 ENVIRONMENT "${environment}")
    fsi_start_early(${test})
  endforeach()
endfunction()

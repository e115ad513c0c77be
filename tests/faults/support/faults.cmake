# fsi_fault_harness([QUICK] [STARTS] [ARGUMENT...]): registers the short form of FOLDER/FOLDER.py of the calling folder as the test
# faults.FOLDER. QUICK: among the quick tests. STARTS: as of fsi_integration_test. Further arguments go to the program.
function(fsi_fault_harness)
  cmake_parse_arguments(arg "QUICK;STARTS" "" "" ${ARGN})
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(labels faults)
  if(arg_QUICK)
    list(APPEND labels quick)
  endif()
  set(settings ${FSI_WITH_SETTINGS})
  if(arg_STARTS)
    set(settings)
  endif()
  add_test(NAME faults.${folder}
    COMMAND ${settings} ${FSI_PYTHON} -E -B ${PROJECT_SOURCE_DIR}/tests/faults/run.py ${folder}
      --programs ${PROJECT_BINARY_DIR}/bin ${arg_UNPARSED_ARGUMENTS})
  set_tests_properties(faults.${folder} PROPERTIES LABELS "${labels}" TIMEOUT 600)
  fsi_start_early(faults.${folder})
endfunction()

# Tests on several processes, by Open MPI's mpirun (mpirun.sh). Without FSI_MPI nothing is registered or built. A test
# takes as many of ctest's processors as it has processes.

# fsi_add_mpi_test(NAME name PROCESSES 1 2 3 COMMAND program [argument...] [SECONDS 60] [LABELS label...]
#                  [ENVIRONMENT name=value...]): registers "name: N processes" for each number. COMMAND may name a target.
function(fsi_add_mpi_test)
  if(NOT FSI_MPI)
    return()
  endif()
  cmake_parse_arguments(arg "" "NAME;SECONDS" "PROCESSES;COMMAND;LABELS;ENVIRONMENT" ${ARGN})
  if(NOT arg_SECONDS)
    set(arg_SECONDS 60)
  endif()
  if(TARGET "${arg_COMMAND}" OR arg_COMMAND MATCHES ";")
    list(POP_FRONT arg_COMMAND program)
    if(TARGET ${program})
      set(program $<TARGET_FILE:${program}>)
    endif()
    list(PREPEND arg_COMMAND ${program})
  endif()
  math(EXPR last_resort "${arg_SECONDS} + 10")  # mpirun has ended the processes by then
  foreach(processes IN LISTS arg_PROCESSES)
    set(test "${arg_NAME}: ${processes} processes")
    if(processes EQUAL 1)
      set(test "${arg_NAME}: 1 process")
    endif()
    add_test(NAME ${test}
      COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/mpirun.sh ${processes} ${arg_SECONDS} ${arg_COMMAND})
    set_tests_properties(${test} PROPERTIES
      PROCESSORS ${processes} TIMEOUT ${last_resort} LABELS "mpi;${arg_LABELS}"
      ENVIRONMENT "FSI_MPIRUN=${MPIEXEC_EXECUTABLE};${arg_ENVIRONMENT}")
  endforeach()
endfunction()

# mpi_unit_test(folder PROCESSES 1 2 3 SOURCES ... LIBRARIES ... [SECONDS 60]): a GoogleTest program test_FOLDER_mpi whose
# tests all processes run together; it fails where one of them fails. Among the quick tests.
function(mpi_unit_test folder)
  if(NOT FSI_MPI)
    return()
  endif()
  cmake_parse_arguments(arg "" "SECONDS" "PROCESSES;SOURCES;LIBRARIES" ${ARGN})
  set(target test_${folder}_mpi)
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE fsi_mpi_test_main ${arg_LIBRARIES})
  add_dependencies(quick_tests ${target})
  fsi_add_mpi_test(NAME ${folder} PROCESSES ${arg_PROCESSES} COMMAND ${target} SECONDS "${arg_SECONDS}" LABELS quick)
endfunction()

if(FSI_MPI)
  add_library(fsi_mpi_test_main STATIC ${CMAKE_CURRENT_LIST_DIR}/mpi_test_main.cpp)
  target_link_libraries(fsi_mpi_test_main PUBLIC fsi_parallel GTest::gtest OpenMP::OpenMP_CXX)
endif()

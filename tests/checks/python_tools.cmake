# The Python formatter and the type checker, as programs of their own: settings in pyproject.toml at the root. The type
# checker reads the packages of the interpreter that fsi-compare runs with.
foreach(tool black mypy)
  string(TOUPPER ${tool} _name)
  find_program(${_name} ${tool})
  if(NOT ${_name})
    message(FATAL_ERROR "${tool} is missing; install the Debian package ${tool} or configure with -DFSI_TESTS=OFF")
  endif()
endforeach()

add_test(NAME black
  COMMAND ${of_version} ${BLACK} 23 ${BLACK} --check --diff --quiet --config pyproject.toml compare gallery/known_solutions scripts tests
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
add_test(NAME mypy
  COMMAND ${of_version} ${MYPY} 1.0 ${MYPY} --config-file pyproject.toml --python-executable ${FSI_PYTHON}
    --cache-dir ${CMAKE_CURRENT_BINARY_DIR}/mypy_cache
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(black mypy PROPERTIES LABELS check TIMEOUT 300 SKIP_RETURN_CODE 77)
fsi_start_early(mypy)

# `cmake --build --preset release --target api` makes the API documentation from the comments in the headers: HTML, to be
# opened at api/html/index.html of the build folder. Not part of the default build; Doxygen need not be there to configure.
find_program(DOXYGEN_PROGRAM doxygen)
if(DOXYGEN_PROGRAM)
  configure_file(docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(api
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/api  # pages of headers that are no more
    COMMAND ${DOXYGEN_PROGRAM} ${PROJECT_BINARY_DIR}/Doxyfile
    COMMAND ${CMAKE_COMMAND} -E echo "API documentation: ${PROJECT_BINARY_DIR}/api/html/index.html"
    VERBATIM)
else()
  add_custom_target(api
    COMMAND ${CMAKE_COMMAND} -E echo "doxygen is missing; install the Debian package doxygen and configure again"
    COMMAND ${CMAKE_COMMAND} -E false
    VERBATIM)
endif()

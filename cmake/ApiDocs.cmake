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

# `cmake --build --preset release --target site` makes the documentation site with the API in it: site/index.html of the
# build folder, by the Debian packages mkdocs and mkdocs-material.
if(DOXYGEN_PROGRAM)
  add_custom_target(site
    COMMAND ${FSI_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/make_site.py ${PROJECT_BINARY_DIR}/site
      --api ${PROJECT_BINARY_DIR}/api/html
    VERBATIM)
  add_dependencies(site api)
else()
  add_custom_target(site
    COMMAND ${FSI_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/make_site.py ${PROJECT_BINARY_DIR}/site
    VERBATIM)
endif()

# Debian packages of what is built: `cpack -G DEB` in the build folder makes fsi-duo (programs, cases, studies, documents)
# and fsi-duo-dev (libraries and headers), of one build. scripts/package.sh makes those for other machines: fsi-duo with the
# drivers for each x86-64 level, fsi-duo-dev for the lowest.
set(CPACK_PACKAGE_NAME fsi-duo)
set(CPACK_PACKAGE_VENDOR "the fsi-duo authors")
set(FSI_MAINTAINER "the fsi-duo authors <fsi-duo@localhost>" CACHE STRING "Who answers for the Debian packages, with address")
set(CPACK_PACKAGE_CONTACT "${FSI_MAINTAINER}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL programs development)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME fsi-duo)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
# Beside the shared libraries: what fsi-compare imports, for the interpreter that configuring found, and
# libjs-three, which it puts into reports; what fsi-mesh import reads other formats with.
string(CONCAT CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "python3 (>= 3.11), python3-matplotlib, python3-numpy, python3-h5py, "
  "python3-jinja2, libjs-three, python3-meshio, python3-netcdf4")
if(FSI_MPI)  # mpirun, which asks for ssh
  string(APPEND CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS ", openmpi-bin, openssh-client")
endif()
if(NOT FSI_PYTHON STREQUAL "/usr/bin/python3")
  message(STATUS "Packages: fsi-compare would run with ${FSI_PYTHON}, which the Debian packages do not bring; "
    "configure with -DFSI_PYTHON=/usr/bin/python3")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME fsi-duo-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "cmake, pkg-config, libeigen3-dev, libfmt-dev, libspdlog-dev, libcli11-dev, nlohmann-json3-dev, libtomlplusplus-dev, zlib1g-dev, liblzma-dev, "
  "libsuitesparse-dev, libopenblas-pthread-dev, libgmsh-dev, libcgal-dev, ")
if(FSI_MPI)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libhdf5-openmpi-dev, libopenmpi-dev, petsc-dev, libptscotch-dev")
else()
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libhdf5-dev")
endif()

# The first line is the title; a line with a point alone is an empty line.
set(_programs_text "fluid-structure interaction of an artery, solved twice and compared
A pressure pulse in a blood-filled elastic artery, by a monolithic Newton method and by a partitioned
fixed-point iteration between fluid and wall: fsi-mesh, fsi-monolithic, fsi-partitioned, fsi-compare.")
set(_development_text "fluid-structure interaction, libraries and headers
Static libraries, headers and the CMake package fsi-duo of the programs in fsi-duo.")
set(_native_text "
.
Built for the instruction set of the machine that made this package: it may not start on another one.")
if(FSI_ARCH)  # as CMakeLists.txt chooses
  set(_native_text "
.
Built for processors with the instructions of ${FSI_ARCH}: it does not start on others.")
elseif(NOT FSI_NATIVE)
  set(_native_text "")
endif()
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "${_programs_text}${_native_text}")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${_development_text}${_native_text}")
if(FSI_PACKAGE_LEVELS)
  list(JOIN _packaged ", " _levels_text)  # of cmake/Levels.cmake
  set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "${_programs_text}
.
Holds the drivers for ${_levels_text} and starts the best for the processor.")
endif()
include(CPack)

# HDF5's C library, the parallel one with FSI_MPI: HDF5_C_INCLUDE_DIRS, HDF5_C_DEFINITIONS and HDF5_C_LIBRARIES.
# Debian names each of its builds for pkg-config. CMake's own search takes the serial build wherever that brings CMake files
# (HDF5 2 does), whatever HDF5_PREFER_PARALLEL asks for; so it is for other systems, and for an HDF5 that is named by
# -DHDF5_DIR, -DHDF5_ROOT or the variable HDF5_ROOT of the environment.
if(DEFINED FSI_HDF5_FOR_MPI AND NOT "${FSI_HDF5_FOR_MPI}" STREQUAL "${FSI_MPI}")
  get_cmake_property(_cached CACHE_VARIABLES)  # what was found for the other choice must not stay
  foreach(_variable IN LISTS _cached)
    if(_variable MATCHES "^(FSI_DEBIAN_)?HDF5_")
      unset(${_variable} CACHE)
    endif()
  endforeach()
endif()
set(FSI_HDF5_FOR_MPI ${FSI_MPI} CACHE INTERNAL "Which HDF5 was looked for")

if(NOT HDF5_DIR AND NOT HDF5_ROOT AND NOT DEFINED ENV{HDF5_ROOT})
  if(NOT FSI_MPI)
    set(_build hdf5-serial)
  elseif("${MPI_C_LIBRARIES}" MATCHES "mpich")
    set(_build hdf5-mpich)
  else()
    set(_build hdf5-openmpi)
  endif()
  pkg_check_modules(FSI_DEBIAN_HDF5 QUIET ${_build})
endif()
if(FSI_DEBIAN_HDF5_FOUND)
  set(HDF5_C_INCLUDE_DIRS ${FSI_DEBIAN_HDF5_INCLUDE_DIRS})
  set(HDF5_C_DEFINITIONS "")
  set(HDF5_C_LIBRARIES ${FSI_DEBIAN_HDF5_LINK_LIBRARIES})
  message(STATUS "HDF5 ${FSI_DEBIAN_HDF5_VERSION}: ${_build}")
else()
  set(HDF5_PREFER_PARALLEL ${FSI_MPI})  # one file written by all processes
  find_package(HDF5 REQUIRED COMPONENTS C)
  if(FSI_MPI AND NOT HDF5_IS_PARALLEL)
    message(FATAL_ERROR "FSI_MPI needs the parallel HDF5 (Debian: libhdf5-openmpi-dev); or give -DFSI_MPI=OFF")
  endif()
endif()

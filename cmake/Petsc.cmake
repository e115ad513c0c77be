# PETSc, as the target PkgConfig::PETSC. Its headers refuse an MPI of another version than PETSc was compiled with, and
# distributions that change MPI ship such pairs for a while: told here, not after minutes of compiling.
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
# The flags PETSc's package was itself built with are none of its users': gcc refuses precompiled headers beside them.
set_property(TARGET PkgConfig::PETSC PROPERTY INTERFACE_COMPILE_OPTIONS)

if(NOT FSI_PETSC_COMPILES)  # a failure is no cached answer: packages change
  unset(FSI_PETSC_COMPILES CACHE)
  set(_source ${PROJECT_BINARY_DIR}/CMakeFiles/petsc_headers.c)
  file(WRITE ${_source} "#include <petscsys.h>\nint main(void) { return 0; }\n")
  set(_kind "${CMAKE_TRY_COMPILE_TARGET_TYPE}")
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # headers only, no linking
  try_compile(FSI_PETSC_COMPILES ${PROJECT_BINARY_DIR}/CMakeFiles/petsc_headers SOURCES ${_source}
    LINK_LIBRARIES PkgConfig::PETSC MPI::MPI_C OUTPUT_VARIABLE _output)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE "${_kind}")
  if(NOT FSI_PETSC_COMPILES)
    string(REGEX MATCH "error:? [^\n]*" _reason "${_output}")
    message(FATAL_ERROR "PETSc ${PETSC_VERSION} does not compile with the MPI found, ${MPI_C_LIBRARIES}: ${_reason}\n"
      "Install a PETSc and an MPI that belong together, or build for one process: -DFSI_MPI=OFF, or the option --serial of "
      "scripts/quickstart.sh and scripts/test.sh.")
  endif()
endif()

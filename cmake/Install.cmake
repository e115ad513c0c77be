# What `cmake --install` puts where. Below the prefix everything finds everything else by relative paths, so that the
# tree can be moved.
#   bin/                   the programs
#   lib/fsi-duo/LEVEL/     with FSI_PACKAGE_LEVELS: the drivers for each x86-64 level, which those in bin/ start
#   share/fsi-duo/         fsi-compare's Python, a study to copy, ready cases, the gallery, an example for Slurm
#   lib/python3/dist-packages/   fsi-duo.pth, which puts that Python on the path of Debian's
#   share/doc/fsi-duo/     README, docs, licence
#   include/fsi-duo/       headers, in the folders of the sources
#   lib/                   libraries, and lib/cmake/fsi-duo for find_package(fsi-duo)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(_headers ${CMAKE_INSTALL_INCLUDEDIR}/fsi-duo)
set(_libraries ${CMAKE_INSTALL_LIBDIR})
set(_config ${CMAKE_INSTALL_LIBDIR}/cmake/fsi-duo)
set(_data ${CMAKE_INSTALL_DATADIR}/fsi-duo)
set(_documents ${CMAKE_INSTALL_DATADIR}/doc/fsi-duo)

# Programs. fsi-mesh spends no time in element loops and looks for fsi-compare beside itself: one build of it will do.
install(TARGETS fsi-mesh RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
set(_drivers fsi-monolithic fsi-partitioned)
if(FSI_PACKAGE_LEVELS)
  include(cmake/Levels.cmake)
else()
  install(TARGETS ${_drivers} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
endif()

# fsi-compare: compare/ and meshes/ lie beside each other as in the sources, where it looks for cases and studies. The
# studies of this project, compare/research, stay in the source tree.
set(FSI_COMPARE_FOLDERS ".")
set(FSI_COMPARE_START fsi_compare.start)
file(RELATIVE_PATH FSI_COMPARE_PACKAGE_DIR
  ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/fsi-duo/compare)
foreach(_program fsi-compare fsi-python)
  configure_file(compare/${_program}.in ${PROJECT_BINARY_DIR}/installed/${_program} @ONLY)
  install(PROGRAMS ${PROJECT_BINARY_DIR}/installed/${_program} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
endforeach()
# `import fsi_compare` without fsi-python: below /usr, Debian's Python reads this file by itself.
set(_python lib/python3/dist-packages)
file(RELATIVE_PATH _package ${CMAKE_INSTALL_PREFIX}/${_python} ${CMAKE_INSTALL_FULL_DATADIR}/fsi-duo/compare)
file(WRITE ${PROJECT_BINARY_DIR}/installed/fsi-duo.pth "${_package}\n")
install(FILES ${PROJECT_BINARY_DIR}/installed/fsi-duo.pth DESTINATION ${_python} COMPONENT programs)
install(DIRECTORY compare/fsi_compare compare/studies DESTINATION ${_data}/compare COMPONENT programs
  PATTERN __pycache__ EXCLUDE)
install(DIRECTORY meshes/artery DESTINATION ${_data}/meshes COMPONENT programs FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY gallery DESTINATION ${_data} COMPONENT programs
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.py" PATTERN "*.geo" PATTERN "*.csv" PATTERN __pycache__ EXCLUDE)
install(FILES scripts/slurm/fsi-duo.sbatch DESTINATION ${_data}/slurm COMPONENT programs)
install(DIRECTORY docs DESTINATION ${_documents} COMPONENT programs PATTERN "*.in" EXCLUDE)
install(FILES README.md DESTINATION ${_documents} COMPONENT programs)
install(FILES CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION ${_documents} COMPONENT programs OPTIONAL)
install(FILES LICENSE DESTINATION ${_documents} RENAME copyright COMPONENT programs)

# Headers and libraries. The libraries are found in the folders, so that a new one needs no entry here.
install(DIRECTORY common/ DESTINATION ${_headers} COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY monolithic partitioned DESTINATION ${_headers} COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_BINARY_DIR}/common/base/base/version.hpp DESTINATION ${_headers}/base COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/common/fem/fem/compiled_elements.hpp DESTINATION ${_headers}/fem COMPONENT development)

function(fsi_libraries_below folder result)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  set(found "")
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "_LIBRARY$")
      list(APPEND found ${target})
    endif()
  endforeach()
  foreach(subfolder IN LISTS subfolders)
    fsi_libraries_below(${subfolder} below)
    list(APPEND found ${below})
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

set(_targets fsi_flags)
foreach(_folder common monolithic partitioned)
  fsi_libraries_below(${PROJECT_SOURCE_DIR}/${_folder} _below)
  list(APPEND _targets ${_below})
endforeach()
foreach(_target IN LISTS _targets)  # fsi_mesh_lib here is fsi-duo::mesh to others
  string(REGEX REPLACE "^fsi_|_lib$" "" _name ${_target})
  set_target_properties(${_target} PROPERTIES EXPORT_NAME ${_name})
endforeach()
install(TARGETS ${_targets} EXPORT fsi-duo-targets ARCHIVE DESTINATION ${_libraries} COMPONENT development)
install(EXPORT fsi-duo-targets NAMESPACE fsi-duo:: DESTINATION ${_config} COMPONENT development)
configure_package_config_file(cmake/fsi-duo-config.cmake.in ${PROJECT_BINARY_DIR}/installed/fsi-duo-config.cmake
  INSTALL_DESTINATION ${_config})
# The interfaces may change with each version until 1.0.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/installed/fsi-duo-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/installed/fsi-duo-config.cmake
  ${PROJECT_BINARY_DIR}/installed/fsi-duo-config-version.cmake
  DESTINATION ${_config} COMPONENT development)

# With CMAKE_UNITY_BUILD (all presets but `debug` and `tsan`), sources of a target are compiled several behind each other as
# one text, so that headers are read and templates are made once: half of the time. Where that cannot be, the target or the
# source says so beside its list of sources. The check clang_tidy compiles each source alone.
if(CMAKE_UNITY_BUILD)
  foreach(_target IN LISTS _targets)  # the libraries, found by cmake/Install.cmake
    get_target_property(_type ${_target} TYPE)
    if(NOT _type STREQUAL "INTERFACE_LIBRARY")
      set_property(TARGET ${_target} PROPERTY UNITY_BUILD_CODE_AFTER_INCLUDE "#undef FSI_INSTANTIATE")
    endif()
  endforeach()
endif()

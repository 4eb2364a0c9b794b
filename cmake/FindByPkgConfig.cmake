# omma_find_by_pkg_config(NAME TARGET modules...): what a Find module has to do for a library that Debian ships with
# pkg-config files only.
macro(omma_find_by_pkg_config name target)
  find_package(PkgConfig REQUIRED QUIET)
  pkg_check_modules(${name} REQUIRED QUIET IMPORTED_TARGET GLOBAL ${ARGN})
  if(NOT TARGET ${target})
    add_library(${target} ALIAS PkgConfig::${name})
  endif()
  set(${name}_FOUND ON)
endmacro()

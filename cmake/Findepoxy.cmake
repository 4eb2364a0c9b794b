# libepoxy ships only a pkg-config file.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(epoxy REQUIRED QUIET IMPORTED_TARGET GLOBAL epoxy)
if(NOT TARGET epoxy::epoxy)
  add_library(epoxy::epoxy ALIAS PkgConfig::epoxy)
endif()
set(epoxy_FOUND ON)

# Debian's libspng ships only a pkg-config file.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(spng REQUIRED QUIET IMPORTED_TARGET GLOBAL spng)
if(NOT TARGET spng::spng)
  add_library(spng::spng ALIAS PkgConfig::spng)
endif()
set(spng_FOUND ON)

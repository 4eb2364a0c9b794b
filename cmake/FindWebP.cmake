# Debian's libwebp ships only pkg-config files.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(WebP REQUIRED QUIET IMPORTED_TARGET GLOBAL libwebp libwebpdemux)
if(NOT TARGET WebP::webp)
  add_library(WebP::webp ALIAS PkgConfig::WebP)
endif()
set(WebP_FOUND ON)

# OpenImageIO's own package insists on the programs of openimageio-tools, and they on Qt; its pkg-config file does not.
find_package(PkgConfig REQUIRED QUIET)
pkg_check_modules(OpenImageIO QUIET IMPORTED_TARGET GLOBAL OpenImageIO)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO ALIAS PkgConfig::OpenImageIO)
endif()

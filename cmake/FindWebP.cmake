include(${CMAKE_CURRENT_LIST_DIR}/FindByPkgConfig.cmake)
omma_find_by_pkg_config(WebP WebP::webp libwebp libwebpdemux)

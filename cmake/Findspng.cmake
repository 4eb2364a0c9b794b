include(${CMAKE_CURRENT_LIST_DIR}/FindByPkgConfig.cmake)
omma_find_by_pkg_config(spng spng::spng spng)

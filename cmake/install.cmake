# The program, and what other projects use: find_package(lfdsim), target lfdsim::lfdsim. (The model reader: content/content.cmake.)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(lfdsim_umbrella INTERFACE)
add_library(lfdsim::lfdsim ALIAS lfdsim_umbrella)
set_target_properties(lfdsim_umbrella PROPERTIES EXPORT_NAME lfdsim)
target_sources(lfdsim_umbrella INTERFACE FILE_SET HEADERS BASE_DIRS src FILES src/lfdsim/lfdsim.h)
set(libraries lfdsim_model lfdsim_image lfdsim_engine lfdsim_content lfdsim_inverse lfdsim_files lfdsim_analysis)
target_link_libraries(lfdsim_umbrella INTERFACE ${libraries})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/lfdsim)
install(TARGETS lfdsim_umbrella EXPORT lfdsimTargets FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS ${libraries} EXPORT lfdsimTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lfdsim)
install(EXPORT lfdsimTargets NAMESPACE lfdsim:: DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lfdsimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(${CMAKE_CURRENT_LIST_DIR}/lfdsimConfig.cmake.in ${PROJECT_BINARY_DIR}/lfdsimConfig.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lfdsimConfig.cmake ${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake
  ${PROJECT_BINARY_DIR}/lfdsimConfigVersion.cmake DESTINATION ${package})

install(TARGETS lfdsim RUNTIME)
install(DIRECTORY displays DESTINATION ${CMAKE_INSTALL_DATADIR}/lfdsim)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

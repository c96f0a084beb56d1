# The program lfdsim: one file per command.
file(GLOB cli_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
add_executable(lfdsim ${cli_sources})
target_link_libraries(lfdsim PRIVATE lfdsim_engine lfdsim_content lfdsim_files CLI11::CLI11 fmt::fmt spdlog::spdlog
  nlohmann_json::nlohmann_json TBB::tbb)
target_compile_definitions(lfdsim PRIVATE LFDSIM_VERSION="${PROJECT_VERSION}")
# `lfdsim doctor` names what the program was built with.
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/doctor.cpp PROPERTIES COMPILE_DEFINITIONS
  "LFDSIM_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}\";LFDSIM_BUILD_TYPE=\"${CMAKE_BUILD_TYPE}\";LFDSIM_EMBREE=\"${embree_VERSION}\";LFDSIM_ASSIMP=\"${assimp_VERSION}\";LFDSIM_OPENEXR=\"${OpenEXR_VERSION}\";LFDSIM_TOMLPLUSPLUS=\"${tomlplusplus_VERSION}\"")

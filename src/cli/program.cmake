# The program lfdsim: one file per command.
file(GLOB_RECURSE cli_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
add_executable(lfdsim ${cli_sources})
target_link_libraries(lfdsim PRIVATE lfdsim_view lfdsim_peers lfdsim_report lfdsim_meshed lfdsim_files CLI11::CLI11 fmt::fmt
  spdlog::spdlog nlohmann_json::nlohmann_json TBB::tbb)
target_compile_definitions(lfdsim PRIVATE LFDSIM_VERSION="${PROJECT_VERSION}")
# `lfdsim doctor` and `lfdsim bench` name what the program was built with, and how.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
get_directory_property(options_of_all COMPILE_OPTIONS)
list(JOIN options_of_all " " options_of_all)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${options_of_all}" flags)
set(build_facts "LFDSIM_COMPILER=\"${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}\"" "LFDSIM_FLAGS=\"${flags}\""
  "LFDSIM_BUILD_TYPE=\"${CMAKE_BUILD_TYPE}\"")
foreach(kernel scalar baseline avx2 avx512)
  string(TOUPPER ${kernel} name)
  set(of_kernel "")
  if(TARGET lfdsim_kernel_${kernel})
    set(of_kernel "$<JOIN:$<TARGET_PROPERTY:lfdsim_kernel_${kernel},COMPILE_OPTIONS>, >")
  endif()
  list(APPEND build_facts "LFDSIM_FLAGS_${name}=\"${of_kernel}\"")
endforeach()
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/program/machine.cpp PROPERTIES COMPILE_DEFINITIONS "${build_facts}")
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/commands/doctor.cpp PROPERTIES COMPILE_DEFINITIONS
  "LFDSIM_EMBREE=\"${embree_VERSION}\";LFDSIM_ASSIMP=\"${assimp_VERSION}\";LFDSIM_OPENEXR=\"${OpenEXR_VERSION}\";LFDSIM_TOMLPLUSPLUS=\"${tomlplusplus_VERSION}\"")

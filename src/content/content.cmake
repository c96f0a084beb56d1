# The reader of model files is a program of its own: see content/reader/main.cpp.
include(GNUInstallDirs)
add_executable(lfdsim-model-reader
  content/reader/main.cpp content/reader/import.cpp content/reader/axes.cpp content/reader/colours_3mf.cpp content/reader/fit_to_floats.cpp content/reader/limits/edited_text.cpp content/reader/limits/folder.cpp
  content/reader/gltf/gltf_draco.cpp content/reader/gltf/gltf_file.cpp content/reader/gltf/gltf_loader.cpp content/reader/gltf/gltf_materials.cpp content/reader/gltf/gltf_mesh.cpp
  content/reader/gltf/gltf_nodes.cpp content/reader/limits/limits.cpp content/reader/picture.cpp content/reader/ply/ply_file.cpp
  content/reader/ply/ply_loader.cpp content/reader/limits/refusal.cpp content/reader/repairs.cpp content/reader/smooth_normals.cpp
  content/reader/textures.cpp)
target_include_directories(lfdsim-model-reader PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(lfdsim-model-reader PRIVATE assimp::assimp draco::draco minizip lfdsim_image nlohmann_json::nlohmann_json)
install(TARGETS lfdsim-model-reader RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/lfdsim)

# Programs need it when they run: they wait for it to link, not to compile.
set_property(TARGET lfdsim_content PROPERTY INTERFACE_LINK_DEPENDS $<BUILD_INTERFACE:$<TARGET_FILE:lfdsim-model-reader>>)
set_source_files_properties(content/models/reader_path.cpp PROPERTIES COMPILE_DEFINITIONS
  "LFDSIM_INSTALLED_READER=\"${CMAKE_INSTALL_FULL_LIBEXECDIR}/lfdsim/lfdsim-model-reader\";LFDSIM_BUILT_READER=\"${CMAKE_BINARY_DIR}/lfdsim-model-reader\"")

# No errno and no traps from mathematics, so that loops over the lanes of a packet become SIMD.
target_compile_options(lfdsim_content PRIVATE -fno-math-errno -fno-trapping-math)

if(LFDSIM_BENCHMARKS)
  add_executable(lfdsim-embree-share ${PROJECT_SOURCE_DIR}/bench/embree_share.cpp)
  target_link_libraries(lfdsim-embree-share PRIVATE lfdsim_content lfdsim_files embree ${CMAKE_DL_LIBS})
endif()

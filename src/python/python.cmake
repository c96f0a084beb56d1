# The Python module lfdsim._core, and beside it in the build the package around it, so that PYTHONPATH=BUILD/python finds both.
option(LFDSIM_PYTHON "the Python module: Python 3.10 or newer with nanobind" OFF)
if(NOT LFDSIM_PYTHON)
  return()
endif()

# abi3, for all later versions, needs 3.12; without SABIModule nanobind would leave it out silently.
find_package(Python 3.10 REQUIRED COMPONENTS Interpreter Development.Module ${SKBUILD_SABI_COMPONENT})
set(LFDSIM_PYTHON_INTERPRETER ${Python_EXECUTABLE} CACHE INTERNAL "the Python that the module is for")
execute_process(COMMAND ${Python_EXECUTABLE} -m nanobind --cmake_dir OUTPUT_STRIP_TRAILING_WHITESPACE OUTPUT_VARIABLE nanobind
  COMMAND_ERROR_IS_FATAL ANY)
unset(nanobind_DIR CACHE)  # pip builds each time in another environment
find_package(nanobind CONFIG REQUIRED PATHS ${nanobind} NO_DEFAULT_PATH)

file(GLOB python_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
nanobind_add_module(_core NB_STATIC STABLE_ABI NOMINSIZE ${python_sources})
target_include_directories(_core PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_include_directories(_core SYSTEM PRIVATE ${NB_DIR}/include)  # whose warnings are not ours
target_link_libraries(_core PRIVATE lfdsim_report lfdsim_files nlohmann_json::nlohmann_json TBB::tbb fmt::fmt)
target_compile_definitions(_core PRIVATE LFDSIM_VERSION="${PROJECT_VERSION}")
set_target_properties(_core PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/lfdsim)
foreach(library nanobind-static nanobind-static-abi3)  # not ours
  if(TARGET ${library})
    set_target_properties(${library} PROPERTIES UNITY_BUILD OFF COMPILE_WARNING_AS_ERROR OFF)
    target_compile_options(${library} PRIVATE -w)
  endif()
endforeach()

nanobind_add_stub(_core_stub MODULE _core OUTPUT ${CMAKE_BINARY_DIR}/python/lfdsim/_core.pyi
  PYTHON_PATH ${CMAKE_BINARY_DIR}/python/lfdsim DEPENDS _core)

set(package ${PROJECT_SOURCE_DIR}/python/lfdsim)
file(GLOB package_files CONFIGURE_DEPENDS RELATIVE ${package} ${package}/*)
list(REMOVE_ITEM package_files __pycache__)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/python/lfdsim)
foreach(name ${package_files})
  file(CREATE_LINK ${package}/${name} ${CMAKE_BINARY_DIR}/python/lfdsim/${name} SYMBOLIC)
endforeach()

# `lfdsim study` goes on in the Python that the module is for. Of a wheel that is the one that pip installs it in.
if(NOT SKBUILD)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/src/cli/commands/study.cpp PROPERTIES COMPILE_DEFINITIONS
    "LFDSIM_PYTHON_INTERPRETER=\"${LFDSIM_PYTHON_INTERPRETER}\"")
endif()

# In a wheel the programs lie in bin/, beside the module.
if(SKBUILD)
  install(TARGETS _core LIBRARY DESTINATION lfdsim COMPONENT python)
  install(FILES ${CMAKE_BINARY_DIR}/python/lfdsim/_core.pyi DESTINATION lfdsim COMPONENT python)
  install(TARGETS lfdsim lfdsim-model-reader RUNTIME DESTINATION lfdsim/bin COMPONENT python)
endif()

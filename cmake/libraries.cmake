# A target's code may become part of a shared library, such as the Python module. Its names are not seen from outside of that, so that
# calls are as direct as in a program.
function(lfdsim_for_shared_libraries target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    CUDA_VISIBILITY_PRESET hidden)
endfunction()

# The static library lfdsim_NAME of the C++ files in ROOMS, folders of src (by default NAME and all in it). HEADERS are the
# public ones, which lfdsim/lfdsim.h includes and which are installed; LINK is handed to target_link_libraries.
# Usage: lfdsim_library(image HEADERS image/image.h LINK PUBLIC lfdsim_model PRIVATE PNG::PNG)
function(lfdsim_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;HEADERS;LINK")
  if(NOT arg_ROOMS)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  endif()
  foreach(room ${arg_ROOMS})
    file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cpp)
    list(APPEND sources ${files})
  endforeach()
  list(TRANSFORM arg_HEADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  add_library(lfdsim_${name} STATIC ${sources})
  add_library(lfdsim::${name} ALIAS lfdsim_${name})
  set_target_properties(lfdsim_${name} PROPERTIES EXPORT_NAME ${name})
  lfdsim_for_shared_libraries(lfdsim_${name})
  target_sources(lfdsim_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_CURRENT_SOURCE_DIR} FILES ${arg_HEADERS})
  target_compile_features(lfdsim_${name} PUBLIC cxx_std_20)
  if(arg_LINK)
    target_link_libraries(lfdsim_${name} ${arg_LINK})
  endif()
endfunction()

# Reads libraries' heavy headers once for all files of a target. With Clang alone: GCC 12 then warns of its own library, and in its
# build every file is seen to include what it uses. Usage: lfdsim_precompile(image_tests <gtest/gtest.h>)
function(lfdsim_precompile target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# Code that handles text and requests is quick enough when it is made small, and takes a third less time to compile; with sanitizers,
# without any optimisation, a third of the time. Usage: lfdsim_text(lfdsim_files)
function(lfdsim_text)
  set(level $<$<AND:$<CXX_COMPILER_ID:Clang>,$<NOT:$<CONFIG:Debug>>>:-Oz>)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set(level -O0)
  endif()
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE ${level})
  endforeach()
endfunction()

# With LFDSIM_QUICK_SANITIZERS, what no fuzzer looks into and what computes little: both sanitizers take twice as long to compile as the
# one for addresses.
function(lfdsim_only_addresses_if_quick)
  if(LFDSIM_QUICK_SANITIZERS)
    foreach(target ${ARGN})
      target_compile_options(${target} PRIVATE -fno-sanitize=undefined)
    endforeach()
  endif()
endfunction()

# What the fuzzers look into.
function(lfdsim_fuzzed)
  if(LFDSIM_FUZZ)
    foreach(target ${ARGN})
      target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endforeach()
  endif()
endfunction()

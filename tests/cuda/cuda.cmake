# Tests of the GPU's side on machines without one: what is linked with the stand-in takes it for CUDA's runtime.
add_test(NAME cuda_code COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/ptx.py "${CMAKE_CUDA_COMPILER}" ${PROJECT_SOURCE_DIR})
add_test(NAME cuda_code_full COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/ptx.py "${CMAKE_CUDA_COMPILER}" ${PROJECT_SOURCE_DIR} --full)
set_tests_properties(cuda_code cuda_code_full PROPERTIES SKIP_RETURN_CODE 77)
set_tests_properties(cuda_code_full PROPERTIES LABELS full)
if(NOT LFDSIM_CUDA_STATE MATCHES "^CUDA")
  return()
endif()

find_package(CUDAToolkit REQUIRED)
add_library(cuda_stand_in OBJECT ${CMAKE_CURRENT_LIST_DIR}/stand_in.cpp ${CMAKE_CURRENT_LIST_DIR}/stand_in_kernels.cpp)
target_include_directories(cuda_stand_in SYSTEM PRIVATE ${CUDAToolkit_INCLUDE_DIRS})
target_link_libraries(cuda_stand_in PRIVATE lfdsim_engine TBB::tbb)
foreach(program lfdsim engine_tests)
  add_executable(${program}-on-stand-in $<TARGET_OBJECTS:cuda_stand_in> $<TARGET_OBJECTS:${program}>)
  target_link_libraries(${program}-on-stand-in PRIVATE $<TARGET_PROPERTY:${program},LINK_LIBRARIES> lfdsim_host_items)
endforeach()

# What takes longest of OnGpu is in Wide.Filtered too, but for the queue.
add_test(NAME cuda_stand_in.engine COMMAND engine_tests-on-stand-in --gtest_filter=OnGpu.*:Devices.*-*.Filtered*:*.TargetErrors*)
add_test(NAME cuda_stand_in.engine_full COMMAND engine_tests-on-stand-in --gtest_filter=OnGpu.Filtered*:OnGpu.TargetErrors*)
add_test(NAME cuda_stand_in.program COMMAND ${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/stand_in.py $<TARGET_FILE:lfdsim-on-stand-in>)
set_tests_properties(cuda_stand_in.engine_full PROPERTIES LABELS full)

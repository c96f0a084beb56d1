# The engine: its floor with the CPU's kernels (kernels.cmake) and, where they are compiled, the GPU's (gpu.cmake).
lfdsim_library(engine ROOMS engine engine/devices engine/estimator engine/scene engine/views engine/wide
  HEADERS engine/estimator/summed_panel.h engine/render.h
  LINK PUBLIC lfdsim_model lfdsim_image PRIVATE TBB::tbb fmt::fmt)
set(here ${CMAKE_CURRENT_LIST_DIR})

foreach(kernel IN LISTS LFDSIM_KERNELS)
  string(TOUPPER ${kernel} upper)
  target_sources(lfdsim_engine PRIVATE $<TARGET_OBJECTS:lfdsim_kernel_${kernel}>)
  target_compile_definitions(lfdsim_engine PRIVATE LFDSIM_WITH_${upper})
endforeach()

if(TARGET lfdsim_cuda)
  target_sources(lfdsim_engine PRIVATE $<TARGET_OBJECTS:lfdsim_cuda>)
  find_package(CUDAToolkit REQUIRED)
  target_link_libraries(lfdsim_engine PRIVATE CUDA::cudart_static)
else()
  target_sources(lfdsim_engine PRIVATE ${here}/cuda/absent.cpp)
endif()

# The GPU's kernels, where a CUDA toolkit is found that can compile them. One binary then serves machines with a GPU and without: the
# runtime is linked statically, and it looks for the driver when it is first called.
option(LFDSIM_CUDA "GPU kernels, where there is a CUDA toolkit" ON)
option(LFDSIM_CUDA_FMAD "GPU: contract products and sums; faster, and not the CPU's bits" OFF)
option(LFDSIM_CUDA_QUICK "GPU: compiled in an eighth of the time, and slow: for tests on machines without a GPU" OFF)
set(LFDSIM_CUDA_STATE "none: switched off (LFDSIM_CUDA)")
if(LFDSIM_CUDA)
  if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
    # To distribute the program: -D CMAKE_CUDA_ARCHITECTURES="75-real;86-real;90". For newer GPUs the driver compiles the last one's
    # PTX when the program first runs; where this machine has no GPU, only PTX is built.
    set(CMAKE_CUDA_ARCHITECTURES 75-virtual)
    if(EXISTS /dev/nvidiactl)
      set(CMAKE_CUDA_ARCHITECTURES native)
    endif()
  endif()
  include(CheckLanguage)
  check_language(CUDA)
  set(LFDSIM_CUDA_STATE "none: no CUDA toolkit (nvcc)")
  if(CMAKE_CUDA_COMPILER)
    enable_language(CUDA)
    if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION)  # CMake 3.25 does not know that nvcc has it
      set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION -std=c++20)
    endif()
    set(LFDSIM_CUDA_STATE "CUDA ${CMAKE_CUDA_COMPILER_VERSION}")
    if(CMAKE_CUDA_COMPILER_VERSION VERSION_LESS 12.1)  # C++20, and kernels with arguments of more than 4 KB
      set(LFDSIM_CUDA_STATE "none: CUDA ${CMAKE_CUDA_COMPILER_VERSION} is too old, 12.1 is needed")
    endif()
  endif()
endif()
set(LFDSIM_CUDA_STATE "${LFDSIM_CUDA_STATE}" CACHE INTERNAL "which toolkit the GPU's kernels are compiled by")
message(STATUS "GPU kernels: ${LFDSIM_CUDA_STATE}")

if(LFDSIM_CUDA_STATE MATCHES "^CUDA")
  # The kernels of each sampler take up to a minute: the longest first.
  set(cuda_files points_sobol.cu points_random.cu queue.cu)
  list(TRANSFORM cuda_files PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/engine/cuda/ OUTPUT_VARIABLE cuda_sources)
  add_library(lfdsim_cuda OBJECT ${cuda_sources})
  lfdsim_for_shared_libraries(lfdsim_cuda)
  target_include_directories(lfdsim_cuda PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(lfdsim_cuda PRIVATE LFDSIM_ISA=cuda LFDSIM_PLAIN_LIGHT $<$<BOOL:${LFDSIM_CUDA_FMAD}>:LFDSIM_CUDA_FMAD>)
  set_target_properties(lfdsim_cuda PROPERTIES CUDA_RUNTIME_LIBRARY Static CUDA_STANDARD 20 CUDA_STANDARD_REQUIRED ON)
  target_compile_options(lfdsim_cuda PRIVATE
    --fmad=$<IF:$<BOOL:${LFDSIM_CUDA_FMAD}>,true,false> -Xcompiler=-ffp-contract=off --threads=0)
  if(LFDSIM_CUDA_QUICK AND CMAKE_CUDA_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    target_compile_options(lfdsim_cuda PRIVATE "SHELL:-Ofc min")
    target_compile_definitions(lfdsim_cuda PRIVATE LFDSIM_FEW_SPECIALISATIONS)
  endif()
endif()

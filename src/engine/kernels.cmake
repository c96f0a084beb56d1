set(LFDSIM_KERNELS scalar baseline avx2 avx512 CACHE STRING "instruction sets to build kernels for; scalar and baseline at least")
set(kernel_level -O3)
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(kernel_level -O1)
endif()
# Each takes the sanitizers a minute or more to compile, together twice as long as one of them. The kernels are the same source.
# AddressSanitizer's checks are calls: they run half as fast, and compile in less than half of the time.
if(LFDSIM_QUICK_SANITIZERS)
  set(LFDSIM_KERNELS scalar baseline)
  set(scalar_quick -fno-sanitize=undefined "SHELL:-mllvm -asan-instrumentation-with-call-threshold=0" -DLFDSIM_FEW_SPECIALISATIONS)
  set(baseline_quick -fno-sanitize=address -DLFDSIM_FEW_SPECIALISATIONS)
endif()
# One object for each kernel: the same source for each instruction set. No errno and no traps in mathematics; contraction is off
# everywhere.
function(lfdsim_kernel name isa lanes)
  if(NOT name IN_LIST LFDSIM_KERNELS)
    return()
  endif()
  add_library(lfdsim_kernel_${name} OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/engine/kernels/${name}.cpp)
  set_target_properties(lfdsim_kernel_${name} PROPERTIES UNITY_BUILD OFF)
  lfdsim_for_shared_libraries(lfdsim_kernel_${name})
  target_include_directories(lfdsim_kernel_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(lfdsim_kernel_${name} PRIVATE LFDSIM_ISA=${name} LFDSIM_LANES=${lanes} LFDSIM_KERNEL=render_tile_${name})
  # GCC 12 takes the undefined vectors of its own AVX-512 headers for a mistake. Where it makes vectors of its own it contracts sums and
  # differences of products though contraction is off; lanes are vectors anyway.
  target_compile_options(lfdsim_kernel_${name} PRIVATE ${kernel_level} ${${name}_quick} -fno-math-errno -fno-trapping-math ${isa}
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-uninitialized;-fno-tree-vectorize>")
endfunction()

lfdsim_kernel(scalar "" 1)
lfdsim_kernel(baseline "" 4)
lfdsim_kernel(avx2 "-mavx2;-mbmi2" 8)
lfdsim_kernel(avx512 "-mavx2;-mbmi2;-mavx512f;-mavx512dq;-mavx512bw;-mavx512vl;-mprefer-vector-width=512" 16)

# The rules of the numbers (same bits from g++ and clang, -O0 and -O3, SSE2 and AVX-512) and the warnings.
# peperite_fp is public: whoever includes our headers computes by the same rules.
add_library(peperite_fp INTERFACE)
add_library(Peperite::fp ALIAS peperite_fp)
set_target_properties(peperite_fp PROPERTIES EXPORT_NAME fp)
target_compile_options(peperite_fp INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math
  -Wno-psabi  # vectors never cross a translation unit, so how they are passed does not matter
  # g++ 12 makes fused multiply-adds (vfmaddsub) of alternating sums of products whatever -ffp-contract says; where, depends
  # on the machine. The test `fused` looks for any.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
# Laws of a project downstream are compiled into passes of its own, whose vectors are those of the library.
if(PEPERITE_ARCH)
  target_compile_options(peperite_fp INTERFACE $<INSTALL_INTERFACE:-march=${PEPERITE_ARCH}>)
endif()
target_compile_definitions(peperite_fp INTERFACE EIGEN_DONT_VECTORIZE OMPI_SKIP_MPICXX)
target_compile_features(peperite_fp INTERFACE cxx_std_20)

add_library(peperite_build INTERFACE)
target_link_libraries(peperite_build INTERFACE peperite_fp)
target_compile_options(peperite_build INTERFACE
  -fno-semantic-interposition  # functions that a shared object exports are inlined in it as in a program
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow -Werror
  # g++ 12 finds its own AVX-512 headers and fmt's at fault; clang keeps these warnings.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized;-Wno-stringop-overflow>)
if(PEPERITE_ARCH)
  target_compile_options(peperite_build INTERFACE -march=${PEPERITE_ARCH})
endif()

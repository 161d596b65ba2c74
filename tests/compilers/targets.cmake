# Same bits from every compiler (compare.py), and the start-up check that refuses a build that breaks the rules.
add_executable(fingerprints compilers/fingerprints.cpp)
target_link_libraries(fingerprints PRIVATE sph peperite_build)
target_link_options(fingerprints PRIVATE LINKER:-Map=$<TARGET_FILE:fingerprints>.map)
add_test(NAME compilers
  COMMAND ${PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/compilers/compare.py --native $<TARGET_FILE:fingerprints>
          --work ${CMAKE_CURRENT_BINARY_DIR}/compilers "--mpiexec=${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG}")
set_tests_properties(compilers PROPERTIES
  ENVIRONMENT "${PEPERITE_MPI_ENVIRONMENT}" TIMEOUT 900 PROCESSORS 2)

add_executable(contraction compilers/test_contraction.cpp ${PROJECT_SOURCE_DIR}/libsph/src/run/self_check.cpp)
target_include_directories(contraction PRIVATE ${PROJECT_SOURCE_DIR}/libsph/src)
target_link_libraries(contraction PRIVATE sph peperite_build)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")  # others always have fused multiply-adds
  set(with_fma -mfma)
endif()
set_source_files_properties(${PROJECT_SOURCE_DIR}/libsph/src/run/self_check.cpp PROPERTIES
  COMPILE_OPTIONS "-O2;${with_fma};-ffp-contract=fast")  # of this folder's target only; comes after the target's own
add_test(NAME self_check.contraction COMMAND contraction)
add_test(NAME fused COMMAND ${PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/compilers/fused.py ${CMAKE_OBJDUMP}
  $<TARGET_FILE:sph> $<TARGET_FILE:decomp> $<TARGET_FILE:stokes>)

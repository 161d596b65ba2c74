# The programs of the tests over poisoned memory (decomp/poison.hpp), in bin/poisoned: the same objects and
# libraries, linked once more with a decomp::poisons() of their own, which comes before the library's.
add_library(poison OBJECT ${PROJECT_SOURCE_DIR}/libdecomp/src/poison.cpp)
target_compile_definitions(poison PRIVATE PEPERITE_POISON)
target_include_directories(poison PRIVATE ${PROJECT_SOURCE_DIR}/libdecomp/include)
target_link_libraries(poison PRIVATE peperite_build)

foreach(program test_decomp test_sph fuzz_ranks peperite)
  add_executable(poisoned_${program} $<TARGET_OBJECTS:${program}> $<TARGET_OBJECTS:poison>)
  target_link_libraries(poisoned_${program} PRIVATE $<TARGET_PROPERTY:${program},LINK_LIBRARIES>)
  set_target_properties(poisoned_${program} PROPERTIES
    OUTPUT_NAME ${program} RUNTIME_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/poisoned)
endforeach()

add_mpi_test(poisoned.decomp poisoned_test_decomp RANKS 3 ARGS --gtest_filter=-Balance.*)
add_mpi_test(poisoned.sph poisoned_test_sph RANKS 1 3 ARGS --gtest_filter=Poison.*:ListReach.*:GrainSkins.*:WideDomains.*)

# The kept cases, and random scenes that are always the same.
set(bit_fuzz ${PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/bit_fuzz.py
  --programs $<TARGET_FILE_DIR:poisoned_fuzz_ranks> --mpirun ${MPIEXEC_EXECUTABLE} --no-shrink)
add_test(NAME poisoned.kept COMMAND ${bit_fuzz} --replay ${kept})
add_test(NAME poisoned.scenes COMMAND ${bit_fuzz} --seed 19 --cases 20)
set_tests_properties(poisoned.kept poisoned.scenes PROPERTIES TIMEOUT 300 PROCESSORS 4)

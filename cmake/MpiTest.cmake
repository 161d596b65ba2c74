# add_mpi_test(<name> <target> RANKS 1 2 4 [TIMEOUT s] [COST s] [LABELS ...] [ARGS ...]): one ctest per rank count, name.npN.
# COST, in seconds, is given to those that take a minute or more: where no times are kept yet, they begin first.
# The environment lets root run more ranks than cores without binding two jobs to the same core.
set(PEPERITE_MPI_ENVIRONMENT
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
  HWLOC_COMPONENTS=-opencl)

function(add_mpi_test name target)
  cmake_parse_arguments(arg "" "TIMEOUT;COST;LABELS" "RANKS;ARGS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  if(CMAKE_CROSSCOMPILING_EMULATOR)
    math(EXPR arg_TIMEOUT "60 * ${arg_TIMEOUT}")
  endif()
  if(NOT arg_COST)
    set(arg_COST 0)
  endif()
  foreach(np IN LISTS arg_RANKS)
    add_test(NAME ${name}.np${np}
      COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${np} ${CMAKE_CROSSCOMPILING_EMULATOR}
              $<TARGET_FILE:${target}> ${arg_ARGS})
    set_tests_properties(${name}.np${np} PROPERTIES
      ENVIRONMENT "${PEPERITE_MPI_ENVIRONMENT}" TIMEOUT ${arg_TIMEOUT} COST ${arg_COST} PROCESSORS ${np}
      LABELS "${arg_LABELS}")
  endforeach()
endfunction()

// gtest under MPI: every rank runs every test; a rank speaks only when a test fails, and the exit status
// is the worst of all ranks.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (argc > 1) {  // what the library does not know; its help it has printed already
    const bool help = std::strcmp(argv[1], "--help") == 0;
    if (rank == 0 && !help)
      std::fprintf(stderr, "%s: error: unknown argument %s (see --help)\n", argv[0], argv[1]);
    MPI_Finalize();
    return help ? 0 : 2;
  }
  auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) delete listeners.Release(listeners.default_result_printer());
  int failed = RUN_ALL_TESTS();
  int worst = 0;
  MPI_Allreduce(&failed, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (failed != 0 && rank != 0) std::fprintf(stderr, "tests failed on rank %d\n", rank);
  MPI_Finalize();
  return worst;
}

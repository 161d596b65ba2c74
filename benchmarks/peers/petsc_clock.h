/* Put before PETSc's ex42.c and ex43.c by the compiler (-include): times of their assembly, of the solver's set-up and of
   the solution, in one line. A geometric multigrid for the velocities of ex42 gets the grid that the example keeps from
   it (PEER_GIVES_GRID). */
#include <petscdmda.h>
#include <petscksp.h>

static double clock_assembly, clock_solver;

/* The velocities' grid for the first block of a fieldsplit. */
static PetscErrorCode give_grid(KSP ksp, DM grid)
{
  PC pc;
  PetscBool split;
  KSP *blocks;
  PetscInt count, dim;
  DM velocities;

  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCFIELDSPLIT, &split));
  if (!split) PetscFunctionReturn(0);
  PetscCall(PCFieldSplitGetSubKSP(pc, &count, &blocks));
  PetscCall(DMGetDimension(grid, &dim));
  PetscCall(DMDACreateCompatibleDMDA(grid, dim, &velocities));
  PetscCall(KSPSetDM(blocks[0], velocities));
  PetscCall(KSPSetDMActive(blocks[0], PETSC_FALSE));
  PetscCall(DMDestroy(&velocities));
  PetscCall(PetscFree(blocks));
  PetscFunctionReturn(0);
}

/* Of nodes, as if all had the volume of a cell. */
static PetscErrorCode rms_speed(Vec x, double *speed)
{
  PetscInt values, fields, axis;
  PetscReal norm, square = 0;

  PetscFunctionBeginUser;
  PetscCall(VecGetSize(x, &values));
  PetscCall(VecGetBlockSize(x, &fields));
  for (axis = 0; axis + 1 < fields; ++axis) {
    PetscCall(VecStrideNorm(x, axis, NORM_2, &norm));
    square += norm * norm;
  }
  *speed = PetscSqrtReal(square * fields / values);
  PetscFunctionReturn(0);
}

static PetscErrorCode timed_solve(KSP ksp, Vec f, Vec x, DM grid)
{
  double ready, end, speed;
  PetscInt iterations;
  PetscReal left, whole;
  KSPConvergedReason why;

  PetscFunctionBeginUser;
  PetscCall(KSPSetUp(ksp));
  if (grid) PetscCall(give_grid(ksp, grid));
  PetscCall(KSPSetUpOnBlocks(ksp));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  ready = MPI_Wtime();
  PetscCall(KSPSolve(ksp, f, x));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  end = MPI_Wtime();
  PetscCall(KSPGetIterationNumber(ksp, &iterations));
  PetscCall(KSPGetResidualNorm(ksp, &left));
  PetscCall(KSPGetConvergedReason(ksp, &why));
  PetscCall(VecNorm(f, NORM_2, &whole));
  PetscCall(rms_speed(x, &speed));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                        "assembly %.6f s, set-up %.6f s, solve %.6f s, %d iterations to %.3g%s, rms speed %.6g\n",
                        clock_solver - clock_assembly, ready - clock_solver, end - ready, (int)iterations,
                        (double)(left / whole), why > 0 ? "" : " (not converged)", speed));
  PetscFunctionReturn(0);
}

#define DMCreateMatrix(grid, matrix) \
  (clock_assembly = clock_assembly > 0 ? clock_assembly : MPI_Wtime(), DMCreateMatrix(grid, matrix))
#define KSPCreate(comm, ksp) (MPI_Barrier(PETSC_COMM_WORLD), clock_solver = MPI_Wtime(), KSPCreate(comm, ksp))
#ifdef PEER_GIVES_GRID
#define KSPSolve(ksp, f, x) timed_solve(ksp, f, x, da_Stokes)
#else
#define KSPSolve(ksp, f, x) timed_solve(ksp, f, x, NULL)
#endif

/* Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * What each rank works in each phase of a run, apart from waiting for others.
 *
 *     mpicc -O2 -shared -fPIC mpi_waits.c -o mpi_waits.so -ldl
 *     MPI_WAITS=place LD_PRELOAD=./mpi_waits.so mpirun -np 2 isochor ...
 *
 * writes place.<rank>: a line for each section of the table that ends a run, with the
 * processor time of the rank in seconds, outside of MPI and inside of it, then the name.
 * A section has what isn't in the sections within it. Ranks that wait inside of MPI
 * keep their processor, so that neither their elapsed nor their processor time tells what
 * they do; the time outside of MPI does, on a machine with other work to do, too. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum
{
  most_sections = 64
};
static char   names[most_sections][64] = {"outside of all"};
static double work[most_sections], inside[most_sections];
static int    n_sections = 1, stack[most_sections], top = 0;
static double last = 0, inside_since_last = 0, entered = 0;
static int    depth = 0;

static double
processor_time(void)
{
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

/* Give the section at hand what has passed. */
static void
account(void)
{
  const double now = processor_time();
  work[stack[top]] += now - last - inside_since_last;
  inside[stack[top]] += inside_since_last;
  inside_since_last = 0;
  last              = now;
}

static int
section(const char *name)
{
  int i = 0;
  while (i < n_sections && strcmp(names[i], name) != 0)
    ++i;
  if (i == n_sections && n_sections < most_sections)
    strncpy(names[n_sections++], name, sizeof(names[0]) - 1);
  return i < most_sections ? i : 0;
}

/* dealii::TimerOutput::enter_subsection(const std::string &) and leave_subsection(): the
 * first member of a std::string points to its characters. */
void
_ZN6dealii11TimerOutput16enter_subsectionERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE(
  void *timer, const char **name)
{
  void (*original)(void *, const char **) = dlsym(RTLD_NEXT, __func__);
  account();
  if (top + 1 < most_sections)
    stack[++top] = section(*name);
  original(timer, name);
}

void
_ZN6dealii11TimerOutput16leave_subsectionERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE(
  void *timer, const char **name)
{
  void (*original)(void *, const char **) = dlsym(RTLD_NEXT, __func__);
  original(timer, name);
  account();
  if (top > 0)
    --top;
}

static void
report(void)
{
  const char *rank = getenv("OMPI_COMM_WORLD_RANK");
  if (rank == NULL)
    rank = getenv("PMI_RANK");
  char path[4096];
  snprintf(path, sizeof(path), "%s.%s", getenv("MPI_WAITS"), rank ? rank : "0");
  FILE *file = fopen(path, "w");
  if (file == NULL)
    return;
  account();
  for (int i = 0; i < n_sections; ++i)
    fprintf(file, "%.4f %.4f %s\n", work[i], inside[i], names[i]);
  fclose(file);
}

__attribute__((constructor)) static void
start(void)
{
  if (getenv("MPI_WAITS") != NULL)
    atexit(report);
}

#define WRAP(function, parameters, arguments)               \
  int MPI_##function parameters                             \
  {                                                         \
    if (depth++ == 0)                                       \
      entered = processor_time();                           \
    const int error = PMPI_##function arguments;            \
    if (--depth == 0)                                       \
      inside_since_last += processor_time() - entered;      \
    return error;                                           \
  }

/* clang-format off */
WRAP(Allreduce, (const void *sendbuf, void *recvbuf, int count, MPI_Datatype datatype, MPI_Op op, MPI_Comm comm), (sendbuf, recvbuf, count, datatype, op, comm))
WRAP(Allgather, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, void *recvbuf, int recvcount, MPI_Datatype recvtype, MPI_Comm comm), (sendbuf, sendcount, sendtype, recvbuf, recvcount, recvtype, comm))
WRAP(Allgatherv, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, void *recvbuf, const int recvcounts[], const int displs[], MPI_Datatype recvtype, MPI_Comm comm), (sendbuf, sendcount, sendtype, recvbuf, recvcounts, displs, recvtype, comm))
WRAP(Alltoall, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, void *recvbuf, int recvcount, MPI_Datatype recvtype, MPI_Comm comm), (sendbuf, sendcount, sendtype, recvbuf, recvcount, recvtype, comm))
WRAP(Alltoallv, (const void *sendbuf, const int sendcounts[], const int sdispls[], MPI_Datatype sendtype, void *recvbuf, const int recvcounts[], const int rdispls[], MPI_Datatype recvtype, MPI_Comm comm), (sendbuf, sendcounts, sdispls, sendtype, recvbuf, recvcounts, rdispls, recvtype, comm))
WRAP(Barrier, (MPI_Comm comm), (comm))
WRAP(Bcast, (void *buffer, int count, MPI_Datatype datatype, int root, MPI_Comm comm), (buffer, count, datatype, root, comm))
WRAP(Reduce, (const void *sendbuf, void *recvbuf, int count, MPI_Datatype datatype, MPI_Op op, int root, MPI_Comm comm), (sendbuf, recvbuf, count, datatype, op, root, comm))
WRAP(Reduce_scatter, (const void *sendbuf, void *recvbuf, const int recvcounts[], MPI_Datatype datatype, MPI_Op op, MPI_Comm comm), (sendbuf, recvbuf, recvcounts, datatype, op, comm))
WRAP(Scan, (const void *sendbuf, void *recvbuf, int count, MPI_Datatype datatype, MPI_Op op, MPI_Comm comm), (sendbuf, recvbuf, count, datatype, op, comm))
WRAP(Exscan, (const void *sendbuf, void *recvbuf, int count, MPI_Datatype datatype, MPI_Op op, MPI_Comm comm), (sendbuf, recvbuf, count, datatype, op, comm))
WRAP(Gather, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, void *recvbuf, int recvcount, MPI_Datatype recvtype, int root, MPI_Comm comm), (sendbuf, sendcount, sendtype, recvbuf, recvcount, recvtype, root, comm))
WRAP(Gatherv, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, void *recvbuf, const int recvcounts[], const int displs[], MPI_Datatype recvtype, int root, MPI_Comm comm), (sendbuf, sendcount, sendtype, recvbuf, recvcounts, displs, recvtype, root, comm))
WRAP(Scatter, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, void *recvbuf, int recvcount, MPI_Datatype recvtype, int root, MPI_Comm comm), (sendbuf, sendcount, sendtype, recvbuf, recvcount, recvtype, root, comm))
WRAP(Scatterv, (const void *sendbuf, const int sendcounts[], const int displs[], MPI_Datatype sendtype, void *recvbuf, int recvcount, MPI_Datatype recvtype, int root, MPI_Comm comm), (sendbuf, sendcounts, displs, sendtype, recvbuf, recvcount, recvtype, root, comm))
WRAP(Send, (const void *buf, int count, MPI_Datatype datatype, int dest, int tag, MPI_Comm comm), (buf, count, datatype, dest, tag, comm))
WRAP(Recv, (void *buf, int count, MPI_Datatype datatype, int source, int tag, MPI_Comm comm, MPI_Status *status), (buf, count, datatype, source, tag, comm, status))
WRAP(Isend, (const void *buf, int count, MPI_Datatype datatype, int dest, int tag, MPI_Comm comm, MPI_Request *request), (buf, count, datatype, dest, tag, comm, request))
WRAP(Irecv, (void *buf, int count, MPI_Datatype datatype, int source, int tag, MPI_Comm comm, MPI_Request *request), (buf, count, datatype, source, tag, comm, request))
WRAP(Rsend, (const void *ibuf, int count, MPI_Datatype datatype, int dest, int tag, MPI_Comm comm), (ibuf, count, datatype, dest, tag, comm))
WRAP(Ssend, (const void *buf, int count, MPI_Datatype datatype, int dest, int tag, MPI_Comm comm), (buf, count, datatype, dest, tag, comm))
WRAP(Sendrecv, (const void *sendbuf, int sendcount, MPI_Datatype sendtype, int dest, int sendtag, void *recvbuf, int recvcount, MPI_Datatype recvtype, int source, int recvtag, MPI_Comm comm, MPI_Status *status), (sendbuf, sendcount, sendtype, dest, sendtag, recvbuf, recvcount, recvtype, source, recvtag, comm, status))
WRAP(Wait, (MPI_Request *request, MPI_Status *status), (request, status))
WRAP(Waitall, (int count, MPI_Request array_of_requests[], MPI_Status *array_of_statuses), (count, array_of_requests, array_of_statuses))
WRAP(Waitany, (int count, MPI_Request array_of_requests[], int *index, MPI_Status *status), (count, array_of_requests, index, status))
WRAP(Waitsome, (int incount, MPI_Request array_of_requests[], int *outcount, int array_of_indices[], MPI_Status array_of_statuses[]), (incount, array_of_requests, outcount, array_of_indices, array_of_statuses))
WRAP(Test, (MPI_Request *request, int *flag, MPI_Status *status), (request, flag, status))
WRAP(Testall, (int count, MPI_Request array_of_requests[], int *flag, MPI_Status array_of_statuses[]), (count, array_of_requests, flag, array_of_statuses))
WRAP(Probe, (int source, int tag, MPI_Comm comm, MPI_Status *status), (source, tag, comm, status))
WRAP(Iprobe, (int source, int tag, MPI_Comm comm, int *flag, MPI_Status *status), (source, tag, comm, flag, status))
WRAP(Ibarrier, (MPI_Comm comm, MPI_Request *request), (comm, request))
WRAP(Comm_dup, (MPI_Comm comm, MPI_Comm *newcomm), (comm, newcomm))
WRAP(Comm_split, (MPI_Comm comm, int color, int key, MPI_Comm *newcomm), (comm, color, key, newcomm))
WRAP(Comm_free, (MPI_Comm *comm), (comm))

// Counts calls of MPI through its profiling interface: calls of a test program arrive here first. Include it in one file of a program.
#pragma once
#include <mpi.h>

namespace {

int graphs_made = 0, graphs_freed = 0, all_to_all_calls = 0, neighbour_calls = 0;

}  // namespace

extern "C" {

int MPI_Dist_graph_create_adjacent(MPI_Comm comm, int indegree, const int sources[], const int source_weights[],
                                   int outdegree, const int destinations[], const int destination_weights[],
                                   MPI_Info info, int reorder, MPI_Comm* graph) {
  ++graphs_made;
  return PMPI_Dist_graph_create_adjacent(comm, indegree, sources, source_weights, outdegree, destinations,
                                         destination_weights, info, reorder, graph);
}

int MPI_Comm_free(MPI_Comm* comm) {
  int topology = MPI_UNDEFINED;
  PMPI_Topo_test(*comm, &topology);
  graphs_freed += topology == MPI_DIST_GRAPH;
  return PMPI_Comm_free(comm);
}

int MPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                 MPI_Comm comm) {
  ++all_to_all_calls;
  return PMPI_Alltoall(out, out_count, out_type, in, in_count, in_type, comm);
}

int MPI_Alltoallv(const void* out, const int out_counts[], const int out_starts[], MPI_Datatype out_type, void* in,
                  const int in_counts[], const int in_starts[], MPI_Datatype in_type, MPI_Comm comm) {
  ++all_to_all_calls;
  return PMPI_Alltoallv(out, out_counts, out_starts, out_type, in, in_counts, in_starts, in_type, comm);
}

int MPI_Neighbor_alltoallv(const void* out, const int out_counts[], const int out_starts[], MPI_Datatype out_type,
                           void* in, const int in_counts[], const int in_starts[], MPI_Datatype in_type,
                           MPI_Comm comm) {
  ++neighbour_calls;
  return PMPI_Neighbor_alltoallv(out, out_counts, out_starts, out_type, in, in_counts, in_starts, in_type, comm);
}
}

namespace plastron::test {

/// The calls since the construction.
class Calls {
 public:
  int graphs() const { return graphs_made - graphs_made_; }
  int freed() const { return graphs_freed - graphs_freed_; }
  int all_to_all() const { return all_to_all_calls - all_to_all_calls_; }
  int neighbours() const { return neighbour_calls - neighbour_calls_; }

 private:
  int graphs_made_ = graphs_made, graphs_freed_ = graphs_freed, all_to_all_calls_ = all_to_all_calls,
      neighbour_calls_ = neighbour_calls;
};

}  // namespace plastron::test

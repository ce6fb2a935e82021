// A library to be loaded before the program: one rank dies at one of its calls of MPI, as if its machine had failed.
//
// SCREE_DYING_RANK says which; SCREE_DIES_AT the number of the call, counted from 1. Without it, the rank writes the number of
// all its calls to the file SCREE_CALLS when MPI ends.
#include <mpi.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace {

long calls = 0;

bool is_it() {
    static const bool chosen = [] {
        const char* wanted = std::getenv("SCREE_DYING_RANK");
        int rank = -1;
        PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
        return wanted && std::atoi(wanted) == rank;
    }();
    return chosen;
}

void count() {
    if (!is_it()) return;
    static const char* const when = std::getenv("SCREE_DIES_AT");
    ++calls;
    if (when && calls == std::atol(when)) std::raise(SIGKILL);
}

}  // namespace

extern "C" {

int MPI_Alltoall(const void* sent, int send_count, MPI_Datatype send_type, void* received, int receive_count,
                 MPI_Datatype receive_type, MPI_Comm all) {
    count();
    return PMPI_Alltoall(sent, send_count, send_type, received, receive_count, receive_type, all);
}

int MPI_Allreduce(const void* sent, void* received, int length, MPI_Datatype type, MPI_Op operation, MPI_Comm all) {
    count();
    return PMPI_Allreduce(sent, received, length, type, operation, all);
}

int MPI_Waitall(int length, MPI_Request* requests, MPI_Status* statuses) {
    count();
    return PMPI_Waitall(length, requests, statuses);
}

int MPI_Finalize() {
    if (const char* file = std::getenv("SCREE_CALLS"); file && is_it())
        if (std::FILE* out = std::fopen(file, "w")) {
            std::fprintf(out, "%ld\n", calls);
            std::fclose(out);
        }
    return PMPI_Finalize();
}

}  // extern "C"

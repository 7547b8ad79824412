// Multigrid for diffusion beside hypre's PFMG on the same box of n^3 whole cells, to 1e-8: time and
// cycles. Built where CMake finds hypre and MPI (libhypre-dev, libopenmpi-dev).
//   diffusion_against_pfmg nacre 128              three bands at once, on all cores
//   mpirun -n 2 diffusion_against_pfmg pfmg 128   one band; conjugate gradients with PFMG
#include <HYPRE.h>
#include <HYPRE_struct_ls.h>
#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "nacre/diffusion/solver.h"

namespace {

using namespace nacre;

// Marble's red in a cube of 20 mm behind a boundary of index 1.5: mm.
constexpr double D = 0.152, sigma_a = 0.0021, A = 3.95, side = 20.;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}
/// What a cell absorbs, and what leaves it through so many faces of the box.
double reaction(double h, int faces) {
    return sigma_a * h * h * h + faces * h * h / (2. * A + 0.5 * h / D);
}
int outer_faces(int n, int i, int j, int k) {
    int faces = 0;
    for (const int x : {i, j, k}) faces += (x == 0) + (x == n - 1);
    return faces;
}

void by_nacre(int n) {
    const double h = side / n, start = now();
    const auto half = [&](int i, int j, int k) {
        return (std::size_t(k) * std::size_t(n) + std::size_t(j)) * std::size_t(n) + std::size_t(i);
    };
    const std::size_t all = std::size_t(n) * std::size_t(n) * std::size_t(n);
    BandMatrix m;
    m.even = (all + 1) / 2;
    std::vector<CellPlace> places;
    std::vector<std::uint32_t> number(all);
    for (const int colour : {0, 1})
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    if (((i + j + k) & 1) != colour) continue;
                    number[half(i, j, k)] = std::uint32_t(places.size());
                    places.push_back({i, j, k});
                }
    m.first.push_back(0);
    for (const CellPlace& p : places) {
        for (std::size_t face = 0; face < 6; ++face) {
            CellPlace q = p;
            q[face / 2] += face % 2 ? 1 : -1;
            if (q[face / 2] < 0 || q[face / 2] >= n) continue;
            m.neighbour.push_back(number[half(q[0], q[1], q[2])]);
            m.weight.push_back(BandFloats(float(D * h)));
        }
        m.first.push_back(std::uint32_t(m.neighbour.size()));
        m.reaction.push_back(BandFloats(float(reaction(h, outer_faces(n, p[0], p[1], p[2])))));
    }
    const double built = now();
    Multigrid multigrid(std::move(m), std::move(places));
    const double ready = now();
    const std::vector<BandDoubles> b(all, BandDoubles(h * h * h));
    std::vector<BandDoubles> x;
    const SolveReport r = solve(multigrid, b, x);
    std::printf("nacre %d^3: %d cycles, factor %.3f, setup %.2f s, solve %.2f s (matrix %.2f s)\n",
                n, r.cycles, r.factor(), ready - built, now() - ready, built - start);
}

void by_pfmg(int n) {
    int rank = 0, ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const double h = side / n;
    HYPRE_Int low[] = {0, 0, n * rank / ranks}, high[] = {n - 1, n - 1, n * (rank + 1) / ranks - 1};
    HYPRE_StructGrid grid;
    HYPRE_StructGridCreate(MPI_COMM_WORLD, 3, &grid);
    HYPRE_StructGridSetExtents(grid, low, high);
    HYPRE_StructGridAssemble(grid);
    HYPRE_StructStencil stencil;
    HYPRE_StructStencilCreate(3, 4, &stencil);
    HYPRE_Int offsets[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int e = 0; e < 4; ++e) HYPRE_StructStencilSetElement(stencil, e, offsets[e]);
    HYPRE_StructMatrix a;
    HYPRE_StructMatrixCreate(MPI_COMM_WORLD, grid, stencil, &a);
    HYPRE_StructMatrixSetSymmetric(a, 1);
    HYPRE_StructMatrixInitialize(a);
    const std::size_t cells = std::size_t(n) * std::size_t(n) * std::size_t(high[2] - low[2] + 1);
    std::vector<double> values(4 * cells), right(cells, h * h * h), zero(cells, 0.);
    std::size_t at = 0;
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i, at += 4) {
                const int faces = outer_faces(n, i, j, k);
                values[at] = D * h * (6 - faces) + reaction(h, faces);
                values[at + 1] = i + 1 < n ? -D * h : 0.;
                values[at + 2] = j + 1 < n ? -D * h : 0.;
                values[at + 3] = k + 1 < n ? -D * h : 0.;
            }
    HYPRE_Int entries[] = {0, 1, 2, 3};
    HYPRE_StructMatrixSetBoxValues(a, low, high, 4, entries, values.data());
    HYPRE_StructMatrixAssemble(a);
    HYPRE_StructVector b, x;
    for (auto [v, from] : {std::pair{&b, &right}, {&x, &zero}}) {
        HYPRE_StructVectorCreate(MPI_COMM_WORLD, grid, v);
        HYPRE_StructVectorInitialize(*v);
        HYPRE_StructVectorSetBoxValues(*v, low, high, from->data());
        HYPRE_StructVectorAssemble(*v);
    }
    const double start = now();
    HYPRE_StructSolver solver, cycle;
    HYPRE_StructPCGCreate(MPI_COMM_WORLD, &solver);
    HYPRE_StructPCGSetTol(solver, 1e-8);
    HYPRE_StructPCGSetTwoNorm(solver, 1);
    HYPRE_StructPCGSetMaxIter(solver, 100);
    HYPRE_StructPFMGCreate(MPI_COMM_WORLD, &cycle);
    HYPRE_StructPFMGSetMaxIter(cycle, 1);
    HYPRE_StructPFMGSetTol(cycle, 0.);
    HYPRE_StructPFMGSetZeroGuess(cycle);
    HYPRE_StructPFMGSetRelaxType(cycle, 2);  // symmetric red-black Gauss-Seidel
    HYPRE_StructPFMGSetNumPreRelax(cycle, 1);
    HYPRE_StructPFMGSetNumPostRelax(cycle, 1);
    HYPRE_StructPFMGSetRAPType(cycle, 1);  // coarse matrices of the same seven points
    HYPRE_StructPCGSetPrecond(solver, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, cycle);
    HYPRE_StructPCGSetup(solver, a, b, x);
    MPI_Barrier(MPI_COMM_WORLD);
    const double ready = now();
    HYPRE_StructPCGSolve(solver, a, b, x);
    MPI_Barrier(MPI_COMM_WORLD);
    const double done = now();
    HYPRE_Int cycles = 0;
    double left = 0.;
    HYPRE_StructPCGGetNumIterations(solver, &cycles);
    HYPRE_StructPCGGetFinalRelativeResidualNorm(solver, &left);
    if (rank == 0)
        std::printf(
            "PFMG  %d^3, %d ranks: %d cycles to %.1e, setup %.2f s, solve %.2f s (one band)\n", n,
            ranks, int(cycles), left, ready - start, done - ready);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "diffusion_against_pfmg nacre|pfmg N\n");
        return 2;
    }
    const int n = std::atoi(argv[2]);
    if (std::string_view(argv[1]) == "nacre") {
        by_nacre(n);
        return 0;
    }
    MPI_Init(&argc, &argv);
    by_pfmg(n);
    MPI_Finalize();
}

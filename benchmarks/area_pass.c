/* Compiled once per instruction set, with BILLOW_AREA_PASS naming its table. */
#include "benchmarks/area_pass.h"
#include "elements/kernel_transpose.h"

enum { PACKS = BILLOW_LANES / PACK_WIDTH, SUM_PACKS = 8 / PACK_WIDTH };

typedef struct Corners {
    Pack x[3][3], force[3][3], share[1][3];
} Corners;

ALWAYS_INLINE double total(const Pack part[SUM_PACKS])
{
    double sum = 0.0;
    for (int i = 0; i < 8; i++) sum += part[i / PACK_WIDTH][i % PACK_WIDTH];
    return sum;
}

ALWAYS_INLINE void edges_as_forces(Corners *t)
{
    for (int k = 0; k < 3; k++) {
        t->force[1][k] = t->x[1][k] - t->x[0][k];
        t->force[2][k] = t->x[2][k] - t->x[0][k];
        t->force[0][k] = t->force[1][k] + t->force[2][k];
        t->share[0][k] = pack_of(0.0);
    }
}

/* Area vector share of a corner, (E8), volume and area. */
ALWAYS_INLINE void measure(const KernelInput *input, Pack sign, Corners *t, Pack *volume, Pack *area)
{
    Pack sixth = (1.0 / 6.0) * sign, *share = t->share[0], *u = t->force[1], *v = t->force[2], *x = t->x[0];
    share[0] = sixth * (u[1] * v[2] - u[2] * v[1]);
    share[1] = sixth * (u[2] * v[0] - u[0] * v[2]);
    share[2] = sixth * (u[0] * v[1] - u[1] * v[0]);
    const double *o = input->origin;
    *volume += (x[0] - o[0]) * share[0] + (x[1] - o[1]) * share[1] + (x[2] - o[2]) * share[2];
    *area += 3.0 * pack_root(share[0] * share[0] + share[1] * share[1] + share[2] * share[2]);
}

ALWAYS_INLINE void pass(int gas, const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    Pack volume[SUM_PACKS] = {{0}}, area[SUM_PACKS] = {{0}};
    for (int block = input->first_block; block < input->end_block; block++)
        for (int i = 0; i < PACKS; i++) {
            ptrdiff_t lane = (ptrdiff_t)i * PACK_WIDTH, first = (ptrdiff_t)block * BILLOW_LANES * 3 + lane;
            Corners t;
            for (int c = 0; c < 3; c++)
                gather_nodes(group->node + first + (ptrdiff_t)c * BILLOW_LANES, input->x, t.x[c]);
            edges_as_forces(&t);
            const double *tail =
                group->geometry + ((ptrdiff_t)block * group->geometry_size + GEOMETRY_POINT_SIZE) * BILLOW_LANES + lane;
            if (gas)
                measure(input, pack_load(tail + (ptrdiff_t)GEOMETRY_SIGN * BILLOW_LANES), &t, &volume[i % SUM_PACKS],
                        &area[i % SUM_PACKS]);
            add_rows(3, 1, group->row + first, BILLOW_LANES, t.force, t.share, input->rows);
        }
    sums->volume += total(volume);
    sums->area += total(area);
}

static void plain(const KernelInput *input, ChunkSums *sums)
{
    pass(0, input, sums);
}

static void with_gas(const KernelInput *input, ChunkSums *sums)
{
    pass(1, input, sums);
}

const AreaPass BILLOW_AREA_PASS = {plain, with_gas};

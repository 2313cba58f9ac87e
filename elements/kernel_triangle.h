/* The 3-node membrane: edges, metric, corner forces (docs/theory.md, Elements). Included by elements/kernels.c alone.
 */
#ifndef BILLOW_KERNEL_TRIANGLE_H
#define BILLOW_KERNEL_TRIANGLE_H

#include "elements/kernel_element.h"

/* Edges from the first corner (eq. E1). */
typedef struct TrianglePack {
    Pack e1[3], e2[3];
    Pack force[3][3], share[3]; /* of each corner; of all corners alike */
} TrianglePack;

/* C = F^T F with F = e M formed first: the metric of a sliver's edges would lose the square of its aspect in digits. */
ALWAYS_INLINE PackTensor triangle_metric(const double *point, const TrianglePack *t)
{
    Pack m11 = lane_values(point, GEOMETRY_M11), m12 = lane_values(point, GEOMETRY_M12),
         m21 = lane_values(point, GEOMETRY_M21), m22 = lane_values(point, GEOMETRY_M22), f1[3], f2[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        f1[k] = m11 * t->e1[k] + m21 * t->e2[k];
        f2[k] = m12 * t->e1[k] + m22 * t->e2[k];
    }
    PackTensor c = {dot(f1, f1), dot(f2, f2), dot(f1, f2)};
    return c;
}

/* Gathers the corners; edges, area vector share S/3 per corner (eq. E8), volume under the facet, area. */
ALWAYS_INLINE void triangle_area(const KernelInput *input, const ElementPlace *place, Pack sign, int i, TrianglePack *t,
                                 PackSums *sums)
{
    Pack x0[3], x1[3], x2[3];
    gather_nodes(place->node, input->x, x0);
    gather_nodes(place->node + LANES, input->x, x1);
    gather_nodes(place->node + 2 * LANES, input->x, x2);
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        t->e1[k] = x1[k] - x0[k];
        t->e2[k] = x2[k] - x0[k];
        x0[k] -= input->origin[k];
    }
    Pack sixth = (1.0 / 6.0) * sign, *share = t->share;
    share[0] = sixth * (t->e1[1] * t->e2[2] - t->e1[2] * t->e2[1]);
    share[1] = sixth * (t->e1[2] * t->e2[0] - t->e1[0] * t->e2[2]);
    share[2] = sixth * (t->e1[0] * t->e2[1] - t->e1[1] * t->e2[0]);
    sums->volume.part[i % SUM_PACKS] += dot(x0, share);
    sums->area.part[i % SUM_PACKS] += 3.0 * pack_root(dot(share, share));
}

/* Corner forces: f2 = -(p11 e1 + p12 e2), f3 = -(p12 e1 + p22 e2), f1 the rest (eq. E6). */
ALWAYS_INLINE void triangle_forces(const PackTensor *p, TrianglePack *t)
{
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack f2 = p->a11 * t->e1[k] + p->a12 * t->e2[k], f3 = p->a12 * t->e1[k] + p->a22 * t->e2[k];
        t->force[0][k] = f2 + f3;
        t->force[1][k] = -f2;
        t->force[2][k] = -f3;
    }
}

ALWAYS_INLINE void triangle_add(const KernelInput *input, const ElementPlace *place, TrianglePack *t)
{
    if (input->rows) add_rows(3, 1, place->row, LANES, t->force, &t->share, input->rows);
}

ALWAYS_INLINE void triangle_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const LawInput in = make_law_input(input);
    PackSums packs = {0};
    for (int block = input->first_block; block < input->end_block; block += BLOCKS_AT_ONCE) {
        TrianglePack t[STREAMS];
        PointPack p[STREAMS];
        PointPlace point[STREAMS];
        ElementPlace place[STREAMS];
        int streams = count_streams(input, block);
        for (int i = 0; i < streams; i++) {
            place[i] = find_place(input, block + i / PACKS, i % PACKS, 3, 1);
            point[i] = point_place(&place[i], 0);
            triangle_area(input, &place[i], lane_values(place[i].tail, GEOMETRY_SIGN), i, &t[i], &packs);
            p[i].c = triangle_metric(place[i].geometry, &t[i]);
        }
        stream_stress(mode, &in, streams, point, p);
        for (int i = 0; i < streams; i++) {
            triangle_forces(&p[i].p, &t[i]);
            triangle_add(input, &place[i], &t[i]);
            sum_point(input, block + i / PACKS, i % PACKS, &p[i], &packs);
        }
    }
    finish_sums(&packs, sums);
}

static void kernel_triangle(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) triangle_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input), WORK)
#undef WORK
}

#endif

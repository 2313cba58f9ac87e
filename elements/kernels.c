/* Element kernels for one instruction set: this file is compiled once per set, with BILLOW_KERNEL_TABLE naming its
 * table.
 *
 * A kernel walks over blocks of BILLOW_LANES elements, a pack of lanes at a time: gather the corners, metric, stress
 * (kernel_stages.h), corner sums. Equations: docs/theory.md, Elements. */
#include "elements/kernels.h"

#include "elements/kernel_quad.h"
#include "elements/kernel_triangle.h"

extern const KernelTable BILLOW_KERNEL_TABLE, BILLOW_FURTHER_TABLE;

/* ---- surfaces without stress ---- */

static void surface_triangle(const KernelInput *input, int block, int pack, PackSums *sums)
{
    ElementPlace place = find_place(input, block, pack, 3, 0);
    TrianglePack t;
    for (int k = 0; k < 9; k++) t.force[k / 3][k % 3] = pack_of(0.0);
    triangle_area(input, &place, pack_load(place.geometry), pack, &t, sums);
    triangle_add(input, &place, &t);
}

static void surface_quad(const KernelInput *input, int block, int pack, PackSums *sums)
{
    ElementPlace place = find_place(input, block, pack, 4, 0);
    QuadPack q;
    for (int k = 0; k < 12; k++) q.force[k / 3][k % 3] = pack_of(0.0);
    quad_gradients(input, &place, &q);
    quad_area(pack_load(place.geometry), pack, &q, sums);
    quad_add(input, &place, &q);
}

static void kernel_surface(const KernelInput *input, ChunkSums *sums)
{
    PackSums packs = {0};
    for (int block = input->first_block; block < input->end_block; block++) {
        for (int i = 0; i < PACKS; i++) {
            if (input->group->corner_count == 3)
                surface_triangle(input, block, i, &packs);
            else
                surface_quad(input, block, i, &packs);
        }
    }
    finish_sums(&packs, sums);
}

#ifdef BILLOW_FURTHER_LAWS
#define FURTHER NULL
#else
#define FURTHER &BILLOW_FURTHER_TABLE
#endif
const KernelTable BILLOW_KERNEL_TABLE = {BILLOW_KERNEL_LEVEL, kernel_surface,  kernel_triangle,
                                         kernel_quad_full,    kernel_quad_one, FURTHER};

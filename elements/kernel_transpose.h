/* Rows of memory to packs and back: node coordinates into lanes, lane values into corner records. Pure moves, so every
 * instruction set gives the same bits. */
#ifndef BILLOW_KERNEL_TRANSPOSE_H
#define BILLOW_KERNEL_TRANSPOSE_H

#include <stddef.h>

#include "elements/kernels.h"
#include "elements/pack.h"

/* Two and four doubles anywhere in memory. */
typedef double LooseTwo __attribute__((vector_size(16), aligned(8), may_alias));
typedef double LooseFour __attribute__((vector_size(32), aligned(8), may_alias));

/* gather_nodes: x, y, z of PACK_WIDTH nodes, three doubles each; a row's fourth double is loaded and dropped.
 * add_rows: adds a force f and an area vector s per lane to that lane's row of corner sums (ROW_SIZE doubles: f, one
 * unused, s, one unused), lane by lane, since lanes may share a row. */
#if BILLOW_KERNEL_LEVEL >= 4
/* Two rows side by side in one register. */
ALWAYS_INLINE Pack two_rows(const double *low, const double *high)
{
    return __builtin_shufflevector(*(const LooseFour *)low, *(const LooseFour *)high, 0, 1, 2, 3, 4, 5, 6, 7);
}

ALWAYS_INLINE void gather_nodes(const int32_t *restrict node, const double *restrict x, Pack out[3])
{
    const double *row[8];
#pragma GCC unroll 8
    for (int i = 0; i < 8; i++) row[i] = x + 3 * (ptrdiff_t)node[i];
    Pack a = two_rows(row[0], row[2]), b = two_rows(row[1], row[3]), c = two_rows(row[4], row[6]),
         d = two_rows(row[5], row[7]);
    Pack ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
         cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14),
         ab1 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15),
         cd1 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    out[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5, 8, 9, 12, 13);
    out[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5, 8, 9, 12, 13);
    out[2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7, 10, 11, 14, 15);
}

/* Lanes i and i + 4 of a vector side by side, x y z 0 x y z 0. */
ALWAYS_INLINE void lane_pairs(const Pack v[3], Pack pair[4])
{
    const Pack zero = pack_of(0.0);
    Pack ab = __builtin_shufflevector(v[0], v[1], 0, 8, 2, 10, 4, 12, 6, 14),
         cd = __builtin_shufflevector(v[2], zero, 0, 8, 2, 10, 4, 12, 6, 14),
         ab1 = __builtin_shufflevector(v[0], v[1], 1, 9, 3, 11, 5, 13, 7, 15),
         cd1 = __builtin_shufflevector(v[2], zero, 1, 9, 3, 11, 5, 13, 7, 15);
    pair[0] = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13);
    pair[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 4, 5, 12, 13);
    pair[2] = __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
    pair[3] = __builtin_shufflevector(ab1, cd1, 2, 3, 10, 11, 6, 7, 14, 15);
}

ALWAYS_INLINE void add_rows(int corners, int areas, const int32_t *restrict row, int stride, Pack f[][3], Pack s[][3],
                            double *rows)
{
    Pack force[4][4], area[4][4];
#pragma GCC unroll 4
    for (int c = 0; c < corners; c++) lane_pairs(f[c], force[c]);
#pragma GCC unroll 4
    for (int c = 0; c < areas; c++) lane_pairs(s[c], area[c]);
#pragma GCC unroll 8
    for (int i = 0; i < 8; i++) {
#pragma GCC unroll 4
        for (int c = 0; c < corners; c++) {
            Pack fi = force[c][i % 4], si = area[areas == 1 ? 0 : c][i % 4];
            Pack *to = (Pack *)(void *)(rows + ROW_SIZE * (ptrdiff_t)row[c * stride + i]);
            *to += i < 4 ? __builtin_shufflevector(fi, si, 0, 1, 2, 3, 8, 9, 10, 11)
                         : __builtin_shufflevector(fi, si, 4, 5, 6, 7, 12, 13, 14, 15);
        }
    }
}
#elif BILLOW_KERNEL_LEVEL == 3
ALWAYS_INLINE void gather_nodes(const int32_t *restrict node, const double *restrict x, Pack out[3])
{
    const LooseFour *a = (const LooseFour *)(x + 3 * (ptrdiff_t)node[0]),
                    *b = (const LooseFour *)(x + 3 * (ptrdiff_t)node[1]),
                    *c = (const LooseFour *)(x + 3 * (ptrdiff_t)node[2]),
                    *d = (const LooseFour *)(x + 3 * (ptrdiff_t)node[3]);
    Pack ab = __builtin_shufflevector(*a, *b, 0, 4, 2, 6), cd = __builtin_shufflevector(*c, *d, 0, 4, 2, 6),
         ab1 = __builtin_shufflevector(*a, *b, 1, 5, 3, 7), cd1 = __builtin_shufflevector(*c, *d, 1, 5, 3, 7);
    out[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
    out[2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

ALWAYS_INLINE void lane_vectors(const Pack v[3], Pack lane[4])
{
    const Pack zero = pack_of(0.0);
    Pack ab = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6), cd = __builtin_shufflevector(v[2], zero, 0, 4, 2, 6),
         ab1 = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7), cd1 = __builtin_shufflevector(v[2], zero, 1, 5, 3, 7);
    lane[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
    lane[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
    lane[2] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    lane[3] = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
}

ALWAYS_INLINE void add_rows(int corners, int areas, const int32_t *restrict row, int stride, Pack f[][3], Pack s[][3],
                            double *rows)
{
    Pack force[4][4], area[4][4];
#pragma GCC unroll 4
    for (int c = 0; c < corners; c++) lane_vectors(f[c], force[c]);
#pragma GCC unroll 4
    for (int c = 0; c < areas; c++) lane_vectors(s[c], area[c]);
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
#pragma GCC unroll 4
        for (int c = 0; c < corners; c++) {
            Pack *to = (Pack *)(void *)(rows + ROW_SIZE * (ptrdiff_t)row[c * stride + i]);
            to[0] += force[c][i];
            to[1] += area[areas == 1 ? 0 : c][i];
        }
    }
}
#else
ALWAYS_INLINE void gather_nodes(const int32_t *restrict node, const double *restrict x, Pack out[3])
{
    const double *a = x + 3 * (ptrdiff_t)node[0], *b = x + 3 * (ptrdiff_t)node[1];
    Pack low_a = *(const LooseTwo *)a, low_b = *(const LooseTwo *)b;
    out[0] = __builtin_shufflevector(low_a, low_b, 0, 2);
    out[1] = __builtin_shufflevector(low_a, low_b, 1, 3);
    out[2] = (Pack){a[2], b[2]};
}

ALWAYS_INLINE void add_rows(int corners, int areas, const int32_t *restrict row, int stride, Pack f[][3], Pack s[][3],
                            double *rows)
{
    for (int i = 0; i < 2; i++) {
        for (int c = 0; c < corners; c++) {
            double *to = rows + ROW_SIZE * (ptrdiff_t)row[c * stride + i];
            for (int k = 0; k < 3; k++) {
                to[k] += f[c][k][i];
                to[4 + k] += s[areas == 1 ? 0 : c][k][i];
            }
        }
    }
}
#endif

#endif

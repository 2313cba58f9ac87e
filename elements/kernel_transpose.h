/* Rows of memory to packs and back: node coordinates into lanes, lane values into corner records. Pure moves, so every
 * instruction set gives the same bits. */
#ifndef BILLOW_KERNEL_TRANSPOSE_H
#define BILLOW_KERNEL_TRANSPOSE_H

#include <stddef.h>

#include "elements/pack.h"

/* Two and four doubles anywhere in memory. */
typedef double LooseTwo __attribute__((vector_size(16), aligned(8), may_alias));
typedef double LooseFour __attribute__((vector_size(32), aligned(8), may_alias));

/* gather_nodes: x, y, z of PACK_WIDTH nodes, three doubles each; a row's fourth double is loaded and dropped.
 * scatter_four: lane values of four quantities to four consecutive doubles per lane, the lanes size doubles apart. */
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

ALWAYS_INLINE void scatter_four(int size, const Pack from[4], double *restrict record)
{
    Pack ab = __builtin_shufflevector(from[0], from[1], 0, 8, 2, 10, 4, 12, 6, 14),
         cd = __builtin_shufflevector(from[2], from[3], 0, 8, 2, 10, 4, 12, 6, 14),
         ab1 = __builtin_shufflevector(from[0], from[1], 1, 9, 3, 11, 5, 13, 7, 15),
         cd1 = __builtin_shufflevector(from[2], from[3], 1, 9, 3, 11, 5, 13, 7, 15);
    /* lanes i and i + 4 side by side */
    const Pack rows[4] = {__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(ab1, cd1, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15),
                          __builtin_shufflevector(ab1, cd1, 2, 3, 10, 11, 6, 7, 14, 15)};
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        *(LooseFour *)(record + size * i) = __builtin_shufflevector(rows[i], rows[i], 0, 1, 2, 3);
        *(LooseFour *)(record + size * (i + 4)) = __builtin_shufflevector(rows[i], rows[i], 4, 5, 6, 7);
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

ALWAYS_INLINE void scatter_four(int size, const Pack from[4], double *restrict record)
{
    Pack ab = __builtin_shufflevector(from[0], from[1], 0, 4, 2, 6),
         cd = __builtin_shufflevector(from[2], from[3], 0, 4, 2, 6),
         ab1 = __builtin_shufflevector(from[0], from[1], 1, 5, 3, 7),
         cd1 = __builtin_shufflevector(from[2], from[3], 1, 5, 3, 7);
    *(LooseFour *)record = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
    *(LooseFour *)(record + size) = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
    *(LooseFour *)(record + 2 * size) = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    *(LooseFour *)(record + 3 * size) = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
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

ALWAYS_INLINE void scatter_four(int size, const Pack from[4], double *restrict record)
{
    *(LooseTwo *)record = __builtin_shufflevector(from[0], from[1], 0, 2);
    *(LooseTwo *)(record + 2) = __builtin_shufflevector(from[2], from[3], 0, 2);
    *(LooseTwo *)(record + size) = __builtin_shufflevector(from[0], from[1], 1, 3);
    *(LooseTwo *)(record + size + 2) = __builtin_shufflevector(from[2], from[3], 1, 3);
}
#endif

#endif

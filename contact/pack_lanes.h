/* What the exact kernels of contact need beyond elements/pack.h: masks, vectors of lanes, rows of nodes. */
#ifndef BILLOW_CONTACT_PACK_LANES_H
#define BILLOW_CONTACT_PACK_LANES_H

#include <stddef.h>

#include "contact/contact_motion.h"
#include "elements/pack.h"

/* Lanes for which something holds. */
#if BILLOW_KERNEL_LEVEL >= 4
typedef unsigned PackMask;
ALWAYS_INLINE PackMask mask_less(Pack a, Pack b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
}
ALWAYS_INLINE Pack mask_choose(PackMask set, Pack yes, Pack no)
{
    return (Pack)_mm512_mask_blend_pd((__mmask8)set, (__m512d)no, (__m512d)yes);
}
ALWAYS_INLINE unsigned mask_lanes(PackMask set)
{
    return set & 0xFFu;
}
#elif BILLOW_KERNEL_LEVEL == 3
typedef PackBits PackMask;
ALWAYS_INLINE PackMask mask_less(Pack a, Pack b)
{
    return (PackMask)_mm256_cmp_pd((__m256d)a, (__m256d)b, _CMP_LT_OQ);
}
ALWAYS_INLINE Pack mask_choose(PackMask set, Pack yes, Pack no)
{
    return (Pack)_mm256_blendv_pd((__m256d)no, (__m256d)yes, (__m256d)set);
}
ALWAYS_INLINE unsigned mask_lanes(PackMask set)
{
    return (unsigned)_mm256_movemask_pd((__m256d)set);
}
#else
typedef PackBits PackMask;
ALWAYS_INLINE PackMask mask_less(Pack a, Pack b)
{
    return (PackMask)_mm_cmplt_pd((__m128d)a, (__m128d)b);
}
ALWAYS_INLINE Pack mask_choose(PackMask set, Pack yes, Pack no)
{
    return (Pack)_mm_blendv_pd((__m128d)no, (__m128d)yes, (__m128d)set);
}
ALWAYS_INLINE unsigned mask_lanes(PackMask set)
{
    return (unsigned)_mm_movemask_pd((__m128d)set);
}
#endif

/* A vector of each lane. */
typedef struct Pack3 {
    Pack at[3];
} Pack3;

/* Rows of nodes, whole, and turned round, which is quicker than gathering: column k of all lanes. */
typedef struct PackRows {
    Pack at[4];
} PackRows;

#if BILLOW_KERNEL_LEVEL >= 4
ALWAYS_INLINE PackRows rows_turn(const __m256d row[8])
{
    __m512d two[4];
#pragma GCC unroll 4
    for (int k = 0; k < 4; k++) two[k] = _mm512_insertf64x4(_mm512_castpd256_pd512(row[k]), row[k + 4], 1);
    __m512d xz = _mm512_unpacklo_pd(two[0], two[1]), more_xz = _mm512_unpacklo_pd(two[2], two[3]);
    __m512d yw = _mm512_unpackhi_pd(two[0], two[1]), more_yw = _mm512_unpackhi_pd(two[2], two[3]);
    __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return (PackRows){{(Pack)_mm512_permutex2var_pd(xz, low, more_xz), (Pack)_mm512_permutex2var_pd(yw, low, more_yw),
                       (Pack)_mm512_permutex2var_pd(xz, high, more_xz),
                       (Pack)_mm512_permutex2var_pd(yw, high, more_yw)}};
}
#elif BILLOW_KERNEL_LEVEL == 3
ALWAYS_INLINE PackRows rows_turn(const __m256d row[4])
{
    __m256d xz = _mm256_unpacklo_pd(row[0], row[1]), more_xz = _mm256_unpacklo_pd(row[2], row[3]);
    __m256d yw = _mm256_unpackhi_pd(row[0], row[1]), more_yw = _mm256_unpackhi_pd(row[2], row[3]);
    return (PackRows){{(Pack)_mm256_permute2f128_pd(xz, more_xz, 0x20), (Pack)_mm256_permute2f128_pd(yw, more_yw, 0x20),
                       (Pack)_mm256_permute2f128_pd(xz, more_xz, 0x31),
                       (Pack)_mm256_permute2f128_pd(yw, more_yw, 0x31)}};
}
#endif

/* Four doubles of each node, stride doubles apart. */
ALWAYS_INLINE PackRows rows_load(const double *from, int stride, const int32_t *node)
{
#if BILLOW_KERNEL_LEVEL >= 3
    __m256d row[PACK_WIDTH];
#pragma GCC unroll 8
    for (int l = 0; l < PACK_WIDTH; l++) row[l] = _mm256_loadu_pd(from + stride * (ptrdiff_t)node[l]);
    return rows_turn(row);
#else
    const double *a = from + stride * (ptrdiff_t)node[0], *b = from + stride * (ptrdiff_t)node[1];
    __m128d first = _mm_loadu_pd(a), second = _mm_loadu_pd(b), third = _mm_loadu_pd(a + 2),
            fourth = _mm_loadu_pd(b + 2);
    return (PackRows){{(Pack)_mm_unpacklo_pd(first, second), (Pack)_mm_unpackhi_pd(first, second),
                       (Pack)_mm_unpacklo_pd(third, fourth), (Pack)_mm_unpackhi_pd(third, fourth)}};
#endif
}

/* Vectors of nodes; nothing beyond them is read. */
ALWAYS_INLINE Pack3 nodes_load(const double *from, const int32_t *node)
{
#if BILLOW_KERNEL_LEVEL >= 3
    __m256d row[PACK_WIDTH];
#pragma GCC unroll 8
    for (int l = 0; l < PACK_WIDTH; l++)
        row[l] = _mm256_maskload_pd(from + 3 * (ptrdiff_t)node[l], _mm256_setr_epi64x(-1, -1, -1, 0));
    PackRows turned = rows_turn(row);
    return (Pack3){{turned.at[0], turned.at[1], turned.at[2]}};
#else
    const double *a = from + 3 * (ptrdiff_t)node[0], *b = from + 3 * (ptrdiff_t)node[1];
    __m128d first = _mm_loadu_pd(a), second = _mm_loadu_pd(b);
    return (Pack3){{(Pack)_mm_unpacklo_pd(first, second), (Pack)_mm_unpackhi_pd(first, second), {a[2], b[2]}}};
#endif
}

ALWAYS_INLINE Pack3 pack3_subtract(Pack3 a, Pack3 b)
{
    return (Pack3){{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
}

ALWAYS_INLINE Pack pack3_dot(Pack3 a, Pack3 b)
{
    return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}

ALWAYS_INLINE Pack3 pack3_cross(Pack3 a, Pack3 b)
{
    return (Pack3){{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
                    a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

/* contact_ahead. */
ALWAYS_INLINE Pack pack_ahead(Pack way, Pack thickness)
{
    return pack_larger(2.0 * way - (1.0 - CONTACT_FLOOR) * thickness, way);
}

#endif

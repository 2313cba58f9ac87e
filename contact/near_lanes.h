/* The 16 items of a group lane by lane in single precision: as many registers of the instruction set as that takes, and
 * what the near kernels do with one register. Sets of lanes are bits of an unsigned. */
#ifndef BILLOW_NEAR_LANES_H
#define BILLOW_NEAR_LANES_H

#include "contact/contact_motion.h"
#include "elements/pack.h"

#if BILLOW_KERNEL_LEVEL >= 4
enum { NEAR_WIDTH = 16 };
#elif BILLOW_KERNEL_LEVEL == 3
enum { NEAR_WIDTH = 8 };
#else
enum { NEAR_WIDTH = 4 };
#endif

typedef float Lanes __attribute__((vector_size(4 * NEAR_WIDTH)));

/* One number of each item. */
typedef struct LaneArray {
    _Alignas(64) float at[CONTACT_GROUP];
} LaneArray;

ALWAYS_INLINE Lanes lanes_of(float value)
{
    return value - (Lanes){0};
}

/* r: first lane, a multiple of NEAR_WIDTH. */
ALWAYS_INLINE Lanes lanes_load(const LaneArray *from, int r)
{
    return *(const Lanes *)(const void *)(from->at + r);
}

typedef float LooseLanes __attribute__((vector_size(4 * NEAR_WIDTH), aligned(4)));

/* From any place. */
ALWAYS_INLINE Lanes lanes_from(const float *from)
{
    return *(const LooseLanes *)(const void *)from;
}

ALWAYS_INLINE void lanes_store(LaneArray *to, int r, Lanes value)
{
    *(Lanes *)(void *)(to->at + r) = value;
}

/* lanes_equal, lanes_below (a <= b): sets of lanes; lanes_replace: value in the lanes of a set.
 * lanes_turn: columns x y z of rows x y z. */
#if BILLOW_KERNEL_LEVEL >= 4
ALWAYS_INLINE Lanes lanes_larger(Lanes a, Lanes b)
{
    return (Lanes)_mm512_max_ps((__m512)a, (__m512)b);
}
ALWAYS_INLINE Lanes lanes_smaller(Lanes a, Lanes b)
{
    return (Lanes)_mm512_min_ps((__m512)a, (__m512)b);
}
ALWAYS_INLINE Lanes lanes_root(Lanes a)
{
    return (Lanes)_mm512_sqrt_ps((__m512)a);
}
ALWAYS_INLINE unsigned lanes_below(Lanes a, Lanes b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}
ALWAYS_INLINE unsigned lanes_equal(const int32_t *a, int32_t b)
{
    return _mm512_cmpeq_epi32_mask(_mm512_loadu_si512(a), _mm512_set1_epi32(b));
}
ALWAYS_INLINE Lanes lanes_replace(Lanes a, unsigned set, float value)
{
    return (Lanes)_mm512_mask_blend_ps((__mmask16)set, (__m512)a, _mm512_set1_ps(value));
}
ALWAYS_INLINE void lanes_turn(const __m128 row[NEAR_WIDTH], Lanes column[3])
{
    __m512 wide[4]; /* rows k, 4 + k, 8 + k, 12 + k */
    for (int k = 0; k < 4; k++) {
        __m256 low = _mm256_set_m128(row[4 + k], row[k]), high = _mm256_set_m128(row[12 + k], row[8 + k]);
        wide[k] = _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
    }
    __m512d a = _mm512_castps_pd(_mm512_unpacklo_ps(wide[0], wide[1])),
            b = _mm512_castps_pd(_mm512_unpacklo_ps(wide[2], wide[3])),
            c = _mm512_castps_pd(_mm512_unpackhi_ps(wide[0], wide[1])),
            d = _mm512_castps_pd(_mm512_unpackhi_ps(wide[2], wide[3]));
    column[0] = (Lanes)_mm512_unpacklo_pd(a, b);
    column[1] = (Lanes)_mm512_unpackhi_pd(a, b);
    column[2] = (Lanes)_mm512_unpacklo_pd(c, d);
}
ALWAYS_INLINE float lanes_least(Lanes a)
{
    return _mm512_reduce_min_ps((__m512)a);
}
ALWAYS_INLINE float lanes_largest(Lanes a)
{
    return _mm512_reduce_max_ps((__m512)a);
}
#elif BILLOW_KERNEL_LEVEL == 3
ALWAYS_INLINE Lanes lanes_larger(Lanes a, Lanes b)
{
    return (Lanes)_mm256_max_ps((__m256)a, (__m256)b);
}
ALWAYS_INLINE Lanes lanes_smaller(Lanes a, Lanes b)
{
    return (Lanes)_mm256_min_ps((__m256)a, (__m256)b);
}
ALWAYS_INLINE Lanes lanes_root(Lanes a)
{
    return (Lanes)_mm256_sqrt_ps((__m256)a);
}
ALWAYS_INLINE unsigned lanes_below(Lanes a, Lanes b)
{
    return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LE_OQ));
}
ALWAYS_INLINE unsigned lanes_equal(const int32_t *a, int32_t b)
{
    __m256i equal = _mm256_cmpeq_epi32(_mm256_loadu_si256((const void *)a), _mm256_set1_epi32(b));
    return (unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(equal));
}
ALWAYS_INLINE Lanes lanes_replace(Lanes a, unsigned set, float value)
{
    __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128), all = _mm256_set1_epi32((int)set);
    __m256i mask = _mm256_cmpeq_epi32(_mm256_and_si256(all, bit), bit);
    return (Lanes)_mm256_blendv_ps((__m256)a, _mm256_set1_ps(value), _mm256_castsi256_ps(mask));
}
ALWAYS_INLINE void lanes_turn(const __m128 row[NEAR_WIDTH], Lanes column[3])
{
    __m256 wide[4]; /* rows k and 4 + k */
    for (int k = 0; k < 4; k++) wide[k] = _mm256_set_m128(row[4 + k], row[k]);
    __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(wide[0], wide[1])),
            b = _mm256_castps_pd(_mm256_unpacklo_ps(wide[2], wide[3])),
            c = _mm256_castps_pd(_mm256_unpackhi_ps(wide[0], wide[1])),
            d = _mm256_castps_pd(_mm256_unpackhi_ps(wide[2], wide[3]));
    column[0] = (Lanes)_mm256_unpacklo_pd(a, b);
    column[1] = (Lanes)_mm256_unpackhi_pd(a, b);
    column[2] = (Lanes)_mm256_unpacklo_pd(c, d);
}
#else
ALWAYS_INLINE Lanes lanes_larger(Lanes a, Lanes b)
{
    return (Lanes)_mm_max_ps((__m128)a, (__m128)b);
}
ALWAYS_INLINE Lanes lanes_smaller(Lanes a, Lanes b)
{
    return (Lanes)_mm_min_ps((__m128)a, (__m128)b);
}
ALWAYS_INLINE Lanes lanes_root(Lanes a)
{
    return (Lanes)_mm_sqrt_ps((__m128)a);
}
ALWAYS_INLINE unsigned lanes_below(Lanes a, Lanes b)
{
    return (unsigned)_mm_movemask_ps(_mm_cmple_ps((__m128)a, (__m128)b));
}
ALWAYS_INLINE unsigned lanes_equal(const int32_t *a, int32_t b)
{
    __m128i equal = _mm_cmpeq_epi32(_mm_loadu_si128((const void *)a), _mm_set1_epi32(b));
    return (unsigned)_mm_movemask_ps(_mm_castsi128_ps(equal));
}
ALWAYS_INLINE Lanes lanes_replace(Lanes a, unsigned set, float value)
{
    __m128i bit = _mm_setr_epi32(1, 2, 4, 8), all = _mm_set1_epi32((int)set);
    __m128i mask = _mm_cmpeq_epi32(_mm_and_si128(all, bit), bit);
    return (Lanes)_mm_blendv_ps((__m128)a, _mm_set1_ps(value), _mm_castsi128_ps(mask));
}
ALWAYS_INLINE void lanes_turn(const __m128 row[NEAR_WIDTH], Lanes column[3])
{
    __m128 a = _mm_unpacklo_ps(row[0], row[1]), b = _mm_unpacklo_ps(row[2], row[3]);
    column[0] = (Lanes)_mm_movelh_ps(a, b);
    column[1] = (Lanes)_mm_movehl_ps(b, a);
    column[2] = (Lanes)_mm_movelh_ps(_mm_unpackhi_ps(row[0], row[1]), _mm_unpackhi_ps(row[2], row[3]));
}
#endif

/* x y z of nodes less an origin. Each node is loaded as a whole: gathers are slower. */
ALWAYS_INLINE void lanes_points(const double *x, const int32_t *node, const double origin[3], Lanes point[3])
{
    __m128 row[NEAR_WIDTH];
#if BILLOW_KERNEL_LEVEL >= 3
    const __m256i xyz = _mm256_setr_epi64x(-1, -1, -1, 0);
    const __m256d zero = _mm256_maskload_pd(origin, xyz);
    for (int k = 0; k < NEAR_WIDTH; k++)
        row[k] = _mm256_cvtpd_ps(_mm256_sub_pd(_mm256_maskload_pd(x + 3 * (ptrdiff_t)node[k], xyz), zero));
#else
    for (int k = 0; k < NEAR_WIDTH; k++) {
        const double *at = x + 3 * (ptrdiff_t)node[k];
        row[k] = _mm_setr_ps((float)(at[0] - origin[0]), (float)(at[1] - origin[1]), (float)(at[2] - origin[2]), 0.0f);
    }
#endif
    lanes_turn(row, point);
}

/* lanes_pick: from[place[lane]] of the lanes of a set, others are of no use. lanes_pack: stores numbers of the lanes of
 * a set one behind the other, and perhaps anything in the rest of NEAR_WIDTH places; returns how many they are. */
#if BILLOW_KERNEL_LEVEL >= 4
ALWAYS_INLINE Lanes lanes_pick(const float *from, const int32_t *place, unsigned set)
{
    __m512i at = _mm512_loadu_si512(place);
    return (Lanes)_mm512_mask_i32gather_ps(_mm512_setzero_ps(), (__mmask16)set, at, from, 4);
}
ALWAYS_INLINE int lanes_pack(const int32_t *number, unsigned set, int32_t *to)
{
    __m512i packed = _mm512_maskz_compress_epi32((__mmask16)set, _mm512_loadu_si512(number));
    _mm512_storeu_si512(to, packed);
    return __builtin_popcount(set);
}
#else
ALWAYS_INLINE Lanes lanes_pick(const float *from, const int32_t *place, unsigned set)
{
    Lanes value = {0};
    for (int k = 0; k < NEAR_WIDTH; k++) value[k] = set >> k & 1u ? from[place[k]] : 0.0f;
    return value;
}
ALWAYS_INLINE int lanes_pack(const int32_t *number, unsigned set, int32_t *to)
{
    int count = 0;
    for (; set; set &= set - 1) to[count++] = number[__builtin_ctz(set)];
    return count;
}
#endif

#if BILLOW_KERNEL_LEVEL < 4
ALWAYS_INLINE float lanes_least(Lanes a)
{
    float least = a[0];
    for (int k = 1; k < NEAR_WIDTH; k++) least = a[k] < least ? a[k] : least;
    return least;
}
ALWAYS_INLINE float lanes_largest(Lanes a)
{
    float largest = a[0];
    for (int k = 1; k < NEAR_WIDTH; k++) largest = a[k] > largest ? a[k] : largest;
    return largest;
}
#endif

ALWAYS_INLINE Lanes lanes_absolute(Lanes a)
{
    return lanes_larger(a, -a);
}

/* Items whose number is b. */
ALWAYS_INLINE unsigned items_equal(const int32_t a[CONTACT_GROUP], int32_t b)
{
    unsigned set = 0;
    for (int r = 0; r < CONTACT_GROUP; r += NEAR_WIDTH) set |= lanes_equal(a + r, b) << r;
    return set;
}

/* Items whose a is no more than their b. */
ALWAYS_INLINE unsigned items_below(const LaneArray *a, const LaneArray *b)
{
    unsigned set = 0;
    for (int r = 0; r < CONTACT_GROUP; r += NEAR_WIDTH) set |= lanes_below(lanes_load(a, r), lanes_load(b, r)) << r;
    return set;
}

/* Those whose a is no more than value. */
ALWAYS_INLINE unsigned items_within(const LaneArray *a, float value)
{
    unsigned set = 0;
    for (int r = 0; r < CONTACT_GROUP; r += NEAR_WIDTH) set |= lanes_below(lanes_load(a, r), lanes_of(value)) << r;
    return set;
}

#endif

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
 * lanes_gather: components of nodes less an origin, from[3 node[lane]]. */
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
ALWAYS_INLINE Lanes lanes_gather(const double *from, const int32_t *node, double origin)
{
    __m512i n = _mm512_loadu_si512(node), place = _mm512_add_epi32(n, _mm512_add_epi32(n, n));
    __m512d zero = _mm512_set1_pd(origin), low, high;
    low = _mm512_i32gather_pd(_mm512_castsi512_si256(place), from, 8);
    high = _mm512_i32gather_pd(_mm512_extracti64x4_epi64(place, 1), from, 8);
    __m256 first = _mm512_cvtpd_ps(_mm512_sub_pd(low, zero)), second = _mm512_cvtpd_ps(_mm512_sub_pd(high, zero));
    return (Lanes)_mm512_insertf32x8(_mm512_castps256_ps512(first), second, 1);
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
ALWAYS_INLINE Lanes lanes_gather(const double *from, const int32_t *node, double origin)
{
    __m256i n = _mm256_loadu_si256((const void *)node), place = _mm256_add_epi32(n, _mm256_add_epi32(n, n));
    __m256d zero = _mm256_set1_pd(origin);
    __m256d low = _mm256_i32gather_pd(from, _mm256_castsi256_si128(place), 8);
    __m256d high = _mm256_i32gather_pd(from, _mm256_extracti128_si256(place, 1), 8);
    __m128 first = _mm256_cvtpd_ps(_mm256_sub_pd(low, zero)), second = _mm256_cvtpd_ps(_mm256_sub_pd(high, zero));
    return (Lanes)_mm256_set_m128(second, first);
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
ALWAYS_INLINE Lanes lanes_gather(const double *from, const int32_t *node, double origin)
{
    Lanes to;
    for (int k = 0; k < NEAR_WIDTH; k++) to[k] = (float)(from[3 * (ptrdiff_t)node[k]] - origin);
    return to;
}
#endif

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

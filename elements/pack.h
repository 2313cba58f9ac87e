/* A pack: as many doubles as one register of the instruction set holds, with the operators + - * / and these functions.
 *
 * The kernels are written on packs, not left to the compiler's vectoriser, which gives up on a branch without a word.
 * Every function is exact or correctly rounded lane by lane, so all instruction sets give the same bits. */
#ifndef BILLOW_PACK_H
#define BILLOW_PACK_H

#include <immintrin.h>
#include <stdint.h>

/* A pack needs every call dissolved. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))

#if BILLOW_KERNEL_LEVEL >= 4
enum { PACK_WIDTH = 8 };
#elif BILLOW_KERNEL_LEVEL == 3
enum { PACK_WIDTH = 4 };
#else
enum { PACK_WIDTH = 2 };
#endif

typedef double Pack __attribute__((vector_size(8 * PACK_WIDTH)));
typedef uint64_t PackBits __attribute__((vector_size(8 * PACK_WIDTH)));

ALWAYS_INLINE Pack pack_of(double value)
{
    return value - (Pack){0};
}

/* PACK_WIDTH doubles, aligned as a pack. */
ALWAYS_INLINE Pack pack_load(const double *from)
{
    return *(const Pack *)(const void *)from;
}

ALWAYS_INLINE void pack_store(double *to, Pack value)
{
    *(Pack *)(void *)to = value;
}

typedef float PackFloat __attribute__((vector_size(4 * PACK_WIDTH)));

/* PACK_WIDTH numbers kept in single precision, aligned as such. */
ALWAYS_INLINE Pack pack_load_single(const float *from)
{
    return __builtin_convertvector(*(const PackFloat *)(const void *)from, Pack);
}

ALWAYS_INLINE void pack_store_single(float *to, Pack value)
{
    *(PackFloat *)(void *)to = __builtin_convertvector(value, PackFloat);
}

/* a > b ? a : b; b where either is not a number. pack_root: square root. pack_where_positive: x > 0 ? yes : no. */
#if BILLOW_KERNEL_LEVEL >= 4
ALWAYS_INLINE Pack pack_larger(Pack a, Pack b)
{
    return (Pack)_mm512_max_pd((__m512d)a, (__m512d)b);
}
ALWAYS_INLINE Pack pack_root(Pack a)
{
    return (Pack)_mm512_sqrt_pd((__m512d)a);
}
ALWAYS_INLINE Pack pack_where_positive(Pack x, Pack yes, Pack no)
{
    return (Pack)_mm512_mask_blend_pd(_mm512_cmp_pd_mask((__m512d)x, _mm512_setzero_pd(), _CMP_GT_OQ), (__m512d)no,
                                      (__m512d)yes);
}
#elif BILLOW_KERNEL_LEVEL == 3
ALWAYS_INLINE Pack pack_larger(Pack a, Pack b)
{
    return (Pack)_mm256_max_pd((__m256d)a, (__m256d)b);
}
ALWAYS_INLINE Pack pack_root(Pack a)
{
    return (Pack)_mm256_sqrt_pd((__m256d)a);
}
ALWAYS_INLINE Pack pack_where_positive(Pack x, Pack yes, Pack no)
{
    return (Pack)_mm256_blendv_pd((__m256d)no, (__m256d)yes,
                                  _mm256_cmp_pd((__m256d)x, _mm256_setzero_pd(), _CMP_GT_OQ));
}
#else
ALWAYS_INLINE Pack pack_larger(Pack a, Pack b)
{
    return (Pack)_mm_max_pd((__m128d)a, (__m128d)b);
}
ALWAYS_INLINE Pack pack_root(Pack a)
{
    return (Pack)_mm_sqrt_pd((__m128d)a);
}
ALWAYS_INLINE Pack pack_where_positive(Pack x, Pack yes, Pack no)
{
    return (Pack)_mm_blendv_pd((__m128d)no, (__m128d)yes, _mm_cmpgt_pd((__m128d)x, _mm_setzero_pd()));
}
#endif

/* a < b ? a : b; b where either is not a number. */
ALWAYS_INLINE Pack pack_smaller(Pack a, Pack b)
{
#if BILLOW_KERNEL_LEVEL >= 4
    return (Pack)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif BILLOW_KERNEL_LEVEL == 3
    return (Pack)_mm256_min_pd((__m256d)a, (__m256d)b);
#else
    return (Pack)_mm_min_pd((__m128d)a, (__m128d)b);
#endif
}

ALWAYS_INLINE Pack pack_absolute(Pack a)
{
    return (Pack)((PackBits)a & 0x7FFFFFFFFFFFFFFFu);
}

/* 1/sqrt(x) for normal positive x, to two units in the last place: Newton's steps from half the exponent. Where the
 * processor takes roots and divides one at a time this is several times faster. */
ALWAYS_INLINE Pack pack_reciprocal_root(Pack x)
{
    Pack half = 0.5 * x, y = (Pack)(0x5FE6EB50C7B537A9u - ((PackBits)x >> 1));
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) y *= 1.5 - (half * y) * y;
    return y;
}

enum { PACKS_TOGETHER = 4 };

/* The same of several packs at a time, whose steps do not wait for each other. count: a multiple of PACKS_TOGETHER. */
ALWAYS_INLINE void pack_reciprocal_roots(int count, const Pack *x, Pack *root)
{
    for (int first = 0; first < count; first += PACKS_TOGETHER) {
        Pack half[PACKS_TOGETHER], y[PACKS_TOGETHER];
#pragma GCC unroll 4
        for (int j = 0; j < PACKS_TOGETHER; j++) {
            half[j] = 0.5 * x[first + j];
            y[j] = (Pack)(0x5FE6EB50C7B537A9u - ((PackBits)x[first + j] >> 1));
        }
#pragma GCC unroll 4
        for (int i = 0; i < 4; i++) {
#pragma GCC unroll 4
            for (int j = 0; j < PACKS_TOGETHER; j++) y[j] *= 1.5 - (half[j] * y[j]) * y[j];
        }
#pragma GCC unroll 4
        for (int j = 0; j < PACKS_TOGETHER; j++) root[first + j] = y[j];
    }
}

#endif

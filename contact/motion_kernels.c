/* Compiled once per instruction set, with BILLOW_MOTION_TABLE naming its table. */
#include "contact/motion_kernels.h"

#include <math.h>

#include "contact/near_lanes.h"

/* Components x y z of one node at a time: the least and the largest. */
#if BILLOW_KERNEL_LEVEL >= 3
typedef struct Vector {
    __m256d xyz; /* and 0 */
} Vector;
ALWAYS_INLINE Vector vector_load(const double *from)
{
    return (Vector){_mm256_maskload_pd(from, _mm256_setr_epi64x(-1, -1, -1, 0))};
}
ALWAYS_INLINE Vector vector_smaller(Vector a, Vector b)
{
    return (Vector){_mm256_min_pd(a.xyz, b.xyz)};
}
ALWAYS_INLINE Vector vector_larger(Vector a, Vector b)
{
    return (Vector){_mm256_max_pd(a.xyz, b.xyz)};
}
ALWAYS_INLINE void vector_store(double to[4], Vector a)
{
    _mm256_storeu_pd(to, a.xyz);
}
#else
typedef struct Vector {
    __m128d xy, z;
} Vector;
ALWAYS_INLINE Vector vector_load(const double *from)
{
    return (Vector){_mm_loadu_pd(from), _mm_load_sd(from + 2)};
}
ALWAYS_INLINE Vector vector_smaller(Vector a, Vector b)
{
    return (Vector){_mm_min_pd(a.xy, b.xy), _mm_min_sd(a.z, b.z)};
}
ALWAYS_INLINE Vector vector_larger(Vector a, Vector b)
{
    return (Vector){_mm_max_pd(a.xy, b.xy), _mm_max_sd(a.z, b.z)};
}
ALWAYS_INLINE void vector_store(double to[4], Vector a)
{
    _mm_storeu_pd(to, a.xy);
    _mm_storeu_pd(to + 2, a.z);
}
#endif

static void follow(ContactGroups *groups, const double *v, int first, int end)
{
    for (int g = first; g < end; g++) {
        if (!groups->watched[g]) continue;
        const int32_t *node = groups->node + groups->start[g];
        int count = groups->start[g + 1] - groups->start[g];
        Vector low[2], high[2]; /* two at a time: each waits for the one before */
        for (int i = 0; i < 2; i++) low[i] = high[i] = vector_load(v + 3 * (ptrdiff_t)node[0]);
        for (int k = 0; k < count; k += 2)
            for (int i = 0; i < 2; i++) {
                Vector of_node = vector_load(v + 3 * (ptrdiff_t)node[k + i < count ? k + i : k]);
                low[i] = vector_smaller(low[i], of_node);
                high[i] = vector_larger(high[i], of_node);
            }
        double least[4], most[4];
        vector_store(least, vector_smaller(low[0], low[1]));
        vector_store(most, vector_larger(high[0], high[1]));
        contact_velocity_keep(groups, g, least, most);
    }
}

/* Up to NEAR_WIDTH numbers of an array; the other lanes are of no use. */
#if BILLOW_KERNEL_LEVEL >= 4
ALWAYS_INLINE Lanes some_load(const float *from, int count)
{
    return (Lanes)_mm512_maskz_loadu_ps((__mmask16)((1u << count) - 1u), from);
}
ALWAYS_INLINE void some_store(float *to, int count, Lanes value)
{
    _mm512_mask_storeu_ps(to, (__mmask16)((1u << count) - 1u), (__m512)value);
}
#else
ALWAYS_INLINE Lanes some_load(const float *from, int count)
{
    Lanes value = {0};
    for (int k = 0; k < count; k++) value[k] = from[k];
    return value;
}
ALWAYS_INLINE void some_store(float *to, int count, Lanes value)
{
    for (int k = 0; k < count; k++) to[k] = value[k];
}
#endif

static unsigned wake(const ContactWatch *watch, const int32_t *other, float *slack, int count, float *speed)
{
    const ContactGroups *own = watch->own, *all = watch->others;
    const __m128 down = _mm_load_ps(own->speeds[watch->group].down), up = _mm_load_ps(own->speeds[watch->group].up);
    unsigned awake = 0;
    for (int r = 0; r < count; r += NEAR_WIDTH) {
        int some = count - r < NEAR_WIDTH ? count - r : NEAR_WIDTH;
        Lanes axis[3];
        __m128 closing[NEAR_WIDTH];
        for (int k = 0; k < NEAR_WIDTH; k++) {
            const ContactSpeeds *speeds = &all->speeds[other[r + (k < some ? k : 0)]];
            closing[k] =
                _mm_max_ps(_mm_add_ps(up, _mm_load_ps(speeds->down)), _mm_add_ps(down, _mm_load_ps(speeds->up)));
        }
        lanes_turn(closing, axis);
        Lanes square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2], left = some_load(slack + r, some);
        /* rounded towards what is closer */
        Lanes fast = lanes_root(square) * (1.0f + 2e-6f), way = fast * watch->before;
        left -= way + 3e-7f * (lanes_absolute(left) + way);
        Lanes ahead = fast * watch->longer;
        ahead = lanes_larger(ahead, 2.0f * ahead - (1.0f - (float)CONTACT_FLOOR) * watch->least);
        Lanes need = (ahead + watch->deepest) * (1.0f + 1e-6f);
        *(Lanes *)(void *)(speed + r) = fast;
        some_store(slack + r, some, left);
        awake |= lanes_below(left, need) << r;
    }
    return awake & ((1u << count) - 1u);
}

typedef double LoosePack __attribute__((vector_size(8 * PACK_WIDTH), aligned(8)));

ALWAYS_INLINE Pack loose_load(const double *from)
{
    return *(const LoosePack *)(const void *)from;
}

/* Components x y z x y z ... as one array: those of lane l of pack p of three are of axis (p PACK_WIDTH + l) mod 3. */
static void drift(ContactMotion *motion, const double *x, const double *v, const DriftOrigin *origin, double pending,
                  int count)
{
    double square[3 * CONTACT_NODE_CHUNK], fastest = motion->fastest;
    Pack low[3], high[3], way_of[3], velocity[3];
    int size = 3 * count, done = 0;
    const double *from = origin->from;
    for (int p = 0; p < 3; p++) {
        low[p] = high[p] = pack_of(0.0);
        for (int l = 0; l < PACK_WIDTH; l++) {
            way_of[p][l] = origin->way[(p * PACK_WIDTH + l) % 3];
            velocity[p][l] = origin->velocity[(p * PACK_WIDTH + l) % 3];
        }
    }
    for (; done + 3 * PACK_WIDTH <= size; done += 3 * PACK_WIDTH)
        for (int p = 0; p < 3; p++) {
            int at = done + p * PACK_WIDTH;
            Pack u = loose_load(v + at), way = loose_load(x + at) + pending * u - loose_load(from + at) - way_of[p];
            u -= velocity[p];
            low[p] = pack_larger(-way, low[p]); /* of -way */
            high[p] = pack_larger(way, high[p]);
            *(LoosePack *)(void *)(square + at) = u * u;
        }
    for (int p = 0; p < 3; p++)
        for (int l = 0; l < PACK_WIDTH; l++)
            contact_drift_add(&motion->drift, (p * PACK_WIDTH + l) % 3, -low[p][l], high[p][l]);
    for (; done < size; done++) {
        double way = x[done] + pending * v[done] - from[done] - origin->way[done % 3],
               u = v[done] - origin->velocity[done % 3];
        contact_drift_add(&motion->drift, done % 3, way, way);
        square[done] = u * u;
    }
    for (int n = 0; n < count; n++) {
        double speed = square[3 * n] + square[3 * n + 1] + square[3 * n + 2];
        fastest = speed > fastest ? speed : fastest;
    }
    motion->fastest = fastest;
}

static int overlap(const float *bounds, ptrdiff_t count, const int32_t *all, const float query[6], int32_t first,
                   int32_t end, int32_t *found)
{
    const float *low = bounds, *high = bounds + 3 * count;
    int total = 0;
    for (int32_t p = first; p < end; p += NEAR_WIDTH) {
        unsigned set = end - p < NEAR_WIDTH ? (1u << (end - p)) - 1u : (1u << (NEAR_WIDTH - 1) << 1) - 1u;
        for (int k = 0; k < 3; k++) {
            set &= lanes_below(lanes_from(low + k * count + p), lanes_of(query[3 + k]));
            set &= lanes_below(lanes_of(query[k]), lanes_from(high + k * count + p));
        }
        total += lanes_pack(all + p, set, found + total);
    }
    return total;
}

const MotionKernels BILLOW_MOTION_TABLE = {.follow = follow, .wake = wake, .overlap = overlap, .drift = drift};

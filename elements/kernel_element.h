/* What the kernels of all elements share: partial sums over packs, the mode of a law, where a pack of elements has its
 * constants and histories. Included by elements/kernel_triangle.h and elements/kernel_quad.h. */
#ifndef BILLOW_KERNEL_ELEMENT_H
#define BILLOW_KERNEL_ELEMENT_H

#include "elements/kernel_stages.h"
#include "elements/kernel_transpose.h"

/* Eight partial sums, then a tree: the same order in every instruction set. */
enum { SUM_WIDTH = 8, SUM_PACKS = SUM_WIDTH / PACK_WIDTH };

typedef struct PackSum {
    Pack part[SUM_PACKS];
} PackSum;

typedef struct PackSums {
    PackSum volume, area, energy, viscous, hourglass;
    Pack rate;
} PackSums;

ALWAYS_INLINE double total(const PackSum *sum)
{
    double part[SUM_WIDTH];
    for (int i = 0; i < SUM_WIDTH; i++) part[i] = sum->part[i / PACK_WIDTH][i % PACK_WIDTH];
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

ALWAYS_INLINE double largest(Pack pack)
{
    double value = pack[0];
    for (int i = 1; i < PACK_WIDTH; i++) value = pack[i] > value ? pack[i] : value;
    return value;
}

ALWAYS_INLINE void finish_sums(const PackSums *packs, ChunkSums *sums)
{
    sums->volume += total(&packs->volume);
    sums->area += total(&packs->area);
    sums->energy += total(&packs->energy);
    sums->viscous += total(&packs->viscous);
    sums->hourglass += total(&packs->hourglass);
    double rate = largest(packs->rate);
    sums->rate = rate > sums->rate ? rate : sums->rate;
}

/* What a point says to the sums of its chunk; i: number of the pack in its block. */
ALWAYS_INLINE void sum_point(const KernelInput *input, int block, int i, const PointPack *p, PackSums *sums)
{
    sums->energy.part[i % SUM_PACKS] += p->energy;
    sums->viscous.part[i % SUM_PACKS] += p->viscous;
    sums->rate = pack_larger(p->rate, sums->rate);
    if (input->lane_rate) {
        double *rate = input->lane_rate + (ptrdiff_t)(block - input->first_block) * LANES + i * PACK_WIDTH;
        for (int l = 0; l < PACK_WIDTH; l++) rate[l] = p->rate[l];
    }
}

static LawInput make_law_input(const KernelInput *input)
{
    const ElementGroup *group = input->group;
    LawInput in = {
        .law = group->material, .inverse_step = input->inverse_step, .count_work = input->restart_ledger ? 0.0 : 1.0};
    in.new_account = input->open_account || input->restart_ledger;
    in.has_history = group->has_history;
    in.hourglass = group->kind == ELEMENT_QUAD_ONE;
    if (group->law == LAW_GREEN && in.law.no_compression) in.compliance = make_compliance(&in.law.fabric);
    return in;
}

#ifdef BILLOW_FURTHER_LAWS
/* The same elements with the laws of kernel_further.h. */
#include "elements/kernel_further.h"
#define natural_stress further_stress

#define KEEPS_HISTORY(mode, in) ((in)->has_history)

static int kernel_mode(const KernelInput *input)
{
    const ElementGroup *group = input->group;
    if (group->law == LAW_CURVE) return MODE_CURVE;
    return group->material.rubber->terms > 0 ? MODE_OGDEN : MODE_MOONEY;
}

#define FOR_MODE(mode, WORK)                                                                                           \
    switch (mode) {                                                                                                    \
    case MODE_CURVE:                                                                                                   \
        WORK(MODE_CURVE);                                                                                              \
        break;                                                                                                         \
    case MODE_MOONEY:                                                                                                  \
        WORK(MODE_MOONEY);                                                                                             \
        break;                                                                                                         \
    default:                                                                                                           \
        WORK(MODE_OGDEN);                                                                                              \
        break;                                                                                                         \
    }
#else
#define KEEPS_HISTORY(mode, in) ((mode)&MODE_HISTORY)

static int kernel_mode(const KernelInput *input)
{
    const ElementGroup *group = input->group;
    int mode = group->history_size > 0 ? MODE_HISTORY : 0;
    if (input->account && law_keeps_account(group->law, &group->material)) mode |= MODE_ACCOUNT;
    if (group->law == LAW_LOGARITHMIC) return mode | MODE_LOGARITHMIC;
    if (group->law == LAW_BIOT) mode |= MODE_BIOT;
    if (group->material.no_compression) mode |= MODE_TENSION_FIELD;
    if (group->material.has_liner) mode |= MODE_LINER;
    return mode;
}

/* Calls WORK with the mode as a constant. Laws with a stress-work ledger always have a history. */
#define FOR_MODE(mode, WORK)                                                                                           \
    switch (mode) {                                                                                                    \
    case 0:                                                                                                            \
        WORK(0);                                                                                                       \
        break;                                                                                                         \
    case 2:                                                                                                            \
        WORK(2);                                                                                                       \
        break;                                                                                                         \
    case 4:                                                                                                            \
        WORK(4);                                                                                                       \
        break;                                                                                                         \
    case 6:                                                                                                            \
        WORK(6);                                                                                                       \
        break;                                                                                                         \
    case 8:                                                                                                            \
        WORK(8);                                                                                                       \
        break;                                                                                                         \
    case 10:                                                                                                           \
        WORK(10);                                                                                                      \
        break;                                                                                                         \
    case 12:                                                                                                           \
        WORK(12);                                                                                                      \
        break;                                                                                                         \
    case 14:                                                                                                           \
        WORK(14);                                                                                                      \
        break;                                                                                                         \
    case 9:                                                                                                            \
        WORK(9);                                                                                                       \
        break;                                                                                                         \
    case 11:                                                                                                           \
        WORK(11);                                                                                                      \
        break;                                                                                                         \
    case 13:                                                                                                           \
        WORK(13);                                                                                                      \
        break;                                                                                                         \
    case 24:                                                                                                           \
        WORK(24);                                                                                                      \
        break;                                                                                                         \
    case 43:                                                                                                           \
        WORK(43);                                                                                                      \
        break;                                                                                                         \
    case 47:                                                                                                           \
        WORK(47);                                                                                                      \
        break;                                                                                                         \
    case 56:                                                                                                           \
        WORK(56);                                                                                                      \
        break;                                                                                                         \
    default:                                                                                                           \
        WORK(15);                                                                                                      \
        break;                                                                                                         \
    }
#endif

/* Nodes, rows, constants and histories of one pack of elements. */
typedef struct ElementPlace {
    const int32_t *node, *row;     /* of the first corner; the next corner's are LANES further */
    const double *geometry, *tail; /* points, and what comes after them */
    double *metric;                /* history */
    float *stress;
    double *account, *memory;
} ElementPlace;

ALWAYS_INLINE ElementPlace find_place(const KernelInput *input, int block, int pack, int corners, int points)
{
    const ElementGroup *group = input->group;
    ptrdiff_t lane = (ptrdiff_t)pack * PACK_WIDTH, first = (ptrdiff_t)block * LANES;
    const double *geometry = group->geometry + first * group->geometry_size + lane;
    double *history = input->history + group->history_offset + first * group->history_size;
    double *account = input->account;
    if (account) account += (group->first_element + first) * ACCOUNT_SIZE + lane;
    ElementPlace place = {.node = group->node + first * corners + lane,
                          .row = group->row + first * corners + lane,
                          .geometry = geometry,
                          .tail = geometry + (ptrdiff_t)points * GEOMETRY_POINT_SIZE * LANES,
                          .metric = history + lane,
                          .stress = (float *)(void *)(history + (ptrdiff_t)history_values(points) * LANES) + lane,
                          .account = account,
                          .memory = history + (ptrdiff_t)history_size(points) * LANES + lane};
    return place;
}

ALWAYS_INLINE PointPlace point_place(const ElementPlace *place, int point)
{
    PointPlace at = {place->geometry + (ptrdiff_t)point * GEOMETRY_POINT_SIZE * LANES,
                     place->tail,
                     place->metric,
                     place->stress,
                     place->account,
                     place->memory + (ptrdiff_t)point * MEMORY_POINT_SIZE * LANES};
    return at;
}

/* Packs of the blocks that go through the stages together, from this block on. */
ALWAYS_INLINE int count_streams(const KernelInput *input, int block)
{
    int left = input->end_block - block;
    return PACKS * (left < BLOCKS_AT_ONCE ? left : BLOCKS_AT_ONCE);
}

/* The natural stresses of elements with one point. Full streams have their stages unrolled, as their number is known;
 * at the end of a chunk the rest goes one by one. */
ALWAYS_INLINE void stream_stress(int mode, const LawInput *in, int streams, const PointPlace *point, PointPack *p)
{
    if (streams == STREAMS) {
        natural_stress(mode, true, in, STREAMS, point, p);
        return;
    }
    for (int i = 0; i < streams; i++) natural_stress(mode, true, in, 1, point + i, p + i);
}

ALWAYS_INLINE Pack dot(const Pack a[3], const Pack b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

#endif

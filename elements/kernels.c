/* Element kernels for one instruction set: this file is compiled once per set, with BILLOW_KERNEL_TABLE naming its
 * table.
 *
 * A kernel walks over blocks of BILLOW_LANES elements, a pack of lanes at a time: gather the corners, metric, stress
 * (kernel_stages.h), corner sums. Equations: docs/theory.md, Elements. */
#include "elements/kernels.h"

#include "elements/kernel_stages.h"
#include "elements/kernel_transpose.h"

extern const KernelTable BILLOW_KERNEL_TABLE, BILLOW_FURTHER_TABLE;

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
    in.has_history = group->has_history;
    in.one_point = group->kind == ELEMENT_QUAD_ONE;
    if (group->law == LAW_GREEN && in.law.no_compression) in.compliance = make_compliance(&in.law.fabric);
    return in;
}

#ifdef BILLOW_FURTHER_LAWS
/* The same elements with the laws of kernel_further.h. */
#include "elements/kernel_further.h"
#define natural_stress further_stress

static int kernel_mode(const ElementGroup *group)
{
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
static int kernel_mode(const ElementGroup *group)
{
    int mode = group->history_size > 0 ? MODE_HISTORY : 0;
    if (group->law == LAW_LOGARITHMIC) return MODE_LOGARITHMIC | MODE_HISTORY;
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
    double *memory;
} ElementPlace;

ALWAYS_INLINE ElementPlace find_place(const KernelInput *input, int block, int pack, int corners, int points)
{
    const ElementGroup *group = input->group;
    ptrdiff_t lane = (ptrdiff_t)pack * PACK_WIDTH, first = (ptrdiff_t)block * LANES;
    const double *geometry = group->geometry + first * group->geometry_size + lane;
    double *history = input->history + group->history_offset + first * group->history_size;
    ElementPlace place = {.node = group->node + first * corners + lane,
                          .row = group->row + first * corners + lane,
                          .geometry = geometry,
                          .tail = geometry + (ptrdiff_t)points * GEOMETRY_POINT_SIZE * LANES,
                          .metric = history + lane,
                          .stress = (float *)(void *)(history + (ptrdiff_t)points * HISTORY_POINT_SIZE * LANES) + lane,
                          .memory = history + (ptrdiff_t)history_size(points) * LANES + lane};
    return place;
}

ALWAYS_INLINE PointPlace point_place(const ElementPlace *place, int point)
{
    PointPlace at = {place->geometry + (ptrdiff_t)point * GEOMETRY_POINT_SIZE * LANES, place->tail,
                     place->metric + (ptrdiff_t)point * HISTORY_POINT_SIZE * LANES,
                     place->stress + (ptrdiff_t)point * HISTORY_POINT_SIZE * LANES,
                     place->memory + (ptrdiff_t)point * MEMORY_POINT_SIZE * LANES};
    return at;
}

/* Packs of the blocks that go through the stages together, from this block on. */
ALWAYS_INLINE int count_streams(const KernelInput *input, int block)
{
    int left = input->end_block - block;
    return PACKS * (left < BLOCKS_AT_ONCE ? left : BLOCKS_AT_ONCE);
}

ALWAYS_INLINE Pack dot(const Pack a[3], const Pack b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- triangles ---- */

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
        natural_stress(mode, &in, streams, point, p);
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
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* ---- quadrilaterals ---- */

/* Natural gradients of a bilinear quad: x_xi = a + eta h, x_eta = b + xi h (eq. E2). */
typedef struct QuadPack {
    Pack a[3], b[3], h[3], centre[3];
    Pack q[3], skew1, skew2;       /* h less its affine part (eq. E15) */
    Pack force[4][3], share[4][3]; /* of each corner */
} QuadPack;

ALWAYS_INLINE void quad_gradients(const KernelInput *input, const ElementPlace *place, QuadPack *q)
{
    Pack x[4][3];
#pragma GCC unroll 4
    for (int corner = 0; corner < 4; corner++) gather_nodes(place->node + corner * LANES, input->x, x[corner]);
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack lower = x[1][k] - x[0][k], upper = x[2][k] - x[3][k], left = x[3][k] - x[0][k], right = x[2][k] - x[1][k];
        q->a[k] = 0.25 * (lower + upper);
        q->b[k] = 0.25 * (left + right);
        q->h[k] = 0.25 * (upper - lower);
        q->centre[k] = 0.25 * ((x[0][k] + x[1][k]) + (x[2][k] + x[3][k])) - input->origin[k];
    }
}

/* q = h - k1 a - k2 b (eq. E15). constant: where the skews k are. */
ALWAYS_INLINE void free_hourglass(const double *constant, QuadPack *q)
{
    q->skew1 = lane_values(constant, GEOMETRY_SKEW1);
    q->skew2 = lane_values(constant, GEOMETRY_SKEW2);
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) q->q[k] = q->h[k] - (q->skew1 * q->a[k] + q->skew2 * q->b[k]);
}

/* Corner forces from the forces conjugate to a, b and h (eq. E7). */
ALWAYS_INLINE void quad_forces(const Pack qa[3], const Pack qb[3], const Pack qh[3], QuadPack *q)
{
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack fa = 0.25 * qa[k], fb = 0.25 * qb[k], fh = 0.25 * qh[k];
        q->force[0][k] = (fa + fb) - fh;
        q->force[1][k] = (fb - fa) + fh;
        q->force[2][k] = -((fa + fb) + fh);
        q->force[3][k] = (fa - fb) + fh;
    }
}

ALWAYS_INLINE void quad_add(const KernelInput *input, const ElementPlace *place, QuadPack *q)
{
    if (input->rows) add_rows(4, 4, place->row, LANES, q->force, q->share, input->rows);
}

/* Pressure shares of the bilinear patch (eq. E9), its volume and area. */
ALWAYS_INLINE void quad_area(Pack sign, int pack, QuadPack *q, PackSums *sums)
{
    Pack n[3], third = (1.0 / 3.0) * sign;
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        Pack normal = sign * (q->a[i] * q->b[j] - q->a[j] * q->b[i]);
        Pack na = third * (q->a[i] * q->h[j] - q->a[j] * q->h[i]);
        Pack nb = third * (q->h[i] * q->b[j] - q->h[j] * q->b[i]);
        n[k] = normal;
        q->share[0][k] = normal - (na + nb);
        q->share[1][k] = normal + (na - nb);
        q->share[2][k] = normal + (na + nb);
        q->share[3][k] = normal - (na - nb);
    }
    sums->volume.part[pack % SUM_PACKS] += (4.0 / 3.0) * dot(q->centre, n);
    sums->area.part[pack % SUM_PACKS] += 4.0 * pack_root(dot(n, n));
}

enum { QUAD_POINTS = 4 };

/* Metrics at the points g11 = x_xi.x_xi ... in material axes; FORM 0 and 1 fold freely about the diagonal n1-n3
 * (eq. E4a). */
ALWAYS_INLINE void quad_metrics(int mode, const double *points, const QuadPack *q, const double xi[],
                                const double eta[], PointPack *p)
{
    Pack aa = dot(q->a, q->a), bb = dot(q->b, q->b), ab = dot(q->a, q->b), ah = dot(q->a, q->h), bh = dot(q->b, q->h),
         hh = dot(q->h, q->h), qq = mode & MODE_BIOT ? dot(q->q, q->q) : pack_of(0.0), more = (2.0 / 3.0) * qq;
#pragma GCC unroll 4
    for (int i = 0; i < QUAD_POINTS; i++) {
        PackTensor g = {aa + eta[i] * (2.0 * ah + eta[i] * hh), bb + xi[i] * (2.0 * bh + xi[i] * hh),
                        (ab + xi[i] * ah) + (eta[i] * bh + (xi[i] * eta[i]) * hh)};
        if (mode & MODE_BIOT) {
            g.a11 += more;
            g.a22 += more;
            g.a12 -= (1.0 + xi[i] * eta[i]) * qq;
        }
        p[i].c = material_metric(points + i * GEOMETRY_POINT_SIZE * LANES, g);
    }
}

/* Adds the force along q, conjugate to q.q (eq. E7a), to those of a, b and h. */
ALWAYS_INLINE void add_fold_force(Pack normal, Pack shear, const QuadPack *q, Pack qa[3], Pack qb[3], Pack qh[3])
{
    Pack fold = (2.0 / 3.0) * normal - 2.0 * shear;
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack along = fold * q->q[k];
        qa[k] -= q->skew1 * along;
        qb[k] -= q->skew2 * along;
        qh[k] += along;
    }
}

/* Weighted sums of the natural stresses of the points give all that the forces need (eq. E7). */
ALWAYS_INLINE void quad_stress_forces(int mode, const PointPack *p, const double xi[], const double eta[], QuadPack *q)
{
    const Pack zero = pack_of(0.0);
    Pack aa = zero, ab = zero, bb = zero, ah = zero, bh = zero, hh = zero, twist = zero, qa[3], qb[3], qh[3];
#pragma GCC unroll 4
    for (int i = 0; i < QUAD_POINTS; i++) {
        Pack u = eta[i] * p[i].p.a11 + xi[i] * p[i].p.a12, w = eta[i] * p[i].p.a12 + xi[i] * p[i].p.a22;
        aa += p[i].p.a11;
        ab += p[i].p.a12;
        bb += p[i].p.a22;
        ah += u;
        bh += w;
        hh += eta[i] * u + xi[i] * w;
        if (mode & MODE_BIOT) twist += (1.0 + xi[i] * eta[i]) * p[i].p.a12;
    }
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack a = q->a[k], b = q->b[k], h = q->h[k];
        qa[k] = aa * a + ab * b + ah * h;
        qb[k] = ab * a + bb * b + bh * h;
        qh[k] = ah * a + bh * b + hh * h;
    }
    if (mode & MODE_BIOT) add_fold_force(aa + bb, twist, q, qa, qb, qh);
    quad_forces(qa, qb, qh, q);
}

ALWAYS_INLINE void quad_full_pack(int mode, const KernelInput *input, const LawInput *in, int block, int pack,
                                  PackSums *sums)
{
    const double gauss = 0.57735026918962576, xi[] = {-gauss, gauss, gauss, -gauss},
                 eta[] = {-gauss, -gauss, gauss, gauss};
    ElementPlace place = find_place(input, block, pack, 4, QUAD_POINTS);
    QuadPack q;
    PointPack p[QUAD_POINTS];
    PointPlace point[QUAD_POINTS];
    for (int i = 0; i < QUAD_POINTS; i++) point[i] = point_place(&place, i);
    quad_gradients(input, &place, &q);
    if (mode & MODE_BIOT) free_hourglass(place.tail + GEOMETRY_TAIL_SIZE * LANES, &q);
    quad_metrics(mode, place.geometry, &q, xi, eta, p);
    natural_stress(mode, in, QUAD_POINTS, point, p);
    quad_stress_forces(mode, p, xi, eta, &q);
    quad_area(lane_values(place.tail, GEOMETRY_SIGN), pack, &q, sums);
    quad_add(input, &place, &q);
    p[0].energy = (p[0].energy + p[1].energy) + (p[2].energy + p[3].energy);
    p[0].viscous = (p[0].viscous + p[1].viscous) + (p[2].viscous + p[3].viscous);
    p[0].rate = pack_larger(pack_larger(p[0].rate, p[1].rate), pack_larger(p[2].rate, p[3].rate));
    sum_point(input, block, pack, &p[0], sums);
}

ALWAYS_INLINE void quad_full_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const LawInput in = make_law_input(input);
    PackSums packs = {0};
    for (int block = input->first_block; block < input->end_block; block++)
        for (int i = 0; i < PACKS; i++) quad_full_pack(mode, input, &in, block, i, &packs);
    finish_sums(&packs, sums);
}

static void kernel_quad_full(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) quad_full_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* What holds the one-point quad's hourglass vector q in the plane (eq. E18). */
typedef struct HourglassPack {
    Pack hold1, hold2;
} HourglassPack;

/* The mean metric g11 = a.a + q.q/3, so that transverse hourglass modes are held by the stress (eq. E17), in-plane ones
 * by the modulus QH (eq. E18). */
ALWAYS_INLINE PackTensor one_point_metric(const double *constant, QuadPack *quad, int pack, HourglassPack *glass,
                                          PackSums *sums)
{
    free_hourglass(constant, quad);
    Pack third = dot(quad->q, quad->q) * (1.0 / 3.0), r1 = dot(quad->q, quad->a), r2 = dot(quad->q, quad->b);
    glass->hold1 = lane_values(constant, GEOMETRY_HOURGLASS1) * r1;
    glass->hold2 = lane_values(constant, GEOMETRY_HOURGLASS2) * r2;
    sums->hourglass.part[pack % SUM_PACKS] += 0.5 * (glass->hold1 * r1 + glass->hold2 * r2);
    PackTensor g = {dot(quad->a, quad->a) + third, dot(quad->b, quad->b) + third, dot(quad->a, quad->b)};
    return g;
}

ALWAYS_INLINE void one_point_forces(const PackTensor *p, const HourglassPack *glass, QuadPack *quad)
{
    Pack third = (p->a11 + p->a22) * (1.0 / 3.0), qa[3], qb[3], qh[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack a = quad->a[k], b = quad->b[k], hold = glass->hold1 * a + glass->hold2 * b + third * quad->q[k];
        qa[k] = p->a11 * a + p->a12 * b + glass->hold1 * quad->q[k] - quad->skew1 * hold;
        qb[k] = p->a12 * a + p->a22 * b + glass->hold2 * quad->q[k] - quad->skew2 * hold;
        qh[k] = hold;
    }
    quad_forces(qa, qb, qh, quad);
}

ALWAYS_INLINE void quad_one_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const LawInput in = make_law_input(input);
    PackSums packs = {0};
    for (int block = input->first_block; block < input->end_block; block += BLOCKS_AT_ONCE) {
        QuadPack quad[STREAMS];
        HourglassPack glass[STREAMS];
        PointPack p[STREAMS];
        PointPlace point[STREAMS];
        ElementPlace place[STREAMS];
        int streams = count_streams(input, block);
        for (int i = 0; i < streams; i++) {
            place[i] = find_place(input, block + i / PACKS, i % PACKS, 4, 1);
            const double *tail = place[i].tail;
            point[i] = point_place(&place[i], 0);
            quad_gradients(input, &place[i], &quad[i]);
            quad_area(lane_values(tail, GEOMETRY_SIGN), i, &quad[i], &packs);
            p[i].c = material_metric(
                place[i].geometry, one_point_metric(tail + GEOMETRY_TAIL_SIZE * LANES, &quad[i], i, &glass[i], &packs));
        }
        natural_stress(mode, &in, streams, point, p);
        for (int i = 0; i < streams; i++) {
            one_point_forces(&p[i].p, &glass[i], &quad[i]);
            quad_add(input, &place[i], &quad[i]);
            sum_point(input, block + i / PACKS, i % PACKS, &p[i], &packs);
        }
    }
    finish_sums(&packs, sums);
}

static void kernel_quad_one(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) quad_one_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

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

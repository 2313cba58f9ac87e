/* Element kernels for one instruction set: this file is compiled once per set, with BILLOW_KERNEL_TABLE naming its
 * table.
 *
 * A kernel walks over whole blocks of BILLOW_LANES elements: gather the corners, metric, stress (kernel_stages.h),
 * corner records. Sums run over the lanes in order. Equations: docs/theory.md, Elements. */
#include "elements/kernels.h"

#include "elements/kernel_stages.h"

extern const KernelTable BILLOW_KERNEL_TABLE;

/* Corner coordinates of one block: [corner][axis]. */
typedef struct Corners {
    Lane x[4][3];
} Corners;

ALWAYS_INLINE void gather_corners(const ElementGroup *group, int block, const double *restrict x, int corners,
                                  Corners *restrict c)
{
    const int32_t *node = group->node + (size_t)block * (size_t)corners * LANES;
    for (int a = 0; a < corners; a++) {
        for (int l = 0; l < LANES; l++) {
            const double *p = x + 3 * (ptrdiff_t)node[a * LANES + l];
            c->x[a][0][l] = p[0];
            c->x[a][1][l] = p[1];
            c->x[a][2][l] = p[2];
        }
    }
}

/* Lane values to records of size values per element: forces of the corners and area vectors. */
ALWAYS_INLINE void write_records(int size, Lane *restrict from, double *restrict record)
{
    for (int l = 0; l < LANES; l++)
#pragma GCC unroll 24
        for (int k = 0; k < size; k++) record[size * l + k] = from[k][l];
}

/* Eight partial sums, then a tree: the same order in every instruction set. */
ALWAYS_INLINE double sum_lanes(const double *restrict lane)
{
    double part[8] = {0};
    for (int i = 0; i < LANES; i += 8)
#pragma omp simd
        for (int j = 0; j < 8; j++) part[j] += lane[i + j];
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

/* The largest of the lanes and a number; not a number wins. */
ALWAYS_INLINE double largest_lane(const double *restrict lane, double largest)
{
    double part[8];
    for (int j = 0; j < 8; j++) part[j] = lane[j];
    for (int i = 8; i < LANES; i += 8)
#pragma omp simd
        for (int j = 0; j < 8; j++) part[j] = part[j] >= lane[i + j] ? part[j] : lane[i + j];
    for (int j = 0; j < 8; j++) largest = part[j] > largest || part[j] != part[j] ? part[j] : largest;
    return largest;
}

static void copy_rates(const KernelInput *input, int block, const double *rate)
{
    double *out = input->lane_rate + input->group->first_element + (ptrdiff_t)block * LANES;
    for (int l = 0; l < LANES; l++) out[l] = rate[l];
}

/* Sums of one block: volume under it and area from the area vectors s = sum over corners of the shares. */
ALWAYS_INLINE void sum_block(const KernelInput *input, int block, const double *under, const double *area,
                             const PointLanes *p, ChunkSums *sums)
{
    sums->volume += sum_lanes(under);
    sums->area += sum_lanes(area);
    if (!p) return;
    sums->energy += sum_lanes(p->energy);
    sums->viscous += sum_lanes(p->viscous);
    sums->rate = largest_lane(p->rate, sums->rate);
    if (input->lane_rate) copy_rates(input, block, p->rate);
}

static LawInput make_law_input(const KernelInput *input)
{
    const ElementGroup *group = input->group;
    LawInput in = {
        .law = group->material, .inverse_step = input->inverse_step, .count_work = input->restart_ledger ? 0.0 : 1.0};
    if (group->law == LAW_GREEN && in.law.no_compression) in.compliance = make_compliance(&in.law.fabric);
    return in;
}

static int kernel_mode(const ElementGroup *group)
{
    int mode = group->history_size > 0 ? MODE_HISTORY : 0;
    if (group->law == LAW_LOGARITHMIC) mode |= MODE_LOGARITHMIC;
    if (group->material.no_compression) mode |= MODE_TENSION_FIELD;
    if (group->material.has_liner) mode |= MODE_LINER;
    return mode;
}

/* Calls WORK with the mode as a constant. A logarithmic law always has a history. */
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
    default:                                                                                                           \
        WORK(15);                                                                                                      \
        break;                                                                                                         \
    }

/* ---- triangles ---- */

/* Edges (eq. E1). */
ALWAYS_INLINE void triangle_edges(Corners *restrict c, Lane *restrict e)
{
    for (int k = 0; k < 3; k++) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            e[k][l] = c->x[1][k][l] - c->x[0][k][l];
            e[3 + k][l] = c->x[2][k][l] - c->x[0][k][l];
        }
    }
}

/* C = F^T F with F = e M formed first: the metric of a sliver's edges would lose the square of its aspect in digits. */
ALWAYS_INLINE void triangle_strain(Lane *restrict e, const double *restrict point, PointLanes *restrict p)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double m11 = point[GEOMETRY_M11 * LANES + l], m12 = point[GEOMETRY_M12 * LANES + l],
               m21 = point[GEOMETRY_M21 * LANES + l], m22 = point[GEOMETRY_M22 * LANES + l];
        double f1[3], f2[3];
#pragma GCC unroll 3
        for (int k = 0; k < 3; k++) {
            f1[k] = m11 * e[k][l] + m21 * e[3 + k][l];
            f2[k] = m12 * e[k][l] + m22 * e[3 + k][l];
        }
        p->c11[l] = f1[0] * f1[0] + f1[1] * f1[1] + f1[2] * f1[2];
        p->c22[l] = f2[0] * f2[0] + f2[1] * f2[1] + f2[2] * f2[2];
        p->c12[l] = f1[0] * f2[0] + f1[1] * f2[1] + f1[2] * f2[2];
    }
}

/* Area vector share S/3 per corner (eq. E8), volume under the facet. */
ALWAYS_INLINE void triangle_area(Corners *restrict c, Lane *restrict e, const double *restrict sign,
                                 const double *restrict origin, Lane *restrict share, double *restrict under,
                                 double *restrict area)
{
    const double o0 = origin[0], o1 = origin[1], o2 = origin[2];
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double sixth = (1.0 / 6.0) * sign[l];
        double s0 = sixth * (e[1][l] * e[5][l] - e[2][l] * e[4][l]),
               s1 = sixth * (e[2][l] * e[3][l] - e[0][l] * e[5][l]),
               s2 = sixth * (e[0][l] * e[4][l] - e[1][l] * e[3][l]);
        share[0][l] = s0;
        share[1][l] = s1;
        share[2][l] = s2;
        under[l] = (c->x[0][0][l] - o0) * s0 + (c->x[0][1][l] - o1) * s1 + (c->x[0][2][l] - o2) * s2;
        area[l] = 3.0 * sqrt(s0 * s0 + s1 * s1 + s2 * s2);
    }
}

/* Corner forces: f2 = -(p11 e1 + p12 e2), f3 = -(p12 e1 + p22 e2), f1 the rest (eq. E6). */
ALWAYS_INLINE void triangle_forces(Lane *restrict e, const PointLanes *restrict p, Lane *restrict f)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
#pragma GCC unroll 3
        for (int k = 0; k < 3; k++) {
            double f2 = -(p->p11[l] * e[k][l] + p->p12[l] * e[3 + k][l]),
                   f3 = -(p->p12[l] * e[k][l] + p->p22[l] * e[3 + k][l]);
            f[k][l] = -(f2 + f3);
            f[3 + k][l] = f2;
            f[6 + k][l] = f3;
        }
    }
}

ALWAYS_INLINE void triangle_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    const LawInput in = make_law_input(input);
    PointLanes p;
    for (int l = 0; l < LANES; l++) p.energy[l] = p.viscous[l] = 0.0;
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        Lane e[6], record[TRIANGLE_RECORD], under, area;
        const double *point = group->geometry + (size_t)block * (size_t)group->geometry_size * LANES;
        const double *tail = point + GEOMETRY_POINT_SIZE * LANES;
        double *history = input->history + group->history_offset + (size_t)block * (size_t)group->history_size * LANES;
        gather_corners(group, block, input->x, 3, &c);
        triangle_edges(&c, e);
        triangle_strain(e, point, &p);
        natural_stress(mode, &in, point, tail, history, &p);
        triangle_forces(e, &p, record);
        triangle_area(&c, e, tail + GEOMETRY_SIGN * LANES, input->origin, record + 9, under, area);
        write_records(TRIANGLE_RECORD, record,
                      input->corner + group->corner_offset + (size_t)block * TRIANGLE_RECORD * LANES);
        sum_block(input, block, under, area, &p, sums);
    }
}

static void kernel_triangle(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) triangle_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* ---- quadrilaterals ---- */

/* Natural gradients of a bilinear quad: x_xi = a + eta h, x_eta = b + xi h (eq. E2), and their products. */
typedef struct Gradients {
    Lane a[3], b[3], h[3], centre[3];
    Lane aa, bb, ab, ah, bh, hh;
} Gradients;

ALWAYS_INLINE void quad_gradients(Corners *restrict c, Gradients *restrict g)
{
    for (int k = 0; k < 3; k++) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double x1 = c->x[0][k][l], x2 = c->x[1][k][l], x3 = c->x[2][k][l], x4 = c->x[3][k][l];
            g->a[k][l] = 0.25 * ((x2 - x1) + (x3 - x4));
            g->b[k][l] = 0.25 * ((x4 - x1) + (x3 - x2));
            g->h[k][l] = 0.25 * ((x1 - x2) + (x3 - x4));
            g->centre[k][l] = 0.25 * ((x1 + x2) + (x3 + x4));
        }
    }
}

ALWAYS_INLINE double lane_dot(Lane *a, Lane *b, int l)
{
    return a[0][l] * b[0][l] + a[1][l] * b[1][l] + a[2][l] * b[2][l];
}

ALWAYS_INLINE void quad_products(Gradients *restrict g)
{
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        g->aa[l] = lane_dot(g->a, g->a, l);
        g->bb[l] = lane_dot(g->b, g->b, l);
        g->ab[l] = lane_dot(g->a, g->b, l);
        g->ah[l] = lane_dot(g->a, g->h, l);
        g->bh[l] = lane_dot(g->b, g->h, l);
        g->hh[l] = lane_dot(g->h, g->h, l);
    }
}

/* Corner forces from the forces conjugate to a, b and h (eq. E7). */
ALWAYS_INLINE void quad_forces(Lane *restrict qa, Lane *restrict qb, Lane *restrict qh, Lane *restrict f)
{
    for (int k = 0; k < 3; k++) {
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double fa = 0.25 * qa[k][l], fb = 0.25 * qb[k][l], fh = 0.25 * qh[k][l];
            f[k][l] = (fa + fb) - fh;
            f[3 + k][l] = (fb - fa) + fh;
            f[6 + k][l] = -((fa + fb) + fh);
            f[9 + k][l] = (fa - fb) + fh;
        }
    }
}

/* Pressure shares of the bilinear patch (eq. E9), its volume and area. */
ALWAYS_INLINE void quad_area(Gradients *restrict g, const double *restrict sign, const double *restrict origin,
                             Lane *restrict share, double *restrict under, double *restrict area)
{
    Lane n[3];
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double s = sign[l], third = (1.0 / 3.0) * s;
            double normal = s * (g->a[i][l] * g->b[j][l] - g->a[j][l] * g->b[i][l]);
            double na = third * (g->a[i][l] * g->h[j][l] - g->a[j][l] * g->h[i][l]);
            double nb = third * (g->h[i][l] * g->b[j][l] - g->h[j][l] * g->b[i][l]);
            n[k][l] = normal;
            share[k][l] = normal - (na + nb);
            share[3 + k][l] = normal + (na - nb);
            share[6 + k][l] = normal + (na + nb);
            share[9 + k][l] = normal - (na - nb);
        }
    }
    const double o0 = origin[0], o1 = origin[1], o2 = origin[2];
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double n0 = n[0][l], n1 = n[1][l], n2 = n[2][l];
        under[l] =
            (4.0 / 3.0) * ((g->centre[0][l] - o0) * n0 + (g->centre[1][l] - o1) * n1 + (g->centre[2][l] - o2) * n2);
        area[l] = 4.0 * sqrt(n0 * n0 + n1 * n1 + n2 * n2);
    }
}

/* Weighted sums of the natural stresses of the points: all that the forces need. */
typedef struct StressSums {
    Lane aa, ab, bb, ah, bh, hh, energy, viscous, rate;
} StressSums;

/* One of the four points. */
ALWAYS_INLINE void quad_point(int mode, const LawInput *in, Gradients *restrict g, double xi, double eta,
                              const double *restrict point, const double *restrict tail, double *restrict history,
                              StressSums *restrict t)
{
    PointLanes p;
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        p.g11[l] = g->aa[l] + eta * (2.0 * g->ah[l] + eta * g->hh[l]);
        p.g22[l] = g->bb[l] + xi * (2.0 * g->bh[l] + xi * g->hh[l]);
        p.g12[l] = g->ab[l] + xi * g->ah[l] + eta * g->bh[l] + xi * eta * g->hh[l];
        p.energy[l] = p.viscous[l] = 0.0;
    }
    stage_metric(point, &p);
    natural_stress(mode, in, point, tail, history, &p);
#pragma omp simd
    for (int l = 0; l < LANES; l++) {
        double u = eta * p.p11[l] + xi * p.p12[l], w = eta * p.p12[l] + xi * p.p22[l];
        t->aa[l] += p.p11[l];
        t->ab[l] += p.p12[l];
        t->bb[l] += p.p22[l];
        t->ah[l] += u;
        t->bh[l] += w;
        t->hh[l] += eta * u + xi * w;
        t->energy[l] += p.energy[l];
        t->viscous[l] += p.viscous[l];
        t->rate[l] = larger(t->rate[l], p.rate[l]);
    }
}

ALWAYS_INLINE void quad_full_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const double gauss = 0.57735026918962576;
    const ElementGroup *group = input->group;
    const LawInput in = make_law_input(input);
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        Gradients g;
        StressSums t = {0};
        Lane qa[3], qb[3], qh[3], record[QUAD_RECORD], under, area;
        const double *points = group->geometry + (size_t)block * (size_t)group->geometry_size * LANES;
        const double *tail = points + 4 * GEOMETRY_POINT_SIZE * LANES;
        double *history = input->history + group->history_offset + (size_t)block * (size_t)group->history_size * LANES;
        gather_corners(group, block, input->x, 4, &c);
        quad_gradients(&c, &g);
        quad_products(&g);
        for (int i = 0; i < 4; i++)
            quad_point(mode, &in, &g, i == 1 || i == 2 ? gauss : -gauss, i >= 2 ? gauss : -gauss,
                       points + i * GEOMETRY_POINT_SIZE * LANES, tail, history + i * HISTORY_POINT_SIZE * LANES, &t);
        for (int k = 0; k < 3; k++) {
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                double a = g.a[k][l], b = g.b[k][l], h = g.h[k][l];
                qa[k][l] = t.aa[l] * a + t.ab[l] * b + t.ah[l] * h;
                qb[k][l] = t.ab[l] * a + t.bb[l] * b + t.bh[l] * h;
                qh[k][l] = t.ah[l] * a + t.bh[l] * b + t.hh[l] * h;
            }
        }
        quad_forces(qa, qb, qh, record);
        quad_area(&g, tail + GEOMETRY_SIGN * LANES, input->origin, record + 12, under, area);
        write_records(QUAD_RECORD, record, input->corner + group->corner_offset + (size_t)block * QUAD_RECORD * LANES);
        sum_block(input, block, under, area, NULL, sums);
        sums->energy += sum_lanes(t.energy);
        sums->viscous += sum_lanes(t.viscous);
        sums->rate = largest_lane(t.rate, sums->rate);
        if (input->lane_rate) copy_rates(input, block, t.rate);
    }
}

static void kernel_quad_full(const KernelInput *input, ChunkSums *sums){
#define WORK(mode) quad_full_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* One point on the mean metric, with q = h - its affine part: g11 = a.a + q.q/3 (eq. E17), so that transverse hourglass
 * modes are held by the stress, in-plane ones by the modulus QH (eq. E18). */
ALWAYS_INLINE void quad_one_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    const LawInput in = make_law_input(input);
    PointLanes p;
    for (int l = 0; l < LANES; l++) p.energy[l] = p.viscous[l] = 0.0;
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        Gradients g;
        Lane q[3], r1, r2, hold1, hold2, third, qa[3], qb[3], qh[3], record[QUAD_RECORD], under, area, glass;
        const double *point = group->geometry + (size_t)block * (size_t)group->geometry_size * LANES;
        const double *tail = point + GEOMETRY_POINT_SIZE * LANES, *constant = tail + GEOMETRY_TAIL_SIZE * LANES;
        const double *skew1 = constant + GEOMETRY_SKEW1 * LANES, *skew2 = constant + GEOMETRY_SKEW2 * LANES;
        double *history = input->history + group->history_offset + (size_t)block * (size_t)group->history_size * LANES;
        gather_corners(group, block, input->x, 4, &c);
        quad_gradients(&c, &g);
        for (int k = 0; k < 3; k++)
#pragma omp simd
            for (int l = 0; l < LANES; l++) q[k][l] = g.h[k][l] - (skew1[l] * g.a[k][l] + skew2[l] * g.b[k][l]);
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double qq = lane_dot(q, q, l) * (1.0 / 3.0);
            p.g11[l] = lane_dot(g.a, g.a, l) + qq;
            p.g22[l] = lane_dot(g.b, g.b, l) + qq;
            p.g12[l] = lane_dot(g.a, g.b, l);
            r1[l] = lane_dot(q, g.a, l);
            r2[l] = lane_dot(q, g.b, l);
            hold1[l] = constant[GEOMETRY_HOURGLASS1 * LANES + l] * r1[l];
            hold2[l] = constant[GEOMETRY_HOURGLASS2 * LANES + l] * r2[l];
            glass[l] = 0.5 * (hold1[l] * r1[l] + hold2[l] * r2[l]);
        }
        stage_metric(point, &p);
        natural_stress(mode, &in, point, tail, history, &p);
        for (int l = 0; l < LANES; l++) third[l] = (p.p11[l] + p.p22[l]) * (1.0 / 3.0);
        for (int k = 0; k < 3; k++) {
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                double a = g.a[k][l], b = g.b[k][l], hold = hold1[l] * a + hold2[l] * b + third[l] * q[k][l];
                qa[k][l] = p.p11[l] * a + p.p12[l] * b + hold1[l] * q[k][l] - skew1[l] * hold;
                qb[k][l] = p.p12[l] * a + p.p22[l] * b + hold2[l] * q[k][l] - skew2[l] * hold;
                qh[k][l] = hold;
            }
        }
        quad_forces(qa, qb, qh, record);
        quad_area(&g, tail + GEOMETRY_SIGN * LANES, input->origin, record + 12, under, area);
        write_records(QUAD_RECORD, record, input->corner + group->corner_offset + (size_t)block * QUAD_RECORD * LANES);
        sum_block(input, block, under, area, &p, sums);
        sums->hourglass += sum_lanes(glass);
    }
}

static void kernel_quad_one(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) quad_one_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* ---- surfaces without stress ---- */

static void kernel_surface(const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    bool triangle = group->corner_count == 3;
    const int size = triangle ? TRIANGLE_RECORD : QUAD_RECORD;
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        Gradients g;
        Lane e[6], under, area, record[QUAD_RECORD] = {{0}};
        const double *sign = group->geometry + (size_t)block * LANES;
        double *out = input->corner + group->corner_offset + (size_t)block * (size_t)size * LANES;
        gather_corners(group, block, input->x, group->corner_count, &c);
        if (triangle) {
            triangle_edges(&c, e);
            triangle_area(&c, e, sign, input->origin, record + 9, under, area);
            write_records(TRIANGLE_RECORD, record, out);
        } else {
            quad_gradients(&c, &g);
            quad_area(&g, sign, input->origin, record + 12, under, area);
            write_records(QUAD_RECORD, record, out);
        }
        sum_block(input, block, under, area, NULL, sums);
    }
}

const KernelTable BILLOW_KERNEL_TABLE = {BILLOW_KERNEL_LEVEL, kernel_surface, kernel_triangle, kernel_quad_full,
                                         kernel_quad_one};

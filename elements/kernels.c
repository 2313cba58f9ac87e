/* Element kernels for one instruction set: this file is compiled once per set, with BILLOW_KERNEL_TABLE naming its table.
 *
 * A kernel walks over whole blocks of BILLOW_LANES elements. Everything between gathering the nodes and writing the
 * corners is one vector loop; sums run over the lanes in order. Equations: docs/theory.md, Elements. */
#include "elements/kernels.h"

#include "elements/kernel_law.h"

enum { LANES = BILLOW_LANES };

extern const KernelTable BILLOW_KERNEL_TABLE;

/* Corner coordinates of one block. */
typedef struct Corners {
    double x[4][3][LANES];
} Corners;

static inline void gather_corners(const ElementGroup *group, int block, const double *x, int corners, Corners *c)
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

/* Lane results that are summed. */
typedef struct LaneSums {
    double volume[LANES], area[LANES], energy[LANES], viscous[LANES], hourglass[LANES], rate[LANES];
} LaneSums;

static inline void add_lanes(const LaneSums *lanes, ChunkSums *sums)
{
    double volume = 0.0, area = 0.0, energy = 0.0, viscous = 0.0, hourglass = 0.0, rate = sums->rate;
    for (int l = 0; l < LANES; l++) {
        volume += lanes->volume[l];
        area += lanes->area[l];
        energy += lanes->energy[l];
        viscous += lanes->viscous[l];
        hourglass += lanes->hourglass[l];
        rate = lanes->rate[l] > rate ? lanes->rate[l] : rate;
    }
    sums->volume += volume;
    sums->area += area;
    sums->energy += energy;
    sums->viscous += viscous;
    sums->hourglass += hourglass;
    sums->rate = rate;
}

/* Law, damping and ledger of one point in one lane (eq. E10 to E16). point and history: first lane of the point's
 * constants and history. Returns the stress in natural directions times the weight. */
typedef struct NaturalStress {
    double p11, p22, p12; /* weight x M S M^T */
    double energy, viscous, rate;
} NaturalStress;

typedef struct LawInput {
    FabricLaw law;
    Compliance compliance;
    double inverse_step;
    double count_work; /* 1, or 0 when histories are only filled */
} LawInput;

/* What a kernel does besides the law; a constant of each vector loop, so that the loop has no branch. */
enum {
    MODE_LOGARITHMIC = 1, /* else Green */
    MODE_TENSION_FIELD = 2,
    MODE_LINER = 4,
    MODE_HISTORY = 8, /* strain and stress of the last step are kept: stress-work ledger, damping */
};

ALWAYS_INLINE NaturalStress natural_stress(int mode, const LawInput *in, const double *point, const double *tail,
                                           double *history, int l, double g11, double g22, double g12)
{
    double m11 = point[GEOMETRY_M11 * LANES + l], m12 = point[GEOMETRY_M12 * LANES + l],
           m21 = point[GEOMETRY_M21 * LANES + l], m22 = point[GEOMETRY_M22 * LANES + l],
           weight = point[GEOMETRY_WEIGHT * LANES + l];
    Tensor2 c = {m11 * m11 * g11 + 2.0 * m11 * m21 * g12 + m21 * m21 * g22,
                 m12 * m12 * g11 + 2.0 * m12 * m22 * g12 + m22 * m22 * g22,
                 m11 * m12 * g11 + (m11 * m22 + m12 * m21) * g12 + m21 * m22 * g22};
    bool field = mode & MODE_TENSION_FIELD, liner = mode & MODE_LINER;
    PointResult r = mode & MODE_LOGARITHMIC ? logarithmic_point(&in->law, field, liner, c)
                                            : green_point(&in->law, &in->compliance, field, liner, c);
    NaturalStress result;
    Tensor2 s = r.stress;
    result.energy = weight * r.energy;
    result.viscous = 0.0;
    result.rate = r.stretch * tail[GEOMETRY_RATE * LANES + l] + r.tension * tail[GEOMETRY_STRESS_RATE * LANES + l];
    if (mode & MODE_HISTORY) {
        Tensor2 e = green_strain(c);
        Tensor2 de = {e.a11 - history[0 * LANES + l], e.a22 - history[1 * LANES + l], e.a12 - history[2 * LANES + l]};
        double factor = tail[GEOMETRY_VISCOSITY * LANES + l] * in->inverse_step;
        Tensor2 strain_rate = {factor * de.a11, factor * de.a22, factor * de.a12};
        Tensor2 viscous = apply_moduli(&in->law.whole, strain_rate);
        s.a11 += viscous.a11;
        s.a22 += viscous.a22;
        s.a12 += viscous.a12;
        Tensor2 mean = {0.5 * (s.a11 + history[3 * LANES + l]), 0.5 * (s.a22 + history[4 * LANES + l]),
                        0.5 * (s.a12 + history[5 * LANES + l])};
        double work = in->count_work * (weight * contract(mean, de));
        if (mode & MODE_LOGARITHMIC) {
            result.energy = work;
        } else {
            result.viscous = work; /* less the stored energy's change this is what was dissipated */
        }
        history[0 * LANES + l] = e.a11;
        history[1 * LANES + l] = e.a22;
        history[2 * LANES + l] = e.a12;
        history[3 * LANES + l] = s.a11;
        history[4 * LANES + l] = s.a22;
        history[5 * LANES + l] = s.a12;
    }
    result.p11 = weight * (m11 * m11 * s.a11 + 2.0 * m11 * m12 * s.a12 + m12 * m12 * s.a22);
    result.p22 = weight * (m21 * m21 * s.a11 + 2.0 * m21 * m22 * s.a12 + m22 * m22 * s.a22);
    result.p12 = weight * (m11 * m21 * s.a11 + (m11 * m22 + m12 * m21) * s.a12 + m12 * m22 * s.a22);
    return result;
}

static LawInput make_law_input(const KernelInput *input)
{
    const ElementGroup *group = input->group;
    LawInput in = {.law = group->material,
                   .inverse_step = input->inverse_step,
                   .count_work = input->restart_ledger ? 0.0 : 1.0};
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
    case 0: WORK(0); break;                                                                                            \
    case 2: WORK(2); break;                                                                                            \
    case 4: WORK(4); break;                                                                                            \
    case 6: WORK(6); break;                                                                                            \
    case 8: WORK(8); break;                                                                                            \
    case 10: WORK(10); break;                                                                                          \
    case 12: WORK(12); break;                                                                                          \
    case 14: WORK(14); break;                                                                                          \
    case 9: WORK(9); break;                                                                                            \
    case 11: WORK(11); break;                                                                                          \
    case 13: WORK(13); break;                                                                                          \
    default: WORK(15); break;                                                                                          \
    }

/* ---- triangles ---- */

/* Corner forces of a triangle from the natural stress: f2 = -(p11 e1 + p12 e2), f3 = -(p12 e1 + p22 e2), f1 the rest
 * (eq. E6); area vector share S/3 per corner (eq. E8). */
ALWAYS_INLINE void triangle_lane(int mode, const LawInput *in, const Corners *c, const double *point, const double *tail,
                                 double *history, double *corner, const double *origin, int l, LaneSums *lanes)
{
    double e1[3], e2[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        e1[k] = c->x[1][k][l] - c->x[0][k][l];
        e2[k] = c->x[2][k][l] - c->x[0][k][l];
    }
    double g11 = e1[0] * e1[0] + e1[1] * e1[1] + e1[2] * e1[2], g22 = e2[0] * e2[0] + e2[1] * e2[1] + e2[2] * e2[2],
           g12 = e1[0] * e2[0] + e1[1] * e2[1] + e1[2] * e2[2];
    NaturalStress p = natural_stress(mode, in, point, tail, history, l, g11, g22, g12);
    double half = 0.5 * tail[GEOMETRY_SIGN * LANES + l];
    double s[3] = {half * (e1[1] * e2[2] - e1[2] * e2[1]), half * (e1[2] * e2[0] - e1[0] * e2[2]),
                   half * (e1[0] * e2[1] - e1[1] * e2[0])};
    double under = 0.0;
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        double f2 = -(p.p11 * e1[k] + p.p12 * e2[k]), f3 = -(p.p12 * e1[k] + p.p22 * e2[k]);
        double share = s[k] * (1.0 / 3.0);
        under += (c->x[0][k][l] - origin[k]) * share;
        corner[(0 * CORNER_SIZE + k) * LANES + l] = -(f2 + f3);
        corner[(1 * CORNER_SIZE + k) * LANES + l] = f2;
        corner[(2 * CORNER_SIZE + k) * LANES + l] = f3;
        corner[(0 * CORNER_SIZE + 3 + k) * LANES + l] = share;
        corner[(1 * CORNER_SIZE + 3 + k) * LANES + l] = share;
        corner[(2 * CORNER_SIZE + 3 + k) * LANES + l] = share;
    }
    lanes->volume[l] = under;
    lanes->area[l] = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    lanes->energy[l] = p.energy;
    lanes->viscous[l] = p.viscous;
    lanes->rate[l] = p.rate;
}

static void copy_rates(const KernelInput *input, int block, const LaneSums *lanes)
{
    double *out = input->lane_rate + input->group->first_element + (ptrdiff_t)block * LANES;
    for (int l = 0; l < LANES; l++) out[l] = lanes->rate[l];
}

ALWAYS_INLINE void triangle_blocks(int mode, const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    const LawInput in = make_law_input(input);
    LaneSums lanes = {0};
    const double origin[3] = {input->origin[0], input->origin[1], input->origin[2]};
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        gather_corners(group, block, input->x, 3, &c);
        const double *point = group->geometry + (size_t)block * (size_t)group->geometry_size * LANES;
        const double *tail = point + GEOMETRY_POINT_SIZE * LANES;
        double *restrict history =
            input->history + group->history_offset + (size_t)block * (size_t)group->history_size * LANES;
        double *restrict corner = input->corner + group->corner_offset + (size_t)block * 3 * CORNER_SIZE * LANES;
#pragma omp simd
        for (int l = 0; l < LANES; l++) triangle_lane(mode, &in, &c, point, tail, history, corner, origin, l, &lanes);
        add_lanes(&lanes, sums);
        if (input->lane_rate) copy_rates(input, block, &lanes);
    }
}

static void kernel_triangle(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) triangle_blocks(mode, input, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* ---- quadrilaterals ---- */

/* Natural gradients of a bilinear quad: x_xi = a + eta h, x_eta = b + xi h (eq. E2). */
typedef struct Gradients {
    double a[3], b[3], h[3], centre[3];
} Gradients;

ALWAYS_INLINE Gradients quad_gradients(const Corners *c, int l)
{
    Gradients g;
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        double x1 = c->x[0][k][l], x2 = c->x[1][k][l], x3 = c->x[2][k][l], x4 = c->x[3][k][l];
        g.a[k] = 0.25 * ((x2 - x1) + (x3 - x4));
        g.b[k] = 0.25 * ((x4 - x1) + (x3 - x2));
        g.h[k] = 0.25 * ((x1 - x2) + (x3 - x4));
        g.centre[k] = 0.25 * ((x1 + x2) + (x3 + x4));
    }
    return g;
}

ALWAYS_INLINE double dot3(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Corner forces from the forces conjugate to a, b and h (eq. E7), the pressure shares of the bilinear patch (eq. E9) and
 * its volume and area. */
ALWAYS_INLINE void quad_corners(const Gradients *g, const double *qa, const double *qb, const double *qh, double sign,
                                const double *origin, double *corner, int l, LaneSums *lanes)
{
    double n[3], na[3], nb[3], under = 0.0;
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = sign * (g->a[i] * g->b[j] - g->a[j] * g->b[i]);
        na[k] = sign * (1.0 / 3.0) * (g->a[i] * g->h[j] - g->a[j] * g->h[i]);
        nb[k] = sign * (1.0 / 3.0) * (g->h[i] * g->b[j] - g->h[j] * g->b[i]);
    }
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        double fa = 0.25 * qa[k], fb = 0.25 * qb[k], fh = 0.25 * qh[k];
        under += (g->centre[k] - origin[k]) * n[k];
        corner[(0 * CORNER_SIZE + k) * LANES + l] = (fa + fb) - fh;
        corner[(1 * CORNER_SIZE + k) * LANES + l] = (fb - fa) + fh;
        corner[(2 * CORNER_SIZE + k) * LANES + l] = -((fa + fb) + fh);
        corner[(3 * CORNER_SIZE + k) * LANES + l] = (fa - fb) + fh;
        corner[(0 * CORNER_SIZE + 3 + k) * LANES + l] = n[k] - (na[k] + nb[k]);
        corner[(1 * CORNER_SIZE + 3 + k) * LANES + l] = n[k] + (na[k] - nb[k]);
        corner[(2 * CORNER_SIZE + 3 + k) * LANES + l] = n[k] + (na[k] + nb[k]);
        corner[(3 * CORNER_SIZE + 3 + k) * LANES + l] = n[k] - (na[k] - nb[k]);
    }
    lanes->volume[l] = (4.0 / 3.0) * under;
    lanes->area[l] = 4.0 * sqrt(dot3(n, n));
}

/* Full integration: four points; the forces conjugate to a, b, h need only weighted sums of the natural stresses. */
ALWAYS_INLINE void quad_full_lane(int mode, const LawInput *in, const Corners *c, const double *points, const double *tail,
                                  double *history, double *corner, const double *origin, int l, LaneSums *lanes)
{
    const double gauss = 0.57735026918962576;
    Gradients g = quad_gradients(c, l);
    double aa = dot3(g.a, g.a), bb = dot3(g.b, g.b), ab = dot3(g.a, g.b), ah = dot3(g.a, g.h), bh = dot3(g.b, g.h),
           hh = dot3(g.h, g.h);
    double saa = 0.0, sab = 0.0, sbb = 0.0, sah = 0.0, sbh = 0.0, shh = 0.0, energy = 0.0, viscous = 0.0, rate = 0.0;
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        double xi = (i == 1 || i == 2) ? gauss : -gauss, eta = i >= 2 ? gauss : -gauss;
        double g11 = aa + eta * (2.0 * ah + eta * hh), g22 = bb + xi * (2.0 * bh + xi * hh),
               g12 = ab + xi * ah + eta * bh + xi * eta * hh;
        NaturalStress p = natural_stress(mode, in, points + i * GEOMETRY_POINT_SIZE * LANES, tail,
                                         history + i * HISTORY_POINT_SIZE * LANES, l, g11, g22, g12);
        double u = eta * p.p11 + xi * p.p12, w = eta * p.p12 + xi * p.p22;
        saa += p.p11;
        sab += p.p12;
        sbb += p.p22;
        sah += u;
        sbh += w;
        shh += eta * u + xi * w;
        energy += p.energy;
        viscous += p.viscous;
        rate = larger(rate, p.rate);
    }
    double qa[3], qb[3], qh[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        qa[k] = saa * g.a[k] + sab * g.b[k] + sah * g.h[k];
        qb[k] = sab * g.a[k] + sbb * g.b[k] + sbh * g.h[k];
        qh[k] = sah * g.a[k] + sbh * g.b[k] + shh * g.h[k];
    }
    quad_corners(&g, qa, qb, qh, tail[GEOMETRY_SIGN * LANES + l], origin, corner, l, lanes);
    lanes->energy[l] = energy;
    lanes->viscous[l] = viscous;
    lanes->rate[l] = rate;
}

/* One point on the mean metric, with q = h - its affine part: g11 = a.a + q.q/3 (eq. E17), so that transverse hourglass
 * modes are held by the stress, in-plane ones by the modulus QH (eq. E18). */
ALWAYS_INLINE void quad_one_lane(int mode, const LawInput *in, const Corners *c, const double *point, const double *tail,
                                 double *history, double *corner, const double *origin, int l, LaneSums *lanes)
{
    Gradients g = quad_gradients(c, l);
    const double *glass = tail + GEOMETRY_TAIL_SIZE * LANES;
    double skew1 = glass[GEOMETRY_SKEW1 * LANES + l], skew2 = glass[GEOMETRY_SKEW2 * LANES + l];
    double q[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) q[k] = g.h[k] - (skew1 * g.a[k] + skew2 * g.b[k]);
    double qq = dot3(q, q) * (1.0 / 3.0);
    NaturalStress p = natural_stress(mode, in, point, tail, history, l, dot3(g.a, g.a) + qq, dot3(g.b, g.b) + qq,
                                     dot3(g.a, g.b));
    double r1 = dot3(q, g.a), r2 = dot3(q, g.b);
    double h1 = glass[GEOMETRY_HOURGLASS1 * LANES + l] * r1, h2 = glass[GEOMETRY_HOURGLASS2 * LANES + l] * r2;
    double third = (p.p11 + p.p22) * (1.0 / 3.0);
    double qa[3], qb[3], qh[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        double hold = h1 * g.a[k] + h2 * g.b[k] + third * q[k];
        qa[k] = p.p11 * g.a[k] + p.p12 * g.b[k] + h1 * q[k] - skew1 * hold;
        qb[k] = p.p12 * g.a[k] + p.p22 * g.b[k] + h2 * q[k] - skew2 * hold;
        qh[k] = hold;
    }
    quad_corners(&g, qa, qb, qh, tail[GEOMETRY_SIGN * LANES + l], origin, corner, l, lanes);
    lanes->energy[l] = p.energy;
    lanes->viscous[l] = p.viscous;
    lanes->hourglass[l] = 0.5 * (h1 * r1 + h2 * r2);
    lanes->rate[l] = p.rate;
}

ALWAYS_INLINE void quad_blocks(int mode, const KernelInput *input, bool full, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    const LawInput in = make_law_input(input);
    LaneSums lanes = {0};
    const double origin[3] = {input->origin[0], input->origin[1], input->origin[2]};
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        gather_corners(group, block, input->x, 4, &c);
        const double *points = group->geometry + (size_t)block * (size_t)group->geometry_size * LANES;
        const double *tail = points + (full ? 4 : 1) * GEOMETRY_POINT_SIZE * LANES;
        double *restrict history =
            input->history + group->history_offset + (size_t)block * (size_t)group->history_size * LANES;
        double *restrict corner = input->corner + group->corner_offset + (size_t)block * 4 * CORNER_SIZE * LANES;
        if (full) {
#pragma omp simd
            for (int l = 0; l < LANES; l++) quad_full_lane(mode, &in, &c, points, tail, history, corner, origin, l, &lanes);
        } else {
#pragma omp simd
            for (int l = 0; l < LANES; l++) quad_one_lane(mode, &in, &c, points, tail, history, corner, origin, l, &lanes);
        }
        add_lanes(&lanes, sums);
        if (input->lane_rate) copy_rates(input, block, &lanes);
    }
}

static void kernel_quad_full(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) quad_blocks(mode, input, true, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

static void kernel_quad_one(const KernelInput *input, ChunkSums *sums)
{
#define WORK(mode) quad_blocks(mode, input, false, sums)
    FOR_MODE(kernel_mode(input->group), WORK)
#undef WORK
}

/* ---- surfaces without stress ---- */

static void kernel_surface(const KernelInput *input, ChunkSums *sums)
{
    const ElementGroup *group = input->group;
    int corners = group->corner_count;
    LaneSums lanes = {0};
    for (int block = input->first_block; block < input->end_block; block++) {
        Corners c;
        gather_corners(group, block, input->x, corners, &c);
        const double *sign = group->geometry + (size_t)block * LANES;
        double *corner = input->corner + group->corner_offset + (size_t)block * (size_t)corners * CORNER_SIZE * LANES;
        const double none[3] = {0.0, 0.0, 0.0};
        for (int l = 0; l < LANES; l++) {
            if (corners == 4) {
                Gradients g = quad_gradients(&c, l);
                quad_corners(&g, none, none, none, sign[l], input->origin, corner, l, &lanes);
                continue;
            }
            double e1[3], e2[3], under = 0.0, square = 0.0;
        #pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
                e1[k] = c.x[1][k][l] - c.x[0][k][l];
                e2[k] = c.x[2][k][l] - c.x[0][k][l];
            }
        #pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
                int i = (k + 1) % 3, j = (k + 2) % 3;
                double s = 0.5 * sign[l] * (e1[i] * e2[j] - e1[j] * e2[i]), share = s * (1.0 / 3.0);
                under += (c.x[0][k][l] - input->origin[k]) * share;
                square += s * s;
                for (int a = 0; a < 3; a++) {
                    corner[(a * CORNER_SIZE + k) * LANES + l] = 0.0;
                    corner[(a * CORNER_SIZE + 3 + k) * LANES + l] = share;
                }
            }
            lanes.volume[l] = under;
            lanes.area[l] = sqrt(square);
        }
        add_lanes(&lanes, sums);
        if (input->lane_rate) copy_rates(input, block, &lanes);
    }
}

const KernelTable BILLOW_KERNEL_TABLE = {BILLOW_KERNEL_NAME, kernel_surface, kernel_triangle, kernel_quad_full,
                                         kernel_quad_one};

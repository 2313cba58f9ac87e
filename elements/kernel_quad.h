/* The 4-node membranes, of 2 x 2 points and of one with hourglass control (docs/theory.md, Elements). Included by
 * elements/kernels.c alone. */
#ifndef BILLOW_KERNEL_QUAD_H
#define BILLOW_KERNEL_QUAD_H

#include "elements/kernel_element.h"

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

/* Products of the natural gradients of (eq. E2), or forces conjugate to them. */
typedef struct QuadProducts {
    Pack aa, bb, ab, ah, bh, hh, qq;
} QuadProducts;

ALWAYS_INLINE QuadProducts quad_products(int mode, const QuadPack *q)
{
    QuadProducts of = {dot(q->a, q->a),
                       dot(q->b, q->b),
                       dot(q->a, q->b),
                       dot(q->a, q->h),
                       dot(q->b, q->h),
                       dot(q->h, q->h),
                       mode & MODE_BIOT ? dot(q->q, q->q) : pack_of(0.0)};
    return of;
}

/* Metrics at the points g11 = x_xi.x_xi ... in natural directions, linear in the products; FORM 0 and 1 fold freely
 * about the diagonal n1-n3 (eq. E4a). The points are at +-GAUSS: their metrics are sums and differences of a few terms.
 */
ALWAYS_INLINE void quad_metrics(int mode, const QuadProducts *of, PackTensor g[QUAD_POINTS])
{
    Pack a = (2.0 * BILLOW_GAUSS) * of->ah, b = (2.0 * BILLOW_GAUSS) * of->bh, third = (1.0 / 3.0) * of->hh,
         mean = third, same = of->ab + third, other = of->ab - third, sum = 0.5 * (a + b), difference = 0.5 * (a - b);
    if (mode & MODE_BIOT) {
        Pack free = (2.0 / 3.0) * of->qq;
        mean += free;
        same -= 2.0 * free;
        other -= free;
    }
    Pack aa = of->aa + mean, bb = of->bb + mean;
    g[0].a11 = g[1].a11 = aa - a;
    g[2].a11 = g[3].a11 = aa + a;
    g[0].a22 = g[3].a22 = bb - b;
    g[1].a22 = g[2].a22 = bb + b;
    g[0].a12 = same - sum;
    g[1].a12 = other + difference;
    g[2].a12 = same + sum;
    g[3].a12 = other - difference;
}

/* Weighted sums of the natural stresses of the points: the forces conjugate to the products, those to ab, ah and bh
 * halved (eq. E7, E7a). */
ALWAYS_INLINE QuadProducts quad_stresses(int mode, const PointPack *p)
{
    Pack low = p[0].p.a11 + p[1].p.a11, high = p[2].p.a11 + p[3].p.a11, left = p[0].p.a22 + p[3].p.a22,
         right = p[1].p.a22 + p[2].p.a22, same = p[0].p.a12 + p[2].p.a12, other = p[1].p.a12 + p[3].p.a12,
         along = p[2].p.a12 - p[0].p.a12, across = p[1].p.a12 - p[3].p.a12;
    QuadProducts of;
    of.aa = low + high;
    of.bb = left + right;
    of.ab = same + other;
    of.ah = BILLOW_GAUSS * ((high - low) + (along + across));
    of.bh = BILLOW_GAUSS * ((right - left) + (along - across));
    Pack plain = of.aa + of.bb, twist = same - other;
    of.hh = (1.0 / 3.0) * (plain + 2.0 * twist);
    of.qq = mode & MODE_BIOT ? (2.0 / 3.0) * (plain - twist) - 2.0 * of.ab : pack_of(0.0);
    return of;
}

/* Forces conjugate to the products times these. */
ALWAYS_INLINE Pack quad_contract(int mode, const QuadProducts *stress, const QuadProducts *of)
{
    Pack plain = stress->aa * of->aa + stress->bb * of->bb + stress->hh * of->hh;
    Pack mixed = stress->ab * of->ab + stress->ah * of->ah + stress->bh * of->bh;
    if (mode & MODE_BIOT) plain += stress->qq * of->qq;
    return plain + 2.0 * mixed;
}

/* Work of the stress in this step, and its history (eq. E14a). */
ALWAYS_INLINE Pack quad_work(int mode, const LawInput *in, const ElementPlace *place, const QuadProducts *change,
                             const QuadProducts *stress)
{
    float *kept = place->stress;
    QuadProducts sum = {sum_with_last(stress->aa, kept),
                        sum_with_last(stress->bb, kept + LANES),
                        sum_with_last(stress->ab, kept + 3 * LANES),
                        sum_with_last(stress->ah, kept + 4 * LANES),
                        sum_with_last(stress->bh, kept + 5 * LANES),
                        sum_with_last(stress->hh, kept + 2 * LANES),
                        mode & MODE_BIOT ? sum_with_last(stress->qq, kept + 6 * LANES) : pack_of(0.0)};
    return (0.25 * in->count_work) * quad_contract(mode, &sum, change);
}

/* Lets the share of the stress act that the account allows (eq. F7b). Returns the energy of the straight path. */
ALWAYS_INLINE Pack quad_limit(int mode, const LawInput *in, const ElementPlace *place, const QuadProducts *metric,
                              const QuadProducts *change, const PointPack *p, QuadProducts *stress)
{
    Pack trace = (p[0].trace + p[1].trace) + (p[2].trace + p[3].trace);
    Pack psi = 0.25 * (quad_contract(mode, stress, metric) - trace);
    Pack share = acting_share(in, place->account, psi, 0.5 * quad_contract(mode, stress, change));
    stress->aa *= share;
    stress->bb *= share;
    stress->ab *= share;
    stress->ah *= share;
    stress->bh *= share;
    stress->hh *= share;
    stress->qq *= share;
    return psi;
}

ALWAYS_INLINE QuadProducts change_of_products(int mode, const ElementPlace *place, const QuadProducts *of)
{
    double *kept = place->metric;
    QuadProducts change = {change_of(of->aa, kept),
                           change_of(of->bb, kept + LANES),
                           change_of(of->ab, kept + 2 * LANES),
                           change_of(of->ah, kept + 3 * LANES),
                           change_of(of->bh, kept + 4 * LANES),
                           change_of(of->hh, kept + 5 * LANES),
                           mode & MODE_BIOT ? change_of(of->qq, kept + 6 * LANES) : pack_of(0.0)};
    return change;
}

/* Corner forces of the stresses (eq. E7); the one conjugate to q.q acts along q (eq. E7a). */
ALWAYS_INLINE void quad_stress_forces(int mode, const QuadProducts *of, QuadPack *q)
{
    Pack qa[3], qb[3], qh[3];
#pragma GCC unroll 3
    for (int k = 0; k < 3; k++) {
        Pack a = q->a[k], b = q->b[k], h = q->h[k];
        qa[k] = of->aa * a + of->ab * b + of->ah * h;
        qb[k] = of->ab * a + of->bb * b + of->bh * h;
        qh[k] = of->ah * a + of->bh * b + of->hh * h;
        if (mode & MODE_BIOT) {
            Pack along = of->qq * q->q[k];
            qa[k] -= q->skew1 * along;
            qb[k] -= q->skew2 * along;
            qh[k] += along;
        }
    }
    quad_forces(qa, qb, qh, q);
}

ALWAYS_INLINE void quad_full_pack(int mode, const KernelInput *input, const LawInput *in, int block, int pack,
                                  PackSums *sums)
{
    ElementPlace place = find_place(input, block, pack, 4, QUAD_POINTS);
    QuadPack q;
    PointPack p[QUAD_POINTS];
    PointPlace point[QUAD_POINTS];
    PackTensor g[QUAD_POINTS];
    quad_gradients(input, &place, &q);
    if (mode & MODE_BIOT) free_hourglass(place.tail + GEOMETRY_TAIL_SIZE * LANES, &q);
    QuadProducts metric = quad_products(mode, &q), change = metric;
    if (KEEPS_HISTORY(mode, in)) change = change_of_products(mode, &place, &metric);
    quad_metrics(mode, &metric, g);
#pragma GCC unroll 4
    for (int i = 0; i < QUAD_POINTS; i++) {
        point[i] = point_place(&place, i);
        p[i].c = p[i].change = material_metric(point[i].point, g[i]); /* the change is read with DAMP only */
    }
    if (KEEPS_HISTORY(mode, in) && in->law.damping > 0.0) {
        quad_metrics(mode, &change, g);
        for (int i = 0; i < QUAD_POINTS; i++) p[i].change = material_metric(point[i].point, g[i]);
    }
    natural_stress(mode, false, in, QUAD_POINTS, point, p);
    QuadProducts stress = quad_stresses(mode, p);
    Pack psi = pack_of(0.0);
    if (mode & MODE_ACCOUNT) psi = quad_limit(mode, in, &place, &metric, &change, p, &stress);
    quad_stress_forces(mode, &stress, &q);
    quad_area(lane_values(place.tail, GEOMETRY_SIGN), pack, &q, sums);
    quad_add(input, &place, &q);
    bool energy_is_work = mode & (MODE_BIOT | MODE_LOGARITHMIC) || in->law.has_memory;
    p[0].energy = energy_is_work ? pack_of(0.0) : (p[0].energy + p[1].energy) + (p[2].energy + p[3].energy);
    p[0].viscous = pack_of(0.0);
    if (KEEPS_HISTORY(mode, in)) {
        Pack work = quad_work(mode, in, &place, &change, &stress);
        if (mode & MODE_ACCOUNT) keep_account(in, place.account, psi, work);
        if (energy_is_work)
            p[0].energy = work;
        else
            p[0].viscous = work;
    }
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
    FOR_MODE(kernel_mode(input), WORK)
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
        stream_stress(mode, &in, streams, point, p);
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
    FOR_MODE(kernel_mode(input), WORK)
#undef WORK
}

#endif

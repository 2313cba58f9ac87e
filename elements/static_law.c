/* Stress, tangent and energy of the laws at one point. The stress comes from the functions of the explicit kernels on
 * the smallest packs; what is derived here is how it changes. */
#include "elements/static_law.h"

#include <math.h>

#define BILLOW_KERNEL_LEVEL 2 /* the first lane counts */
#include "elements/kernel_law.h"
#include "elements/law_point.h"

bool static_law_is_symmetric(LawKind kind, const FabricLaw *fabric)
{
    if (kind == LAW_LOGARITHMIC) return false;
    if (kind != LAW_BIOT || !fabric->no_compression) return true;
    /* the projection (F7) is a gradient where D is a multiple of 1 */
    const PlaneModuli *d = &fabric->fabric;
    return d->d12 == 0.0 && d->d11 == d->d22 && 2.0 * d->d33 == d->d11;
}

/* A symmetric plane tensor. */
typedef struct Tensor {
    double a11, a22, a12;
} Tensor;

static Tensor first_lane(PackTensor t)
{
    return (Tensor){t.a11[0], t.a22[0], t.a12[0]};
}

static Tensor moduli_times(const PlaneModuli *d, Tensor e)
{
    return (Tensor){d->d11 * e.a11 + d->d12 * e.a22, d->d12 * e.a11 + d->d22 * e.a22, 2.0 * d->d33 * e.a12};
}

static double product(Tensor a, Tensor b)
{
    return a.a11 * b.a11 + a.a22 * b.a22 + 2.0 * a.a12 * b.a12;
}

/* 1/2 (A B + B A). */
static Tensor symmetric_product(Tensor a, Tensor b)
{
    return (Tensor){a.a11 * b.a11 + a.a12 * b.a12, a.a22 * b.a22 + a.a12 * b.a12,
                    0.5 * (a.a12 * (b.a11 + b.a22) + b.a12 * (a.a11 + a.a22))};
}

/* A B A. */
static Tensor congruence(Tensor a, Tensor b)
{
    double m11 = a.a11 * b.a11 + a.a12 * b.a12, m12 = a.a11 * b.a12 + a.a12 * b.a22,
           m21 = a.a12 * b.a11 + a.a22 * b.a12, m22 = a.a12 * b.a12 + a.a22 * b.a22;
    return (Tensor){m11 * a.a11 + m12 * a.a12, m21 * a.a12 + m22 * a.a22, m11 * a.a12 + m12 * a.a22};
}

/* The X of 1/2 (X U + U X) = T (eq. F5). */
static Tensor undo_product(Tensor u, Tensor t)
{
    double sum = u.a11 + u.a22, det = u.a11 * u.a22 - u.a12 * u.a12;
    double trace = (u.a22 * t.a11 + u.a11 * t.a22 - 2.0 * u.a12 * t.a12) / det, along = trace / sum,
           sphere = (t.a11 + t.a22) / sum - trace;
    return (Tensor){2.0 * t.a11 / sum - along * u.a11 - sphere, 2.0 * t.a22 / sum - along * u.a22 - sphere,
                    2.0 * t.a12 / sum - along * u.a12};
}

/* The tensor t in its principal frame: values and the direction (c, s) of the first. */
typedef struct Principal {
    double value[2], c, s;
} Principal;

static Principal principal_frame(Tensor t)
{
    double mean = 0.5 * (t.a11 + t.a22), half = 0.5 * (t.a11 - t.a22), radius = sqrt(half * half + t.a12 * t.a12);
    Principal p = {{mean + radius, mean - radius}, 1.0, 0.0};
    if (radius > 0.0) { /* half angles */
        double c2 = half / radius;
        p.c = sqrt(0.5 * (1.0 + c2));
        p.s = sqrt(0.5 * (1.0 - c2));
        if (t.a12 < 0.0) p.s = -p.s;
    }
    return p;
}

static Tensor into_frame(const Principal *p, Tensor t)
{
    double cc = p->c * p->c, ss = p->s * p->s, cs = p->c * p->s;
    return (Tensor){cc * t.a11 + ss * t.a22 + 2.0 * cs * t.a12, ss * t.a11 + cc * t.a22 - 2.0 * cs * t.a12,
                    cs * (t.a22 - t.a11) + (cc - ss) * t.a12};
}

static Tensor out_of_frame(const Principal *p, Tensor t)
{
    double cc = p->c * p->c, ss = p->s * p->s, cs = p->c * p->s;
    return (Tensor){cc * t.a11 + ss * t.a22 - 2.0 * cs * t.a12, ss * t.a11 + cc * t.a22 + 2.0 * cs * t.a12,
                    cs * (t.a11 - t.a22) + (cc - ss) * t.a12};
}

/* Columns of the tangent: the responses to unit strains E11, E22 and 2 E12. */
static const Tensor unit_strain[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};

static void set_column(StaticPoint *point, int column, Tensor s)
{
    point->tangent[0][column] = s.a11;
    point->tangent[1][column] = s.a22;
    point->tangent[2][column] = s.a12;
}

static void symmetrise(StaticPoint *point)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++)
            point->tangent[i][j] = point->tangent[j][i] = 0.5 * (point->tangent[i][j] + point->tangent[j][i]);
}

/* ---- FORM 2 ---- */

/* Second derivative of the relaxed energy where it is uniaxial, S = s n n (eq. Q6). */
static void wrinkled_tangent(const StaticLaw *law, Tensor e, Tensor s, double tangent[3][3])
{
    double trace = s.a11 + s.a22, c = (s.a11 - s.a22) / trace, d = 2.0 * s.a12 / trace; /* cos, sin of 2 theta */
    const double *b = law->compliance;
    double q = 0.5 * (e.a11 - e.a22), r = e.a12, along = 0.5 * (e.a11 + e.a22) + q * c + r * d;
    /* derivatives by theta */
    double slope = 2.0 * (r * c - q * d), bend = -4.0 * (q * c + r * d);
    double a = b[0] + c * (b[1] + b[2] * c), a1 = -2.0 * d * (b[1] + 2.0 * b[2] * c),
           a2 = -4.0 * b[1] * c - 8.0 * b[2] * (c * c - d * d);
    double normal[3] = {0.5 * (1.0 + c), 0.5 * (1.0 - c), 0.5 * d}, turned[3] = {-d, d, c};
    double curvature = slope * slope / a + along * bend / a - 2.0 * along * slope * a1 / (a * a) -
                       along * along * a2 / (2.0 * a * a) + along * along * a1 * a1 / (a * a * a);
    double mixed[3];
    for (int i = 0; i < 3; i++) mixed[i] = (slope / a - along * a1 / (a * a)) * normal[i] + along / a * turned[i];
    double give = curvature < 0.0 ? -1.0 / curvature : 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) tangent[i][j] += normal[i] * normal[j] / a + give * mixed[i] * mixed[j];
}

static void add_moduli_tangent(const PlaneModuli *d, double tangent[3][3])
{
    tangent[0][0] += d->d11;
    tangent[0][1] += d->d12;
    tangent[1][0] += d->d12;
    tangent[1][1] += d->d22;
    tangent[2][2] += d->d33;
}

static void green_point(const StaticLaw *law, PackTensor c, bool tangent, StaticPoint *point)
{
    const FabricLaw *f = &law->fabric;
    PackTensor e = green_strain(c);
    Compliance compliance = {law->compliance[0], law->compliance[1], law->compliance[2]};
    GreenResult result = green_stress(f, &compliance, f->no_compression, f->has_liner, e);
    Tensor s = first_lane(result.stress), strain = first_lane(e);
    point->stress[0] = s.a11;
    point->stress[1] = s.a22;
    point->stress[2] = s.a12;
    point->energy = result.energy[0];
    if (!tangent) return;
    for (int i = 0; i < 9; i++) point->tangent[i / 3][i % 3] = 0.0;
    if (f->has_liner) add_moduli_tangent(&f->liner, point->tangent);
    Tensor taut = moduli_times(&f->fabric, strain);
    Principal p = principal_frame(taut);
    if (!f->no_compression || p.value[1] >= 0.0) {
        add_moduli_tangent(&f->fabric, point->tangent);
        return;
    }
    if (f->has_liner) {
        Tensor held = moduli_times(&f->liner, strain);
        s = (Tensor){s.a11 - held.a11, s.a22 - held.a22, s.a12 - held.a12};
    }
    if (s.a11 + s.a22 > 1e-12 * f->fabric.d11 * (fabs(strain.a11) + fabs(strain.a22) + fabs(strain.a12)))
        wrinkled_tangent(law, strain, s, point->tangent);
}

/* ---- FORM 0 and 1 ---- */

/* Change of the projection onto the tensile cone (eq. F7): principal values keep their sign, directions turn (eq. Q8).
 */
static Tensor project_change(const Principal *p, Tensor dt)
{
    double t1 = p->value[0], t2 = p->value[1];
    if (t2 >= 0.0) return dt;
    if (t1 <= 0.0) return (Tensor){0, 0, 0};
    Tensor local = into_frame(p, dt);
    local.a22 = 0.0;
    local.a12 *= t1 / (t1 - t2);
    return out_of_frame(p, local);
}

static void biot_point(const StaticLaw *law, PackTensor c, bool tangent, StaticPoint *point)
{
    const FabricLaw *f = &law->fabric;
    BiotState state = biot_state(c);
    Pack major;
    PackTensor biot = biot_stress(f, f->no_compression, f->has_liner, state.stretch, &major);
    Tensor s = first_lane(pull_back_biot(biot, &state)), u = first_lane(state.stretch), t = first_lane(biot);
    Tensor e = {u.a11 - 1.0, u.a22 - 1.0, u.a12};
    point->stress[0] = s.a11;
    point->stress[1] = s.a22;
    point->stress[2] = s.a12;
    point->energy = 0.5 * product(t, e);
    if (!tangent) return;
    Principal p = principal_frame(moduli_times(&f->fabric, e));
    for (int i = 0; i < 3; i++) {
        Tensor du = undo_product(u, unit_strain[i]), dt = moduli_times(&f->fabric, du);
        if (f->no_compression) dt = project_change(&p, dt);
        if (f->has_liner) {
            Tensor more = moduli_times(&f->liner, du);
            dt = (Tensor){dt.a11 + more.a11, dt.a22 + more.a22, dt.a12 + more.a12};
        }
        Tensor turn = symmetric_product(s, du);
        set_column(point, i, undo_product(u, (Tensor){dt.a11 - turn.a11, dt.a22 - turn.a22, dt.a12 - turn.a12}));
    }
    symmetrise(point);
}

/* ---- MAT_ELASTIC ---- */

/* Change of ln U = 1/2 ln C with C by 2 dE, in the principal frame of C (eq. Q10). */
static Tensor logarithm_change(const Principal *p, Tensor de)
{
    Tensor local = into_frame(p, de);
    double c1 = p->value[0], c2 = p->value[1], ratio = (c1 - c2) / c2;
    double by_shear = ratio > 1e-6 ? log(c1 / c2) / (c1 - c2) : (1.0 - 0.5 * ratio) / c2;
    local.a11 /= c1;
    local.a22 /= c2;
    local.a12 *= by_shear;
    return out_of_frame(p, local);
}

static void logarithmic_point(const StaticLaw *law, PackTensor c, bool tangent, StaticPoint *point)
{
    const PlaneModuli *d = &law->fabric.whole;
    LogarithmicState state = logarithmic_state(c);
    PackTensor cauchy = apply_moduli(d, state.strain);
    Tensor s = first_lane(pull_back(cauchy, c, state.jacobian, state.pull)), t = first_lane(cauchy),
           e = first_lane(state.strain), metric = first_lane(c);
    point->stress[0] = s.a11;
    point->stress[1] = s.a22;
    point->stress[2] = s.a12;
    point->energy = 0.5 * state.jacobian[0] * product(t, e);
    if (!tangent) return;
    double j = state.jacobian[0], sum = sqrt(metric.a11 + metric.a22 + 2.0 * j);
    Tensor u = {(metric.a11 + j) / sum, (metric.a22 + j) / sum, metric.a12 / sum};
    Tensor inverse = {u.a22 / j, u.a11 / j, -u.a12 / j},
           over = {metric.a22 / (j * j), metric.a11 / (j * j), -metric.a12 / (j * j)};
    Principal p = principal_frame(metric);
    for (int i = 0; i < 3; i++) {
        Tensor de = unit_strain[i], du = undo_product(u, de), dt = moduli_times(d, logarithm_change(&p, de));
        Tensor di = congruence(inverse, du); /* less the change of 1/U */
        double grow = product(over, de);     /* dJ/J = C^-1 : dE */
        Tensor pulled = congruence(inverse, dt);
        /* U^-1 t dU^-1 + its transpose = -(X + X^T) with X = di t U^-1 */
        double ti11 = t.a11 * inverse.a11 + t.a12 * inverse.a12, ti12 = t.a11 * inverse.a12 + t.a12 * inverse.a22,
               ti21 = t.a12 * inverse.a11 + t.a22 * inverse.a12, ti22 = t.a12 * inverse.a12 + t.a22 * inverse.a22;
        double x11 = di.a11 * ti11 + di.a12 * ti21, x12 = di.a11 * ti12 + di.a12 * ti22,
               x21 = di.a12 * ti11 + di.a22 * ti21, x22 = di.a12 * ti12 + di.a22 * ti22;
        set_column(point, i,
                   (Tensor){grow * s.a11 + j * (pulled.a11 - 2.0 * x11), grow * s.a22 + j * (pulled.a22 - 2.0 * x22),
                            grow * s.a12 + j * (pulled.a12 - (x12 + x21))});
    }
    symmetrise(point);
}

/* ---- curves, rubber ---- */

/* The tangent by central differences of the stress: its error is far below what Newton's method notices. */
static void further_point(const StaticLaw *law, const double c[3], bool tangent, StaticPoint *point)
{
    const double h = 1e-6;
    LawPoint at, up, down;
    law_point(law->kind, &law->fabric, c, NULL, 0, 0.0, 0.0, &at);
    for (int i = 0; i < 3; i++) point->stress[i] = at.stress[i];
    point->energy = at.energy;
    if (!tangent) return;
    for (int i = 0; i < 3; i++) { /* C11 = 1 + 2 E11, C12 = 2 E12 */
        double step = i < 2 ? 2.0 * h : h, right[3] = {c[0], c[1], c[2]}, left[3] = {c[0], c[1], c[2]};
        right[i] += step;
        left[i] -= step;
        law_point(law->kind, &law->fabric, right, NULL, 0, 0.0, 0.0, &up);
        law_point(law->kind, &law->fabric, left, NULL, 0, 0.0, 0.0, &down);
        for (int k = 0; k < 3; k++) point->tangent[k][i] = (up.stress[k] - down.stress[k]) / (2.0 * h);
    }
    symmetrise(point);
}

/* ---- all ---- */

StaticLaw static_law_make(LawKind kind, const FabricLaw *fabric)
{
    StaticLaw law = {.kind = kind, .fabric = *fabric};
    if (kind == LAW_GREEN && fabric->no_compression) {
        Compliance c = make_compliance(&fabric->fabric);
        law.compliance[0] = c.b0;
        law.compliance[1] = c.b1;
        law.compliance[2] = c.b2;
    }
    return law;
}

const char *static_law_refusal(LawKind kind, const FabricLaw *fabric)
{
    switch (kind) {
    case LAW_SURFACE:
    case LAW_BIOT:
    case LAW_LOGARITHMIC:
    case LAW_GREEN:
    case LAW_RUBBER:
        return NULL;
    case LAW_CURVE:
        return fabric->has_memory ? "its unloading curves or hysteresis have no static equilibrium of their own" : NULL;
    }
    return "its law has no tangent for the static equilibrium";
}

void static_law_point(const StaticLaw *law, const double c[3], bool tangent, StaticPoint *point)
{
    PackTensor pack = {pack_of(c[0]), pack_of(c[1]), pack_of(c[2])};
    if (law->kind == LAW_GREEN)
        green_point(law, pack, tangent, point);
    else if (law->kind == LAW_BIOT)
        biot_point(law, pack, tangent, point);
    else if (law->kind == LAW_CURVE || law->kind == LAW_RUBBER)
        further_point(law, c, tangent, point);
    else
        logarithmic_point(law, pack, tangent, point);
}

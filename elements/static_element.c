/* Forces and stiffness of one element. All kinds share one form: at a point the Green strain changes by
 *   dE_AB = 1/2 (F_A . dF_B + F_B . dF_A) + 1/2 e_AB d(q . q),  F_A = sum x_a g_aA,  q = sum w_a x_a          (eq. Q3)
 * with gradients g, and e the share of the hourglass vector q in the metric (eq. E4a, E17). */
#include "elements/static_element.h"

#include <math.h>
#include <string.h>

#include "elements/kernels.h"

static const double corner_xi[4] = {-1, 1, 1, -1}, corner_eta[4] = {-1, -1, 1, 1};

/* A point: gradients by material axes (corners x 2), share of q.q in C (11, 22, 12), weight. */
typedef struct Point {
    double g[STATIC_CORNERS][2], e[3], weight;
    bool fold; /* e is not zero */
} Point;

/* What an element's points share. */
typedef struct Shape {
    const ElementGroup *group;
    const double *geometry; /* of the lane; values are BILLOW_LANES apart */
    double w[STATIC_CORNERS], q[3];
} Shape;

static double lane_value(const double *geometry, int quantity)
{
    return geometry[(ptrdiff_t)quantity * BILLOW_LANES];
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static const double *tail_of(const Shape *shape)
{
    return shape->geometry + (ptrdiff_t)shape->group->point_count * GEOMETRY_POINT_SIZE * BILLOW_LANES;
}

/* q = sum w x, the hourglass vector less its affine part (eq. E15). */
static void set_hourglass(Shape *shape, double x[][3])
{
    memset(shape->w, 0, sizeof shape->w);
    memset(shape->q, 0, sizeof shape->q);
    bool has = shape->group->kind == ELEMENT_QUAD_ONE ||
               (shape->group->kind == ELEMENT_QUAD_FULL && shape->group->law == LAW_BIOT);
    if (!has) return;
    const double *constant = tail_of(shape) + GEOMETRY_TAIL_SIZE * BILLOW_LANES;
    double k1 = lane_value(constant, GEOMETRY_SKEW1), k2 = lane_value(constant, GEOMETRY_SKEW2);
    for (int a = 0; a < 4; a++) {
        shape->w[a] = 0.25 * (corner_xi[a] * corner_eta[a] - k1 * corner_xi[a] - k2 * corner_eta[a]);
        for (int k = 0; k < 3; k++) shape->q[k] += shape->w[a] * x[a][k];
    }
}

static void set_point(const Shape *shape, int number, Point *point)
{
    const double *p = shape->geometry + (ptrdiff_t)number * GEOMETRY_POINT_SIZE * BILLOW_LANES;
    double m11 = lane_value(p, GEOMETRY_M11), m12 = lane_value(p, GEOMETRY_M12), m21 = lane_value(p, GEOMETRY_M21),
           m22 = lane_value(p, GEOMETRY_M22);
    memset(point, 0, sizeof *point);
    point->weight = lane_value(p, GEOMETRY_WEIGHT);
    if (shape->group->kind == ELEMENT_TRIANGLE) {
        const double by_natural[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
        for (int a = 0; a < 3; a++) {
            point->g[a][0] = by_natural[a][0] * m11 + by_natural[a][1] * m21;
            point->g[a][1] = by_natural[a][0] * m12 + by_natural[a][1] * m22;
        }
        return;
    }
    bool full = shape->group->kind == ELEMENT_QUAD_FULL;
    double gauss = full ? BILLOW_GAUSS : 0.0, xi = number == 1 || number == 2 ? gauss : -gauss,
           eta = number >= 2 ? gauss : -gauss;
    for (int a = 0; a < 4; a++) {
        double d1 = 0.25 * corner_xi[a] * (1.0 + corner_eta[a] * eta),
               d2 = 0.25 * corner_eta[a] * (1.0 + corner_xi[a] * xi);
        point->g[a][0] = d1 * m11 + d2 * m21;
        point->g[a][1] = d1 * m12 + d2 * m22;
    }
    point->fold = !full || shape->group->law == LAW_BIOT;
    double more = !point->fold ? 0.0
                  : full       ? 2.0 / 3.0
                               : 1.0 / 3.0,
           shear = point->fold && full ? -(1.0 + xi * eta) : 0.0;
    point->e[0] = more * (m11 * m11 + m21 * m21) + 2.0 * shear * m11 * m21;
    point->e[1] = more * (m12 * m12 + m22 * m22) + 2.0 * shear * m12 * m22;
    point->e[2] = more * (m11 * m12 + m21 * m22) + shear * (m11 * m22 + m12 * m21);
}

/* The tensile part of a symmetric tensor (11, 22, 12). */
static void keep_tension(const double s[3], double kept[3])
{
    double mean = 0.5 * (s[0] + s[1]), half = 0.5 * (s[0] - s[1]), radius = sqrt(half * half + s[2] * s[2]);
    memcpy(kept, s, 3 * sizeof *kept);
    if (mean - radius >= 0.0) return;
    double pull = mean + radius > 0.0 ? 0.5 * (mean + radius) : 0.0, turn = pull > 0.0 ? pull / radius : 0.0;
    kept[0] = pull + turn * half;
    kept[1] = pull - turn * half;
    kept[2] = turn * s[2];
}

/* Makes a symmetric 3 x 3 matrix positive semidefinite: Jacobi's rotations, negative eigenvalues dropped (eq. Q12). */
static void drop_negative(double m[3][3])
{
    double scale = fabs(m[0][0]) + fabs(m[1][1]) + fabs(m[2][2]);
    double d1 = m[0][0], d2 = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    double d3 = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[1][2]) - m[0][1] * (m[0][1] * m[2][2] - m[1][2] * m[0][2]) +
                m[0][2] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
    if (d1 > 0.0 && d2 > 0.0 && d3 > 0.0) return;
    double a[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memcpy(a, m, sizeof a);
    for (int sweep = 0; sweep < 12; sweep++) {
        if (fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]) <= 1e-15 * scale) break;
        for (int p = 0; p < 2; p++)
            for (int r = p + 1; r < 3; r++) {
                if (a[p][r] == 0.0) continue;
                double theta = (a[r][r] - a[p][p]) / (2.0 * a[p][r]);
                double t = (theta >= 0.0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
                double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
                for (int k = 0; k < 3; k++) {
                    double kp = a[k][p], kr = a[k][r];
                    a[k][p] = c * kp - s * kr;
                    a[k][r] = s * kp + c * kr;
                }
                for (int k = 0; k < 3; k++) {
                    double pk = a[p][k], rk = a[r][k], vp = v[k][p], vr = v[k][r];
                    a[p][k] = c * pk - s * rk;
                    a[r][k] = s * pk + c * rk;
                    v[k][p] = c * vp - s * vr;
                    v[k][r] = s * vp + c * vr;
                }
            }
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            m[i][j] = 0.0;
            for (int k = 0; k < 3; k++)
                if (a[k][k] > 0.0) m[i][j] += a[k][k] * v[i][k] * v[j][k];
        }
}

/* Adds a symmetric scalar between corners a and b to the diagonal of their block. */
static void add_spring(StaticElement *element, int a, int b, double value)
{
    for (int k = 0; k < 3; k++) element->stiffness[(3 * a + k) * STATIC_SIZE + 3 * b + k] += value;
}

/* Strain rows B (3 x 3 corners) in Voigt order. */
static void strain_rows(const Shape *shape, const Point *point, int corners, const double f[2][3],
                        double rows[3][STATIC_SIZE])
{
    for (int a = 0; a < corners; a++)
        for (int k = 0; k < 3; k++) {
            double along = point->fold ? shape->w[a] * shape->q[k] : 0.0;
            rows[0][3 * a + k] = point->g[a][0] * f[0][k] + point->e[0] * along;
            rows[1][3 * a + k] = point->g[a][1] * f[1][k] + point->e[1] * along;
            rows[2][3 * a + k] = point->g[a][0] * f[1][k] + point->g[a][1] * f[0][k] + 2.0 * point->e[2] * along;
        }
}

static void add_stiffness(const Shape *shape, const Point *point, StaticPoint *law, const double rows[3][STATIC_SIZE],
                          StaticElement *element)
{
    int corners = element->corners, size = 3 * corners;
    drop_negative(law->tangent);
    double s[3], dr[3][STATIC_SIZE];
    keep_tension(law->stress, s);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < size; j++)
            dr[i][j] = point->weight * (law->tangent[i][0] * rows[0][j] + law->tangent[i][1] * rows[1][j] +
                                        law->tangent[i][2] * rows[2][j]);
    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++)
            element->stiffness[i * STATIC_SIZE + j] +=
                rows[0][i] * dr[0][j] + rows[1][i] * dr[1][j] + rows[2][i] * dr[2][j];
    double fold = s[0] * point->e[0] + s[1] * point->e[1] + 2.0 * s[2] * point->e[2];
    if (fold < 0.0) fold = 0.0;
    for (int a = 0; a < corners; a++)
        for (int b = 0; b < corners; b++) {
            const double *ga = point->g[a], *gb = point->g[b];
            double sum = s[0] * ga[0] * gb[0] + s[1] * ga[1] * gb[1] + s[2] * (ga[0] * gb[1] + ga[1] * gb[0]);
            add_spring(element, a, b, point->weight * (sum + fold * shape->w[a] * shape->w[b]));
        }
}

static void add_point(const Shape *shape, const StaticLaw *law, int number, double x[][3], bool stiffness,
                      StaticElement *element)
{
    Point point;
    int corners = element->corners;
    set_point(shape, number, &point);
    double f[2][3] = {{0}}, qq = point.fold ? dot(shape->q, shape->q) : 0.0;
    for (int a = 0; a < corners; a++)
        for (int k = 0; k < 3; k++) {
            f[0][k] += point.g[a][0] * x[a][k];
            f[1][k] += point.g[a][1] * x[a][k];
        }
    double c[3] = {dot(f[0], f[0]) + point.e[0] * qq, dot(f[1], f[1]) + point.e[1] * qq,
                   dot(f[0], f[1]) + point.e[2] * qq};
    StaticPoint at;
    static_law_point(law, c, stiffness, &at);
    element->energy += point.weight * at.energy;
    double rows[3][STATIC_SIZE];
    strain_rows(shape, &point, corners, (const double(*)[3])f, rows);
    for (int a = 0; a < corners; a++)
        for (int k = 0; k < 3; k++) {
            int i = 3 * a + k;
            element->force[a][k] -=
                point.weight * (rows[0][i] * at.stress[0] + rows[1][i] * at.stress[1] + rows[2][i] * at.stress[2]);
        }
    if (!stiffness) return;
    const PlaneModuli *d = &law->fabric.whole;
    double modulus = d->d11 > d->d22 ? d->d11 : d->d22;
    for (int a = 0; a < corners; a++)
        element->scale[a] += point.weight * modulus * (point.g[a][0] * point.g[a][0] + point.g[a][1] * point.g[a][1]);
    add_stiffness(shape, &point, &at, (const double(*)[STATIC_SIZE])rows, element);
}

/* In-plane hourglass energy 1/2 sum c (q . a_i)^2 of the one-point quad (eq. E18) with the gradient of r = q . a_i. */
static void add_hourglass(const Shape *shape, double x[][3], bool stiffness, StaticElement *element)
{
    const double *constant = tail_of(shape) + GEOMETRY_TAIL_SIZE * BILLOW_LANES;
    for (int i = 0; i < 2; i++) {
        const double *natural = i == 0 ? corner_xi : corner_eta;
        double c = lane_value(constant, i == 0 ? GEOMETRY_HOURGLASS1 : GEOMETRY_HOURGLASS2), along[3] = {0},
               gradient[STATIC_SIZE];
        for (int a = 0; a < 4; a++)
            for (int k = 0; k < 3; k++) along[k] += 0.25 * natural[a] * x[a][k];
        double r = dot(shape->q, along);
        element->hourglass += 0.5 * c * r * r;
        for (int a = 0; a < 4; a++)
            for (int k = 0; k < 3; k++) {
                gradient[3 * a + k] = shape->w[a] * along[k] + 0.25 * natural[a] * shape->q[k];
                element->force[a][k] -= c * r * gradient[3 * a + k];
            }
        for (int j = 0; stiffness && j < STATIC_SIZE; j++)
            for (int k = 0; k < STATIC_SIZE; k++)
                element->stiffness[j * STATIC_SIZE + k] += c * gradient[j] * gradient[k];
    }
}

/* ---- area vectors ---- */

/* Subtracts pressure x sign/2 of the symmetric part of d(area_a)/dx_b; every area vector is a sum of cross products
 * of two natural vectors u = sum u_b x_b, v = sum v_b x_b: adds factor (u x v) to corner a. */
typedef struct AreaTerm {
    const double *u, *v; /* coefficients by corner */
} AreaTerm;

static void natural_vector(int corners, const double *coefficient, double x[][3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0;
        for (int b = 0; b < corners; b++) out[k] += coefficient[b] * x[b][k];
    }
}

/* Adds factor[a] (u x v) to the corners' area vectors; the stiffness loses pressure times the symmetric part of its
 * change (eq. Q11). */
static void add_area(int corners, AreaTerm term, const double *factor, double x[][3], bool stiffness, double pressure,
                     StaticElement *element)
{
    double u[3], v[3], n[3];
    natural_vector(corners, term.u, x, u);
    natural_vector(corners, term.v, x, v);
    cross(u, v, n);
    for (int a = 0; a < corners; a++)
        for (int k = 0; k < 3; k++) element->area[a][k] += factor[a] * n[k];
    if (!stiffness || pressure == 0.0) return;
    for (int a = 0; a < corners; a++)
        for (int b = 0; b < corners; b++) {
            /* d(u x v) = (u_b v - v_b u)^ dx_b with ^ from the right: dx_b x (u_b v) + (v_b u) x dx_b */
            double t[3];
            for (int k = 0; k < 3; k++) t[k] = 0.5 * pressure * factor[a] * (term.v[b] * u[k] - term.u[b] * v[k]);
            double *ab = element->stiffness + 3 * a * STATIC_SIZE + 3 * b,
                   *ba = element->stiffness + 3 * b * STATIC_SIZE + 3 * a;
            const double skew[3][3] = {{0, -t[2], t[1]}, {t[2], 0, -t[0]}, {-t[1], t[0], 0}}; /* t x dx */
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    ab[i * STATIC_SIZE + j] -= skew[i][j];
                    ba[i * STATIC_SIZE + j] -= skew[j][i];
                }
        }
}

static void add_areas(int corners, double sign, double x[][3], const double origin[3], bool stiffness, double pressure,
                      StaticElement *element)
{
    if (corners == 3) {
        static const double e1[3] = {-1, 1, 0}, e2[3] = {-1, 0, 1};
        const double sixth[3] = {sign / 6.0, sign / 6.0, sign / 6.0};
        add_area(3, (AreaTerm){e1, e2}, sixth, x, stiffness, pressure, element);
        double r[3] = {x[0][0] - origin[0], x[0][1] - origin[1], x[0][2] - origin[2]};
        element->volume = dot(r, element->area[0]);
        return;
    }
    double a[4], b[4], h[4], whole[4], by_xi[4], by_eta[4], centre[3], t1[3], t2[3], n[3];
    for (int i = 0; i < 4; i++) {
        a[i] = 0.25 * corner_xi[i];
        b[i] = 0.25 * corner_eta[i];
        h[i] = 0.25 * corner_xi[i] * corner_eta[i];
        whole[i] = sign;
        by_xi[i] = sign * corner_xi[i] / 3.0;
        by_eta[i] = sign * corner_eta[i] / 3.0;
    }
    add_area(4, (AreaTerm){a, b}, whole, x, stiffness, pressure, element); /* (eq. E9) */
    add_area(4, (AreaTerm){a, h}, by_xi, x, stiffness, pressure, element);
    add_area(4, (AreaTerm){h, b}, by_eta, x, stiffness, pressure, element);
    for (int k = 0; k < 3; k++) centre[k] = 0.25 * ((x[0][k] + x[1][k]) + (x[2][k] + x[3][k])) - origin[k];
    natural_vector(4, a, x, t1);
    natural_vector(4, b, x, t2);
    cross(t1, t2, n);
    element->volume = 4.0 / 3.0 * sign * dot(centre, n);
}

void static_element(const ElementGroup *group, const StaticLaw *law, int block, int lane, double x[][3],
                    const double origin[3], bool stiffness, double pressure, StaticElement *element)
{
    Shape shape = {.group = group,
                   .geometry = group->geometry + (ptrdiff_t)block * group->geometry_size * BILLOW_LANES + lane};
    memset(element->force, 0, sizeof element->force);
    memset(element->area, 0, sizeof element->area);
    memset(element->scale, 0, sizeof element->scale);
    element->corners = group->corner_count;
    element->energy = element->hourglass = 0.0;
    if (stiffness) memset(element->stiffness, 0, sizeof element->stiffness);
    double sign = group->law == LAW_SURFACE ? shape.geometry[0] : lane_value(tail_of(&shape), GEOMETRY_SIGN);
    add_areas(group->corner_count, sign, x, origin, stiffness, pressure, element);
    if (group->law == LAW_SURFACE) return;
    set_hourglass(&shape, x);
    for (int p = 0; p < group->point_count; p++) add_point(&shape, law, p, x, stiffness, element);
    if (group->kind == ELEMENT_QUAD_ONE) add_hourglass(&shape, x, stiffness, element);
}

/* Distances from tori, bodies of revolution and finite planes: against libccd (MPR) where convex, against sampling
 * and closed forms elsewhere; a capsule as the union of three entities. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <ccd/ccd.h>
#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "contact/contact_entity.h"
#include "solver/vector3.h"
#include "tests/ccd_ball.h"

enum { MOST = 64 };

/* Points of an outline. */
typedef struct Outline {
    int count;
    double z[MOST], r[MOST];
} Outline;

static ContactEntity body_of(const Outline *o)
{
    ContactEntity e = {.shape = ENTITY_PROFILE};
    ProfileFault fault;
    int where;
    assert_int_equal(revolved_profile_make(o->count, o->z, o->r, &e.profile, &fault, &where), 0);
    assert_int_equal(fault, PROFILE_FINE);
    e.size[0] = e.profile.reach;
    return e;
}

/* The farthest point of a convex body of revolution. */
static void support_outline(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
    const Outline *o = object;
    const double *d = direction->v;
    double across = sqrt(d[0] * d[0] + d[1] * d[1]), most = -INFINITY;
    for (int i = 0; i < o->count; i++) {
        double along = o->r[i] * across + o->z[i] * d[2];
        if (along <= most) continue;
        most = along;
        for (int k = 0; k < 2; k++) point->v[k] = across > 0 ? o->r[i] * d[k] / across : 0;
        point->v[2] = o->z[i];
    }
}

static double outer_distance(const void *object, ccd_support_fn support, const double r[3])
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = support;
    ccd.support2 = support_ball;
    ccd.center1 = middle_at_origin;
    ccd.center2 = middle_of_ball;
    ccd.mpr_tolerance = 1e-12;
    ccd.max_iterations = 10000;
    Ball ball = {{r[0], r[1], r[2]}, 0};
    double low = 0, high = 10;
    for (int i = 0; i < 60; i++) {
        ball.radius = 0.5 * (low + high);
        *(ccdMPRIntersect(object, &ball, &ccd) ? &high : &low) = ball.radius;
    }
    return high;
}

/* Unit normal, and a foot at which the distance is zero. */
static void check_foot(const ContactEntity *e, const double r[3], const EntityGap *gap)
{
    double foot[3];
    for (int k = 0; k < 3; k++) foot[k] = r[k] - gap->distance * gap->normal[k];
    assert_true(fabs(vector3_norm(gap->normal) - 1) < 1e-14);
    double rest = entity_gap(e, foot).distance;
    if (!(fabs(rest) < 1e-14)) fail_msg("foot off by %g", rest);
}

static void convex_against_libccd(const char *name, const Outline *o)
{
    ContactEntity e = body_of(o);
    double off = 0;
    int outside = 0;
    for (int i = 0; i < 600; i++) {
        double r[3];
        for (int k = 0; k < 3; k++) r[k] = random_number(-2, 2);
        EntityGap gap = entity_gap(&e, r);
        check_foot(&e, r, &gap);
        if (gap.distance <= 0) continue;
        outside++;
        off = fmax(off, fabs(gap.distance - outer_distance(o, support_outline, r)));
    }
    print_message("    %s: %d places outside, off by %.2g\n", name, outside, off);
    assert_true(outside > 200 && off < 1e-11);
    revolved_profile_free(&e.profile);
}

static const Outline cylinder = {4, {-0.5, -0.5, 0.7, 0.7}, {0, 0.9, 0.9, 0}},
                     cone = {3, {-0.6, -0.6, 1.1}, {0, 0.8, 0}},
                     lens = {5, {-0.4, -0.35, 0, 0.5, 0.6}, {0, 0.5, 0.9, 0.4, 0}};

static void convex_bodies(void **state)
{
    (void)state;
    convex_against_libccd("finite cylinder", &cylinder);
    convex_against_libccd("cone", &cone);
    convex_against_libccd("lens", &lens);
}

/* Inside a finite cylinder the nearest of its three faces counts; on the axis, in the corners and on the surface too.
 */
static void inside_of_cylinder(void **state)
{
    (void)state;
    ContactEntity e = body_of(&cylinder);
    for (int i = 0; i < 2000; i++) {
        double angle = random_number(0, 6.283), rho = i % 10 ? random_number(0, 0.9) : 0, z = random_number(-0.5, 0.7);
        const double r[3] = {rho * cos(angle), rho * sin(angle), z};
        EntityGap gap = entity_gap(&e, r);
        assert_true(fabs(gap.distance + fmin(0.9 - rho, fmin(z + 0.5, 0.7 - z))) < 1e-15);
        check_foot(&e, r, &gap);
    }
    const double corner[3] = {0, 0.9, 0.7};
    EntityGap gap = entity_gap(&e, corner);
    assert_true(gap.distance == 0 && gap.normal[0] == 0 && gap.normal[1] >= 0 && gap.normal[2] >= 0);
    revolved_profile_free(&e.profile);
}

/* The other way round, and as a pair of curves' points in falling order: the same body. */
static void either_direction(void **state)
{
    (void)state;
    Outline back = lens;
    for (int i = 0; i < lens.count; i++) {
        back.z[i] = lens.z[lens.count - 1 - i];
        back.r[i] = lens.r[lens.count - 1 - i];
    }
    ContactEntity a = body_of(&lens), b = body_of(&back);
    for (int i = 0; i < 500; i++) {
        double r[3];
        for (int k = 0; k < 3; k++) r[k] = random_number(-1, 1);
        assert_true(fabs(entity_gap(&a, r).distance - entity_gap(&b, r).distance) < 1e-15);
    }
    revolved_profile_free(&a.profile);
    revolved_profile_free(&b.profile);
}

/* Inside the outline, by the crossings of a ray along r. */
static bool within(const Outline *o, double r, double z)
{
    bool odd = false;
    for (int i = 1; i < o->count; i++) {
        double low = o->z[i - 1], high = o->z[i], share;
        if ((low > z) == (high > z)) continue;
        share = (z - low) / (high - low);
        odd ^= o->r[i - 1] + share * (o->r[i] - o->r[i - 1]) > r;
    }
    return odd;
}

/* No point of a fine net of the outline, turned to the probe's side, is nearer, and one is about as near. */
static void concave_against_samples(const Outline *o, bool inverted)
{
    enum { SAMPLES = 4000 };
    ContactEntity e = body_of(o);
    e.inside = inverted;
    for (int i = 0; i < 1500; i++) {
        double r[3], rho, least = INFINITY;
        for (int k = 0; k < 3; k++) r[k] = random_number(-1.3, 1.3);
        rho = sqrt(r[0] * r[0] + r[1] * r[1]);
        EntityGap gap = entity_gap(&e, r);
        for (int k = 1; k < o->count; k++)
            for (int s = 0; s <= SAMPLES; s++) {
                double u = (double)s / SAMPLES, across = o->r[k - 1] + u * (o->r[k] - o->r[k - 1]) - rho,
                       up = o->z[k - 1] + u * (o->z[k] - o->z[k - 1]) - r[2];
                least = fmin(least, across * across + up * up);
            }
        least = sqrt(least);
        assert_true(fabs(gap.distance) <= least + 1e-14 && fabs(gap.distance) >= least - 1e-3);
        assert_true((gap.distance < 0) == (within(o, rho, r[2]) != inverted));
        check_foot(&e, r, &gap);
    }
    revolved_profile_free(&e.profile);
}

static void concave_bodies(void **state)
{
    (void)state;
    const Outline hourglass = {6, {-0.9, -0.8, 0, 0.1, 0.7, 0.8}, {0, 0.8, 0.1, 0.3, 0.9, 0}},
                  mushroom = {7, {-0.7, -0.7, 0.2, 0, 0.2, 0.6, 0.8}, {0, 0.2, 0.2, 0.9, 1.0, 0.5, 0}}, /* undercut */
        bowl = {7, {-0.5, -0.3, 0.5, 0.5, 0, -0.2, -0.2}, {0, 0.7, 0.9, 0.8, 0.6, 0.2, 0}},             /* hollow */
        ring = {7, {0.2, 0.2, 0.4, 0.6, 0.6, 0.5, 0.2}, {0.4, 0.9, 0.7, 0.9, 0.5, 0.7, 0.4}};
    concave_against_samples(&hourglass, false);
    concave_against_samples(&hourglass, true);
    concave_against_samples(&mushroom, false);
    concave_against_samples(&bowl, false);
    concave_against_samples(&ring, false);
    concave_against_samples(&ring, true);
}

/* Nothing beyond an open end; a tube of one edge, from both sides. */
static void open_ends(void **state)
{
    (void)state;
    const Outline tube = {2, {-1, 2}, {0.5, 0.5}}, cup = {4, {0, 0, 1, 1.2}, {0, 0.5, 0.5, 0.6}};
    ContactEntity e = body_of(&tube), can = body_of(&cup);
    assert_true(revolved_profile_open(&e.profile, 0) && revolved_profile_open(&e.profile, 1));
    assert_true(!revolved_profile_open(&can.profile, 0) && revolved_profile_open(&can.profile, 1));
    for (int i = 0; i < 1000; i++) {
        const double r[3] = {random_number(-1, 1), random_number(-1, 1), random_number(-2, 3)};
        double rho = sqrt(r[0] * r[0] + r[1] * r[1]), d = entity_gap(&e, r).distance;
        assert_true(r[2] < -1 || r[2] > 2 ? d == INFINITY : fabs(d - (rho - 0.5)) < 1e-15);
    }
    can.inside = true;
    assert_true(entity_gap(&can, (const double[]){0.1, 0.1, 2}).distance == INFINITY);
    EntityGap gap = entity_gap(&can, (const double[]){0, 0.1, 0.2});
    assert_true(fabs(gap.distance - 0.2) < 1e-15 && gap.normal[2] == 1);
    gap = entity_gap(&can, (const double[]){0, -0.6, 0.5});
    assert_true(fabs(gap.distance + 0.1) < 1e-15 && fabs(gap.normal[1] - 1) < 1e-15);
    revolved_profile_free(&e.profile);
    revolved_profile_free(&can.profile);
}

static void wrong_outlines(void **state)
{
    (void)state;
    static const struct {
        Outline o;
        ProfileFault fault;
        int where;
    } wrong[] = {{{1, {0}, {1}}, PROFILE_SHORT, 0},
                 {{3, {0, 1, 2}, {0, 1, -1}}, PROFILE_NEGATIVE, 2},
                 {{3, {0, 1, 2}, {1, 0, 1}}, PROFILE_ON_AXIS, 1},
                 {{2, {0, 1}, {0, 0}}, PROFILE_ON_AXIS, 0},
                 {{4, {0, 1, 1, 0}, {1, 2, 1, 2}}, PROFILE_CROSSES, 1},
                 {{3, {0, 1, 0.5}, {1, 1, 1}}, PROFILE_CROSSES, 1},
                 {{5, {0, 0, 1, 0, 0}, {1, 2, 2, 1.5, 1}}, PROFILE_CROSSES, 1},
                 {{2, {1, 1}, {0, 2}}, PROFILE_FLAT, 1}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        RevolvedProfile profile;
        ProfileFault fault;
        int where;
        assert_int_equal(revolved_profile_make(wrong[i].o.count, wrong[i].o.z, wrong[i].o.r, &profile, &fault, &where),
                         0);
        if (fault != wrong[i].fault || (fault < PROFILE_CROSSES && where != wrong[i].where))
            fail_msg("outline %zu: fault %d at %d", i, (int)fault, where);
        assert_null(profile.edge);
    }
}

/* No point of a fine net of the torus is nearer; the foot, the sign by its equation, and both sides of it. */
static void torus(void **state)
{
    (void)state;
    enum { NET = 300 };
    for (int kind = 0; kind < 3; kind++) {
        const double big = 0.8, small = kind == 0 ? 0.3 : kind == 1 ? 0.8 : 0.02;
        ContactEntity e = {.shape = ENTITY_TORUS, .size = {big, small, 0}}, bowl = e;
        bowl.inside = true;
        for (int i = 0; i < 300; i++) {
            double r[3], least = INFINITY;
            for (int k = 0; k < 3; k++) r[k] = random_number(-1.5, 1.5);
            if (i == 0) r[0] = r[1] = 0;
            EntityGap gap = entity_gap(&e, r), other = entity_gap(&bowl, r);
            check_foot(&e, r, &gap);
            assert_true(other.distance == -gap.distance && other.normal[2] == -gap.normal[2]);
            double square = vector3_dot(r, r) + big * big - small * small, side = r[0] * r[0] + r[1] * r[1];
            assert_true((square * square < 4 * big * big * side) == (gap.distance < 0));
            for (int a = 0; a < NET; a++)
                for (int b = 0; b < NET; b++) {
                    double u = 2 * M_PI * a / NET, v = 2 * M_PI * b / NET, out = big + small * cos(v), away[3];
                    const double on[3] = {out * cos(u), out * sin(u), small * sin(v)};
                    vector3_subtract(r, on, away);
                    least = fmin(least, vector3_dot(away, away));
                }
            assert_true(sqrt(least) >= fabs(gap.distance) - 1e-14 && sqrt(least) <= fabs(gap.distance) + 0.025);
        }
        EntityGap middle = entity_gap(&e, (const double[]){0, big, 0});
        assert_true(middle.distance == -small && fabs(vector3_norm(middle.normal) - 1) < 1e-15);
    }
}

/* Two spheres and the tube between them are a capsule, outside and inside. */
typedef struct Capsule {
    double radius, half;
} Capsule;

static void support_capsule(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
    const Capsule *c = object;
    double size = sqrt(ccdVec3Len2(direction));
    for (int k = 0; k < 3; k++) point->v[k] = size > 0 ? c->radius * direction->v[k] / size : 0;
    point->v[2] += direction->v[2] < 0 ? -c->half : c->half;
}

static void capsule(void **state)
{
    (void)state;
    const Capsule c = {0.4, 0.7};
    const Outline tube = {2, {-c.half, c.half}, {c.radius, c.radius}};
    ContactEntity side = body_of(&tube), ball = {.shape = ENTITY_SPHERE, .size = {c.radius, c.radius, c.radius}};
    double off = 0;
    for (int i = 0; i < 1000; i++) {
        double r[3], d, expected;
        for (int k = 0; k < 3; k++) r[k] = random_number(-1.5, 1.5);
        const double low[3] = {r[0], r[1], r[2] + c.half}, high[3] = {r[0], r[1], r[2] - c.half},
                     axis[3] = {r[0], r[1], r[2] - fmax(-c.half, fmin(c.half, r[2]))};
        expected = vector3_norm(axis) - c.radius;
        d = fmin(entity_gap(&side, r).distance,
                 fmin(entity_gap(&ball, low).distance, entity_gap(&ball, high).distance));
        assert_true(fabs(d - expected) < 1e-15);
        if (d > 0) off = fmax(off, fabs(d - outer_distance(&c, support_capsule, r)));
    }
    print_message("    capsule, outside off by %.2g\n", off);
    assert_true(off < 1e-11);
    revolved_profile_free(&side.profile);
}

static void finite_plane(void **state)
{
    (void)state;
    ContactEntity e = {.shape = ENTITY_RECTANGLE, .size = {0.5, 0.3, 0}};
    for (int i = 0; i < 1000; i++) {
        const double r[3] = {random_number(-1, 1), random_number(-1, 1), random_number(-1, 1)};
        EntityGap gap = entity_gap(&e, r);
        bool over = fabs(r[0]) <= 0.5 && fabs(r[1]) <= 0.3;
        assert_true(gap.distance == (over ? r[2] : INFINITY) && gap.normal[2] == 1);
    }
    e.inside = true;
    assert_true(entity_gap(&e, (const double[]){0.1, 0.1, 0.2}).distance == -0.2);
    assert_true(entity_gap(&e, (const double[]){0.6, 0.1, 0.2}).distance == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(convex_bodies),
                                       cmocka_unit_test(inside_of_cylinder),
                                       cmocka_unit_test(either_direction),
                                       cmocka_unit_test(concave_bodies),
                                       cmocka_unit_test(open_ends),
                                       cmocka_unit_test(wrong_outlines),
                                       cmocka_unit_test(torus),
                                       cmocka_unit_test(capsule),
                                       cmocka_unit_test(finite_plane)};
    return cmocka_run_group_tests_name("tori, bodies of revolution, finite planes", tests, NULL, NULL);
}

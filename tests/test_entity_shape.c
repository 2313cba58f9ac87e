/* Distances from the shapes of contact entities: against libccd (MPR) at random places, and what they must be.
 */
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

/* The farthest point of a bounded shape in a direction. */
static void support_shape(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
    const ContactEntity *e = object;
    const double *d = direction->v;
    double *p = point->v, across = sqrt(d[0] * d[0] + d[1] * d[1]), sum = 0;
    if (e->shape == ENTITY_CYLINDER) { /* cut far away */
        for (int k = 0; k < 2; k++) p[k] = across > 0 ? e->size[0] * d[k] / across : 0;
        p[2] = d[2] < 0 ? -50 : 50;
        return;
    }
    for (int k = 0; k < 3; k++) sum += e->size[k] * e->size[k] * d[k] * d[k];
    for (int k = 0; k < 3; k++) p[k] = sum > 0 ? e->size[k] * e->size[k] * d[k] / sqrt(sum) : 0;
}

static ccd_t prepare(void)
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = support_shape;
    ccd.support2 = support_ball;
    ccd.center1 = middle_at_origin;
    ccd.center2 = middle_of_ball;
    ccd.mpr_tolerance = 1e-12;
    ccd.max_iterations = 10000;
    return ccd;
}

/* Distance of a place outside by libccd: the radius from which on a ball about it meets the shape. */
static double outer_distance(const ContactEntity *e, const double r[3])
{
    const ccd_t ccd = prepare();
    Ball ball = {{r[0], r[1], r[2]}, 0};
    double low = 0, high = 10;
    for (int i = 0; i < 60; i++) {
        ball.radius = 0.5 * (low + high);
        *(ccdMPRIntersect(e, &ball, &ccd) ? &high : &low) = ball.radius;
    }
    return high;
}

/* Depth of a place inside by libccd, which finds a way out, for bodies other than balls not always the shortest. */
static double inner_depth(const ContactEntity *e, const double r[3])
{
    const ccd_t ccd = prepare();
    Ball ball = {{r[0], r[1], r[2]}, 1e-3};
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    assert_int_equal(ccdMPRPenetration(e, &ball, &ccd, &depth, &direction, &position), 0);
    return depth - ball.radius;
}

static void check_against_ccd(const ContactEntity *e, bool ball)
{
    double outside = 0, least = 1, most = 0;
    for (int i = 0; i < 500; i++) {
        double r[3];
        for (int k = 0; k < 3; k++) r[k] = random_number(-1.5, 1.5) * e->size[k];
        EntityGap gap = entity_gap(e, r);
        if (gap.distance > 0) {
            outside = fmax(outside, fabs(gap.distance - outer_distance(e, r)));
        } else {
            double excess = inner_depth(e, r) + gap.distance;
            least = fmin(least, excess);
            most = fmax(most, excess);
        }
    }
    print_message("    outside off by %.2g, depth by libccd more by %.2g to %.2g\n", outside, least, most);
    assert_true(outside < 1e-11 && least > -1e-11 && (!ball || most < 1e-11));
}

static void against_libccd(void **state)
{
    (void)state;
    check_against_ccd(&(ContactEntity){.shape = ENTITY_SPHERE, .size = {1.3, 1.3, 1.3}}, true);
    check_against_ccd(&(ContactEntity){.shape = ENTITY_CYLINDER, .size = {0.8, 0.8, 0.8}}, false);
    check_against_ccd(&(ContactEntity){.shape = ENTITY_ELLIPSOID, .size = {1.5, 1.0, 0.7}}, false);
    check_against_ccd(&(ContactEntity){.shape = ENTITY_ELLIPSOID, .size = {0.6, 0.6, 2.0}}, false);
}

/* From any place the foot lies on the ellipsoid, the way to it is along the normal there, and no point of a fine net of
 * the surface is nearer. */
static void ellipsoid_foot(const double half[3], const double r[3])
{
    ContactEntity e = {.shape = ENTITY_ELLIPSOID, .size = {half[0], half[1], half[2]}};
    EntityGap gap = entity_gap(&e, r);
    double foot[3], slope[3], on = 0;
    for (int k = 0; k < 3; k++) {
        foot[k] = r[k] - gap.distance * gap.normal[k];
        on += foot[k] * foot[k] / (half[k] * half[k]);
        slope[k] = foot[k] / (half[k] * half[k]);
    }
    assert_true(fabs(on - 1) < 1e-12);
    assert_true(fabs(vector3_norm(gap.normal) - 1) < 1e-14);
    assert_true(fabs(vector3_dot(slope, gap.normal) / vector3_norm(slope) - 1) < 1e-7);
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j < 80; j++) {
            double a = M_PI * i / 40, b = 2 * M_PI * j / 80, u[3], away[3];
            u[0] = half[0] * sin(a) * cos(b);
            u[1] = half[1] * sin(a) * sin(b);
            u[2] = half[2] * cos(a);
            vector3_subtract(r, u, away);
            assert_true(vector3_norm(away) >= fabs(gap.distance) - 1e-12);
        }
}

static void feet_of_ellipsoids(void **state)
{
    (void)state;
    const double halves[][3] = {{3, 2, 1}, {1, 1, 1}, {1, 2, 1}, {5, 5, 0.1}, {0.1, 5, 5}, {1, 1.0000001, 0.9999999}};
    const double places[][3] = {{0, 0, 0},          {0.5, 0, 0},  {0, 0.3, 0},       {0, 0, 0.2},       {2.9, 0, 0},
                                {1, 0.5, 0},        {0, 1, 1e-9}, {1, 1, 1e-300},    {1e-12, 4, 1e-12}, {10, 20, 30},
                                {1e-9, 1e-9, 1e-9}, {-1, -1, -1}, {1e-300, 2, 1e-7}, {0.1, 0, 1e-20},   {100, 0, 0}};
    for (size_t h = 0; h < sizeof halves / sizeof *halves; h++) {
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) ellipsoid_foot(halves[h], places[i]);
        for (int i = 0; i < 200; i++) {
            double r[3];
            for (int k = 0; k < 3; k++) r[k] = random_number(-2, 2) * halves[h][k];
            ellipsoid_foot(halves[h], r);
        }
    }
}

/* The sphere as an ellipsoid, and inside as the mirror of outside. */
static void same_by_both(void **state)
{
    (void)state;
    ContactEntity ball = {.shape = ENTITY_SPHERE, .size = {0.7, 0.7, 0.7}}, round = ball, bowl = ball;
    round.shape = ENTITY_ELLIPSOID;
    bowl.inside = true;
    for (int i = 0; i < 1000; i++) {
        double r[3];
        for (int k = 0; k < 3; k++) r[k] = random_number(-1, 1);
        EntityGap a = entity_gap(&ball, r), b = entity_gap(&round, r), c = entity_gap(&bowl, r);
        assert_true(fabs(a.distance - b.distance) < 1e-14 && a.distance == -c.distance);
        for (int k = 0; k < 3; k++) assert_true(fabs(a.normal[k] - b.normal[k]) < 1e-13 && a.normal[k] == -c.normal[k]);
    }
    EntityGap plane = entity_gap(&(ContactEntity){.shape = ENTITY_PLANE}, (const double[]){3, 4, -0.5});
    assert_true(plane.distance == -0.5 && plane.normal[2] == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(against_libccd), cmocka_unit_test(feet_of_ellipsoids),
                                       cmocka_unit_test(same_by_both)};
    return cmocka_run_group_tests_name("shapes of contact entities", tests, NULL, NULL);
}

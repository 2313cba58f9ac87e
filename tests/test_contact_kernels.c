/* The kernels of contact against scalar forms: the exact ones have their bits, whatever the instruction set, and the
 * near ones err towards what is closer. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "contact/contact_geometry.h"
#include "contact/meet_kernels.h"
#include "contact/near_kernels.h"
#include "contact/sharp_kernels.h"
#include "elements/kernels.h"
#include "tests/next_number.h"
#include "tests/verify.h"

enum { NODES = 4 * CONTACT_GROUP, ROUNDS = 3000 };

/* The kernels of one instruction set. */
typedef struct Set {
    const char *name;
    const MeetKernels *meet;
    const NearKernels *near;
    const SharpKernels *sharp;
} Set;

/* Those that this processor has. */
static int list_sets(Set set[3])
{
    const Set all[] = {{"v2", &meet_kernels_v2, &near_kernels_v2, &sharp_kernels_v2},
                       {"v3", &meet_kernels_v3, &near_kernels_v3, &sharp_kernels_v3},
                       {"v4", &meet_kernels_v4, &near_kernels_v4, &sharp_kernels_v4}};
    int count = 0;
    for (int i = 0; i < 3; i++)
        if (kernels_select(all[i].name)) set[count++] = all[i];
    return count;
}

static void fill(double *x, int count, double scale)
{
    for (int i = 0; i < count; i++) x[i] = scale * next_number();
}

/* Node 0 of each lane and its triangle, nodes 1 to 3. Every fourth node lies above a corner or an edge's middle. */
static void place_faces(MeetFaces *block, double *x, double thickness)
{
    fill(x, 3 * NODES, 1.0);
    for (int l = 0; l < MEET_LANES; l++) {
        for (int k = 0; k < 4; k++) block->nodes.node[k][l] = 4 * l + k;
        for (int k = 0; k < 3 && l % 4 == 3; k++)
            x[12 * l + k] = l == 3 ? x[12 * l + 3 + k] : 0.5 * (x[12 * l + 3 + k] + x[12 * l + 6 + k]);
        if (l % 4 == 3) x[12 * l + 2] += 0.1 * next_number();
        block->memory[l] = NULL;
        block->thickness[l] = thickness;
        block->depth[l] = block->remembered[l] = 0.0;
    }
}

static void check_faces(const MeetFaces *block, const double *x, double thickness)
{
    for (int l = 0; l < MEET_LANES; l++) {
        ClosestPoint at = {.corner = {4 * l + 1, 4 * l + 2, 4 * l + 3}};
        double bound;
        bool near = closest_point(&at, x + 12 * (ptrdiff_t)l, x, thickness, &bound);
        assert_int_equal(block->near >> l & 1, near);
        if (!near) continue;
        assert_int_equal(block->feature[l], at.feature);
        assert_memory_equal(&block->height[l], &at.height, sizeof at.height);
        assert_memory_equal(&block->distance[l], &at.distance, sizeof at.distance);
        for (int k = 0; k < 3; k++) {
            assert_true(block->weight[k][l] == at.weight[k]);
            assert_true(block->normal[k][l] == at.normal[k]);
            assert_true(block->toward[k][l] == at.toward[k]);
        }
    }
}

static void closest_points(void **state)
{
    (void)state;
    Set set[3];
    const double still[3 * NODES] = {0};
    for (int count = list_sets(set), i = 0; i < ROUNDS; i++) {
        double x[3 * NODES], thickness = i % 2 ? 0.5 : 10.0;
        MeetFaces block;
        place_faces(&block, x, thickness);
        for (int s = 0; s < count; s++) {
            set[s].meet->faces(&(MeetStep){.x = x, .v = still, .longer = 1.0}, &block, 1);
            check_faces(&block, x, thickness);
        }
    }
}

/* Two points on the lines that the normal joins. */
static void check_crossing(const MeetEdges *block, const double *x, int l)
{
    double gap[3] = {0}, sum = 0.0;
    for (int i = 0; i < 4; i++) {
        sum += block->weight[i][l];
        for (int k = 0; k < 3; k++) gap[k] += block->weight[i][l] * x[3 * block->nodes.node[i][l] + k];
    }
    assert_true(fabs(sum) < 1e-12);
    for (int k = 0; k < 3; k++) assert_true(fabs(gap[k] - block->height[l] * block->normal[k][l]) < 1e-9);
}

static void crossings(void **state)
{
    (void)state;
    Set set[3];
    int crossed = 0;
    const double still[3 * NODES] = {0};
    for (int count = list_sets(set), i = 0; i < ROUNDS; i++) {
        double x[3 * NODES];
        MeetEdges block = {0}, first = {0};
        fill(x, 3 * NODES, 1.0);
        for (int l = 0; l < MEET_LANES; l++) {
            for (int k = 0; k < 4; k++) block.nodes.node[k][l] = 4 * l + k;
            block.thickness[l] = 0.7;
        }
        for (int s = 0; s < count; s++) {
            const MeetStep step = {.x = x, .v = still, .longer = 1.0};
            set[s].meet->edges(&step, &block, 1);
            assert_int_equal(block.cross & ~set[s].meet->may_cross(&step, &block.nodes), 0);
            if (s == 0) first = block;
            assert_memory_equal(&block, &first, sizeof block);
        }
        for (int l = 0; l < MEET_LANES; l++)
            if (block.cross >> l & 1) check_crossing(&block, x, l), crossed++;
    }
    verify_between("share of edges that cross", (double)crossed / ROUNDS / MEET_LANES, 0.05, 0.5);
}

/* Lanes of items with nodes of their own, from node number first on. */
static void fill_lanes(ContactLanes *lanes, int corners, int first, int items)
{
    for (int l = 0; l < CONTACT_GROUP; l++) {
        int item = l < items ? l : 0;
        lanes->item[l] = l < items ? l : -1;
        for (int n = 0; n < 4; n++) lanes->node[n][l] = n < corners ? first + corners * item + n : -1;
        lanes->side[l] = l < items ? CONTACT_SIDE_A | CONTACT_SIDE_B : 0;
        lanes->body[l] = -10 - first - l;
        lanes->shell[l] = -10 - first - l;
    }
}

/* An edge along an axis of its own with wings that turn by angle; lanes without wings come last. */
static void place_hinge(double *x, int32_t node[4], double angle, double size)
{
    double e[3], u[3], n[3], at[3];
    for (int k = 0; k < 3; k++) e[k] = next_number(), u[k] = next_number(), at[k] = 3.0 * next_number();
    vector3_normalize(e);
    vector3_cross(e, u, n);
    vector3_normalize(n);
    vector3_cross(n, e, u);
    for (int k = 0; k < 3; k++) {
        x[3 * node[0] + k] = size * at[k];
        x[3 * node[1] + k] = size * (at[k] + e[k]);
        x[3 * node[2] + k] = size * (at[k] + 0.3 * e[k] - 0.8 * u[k]);
        x[3 * node[3] + k] = size * (at[k] + 0.6 * e[k] + 0.5 * (cos(angle) * u[k] + sin(angle) * n[k]));
    }
}

static void turned_edges(void **state)
{
    (void)state;
    Set set[3];
    const double turn = 0.02, angles[] = {0.0, 0.0139, 0.0142, 0.0198, 0.0202, 0.5, 1.6, 3.1};
    const unsigned more[] = {0, 0, 1, 1, 3, 3, 3, 3}; /* bits: beyond the turn x 0.7071, beyond the turn */
    const float square[2] = {(float)(turn * turn), (float)(0.5 * turn * turn)};
    for (int count = list_sets(set), i = 0; i < 200; i++) {
        double x[3 * NODES], size = i % 2 ? 1e-4 : 1e3;
        ContactLanes lanes;
        fill_lanes(&lanes, 4, 0, CONTACT_GROUP);
        unsigned expected[2] = {0, 0};
        for (int l = 0; l < CONTACT_GROUP; l++) {
            int32_t node[4] = {4 * l, 4 * l + 1, 4 * l + 2, 4 * l + 3};
            place_hinge(x, node, (l % 2 ? -1.0 : 1.0) * angles[l / 2], size);
            expected[0] |= (more[l / 2] >> 1 & 1) << l;
            expected[1] |= (more[l / 2] & 1) << l;
        }
        lanes.node[3][15] = lanes.node[2][15] = lanes.node[0][15]; /* free */
        lanes.item[14] = -1;
        expected[0] &= ~(1u << 14), expected[1] &= ~(1u << 14);
        for (int s = 0; s < count; s++) {
            unsigned found[2];
            set[s].sharp->turned(&lanes, x, square, found);
            assert_int_equal(found[0], expected[0]);
            assert_int_equal(found[1], expected[1]);
        }
    }
}

static double exact_face(const double *x, const ContactLanes *nodes, int i, const ContactLanes *triangles, int t)
{
    ClosestPoint at = {.corner = {triangles->node[0][t], triangles->node[1][t], triangles->node[2][t]}};
    double bound;
    closest_point(&at, x + 3 * (ptrdiff_t)nodes->node[0][i], x, INFINITY, &bound);
    return at.distance;
}

/* Of a node from a segment. */
static double from_segment(const double *p, const double *a, const double *b)
{
    double u[3], r[3];
    vector3_subtract(b, a, u);
    vector3_subtract(p, a, r);
    double s = fmin(fmax(vector3_dot(u, r) / vector3_dot(u, u), 0.0), 1.0);
    for (int k = 0; k < 3; k++) r[k] -= s * u[k];
    return vector3_norm(r);
}

/* By thirds again and again: the distance from a segment is a convex function along the other. */
static double exact_edge(const double *x, const ContactLanes *own, int i, const ContactLanes *others, int f)
{
    const double *p = x + 3 * (ptrdiff_t)own->node[0][i], *q = x + 3 * (ptrdiff_t)own->node[1][i];
    const double *a = x + 3 * (ptrdiff_t)others->node[0][f], *b = x + 3 * (ptrdiff_t)others->node[1][f];
    double low = 0.0, high = 1.0, distance[2] = {0};
    for (int round = 0; round < 100; round++) {
        for (int side = 0; side < 2; side++) {
            double s = low + (1 + side) * (high - low) / 3.0, at[3];
            for (int k = 0; k < 3; k++) at[k] = p[k] + s * (q[k] - p[k]);
            distance[side] = from_segment(at, a, b);
        }
        if (distance[0] < distance[1])
            high = low + 2.0 * (high - low) / 3.0;
        else
            low = low + (high - low) / 3.0;
    }
    return distance[0];
}

/* All pairs within reach are found, and none of any is nearer than it says. */
static void check_look(const ContactLook *look, bool edges, double *closest, double *told)
{
    bool found[CONTACT_GROUP][CONTACT_GROUP] = {{0}};
    double nearest = DBL_MAX;
    for (int i = 0; i < look->count; i++) found[look->found[i].owner][look->found[i].other] = true;
    for (int i = 0; i < CONTACT_GROUP && look->owners->item[i] >= 0; i++)
        for (int t = 0; t < CONTACT_GROUP && look->others->item[t] >= 0; t++) {
            double distance = edges ? exact_edge(look->x, look->owners, i, look->others, t)
                                    : exact_face(look->x, look->owners, i, look->others, t);
            nearest = fmin(nearest, distance);
            if (distance <= look->reach) assert_true(found[i][t]);
        }
    assert_true(look->nearest <= nearest);
    *closest += nearest;
    *told += look->nearest;
}

static void looks(void **state)
{
    (void)state;
    Set set[3];
    static ContactLook look;
    double depth[CONTACT_GROUP] = {0}, closest = 0.0, told = 0.0;
    for (int count = list_sets(set), i = 0; i < 400; i++) {
        double x[3 * (NODES + CONTACT_GROUP)];
        ContactLanes own, others;
        bool edges = i % 2;
        fill(x, 3 * (NODES + CONTACT_GROUP), 1.0);
        fill_lanes(&own, edges ? 2 : 1, 0, i % 3 ? CONTACT_GROUP : 5);
        fill_lanes(&others, edges ? 2 : 3, edges ? 2 * CONTACT_GROUP : CONTACT_GROUP, i % 5 ? CONTACT_GROUP : 11);
        for (int n = 0; n < (edges ? 2 : 1) * CONTACT_GROUP; n++) x[3 * n + 2] += 0.02 * i;
        look = (ContactLook){.owners = &own, .others = &others, .x = x, .depth = depth, .reach = 0.3};
        for (int s = 0; s < count; s++) {
            (edges ? set[s].near->edges : set[s].near->faces)(&look);
            check_look(&look, edges, &closest, &told);
        }
    }
    verify_between("distances told over distances", told / closest, 0.8, 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(closest_points), cmocka_unit_test(crossings),
                                       cmocka_unit_test(turned_edges), cmocka_unit_test(looks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What contact keeps of triangles and edges in one place each, against the interface that it comes from. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "contact/contact_loop.h"

/* Three triangles around node 0; what is on the rim differs from corner to corner. Only node 4 moves. */
static int32_t triangle[] = {0, 1, 2, 3, 0, 2, 4, 3, 0};
static int32_t neighbour[] = {-1, 1, -1, 0, -1, 2, 1, -1, -2};
static unsigned char rim[] = {0, 1, 1, 0, 1, 0, 1, 0, 0};
static double triangle_radius[] = {1.0, 1.0, 2.0}, edge_radius[] = {2.0, 3.0};
static int32_t fan_start[] = {0, 3, 4, 6, 8, 9}, fan[] = {0, 1, 2, 0, 0, 1, 1, 2, 2};
static int32_t edge[] = {0, 2, 3, 4};
static double inverse[] = {0.0, 0.0, 0.0, 0.0, 5.0};

static const ContactInterface interface = {.triangle_count = 3,
                                           .triangle = triangle,
                                           .neighbour = neighbour,
                                           .corner_rim = rim,
                                           .triangle_radius = triangle_radius,
                                           .fan_start = fan_start,
                                           .fan = fan,
                                           .edge_count = 2,
                                           .edge = edge,
                                           .edge_radius = edge_radius};

static void records_are_those_of_the_interface(void **state)
{
    (void)state;
    const Model model = {.node_count = 5, .contact_inverse = inverse};
    ContactRun run = {.contact = &interface};
    assert_int_equal(contact_records_create(&run), 0);
    for (int again = 0; again < 2; again++) { /* as after erosion */
        contact_records_fill(&run, &model);
        for (int t = 0; t < 3; t++) {
            const ContactTriangle *kept = &run.triangle[t];
            for (int k = 0; k < 3; k++) {
                assert_int_equal(kept->corner[k], triangle[3 * t + k]);
                assert_int_equal(kept->neighbour[k], neighbour[3 * t + k]);
                assert_int_equal(kept->rims >> k & 1, rim[3 * t + k]);
            }
            assert_true(run.radius[kept->radius] == triangle_radius[t]);
            assert_int_equal(kept->moves, t == 2);
        }
        for (int e = 0; e < 2; e++) {
            for (int k = 0; k < 2; k++) assert_int_equal(run.edge[e].node[k], edge[2 * e + k]);
            assert_true(run.radius[run.edge[e].radius] == edge_radius[e]);
            assert_int_equal(run.edge[e].moves, e == 1);
        }
    }
    contact_records_free(&run);
}

/* The corners that follow node 0 in its triangles, in their sense. */
static void rings_keep_the_winding(void **state)
{
    (void)state;
    const int32_t expected[] = {1, 2, 2, 3, 4, 3};
    const Model model = {.node_count = 5, .contact_inverse = inverse};
    ContactRun run = {.contact = &interface};
    assert_int_equal(contact_records_create(&run), 0);
    contact_records_fill(&run, &model);
    for (int i = 0; i < 6; i++) assert_int_equal(run.ring[i], expected[i]);
    contact_records_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(records_are_those_of_the_interface),
                                       cmocka_unit_test(rings_keep_the_winding)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

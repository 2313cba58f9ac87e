/* The energy balance of motion that is prescribed against a pressure from the first step on (eq. L4a), and of
 * velocities that jump. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>

#include "tests/verify.h"

/* A box 0.2 x 0.3 x 1 under 1 MPa whose lid follows curve 8, as nodes or as a rigid body. */
static void run_box(VerifyRun *run, bool rigid, const char *curve)
{
    static const char sides[] = "*KEYWORD\n*CONTROL_TERMINATION\n4e-4\n*CONTROL_TIMESTEP\n,.9,,,,9\n"
                                "*DEFINE_CURVE\n9\n0,2e-6\n1,2e-6\n"
                                "*NODE\n1\n2,.2\n3,.2,.3\n4,0,.3\n5,0,0,1\n6,.2,0,1\n7,.2,.3,1\n8,0,.3,1\n"
                                "*ELEMENT_SHELL\n1,1,1,4,3,2\n2,2,5,6,7,8\n"
                                "3,3,1,2,6,5\n4,3,2,3,7,6\n5,3,3,4,8,7\n6,3,4,1,5,8\n"
                                "*SECTION_SHELL\n1,9\n1e-3\n*MAT_NULL\n1,1000\n*MAT_RIGID\n2,1000\n1,4,7\n"
                                "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n2,0,1,1,1\n3,0,1,1,1\n4,0,1,1,1\n"
                                "*SET_PART_LIST\n1\n1,2,3\n*AIRBAG_LOAD_CURVE\n1,1\n0,7\n"
                                "*DEFINE_CURVE\n7\n0,1e6\n1,1e6\n";
    static const char nodes[] = "*BOUNDARY_SPC_NODE\n5,0,1,1\n6,0,1,1\n7,0,1,1\n8,0,1,1\n*SET_NODE_LIST\n5\n5,6,7,8\n"
                                "*BOUNDARY_PRESCRIBED_MOTION_SET\n5,3,2,8\n",
                      body[] = "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,3,2,8\n";
    char text[4000];
    int length =
        snprintf(text, sizeof text,
                 "%s*PART\nfloor\n1,1,1\n*PART\nlid\n2,1,%d\n*PART\nwalls\n3,1,1\n%s*DEFINE_CURVE\n8\n%s*END\n", sides,
                 rigid ? 2 : 1, rigid ? body : nodes, curve);
    assert_int_equal(verify_build(run, text, (size_t)length, &(VerifyOptions){.every = 1}), 0);
    assert_int_equal(verify_loop(run), 0);
}

static void test_pressure_from_the_first_step_on(void **state)
{
    (void)state;
    for (int rigid = 0; rigid <= 1; rigid++) {
        VerifyRun run;
        run_box(&run, rigid, "0,0\n1,-10\n");
        double kinetic = run.samples[run.count - 1].kinetic;
        assert_true(kinetic > 1);
        verify_near("imbalance", run.imbalance, 0, 1e-10 * kinetic);
        verify_free(&run);
    }
}

/* There and back, with a jump: the full step between has no kinetic energy, all others balance. */
static void test_reversal(void **state)
{
    (void)state;
    for (int rigid = 0; rigid <= 1; rigid++) {
        VerifyRun run;
        run_box(&run, rigid, "0,0\n2e-4,-2e-3\n4e-4,0\n1,0\n");
        double kinetic = run.samples[1].kinetic;
        int off = 0;
        for (size_t i = 1; i < run.count; i++) off += fabs(run.samples[i].held - run.samples[i].given) > 1e-9 * kinetic;
        print_message("    %s: %d cycles off\n", rigid ? "body" : "nodes", off);
        assert_true(off <= 2);
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pressure_from_the_first_step_on),
        cmocka_unit_test(test_reversal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

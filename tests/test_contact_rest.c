/* A bag folded in eight layers deploys against itself and comes to rest: it is then the bag that came from flat. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include "contact/mesh_crossing.h"

enum { CELLS = 48 }; /* 9,216 elements */

/* Runs the bag to its end, where it must be at rest; its volume and energy stored in the fabric. */
static void come_to_rest(bool folded, double *volume, double *stored)
{
    Scene scene = {0};
    VerifyRun run;
    MeshCrossings crossings;
    scene_resting_bag(&scene, CELLS, folded);
    verify_scene(&run, &scene, &(VerifyOptions){.every = 50, .threads = 2});
    const Energies *e = run.state.energy;
    const VerifySample *last = &run.samples[run.count - 1];
    verify_between("least energy ratio", e->ratio_min, 0.99, 1.01);
    verify_between("largest energy ratio", e->ratio_max, 0.99, 1.01);
    verify_between("kinetic over stored energy", last->kinetic / last->internal, 0.0, 1e-6);
    verify_close("pressure", last->pressure, 115000, 1e-4); /* where the relief valve closes */
    assert_int_equal(
        mesh_find_crossings(run.model.element_count, run.model.element_node, run.internal_x, NULL, &crossings), 0);
    assert_int_equal(crossings.count, 0);
    *volume = last->volume;
    *stored = last->internal;
    verify_free(&run);
}

static void rests_as_from_flat(void **state)
{
    (void)state;
    double volume[2], stored[2];
    for (int folded = 0; folded < 2; folded++) come_to_rest(folded, &volume[folded], &stored[folded]);
    verify_close("volume, folded against flat", volume[1], volume[0], 1e-3);
    verify_close("stored energy, folded against flat", stored[1], stored[0], 1e-2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rests_as_from_flat)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

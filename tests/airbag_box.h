/* Tests of airbag cards from the deck's text to the pressure in a closed box 0.2 x 0.3 x 1 whose lid moves as told. */
#ifndef BILLOW_TESTS_AIRBAG_BOX_H
#define BILLOW_TESTS_AIRBAG_BOX_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "tests/verify.h"

/* The deck: cards is the text of the *AIRBAG keywords and curves; the lid moves by stroke over the time end, there and
 * back, as a triangle. Curve ids up to 9 and part set 1 are taken: parts 1 (bottom), 2 (lid), 3 (walls, null). */
static inline void box_run(VerifyRun *run, const char *cards, double end, double stroke, double limit,
                           const VerifyOptions *options)
{
    Scene scene = {0};
    verify_begin_box(&scene, (const double[3]){0.2, 0.3, 1}, 1, stroke != 0.0 ? 4 : 7, end);
    if (stroke != 0.0) {
        scene_write_curve(&scene.deck, 2, 3, (const double[]){0, 0, 0.5 * end, stroke, end, 0});
        scene_write_rigid_motion(&scene.deck, 2, 3, 2, 2, 1);
    }
    scene_print(&scene.deck, "%s", cards);
    if (limit > 0.0)
        scene_print(&scene.deck, "*CONTROL_TIMESTEP\n%g,0.9,0,0,0,9\n*DEFINE_CURVE\n9\n0,%g\n1,%g\n", limit, limit,
                    limit);
    scene_end(&scene.deck, &scene.mesh);
    verify_scene(run, &scene, options);
}

/* Sum of pressures over the run, for telling decks apart. */
static inline double box_signature(const char *cards, double end, double stroke)
{
    VerifyRun run;
    box_run(&run, cards, end, stroke, 0.0, &(VerifyOptions){.every = 1});
    double sum = verify_mean(&run, 0, end, offsetof(VerifySample, pressure)) +
                 1e3 * verify_mean(&run, 0, end, offsetof(VerifySample, mass)) +
                 verify_mean(&run, 0, end, offsetof(VerifySample, temperature)) +
                 verify_mean(&run, 0, end, offsetof(VerifySample, applied));
    verify_free(&run);
    return sum;
}

/* A field that is changed must change the result by more than this share. */
static inline void box_differs(const char *field, double base, double changed)
{
    if (!(fabs(changed - base) > 1e-4 * fabs(base)))
        print_message("%s has no effect: %.9g, %.9g\n", field, base, changed);
    assert_true(fabs(changed - base) > 1e-4 * fabs(base));
}

#endif

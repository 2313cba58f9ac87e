/* *AIRBAG_WANG_NEFSKE from the deck: the inflator of card 6 and the option POP. */
#include "tests/airbag_box.h"

#include <stdio.h>
#include <string.h>

#define CURVES "*DEFINE_CURVE\n3\n0,0\n0.03,1\n*DEFINE_CURVE\n4\n0,0\n0.02,1\n*DEFINE_CURVE\n5\n0,0\n1,0\n"

#define GAS "742,1038.8,300,0,%d,0,0,296.15\n0.8,0,1e-3\n101325,1.15,1,0,%g,%g\n"

static double inflated(const char *card6)
{
    char text[900];
    snprintf(text, sizeof text, "*AIRBAG_WANG_NEFSKE\n1,1\n" GAS "%s\n" CURVES, 0, 0.0, 0.0, card6);
    return box_signature(text, 0.04, -0.1);
}

static void inflator_fields(void **state)
{
    (void)state;
    double base = inflated("0.9,8e-5,0.4e-3,250,1000,3");
    box_differs("IOC", base, inflated("0.5,8e-5,0.4e-3,250,1000,3"));
    box_differs("IOA", base, inflated("0.9,6e-5,0.4e-3,250,1000,3"));
    box_differs("IVOL", base, inflated("0.9,8e-5,0.5e-3,250,1000,3"));
    box_differs("IRO", base, inflated("0.9,8e-5,0.4e-3,200,1000,3"));
    box_differs("IT", base, inflated("0.9,8e-5,0.4e-3,250,1200,3"));
    box_differs("LCBF", base, inflated("0.9,8e-5,0.4e-3,250,1000,4"));
}

/* Mass that has left the box, whose lid goes down by 0.2 and back. */
static double left(const char *option, double pover, double ppop, const char *card8)
{
    char text[900];
    VerifyRun run;
    snprintf(text, sizeof text, "*AIRBAG_WANG_NEFSKE%s\n1,1\n" GAS "\n%s\n" CURVES, option, 5, pover, ppop, card8);
    box_run(&run, text, 0.04, -0.2, 0, &(VerifyOptions){.every = 1});
    double out = run.state.gas[0].mass_out;
    verify_free(&run);
    return out;
}

/* The lid (part 2) is told to move by a triangle, so that its acceleration is a pulse at the start and at the middle.
 */
static void pop_fields(void **state)
{
    (void)state;
    double open = left("", 5e4, 0, ""), base = left("_POP", 5e4, 1e4, "0");
    box_differs("PPOP", open, left("", 5e4, 6e4, ""));
    verify_close("POP without delay", base, open, 1e-12);
    box_differs("TDP", base, left("_POP", 5e4, 1e4, "0.01"));
    verify_near("AZP never reached", left("_POP", 5e4, 0, "0,0,0,1e9,0,0,0,2"), 0, 0);
    double shaken = left("_POP", 5e4, 0, "0,0,0,0,1,0,0,2");
    verify_close("AMAGP reached at once", shaken, open, 0.05);
    box_differs("TDURP", shaken, left("_POP", 5e4, 0, "0,0,0,0,1,1e-3,0,2") + 1e-6);
    box_differs("TDA", shaken, left("_POP", 5e4, 0, "0,0,0,0,1,0,0.01,2"));
    double axes = left("_POP", 5e4, 0, "0,1,1,1,0,0,0,2"); /* one of the local axes is the lid's normal */
    verify_close("AXP, AYP, AZP", axes, shaken, 1e-12);
    double out[3] = {left("_POP", 5e4, 0, "0,1,0,0,0,0,0,2"), left("_POP", 5e4, 0, "0,0,1,0,0,0,0,2"),
                     left("_POP", 5e4, 0, "0,0,0,1,0,0,0,2")};
    int opened = (out[0] > 0) + (out[1] > 0) + (out[2] > 0);
    assert_int_equal(opened, 1);
    VerifyRun run;
    Scene scene = {0};
    verify_begin_box(&scene, (const double[3]){1, 1, 1}, 1, 7, 0.01);
    scene_print(&scene.deck, "*AIRBAG_WANG_NEFSKE_POP\n1,1\n" GAS "\n0,1,0,0,0,0,0,3\n" CURVES, 5, 0.0, 0.0);
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), -1);
    assert_true(verify_message(&run.diagnostics, SEVERITY_ERROR, "RBIDP = 3 is not a part of *MAT_RIGID"));
    verify_free(&run);
    scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(inflator_fields), cmocka_unit_test(pop_fields)};
    return cmocka_run_group_tests_name("WANG_NEFSKE", tests, NULL, NULL);
}

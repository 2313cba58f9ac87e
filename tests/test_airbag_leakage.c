/* Leakage and part vents from the deck: OPT, FVOPT, FLC, FAC and the others, *MAT_ADD_AIRBAG_POROSITY_LEAKAGE, A23 < 0,
 * blockage, warnings, abstat's areas. The box 0.2 x 0.3 x 1 has a lid that goes down and back; its walls are fabric. */
#include "tests/airbag_box.h"

#include <stdio.h>
#include <string.h>

#include "airbag/gas_vent.h"

#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n3\n0,0.001\n0.05,0.003\n*DEFINE_CURVE\n4\n1e5,0.2\n2e5,2\n*DEFINE_CURVE\n5\n0,0\n1,0\n"            \
    "*DEFINE_CURVE\n6\n0,0\n0.5,0.001\n1,0.004\n*DEFINE_CURVE\n7\n0,0\n1e5,0\n2e5,50\n"

static const double END = 0.05;

/* The deck: keyword and its cards after card 1, leakage fields of the walls' material (FLC, FAC, ELA, FVOPT, X0, X1).
 */
static void leak_run(VerifyRun *run, const char *bag, const char *porosity, const VerifyOptions *options)
{
    char text[1500];
    snprintf(text, sizeof text, "%s%s%s%s\n" CURVES, bag, porosity[0] ? "*MAT_ADD_AIRBAG_POROSITY_LEAKAGE\n3," : "",
             porosity, "");
    box_run(run, text, END, -0.3, 0, options);
}

#define WANG(a, opt) "*AIRBAG_WANG_NEFSKE\n1,1\n718,1005,300,0,5\n" a "\n1e5,1.16,1,0,2e4,0," #opt "\n\n"

static double leaked(const char *bag, const char *porosity)
{
    VerifyRun run;
    leak_run(&run, bag, porosity, &(VerifyOptions){.every = 1});
    double out = run.state.gas[0].mass_out;
    verify_free(&run);
    return out;
}

static void material_fields(void **state)
{
    (void)state;
    const char *orifice = WANG("0", 1);
    double base = leaked(orifice, "0.002,1");
    assert_true(base > 0.0);
    box_differs("FLC", base, leaked(orifice, "0.001,1"));
    box_differs("FLC < 0", base, leaked(orifice, "-3,1"));
    box_differs("FAC", base, leaked(orifice, "0.002,0.5"));
    box_differs("FAC < 0", base, leaked(orifice, "0.002,-4"));
    box_differs("FVOPT", base, leaked(orifice, "0.002,1,0,3"));
    box_differs("X0 = 1", base, leaked(orifice, "0.002,1,0,0,1"));
    box_differs("X0 = 1, FAC over the pressure ratio", base, leaked(orifice, "1,-6,0,0,1"));
    box_differs("X0", base, leaked(orifice, "0.001,0.001,0,0,0.001,0"));
    box_differs("X1", leaked(orifice, "0.001,0.001,0,0,0.001,0"), leaked(orifice, "0.001,0.001,0,0,0.001,0.002"));
    double laws[4] = {base, leaked(WANG("0", 3), "0.002,1"), leaked(WANG("0", 5), "0.002,3e-3"),
                      leaked(WANG("0", 7), "0.002,-7")};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < i; j++) box_differs("OPT", laws[j], laws[i]);
    verify_close("FVOPT decides over OPT", leaked(WANG("0", 1), "0.002,1,0,3"), laws[1], 1e-12);
    verify_near("OPT = 0 ignores FVOPT", leaked(WANG("0", 0), "0.002,1,0,3"), 0, 0);
    verify_near("OPT > 0 ignores CP23, AP23", leaked(WANG("0,0,0,0,1,0,1e-3", 1), "0,0"), 0, 0);
}

/* The same through *MAT_FABRIC: its leakage is that of *MAT_ADD_AIRBAG_POROSITY_LEAKAGE. */
static double fabric_leaked(const char *card3, const char *card4)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_add_box(&scene.mesh, 1, 2, 3, 0.2, 0.3, 1);
    scene_begin(deck, "box", END, 0);
    for (int p = 1; p <= 3; p++) scene_write_part(deck, p, 1, p == 3 ? 3 : 1, "wall");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_write_rigid(deck, 1, 7800, 7, 7);
    scene_print(deck, "*MAT_FABRIC\n3,800,1e8,1e8,0,0,0\n1e7,0,0,1\n0,%s\n%s\n\n", card3, card4);
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
    scene_print(deck, "%s" CURVES, WANG("0", 1));
    scene_end(deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double out = run.state.gas[0].mass_out;
    verify_free(&run);
    return out;
}

static void fabric_fields(void **state)
{
    (void)state;
    double base = fabric_leaked("0.0002,1,0", "0");
    assert_true(base > 0.0);
    box_differs("FLC", base, fabric_leaked("0.0001,1,0", "0"));
    box_differs("FAC", base, fabric_leaked("0.0002,0.5,0", "0"));
    box_differs("FVOPT", base, fabric_leaked("0.0002,1,0,0,0,3", "0"));
    box_differs("X0, X1", base, fabric_leaked("1e-4,1e-4,0", "0,0,0,0,0,0,1e-4,2e-4"));
    verify_close("the initial area with X0 = 1 and A0REF = 1", fabric_leaked("0.0002,1,0", "0,0,1,0,0,0,1,0"),
                 fabric_leaked("0.0002,1,0", "0,0,0,0,0,0,1,0"), 1e-12);
}

/* A23 < 0: the lid as a vent, alone or in a set; VNTOPT; the flow is that of its area. */
static void part_vents(void **state)
{
    (void)state;
    static const char *const sets = "*SET_PART_LIST\n8\n1,2\n";
    char text[900];
    double area = leaked(WANG("0.01,0,0.06", 0), "");
    verify_close("A23 = -2 is its area", leaked(WANG("0.01,0,-2", 0), ""), area, 1e-12);
    snprintf(text, sizeof text, "%s%s", WANG("0.01,0,-8,-1", 0), sets);
    verify_close("A23 = -8, LCA23 = -1 is the set's area", leaked(text, ""), leaked(WANG("0.01,0,0.12", 0), ""), 1e-12);
#define HYBRID(vntopt) "*AIRBAG_HYBRID\n1,1\n300,1.2e5,0,8.314\n0.01,0,-3\n0,0,1,0,0," #vntopt "\n0,0,0,0.029,1,29\n0\n"
    double whole = leaked(HYBRID(0), ""), increase = leaked(HYBRID(1), "");
    assert_true(whole > 0.0);
    verify_near("VNTOPT 1: the walls never grow", increase, 0, 0);
    verify_close("VNTOPT 2", leaked(HYBRID(2), ""), whole, 1e-12);
    verify_near("VNTOPT 10", leaked(HYBRID(10), ""), 0, 0);
}

/* Three quarters of the walls' nodes in contact, as the contact stage would say it. */
static void block(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)user, (void)view;
    for (int e = 0; state->contact_share && model->blockage && e < model->element_count; e++)
        state->contact_share[e] = model->parts[model->element_part[e]].id == 3 ? 0.75 : 0.0;
}

static void blockage(void **state)
{
    (void)state;
    double free = leaked(WANG("0", 2), "0.002,1");
    static const char *const cards[3] = {"0.002,1", "0.002,1,0.2", "0.002,1,-3"};
    double out[3];
    for (int k = 0; k < 3; k++) {
        VerifyRun run;
        leak_run(&run, WANG("0", 2), cards[k], &(VerifyOptions){.every = 1, .probe = block});
        out[k] = run.state.gas[0].mass_out;
        const Airbag *bag = &run.model.airbags[0];
        for (int i = 0; i < bag->part_count; i++) {
            double area = run.state.part_area[bag->first_part + i],
                   blocked = run.state.part_blocked[bag->first_part + i];
            int id = run.model.parts[bag->part[i]].id;
            verify_near("blocked area", blocked, id == 3 ? 0.75 * area : 0.0, 1e-12);
            assert_true(area > 0.0);
        }
        verify_free(&run);
    }
    verify_between("blocked leakage", out[0] / free, 0.24, 0.4); /* the gas stays longer above the outside */
    verify_between("ELA", out[1] / out[0], 1.2, 1.6);
    box_differs("ELA < 0", out[0], out[2]);
    VerifyRun run; /* an odd option does not see it */
    leak_run(&run, WANG("0", 1), "0.002,1", &(VerifyOptions){.every = 1, .probe = block});
    assert_false(run.model.blockage);
    verify_close("OPT = 1", run.state.gas[0].mass_out, free, 1e-12);
    verify_free(&run);
}

/* The parts' flows add up to what the bag's columns say. */
static void flows_by_part(void **state)
{
    (void)state;
    VerifyRun run;
    leak_run(&run, WANG("0.01,0,-2", 1), "0.002,1", &(VerifyOptions){.every = 1, .stop_time = 0.02});
    const Airbag *bag = &run.model.airbags[0];
    const GasState *gas = &run.state.gas[0];
    double flow[8], weight[8], sum = 0;
    GasAreas areas = {run.state.part_area, run.state.part_blocked, NULL};
    gas_part_flows(&bag->gas, run.model.curves, &areas, gas, run.state.clock->time, bag->part_count, weight, flow);
    for (int i = 0; i < bag->part_count; i++) {
        int id = run.model.parts[bag->part[i]].id;
        sum += flow[i];
        if (id == 2) verify_close("vent", flow[i], gas->mass_flow_out_vent, 1e-12);
        if (id == 3) verify_close("leakage", flow[i], gas->mass_flow_out_porosity, 1e-12);
    }
    assert_true(gas->mass_flow_out_vent > 0.0 && gas->mass_flow_out_porosity > 0.0);
    verify_close("sum", sum, gas->mass_flow_out, 1e-9);
    verify_free(&run);
}

/* Porosity without area is said at the start. */
static void warnings(void **state)
{
    (void)state;
    static const struct {
        const char *bag, *porosity, *message;
    } cases[] = {{WANG("0", 1), "", "the leakage has no area"},
                 {WANG("0", 1), "0,1,0,3", "does not leak"},
                 {WANG("0", 0), "0.002,1,0,1", "has OPT = 0"},
                 {WANG("0,0,0,0,0,0,1e-3", 0), "", "only the area"},
                 {WANG("0,0,0,0,1,0,0", 0), "", "only the coefficient"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        VerifyRun run;
        leak_run(&run, cases[i].bag, cases[i].porosity, &(VerifyOptions){.stop = 1});
        if (!verify_message(&run.diagnostics, SEVERITY_WARNING, cases[i].message))
            print_message("not said: %s\n", cases[i].message);
        assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, cases[i].message));
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(material_fields), cmocka_unit_test(fabric_fields),
                                       cmocka_unit_test(part_vents),      cmocka_unit_test(blockage),
                                       cmocka_unit_test(flows_by_part),   cmocka_unit_test(warnings)};
    return cmocka_run_group_tests_name("leakage", tests, NULL, NULL);
}

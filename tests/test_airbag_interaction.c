/* *AIRBAG_INTERACTION from the deck: two boxes 0.2 x 0.2, 1 and 2 high, with one wall in common (part 2). */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

static const double CV = 717.6549, CP = 1004.71686;

/* The boxes; the upper's bottom is the lower's lid. */
static void begin_boxes(Scene *scene, double end, bool moving)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_box(mesh, 1, 2, 3, 0.2, 0.2, 1);
    int upper = mesh->node_count;
    scene_add_box(mesh, 4, 5, 6, 0.2, 0.2, 2);
    scene_transform(mesh, upper, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[3]){0, 0, 1});
    scene_drop_part(mesh, 4);
    scene_weld(mesh, 0, 1e-6);
    scene_begin(deck, "two chambers", end, 0);
    static const int material[7] = {0, 1, 2, 3, 0, 1, 3};
    for (int p = 1; p <= 6; p++)
        if (p != 4) scene_write_part(deck, p, 1, material[p], "wall");
    scene_write_section(deck, 1, 9, 0.01);
    scene_write_rigid(deck, 1, 7800, 7, 7);
    scene_write_rigid(deck, 2, 7800, moving ? 4 : 7, 7);
    scene_write_null(deck, 3, 1e-6);
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
    scene_write_part_set(deck, 2, 3, (const int[]){2, 5, 6});
    scene_write_curve(deck, 1, 2, (const double[]){0, 0, 1e4, 0});
    scene_write_curve(deck, 3, 2, (const double[]){1e5, 1e-3, 3e5, 3e-3});
    scene_write_curve(deck, 4, 2, (const double[]){0, 0, 0.02, 1});
    scene_write_curve(deck, 5, 2, (const double[]){0, 0, 2e5, 0.5});
}

static void write_bag(SceneText *deck, int id, double pover, double iabt)
{
    scene_print(deck, "*AIRBAG_WANG_NEFSKE_ID\n%d,chamber\n%d,1\n", id, id);
    SCENE_CARD(deck, CV, CP, 300, 0, 1, 0, 0, iabt);
    SCENE_CARD(deck, 0);
    SCENE_CARD(deck, 101325, 1.2, 1, 0, pover);
    scene_print(deck, "\n");
}

static void write_pair(Scene *scene, const char *interaction)
{
    write_bag(&scene->deck, 1, 300000 - 101325, 400);
    write_bag(&scene->deck, 2, 0, 300);
    if (interaction) scene_print(&scene->deck, "*AIRBAG_INTERACTION\n%s\n", interaction);
    scene_end(&scene->deck, &scene->mesh);
}

/* B9 with the step that billow finds; the opening by the area of the part. */
static void equalisation(void **state)
{
    (void)state;
    static const double table[][3] = {{0.002, 290433.277, 396.313254}, {0.005, 276729.518, 390.877976},
                                      {0.01, 255499.221, 382.064473},  {0.015, 236117.814, 373.549232},
                                      {0.02, 218647.022, 365.434229},  {0.025, 203394.367, 357.961622}};
    static const char *const cards[] = {"1,2,2e-3,1", "1,2,0,0.05,2", "1,2,0,0.05,-2", "2,1,2e-3,1,0,0,1"};
    for (int k = 0; k < 4; k++) {
        Scene scene = {0};
        begin_boxes(&scene, 0.06, false);
        write_pair(&scene, cards[k]);
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        print_message("    %ld cycles\n", (long)run.cycles);
        for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
            double t = table[i][0];
            verify_close("B9 p1", verify_at(&run, t, offsetof(VerifySample, pressure)), table[i][1], 1e-4);
            verify_close("B9 T1", verify_at(&run, t, offsetof(VerifySample, temperature)), table[i][2], 1e-4);
        }
        const GasState *g = run.state.gas;
        verify_close("B9 end p1", g[0].pressure, 167550, 1e-4);
        verify_close("B9 end p2", g[1].pressure, 167550, 1e-4);
        verify_close("B9 end T1", g[0].temperature, 338.673253, 1e-4);
        verify_close("B9 end T2", g[1].temperature, 360.022419, 1e-4);
        verify_near("mass", (g[0].mass + g[1].mass) / (g[0].initial_mass + g[1].initial_mass) - 1, 0, 1e-13);
        double energy = g[0].initial_energy + g[1].initial_energy;
        verify_near("energy", (g[0].energy + g[1].energy) / energy - 1, 0, 1e-12);
        verify_free(&run);
    }
}

static double flow_of(const char *interaction)
{
    Scene scene = {0};
    begin_boxes(&scene, 0.01, false);
    write_pair(&scene, interaction);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double out = run.state.gas[0].mass_out - run.state.gas[0].mass_in;
    verify_free(&run);
    return out;
}

static void fields(void **state)
{
    (void)state;
    double base = flow_of("1,2,2e-3,1");
    assert_true(base > 0.0);
    static const struct {
        const char *name, *card;
        double least, most;
    } changes[] = {{"AREA", "1,2,3e-3,1", 1.3, 1.6},
                   {"AREA < 0", "1,2,-3,1", 1.1, 1.6},
                   {"SF", "1,2,2e-3,0.7", 0.6, 0.8},
                   {"SF < 0", "1,2,2e-3,-4", 0.1, 0.4},
                   {"PID", "1,2,0,0.1,2", 1.7, 2.1},
                   {"LCID", "1,2,2e-3,1,2,5", 0.3, 0.7},
                   {"IFLOW > 0", "1,2,2e-3,1,0,0,1", -0.1, 1e-9},
                   {"IFLOW < 0", "1,2,2e-3,1,0,0,-1", 0.999, 1.001}};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++)
        verify_between(changes[i].name, flow_of(changes[i].card) / base, changes[i].least, changes[i].most);
}

/* EXCP: the partition does not feel the difference of the pressures; both volumes follow it all the same. */
static void excluded_partition(void **state)
{
    (void)state;
    for (int excluded = 0; excluded < 2; excluded++) {
        Scene scene = {0};
        begin_boxes(&scene, 0.005, true);
        write_pair(&scene, excluded ? "1,2,0,1e-9,2,0,0,1" : "1,2,0,1e-9,2,0,0,0");
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        double grown = run.state.gas[0].volume / 0.04 - 1;
        if (excluded)
            verify_near("volume with EXCP = 1", grown, 0, 1e-12);
        else
            verify_between("volume with EXCP = 0", grown, 1e-3, 1);
        verify_close("both volumes", run.state.gas[0].volume + run.state.gas[1].volume, 0.12, 1e-12);
        verify_free(&run);
    }
}

/* A piston between two chambers that vent into each other: total energy of gas, wall and their work over 1e5 cycles,
 * and against the mechanical work the difference falls as the step squared. */
static void conservation(void **state)
{
    (void)state;
    double off[2];
    for (int k = 0; k < 2; k++) {
        Scene scene = {0};
        begin_boxes(&scene, 0.02, true);
        double dt = k ? 2e-7 : 4e-7; /* below what billow would take */
        scene_print(&scene.deck, "*CONTROL_TIMESTEP\n%g,0.9,0,0,0,9\n*DEFINE_CURVE\n9\n0,%g\n1,%g\n", dt, dt, dt);
        write_pair(&scene, "1,2,5e-4,0.7");
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        const GasState *g = run.state.gas;
        print_message("    %ld cycles\n", (long)run.cycles);
        double before = g[0].initial_energy + g[1].initial_energy;
        double after = g[0].energy + g[1].energy + g[0].work + g[1].work;
        verify_near("gas energy and its work", after / before - 1, 0, 1e-12);
        double volume = (g[0].volume - 0.04 + g[1].volume - 0.08) * 101325; /* work against the ambient pressure */
        off[k] = fabs(g[0].work + g[1].work - volume - run.state.energy->airbag_work) / run.energy;
        verify_free(&run);
    }
    print_message("    work of the gas less that of the forces: %.3g, half the step: %.3g\n", off[0], off[1]);
    verify_between("order of the difference", off[0] / off[1], 3.3, 4.7);
}

/* What the exits have let out over the run: the surroundings' mass. */
static void sum_exits(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)view;
    for (int i = 0; i < model->airbag_count; i++)
        *(double *)user +=
            (state->gas[i].mass_flow_out_vent + state->gas[i].mass_flow_out_porosity) * state->clock->step;
}

/* Everything at once for 1e5 cycles: an inflow, vents, leaking fabric, the moving wall and the opening in it. */
static void conservation_with_all(void **state)
{
    (void)state;
    Scene scene = {0};
    begin_boxes(&scene, 0.02, true);
    scene_print(&scene.deck, "*CONTROL_TIMESTEP\n2e-7,0.9,0,0,0,9\n*DEFINE_CURVE\n9\n0,2e-7\n1,2e-7\n"
                             "*DEFINE_CURVE\n10\n0,3\n0.01,8\n0.02,1\n*MAT_ADD_AIRBAG_POROSITY_LEAKAGE\n3,1e-4,1\n");
    for (int id = 1; id <= 2; id++) {
        scene_print(&scene.deck, "*AIRBAG_WANG_NEFSKE_ID\n%d,chamber\n%d,1\n", id, id);
        SCENE_CARD(&scene.deck, CV, CP, 700, 0, id == 1 ? 10 : 1, 0, 0, 400);
        SCENE_CARD(&scene.deck, 0.7, 0, id == 1 ? 2e-3 : 1e-3);
        SCENE_CARD(&scene.deck, 101325, 1.2, 1, 0, id == 1 ? 2e5 : 0, 0, id == 1 ? 1 : 0);
        scene_print(&scene.deck, "\n");
    }
    scene_print(&scene.deck, "*AIRBAG_INTERACTION\n1,2,5e-4,0.7\n");
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    double outside = 0;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = sum_exits, .user = &outside});
    const GasState *g = run.state.gas;
    assert_true(run.cycles >= 100000);
    verify_between("mass that left [kg]", outside, 0.01, 1);
    verify_between("largest volume of the first", verify_largest(&run, 0, offsetof(VerifySample, volume)), 0.041, 0.12);
    double mass =
        g[0].initial_mass + g[1].initial_mass + 0.01 * (3 + 8) / 2 + 0.01 * (8 + 1) / 2; /* the inflow's curve */
    double balance = 0, energy = 0;
    for (int i = 0; i < 2; i++) {
        balance += g[i].energy + g[i].work + g[i].enthalpy_out - g[i].enthalpy_in - g[i].initial_energy;
        energy += g[i].energy;
    }
    print_message("    %ld cycles, %.3g kg outside, %.3g J of work\n", (long)run.cycles, outside,
                  g[0].work + g[1].work);
    verify_near("mass of bags and surroundings", (g[0].mass + g[1].mass + outside) / mass - 1, 0, 1e-10);
    verify_near("energy of bags and surroundings", balance / energy, 0, 1e-10);
    verify_free(&run);
}

static void refusals(void **state)
{
    (void)state;
    static const char *const other = "*AIRBAG_SIMPLE_AIRBAG_MODEL_ID\n2,other\n2,1\n700,1000,300,1,0,0,101325,1.2\n";
    static const char *const law = "*AIRBAG_LOAD_CURVE_ID\n2,other\n2,1\n0,1\n";
    static const char *const closed = "*AIRBAG_ADIABATIC_GAS_MODEL_ID\n2,other\n2,1\n1,0,1.4,0,1e5,1.2\n";
    static const struct {
        const char *second, *card, *message;
    } wrong[] = {{other, "1,2,1e-3,1", "same gas"},           {other, "1,3,1e-3,1", "AB2 = 3 is not the ABID"},
                 {other, "1,1,1e-3,1", "must name two bags"}, {other, "1,2,0,1", "AREA, PID and LCID are all 0"},
                 {other, "1,2,0,1,77", "PID = 77"},           {other, "1,2,-77,1", "AREA = 77"},
                 {law, "1,2,0,0,0,5", "without one"},         {closed, "1,2,0,0,0,5", "cannot be connected"}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        Scene scene = {0};
        begin_boxes(&scene, 0.01, false);
        write_bag(&scene.deck, 1, 0, 300);
        scene_print(&scene.deck, "%s*AIRBAG_INTERACTION\n%s\n", wrong[i].second, wrong[i].card);
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        int status = verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
        if (!verify_message(&run.diagnostics, SEVERITY_ERROR, wrong[i].message))
            print_message("not said: %s\n", wrong[i].message);
        assert_int_equal(status, -1);
        assert_true(verify_message(&run.diagnostics, SEVERITY_ERROR, wrong[i].message));
        verify_free(&run);
        scene_free(&scene);
    }
}

/* Two HYBRID bags with different lists of gases: one list for both, each gas kept. */
static void mixtures(void **state)
{
    (void)state;
    Scene scene = {0};
    begin_boxes(&scene, 0.05, false);
    static const char *const gases[2] = {"0,0,0,0.004,1,20.8\n0\n", "0,0,0,0.029,1,28.1,0.002\n0\n"};
    for (int k = 0; k < 2; k++)
        scene_print(&scene.deck, "*AIRBAG_HYBRID_ID\n%d,mix\n%d,1\n300,%g,0,8.314\n0\n0,0,1\n%s", k + 1, k + 1,
                    k ? 1e5 : 3e5, gases[k]);
    scene_print(&scene.deck, "*AIRBAG_INTERACTION\n1,2,2e-3,1\n");
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    const GasState *g = run.state.gas;
    assert_int_equal(run.model.airbags[0].gas.species_count, 2);
    verify_close("helium", g[0].species[0] + g[1].species[0], 3e5 * 0.04 * 0.004 / (8.314 * 300), 1e-12);
    verify_close("air", g[1].species[1], 1e5 * 0.08 * 0.029 / (8.314 * 300), 1e-12);
    verify_near("no air in the first", g[0].species[1], 0, 1e-12);
    verify_close("pressures", g[0].pressure, g[1].pressure, 1e-6);
    verify_free(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(equalisation),
                                       cmocka_unit_test(fields),
                                       cmocka_unit_test(excluded_partition),
                                       cmocka_unit_test(conservation),
                                       cmocka_unit_test(conservation_with_all),
                                       cmocka_unit_test(mixtures),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests_name("connected bags", tests, NULL, NULL);
}

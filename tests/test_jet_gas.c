/* What the jet's gas is made of: mixtures (HYBRID_JETTING), the inflator's chamber, connected bags; every field of the
 * jetting cards of HYBRID acts. */
#include "tests/jet_case.h"

#include <stdio.h>

#include "airbag/gas_inflow.h"
#include "airbag/gas_jet.h"
#include "tests/mixture_case.h"

static const double R = 8.314462618;

/* Curves: 31 mass flow of 1 kg/s, 32 of half of that, 33 and 34 temperatures. */
#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n31\n0,1\n1,1\n*DEFINE_CURVE\n32\n0,0.5\n1,0.5\n*DEFINE_CURVE\n33\n0,700\n1,700\n*DEFINE_CURVE\n"   \
    "34\n0,400\n1,400\n*DEFINE_CURVE\n8\n0,0.2\n1,0.2\n*DEFINE_CURVE\n9\n0,0.5\n1,0.5\n*SET_PART_LIST\n7\n3\n*NODE\n"  \
    "90001,0.18,0.18,0.05\n90002,0.18,0.18,1.\n90003,0.28,0.18,0.05\n"
#define NITROGEN "31,33,0,0.0280134,1,29.1006191630,0,0\n"
#define HELIUM "32,34,0,0.0040026,0,20.786156545,0,0\n"

/* Force on the roof with the cards of HYBRID_JETTING: card 3, gases, cards 6 to 8. */
static double hybrid_force(const char *option, const char *card3, const char *gases, const char *jet)
{
    char text[1600];
    double force[3];
    int count = strstr(gases, "0.004") ? 2 : 1;
    snprintf(text, sizeof text, "*AIRBAG_HYBRID%s\n1,1\n%s\n0\n0,0,%d\n%s%s" CURVES, option, card3, count, gases, jet);
    VerifyRun run;
    run_bag(&run, force, text, 30);
    double length = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    verify_near("abstat's reaction", run.state.gas[0].reaction, length, 1e-12 * length);
    verify_free(&run);
    return force[2];
}

#define AIR3 "300,101325,1.2,8.314462618,1,0"
#define CONE "0.18,0.18,0.05,0.18,0.18,1.,0.2,1.\n"
#define FOCUS "0,0,0,0,0,0,0,0\n"

/* One gas is the jet of WANG_NEFSKE; two leave at the temperature that they have when mixed. */
static void mixtures(void **state)
{
    (void)state;
    VerifyRun run;
    double wang[3], force[3];
    run_duct(&run, wang, "_JETTING_CM", CONE FOCUS "0\n", "", 30);
    verify_free(&run);
    verify_close("nitrogen as of WANG_NEFSKE [N]", hybrid_force("_JETTING_CM", AIR3, NITROGEN "0\n", CONE FOCUS "0\n"),
                 wang[2], 1e-8);
    /* 1 kg/s of nitrogen at 700 K, 0.5 kg/s of helium at 400 K */
    double cp1 = 29.1006191630 / 0.0280134, cp2 = 20.786156545 / 0.0040026;
    double r = (R / 0.0280134 + 0.5 * R / 0.0040026) / 1.5, cp = (cp1 + 0.5 * cp2) / 1.5;
    double mixed = (cp1 * 700 + 0.5 * cp2 * 400) / (1.5 * cp), speed = sqrt(cp / (cp - r) * r * mixed);
    verify_close("with helium [N]",
                 hybrid_force("_JETTING_CM", AIR3, NITROGEN "0\n" HELIUM "0\n", CONE FOCUS "0\n") / wang[2],
                 1.5 * speed / OUTLET, 1e-6);
    /* FMASS: half a kg/s of the air of the start, at 300 K, comes with it */
    double drawn = sqrt(1.4 * R / 0.0280134 * (700 + 0.5 * 300) / 1.5);
    verify_close("with what it draws in [N]",
                 hybrid_force("_JETTING_CM", AIR3, NITROGEN "0.5\n", CONE FOCUS "0\n") / wang[2], 1.5 * drawn / OUTLET,
                 1e-6);
    verify_close("CC as GC",
                 hybrid_force("_JETTING_CM", "300,101325,1.2,8.314462618,4,0", NITROGEN "0\n", CONE FOCUS "0\n"),
                 wang[2] / 2, 1e-8);
    run_duct(&run, force, "_JETTING", CONE FOCUS, "", 30);
    verify_free(&run);
    verify_close("without CM [N]", hybrid_force("_JETTING", AIR3, NITROGEN "0\n", CONE FOCUS), force[2], 1e-9);
    verify_close("ATMOSD",
                 hybrid_force("_JETTING", "300,101325,2.4,8.314462618,1,0", NITROGEN "0\n", CONE FOCUS) / force[2], 0.5,
                 1e-9);
}

/* Each field of cards 6 to 8 that is changed changes the force by more than a thousandth. */
static void fields(void **state)
{
    (void)state;
    static const char *const changes[][2] = {
        {"XJFP", "0.05,0.18,0.05,0.18,0.18,1.,0.2,1.\n" FOCUS},
        {"YJFP", "0.18,0.10,0.05,0.18,0.18,1.,0.2,1.\n" FOCUS},
        {"ZJFP", "0.18,0.18,0.15,0.18,0.18,1.,0.2,1.\n" FOCUS},
        {"XJVH", "0.18,0.18,0.05,0.58,0.18,1.,0.2,1.\n" FOCUS},
        {"YJVH", "0.18,0.18,0.05,0.18,0.78,1.,0.2,1.\n" FOCUS},
        {"ZJVH", "0.18,0.18,0.05,0.18,0.18,-1.,0.2,1.\n" FOCUS},
        {"CA", "0.18,0.18,0.05,0.18,0.18,1.,0.3,1.\n" FOCUS},
        {"BETA", "0.18,0.18,0.05,0.18,0.18,1.,0.2,0.5\n" FOCUS},
        {"BETA < 0", "0.18,0.18,0.05,0.18,0.18,1.,0.2,-9\n" FOCUS},
        {"XSJFP", CONE "0.28,0.18,0.05,0,0,0,0,0\n"},
        {"YSJFP", CONE "0.18,0.28,0.05,0,0,0,0,0\n"},
        {"PSID", CONE "0,0,0,7,0,0,0,0\n"},
        {"NODE3", CONE "0,0,0,0,0,90001,90002,90003\n"},
    };
    double base = hybrid_force("_JETTING", AIR3, NITROGEN "0\n", CONE FOCUS);
    assert_true(base > 1);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        double force = hybrid_force("_JETTING", AIR3, NITROGEN "0\n", changes[i][1]);
        if (!(fabs(force - base) > 1e-3 * base)) print_message("%s: %g, %g\n", changes[i][0], base, force);
        assert_true(fabs(force - base) > 1e-3 * base);
    }
    verify_close("CA < 0: the curve has the constant's value",
                 hybrid_force("_JETTING", AIR3, NITROGEN "0\n", "0.18,0.18,0.05,0.18,0.18,1.,-8,1.\n" FOCUS), base,
                 1e-12);
    verify_close("NODE1, NODE2",
                 hybrid_force("_JETTING", AIR3, NITROGEN "0\n", "9.,9.,9.,9.,9.,9.,0.2,1.\n0,0,0,0,0,90001,90002,0\n"),
                 base, 1e-12);
    verify_close("IDUM has no say", hybrid_force("_JETTING", AIR3, NITROGEN "0\n", CONE "0,0,0,0,20.,0,0,0\n"), base,
                 1e-15);
}

static void reaction_field(void **state)
{
    (void)state;
    VerifyRun run;
    double force[3];
    run_bag(&run, force,
            "*AIRBAG_HYBRID_JETTING_CM\n1,1\n" AIR3 "\n0\n0,0,1\n" NITROGEN "0\n" CONE FOCUS "90001\n" CURVES, 6);
    assert_true(run.model.jets[0].react_node >= 0);
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "NREACT = 90001 has no mass"));
    verify_free(&run);
}

/* The inflator of card 6: what leaves its chamber at T_I, by (J1) with the flow of the step. */
static void inflator_chamber(void **state)
{
    (void)state;
    VerifyRun run;
    double force[3];
    SceneText text = {0};
    double r = R / 0.0280134;
    scene_print(&text, "*AIRBAG_WANG_NEFSKE_JETTING_CM\n1,1\n");
    SCENE_CARD(&text, 2.5 * r, 3.5 * r, 0, 0, 0, 0, 0, 300);
    scene_print(&text, "0\n101325,1.2,1\n0.9,8e-5,0.4e-3,250,1000,12\n" CONE FOCUS "0\n");
    scene_print(&text, "*DEFINE_CURVE\n12\n0,0\n0.03,1\n");
    run_bag(&run, force, text.text, 60);
    const GasState *gas = &run.state.gas[0];
    double temperature = gas->inflator_energy / (gas->inflator_mass * 2.5 * r);
    verify_between("the chamber has warmed up [K]", temperature, 500, 1400);
    assert_true(gas->mass_flow_inflator > 0.01);
    verify_close("force of the chamber's jet [N]", force[2], gas->mass_flow_inflator * sqrt(1.4 * r * temperature),
                 0.01);
    scene_text_free(&text);
    verify_free(&run);
}

/* What comes from another bag is no jet. */
static void connected_bag_is_no_jet(void **state)
{
    (void)state;
    VerifyRun run;
    double force[3];
    SceneText text = {0};
    double r = R / 0.0280134;
    for (int bag = 1; bag <= 2; bag++) { /* the same surface twice, the second at twice the pressure */
        scene_print(&text, "*AIRBAG_WANG_NEFSKE%s_ID\n%d,bag\n1,1\n", bag == 1 ? "_JETTING_CM" : "", bag);
        SCENE_CARD(&text, 2.5 * r, 3.5 * r, 700, 0, bag == 1 ? 31 : 12, 0, 0, 300);
        scene_print(&text, "0\n101325,1.2,1,0,%d\n0\n", bag == 1 ? 0 : 101325);
        if (bag == 1) scene_print(&text, CONE FOCUS "0\n");
    }
    scene_print(&text, "*AIRBAG_INTERACTION\n1,2,1e-3,1.\n*DEFINE_CURVE\n12\n0,0\n1,0\n*DEFINE_CURVE\n31\n0,1\n1,1\n");
    run_bag(&run, force, text.text, 60);
    assert_true(run.state.gas[0].mass_flow_in > 1.1);
    verify_close("force of the inflator's jet alone [N]", force[2], OUTLET, 0.01);
    scene_text_free(&text);
    verify_free(&run);
}

/* The flow that the jet is made of ends with the inflow; before the sensor fires there is none. */
static void no_flow_no_jet(void **state)
{
    (void)state;
    MixtureCase m;
    mixture_start(&m, 0.1);
    case_start(&m.c);
    GasModel *gas = &m.c.gas;
    m.sources[MIX_N2].mass_flow_curve = case_curve(&m.c, 2, (const double[]){0, 1, 1, 0});
    m.sources[MIX_N2].temperature_curve = case_curve(&m.c, 2, (const double[]){0, 700, 1, 700});
    m.c.state.mass_flow_inflator = 0.5;
    GasJet jet = gas_jet(gas, m.c.curves, &m.c.state, 0.5);
    assert_true(jet.mass_flow == 0.5 && jet.speed > 500);
    assert_true(gas_jet(gas, m.c.curves, &m.c.state, 2.0).mass_flow == 0); /* over */
    m.c.state.inflow_start = 1.0;
    assert_true(gas_jet(gas, m.c.curves, &m.c.state, 0.5).mass_flow == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mixtures),
        cmocka_unit_test(fields),
        cmocka_unit_test(reaction_field),
        cmocka_unit_test(inflator_chamber),
        cmocka_unit_test(connected_bag_is_no_jet),
        cmocka_unit_test(no_flow_no_jet),
    };
    return cmocka_run_group_tests_name("jet gas", tests, NULL, NULL);
}

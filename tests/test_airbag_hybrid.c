/* *AIRBAG_HYBRID and *AIRBAG_HYBRID_CHEMKIN from the deck: every field acts, references B4 and B6 through the deck. */
#include "tests/airbag_box.h"

#include <stdio.h>
#include <string.h>

/* Curves: 3, 4 mass flows; 5, 6 temperatures; 7 over pressure; 8 over time; 10 mole fraction. */
#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n3\n0,0\n0.01,1\n0.03,0.5\n0.05,0.5\n*DEFINE_CURVE\n4\n0,0.5\n0.05,0.2\n"                           \
    "*DEFINE_CURVE\n5\n0,500\n0.01,800\n0.05,700\n*DEFINE_CURVE\n6\n0,400\n0.05,400\n"                                 \
    "*DEFINE_CURVE\n7\n0,0.001\n1e6,0.002\n*DEFINE_CURVE\n8\n0,0.5\n0.05,1\n*DEFINE_CURVE\n11\n0,0\n0.05,900\n*"       \
    "DEFINE_CURVE\n10\n0,0.2\n0.05,0.9\n*DEFINE_CURVE_FUNCTION\n12\n1.E-3\n"

/* One card of the base deck in another form. */
typedef struct Change {
    const char *field;
    int card;
    const char *text;
} Change;

static double result_of(const char *keyword, const char *const *base, int count, const Change *changes, int changed)
{
    char text[3000];
    int used = snprintf(text, sizeof text, "*AIRBAG_%s\n1,1\n", keyword);
    for (int i = 0; i < count; i++) {
        const char *card = base[i];
        for (int k = 0; k < changed; k++)
            if (changes[k].card == i) card = changes[k].text;
        used += snprintf(text + used, sizeof text - (size_t)used, "%s\n", card);
    }
    snprintf(text + used, sizeof text - (size_t)used, CURVES);
    return box_signature(text, 0.05, -0.2);
}

static void check_changes(const char *keyword, const char *const *base, int count, const Change *changes, int changed)
{
    double first = result_of(keyword, base, count, NULL, 0);
    for (int i = 0; i < changed; i++)
        box_differs(changes[i].field, first, result_of(keyword, base, count, &changes[i], 1));
}

static const char *const hybrid[7] = {"300,1e5,1.16,8.314,1,0",
                                      "0.8,0,1e-3,0,0,0,0,0",
                                      "0,0,2,0,0,0",
                                      "0,0,0,0.029,1,28.1,0.002,4e-6",
                                      "0",
                                      "3,5,0,0.028,0,29,0,0",
                                      "0"};

static void hybrid_fields(void **state)
{
    (void)state;
    static const Change changes[] = {{"ATMOST", 0, "310,1e5,1.16,8.314,1,0"},
                                     {"ATMOSP", 0, "300,1.1e5,1.16,8.314,1,0"},
                                     {"GC", 0, "300,1e5,1.16,8,1,0"},
                                     {"CC", 0, "300,1e5,1.16,8.314,4,0"},
                                     {"HCONV", 0, "300,1e5,1.16,8.314,1,500"},
                                     {"HCONV < 0", 0, "300,1e5,1.16,8.314,1,-11"},
                                     {"C23", 1, "0.5,0,1e-3,0,0,0,0,0"},
                                     {"LCC23", 1, "0,8,1e-3,0,0,0,0,0"},
                                     {"LCC23 < 0", 1, "0,-8,1e-3,0,0,0,0,0"},
                                     {"A23", 1, "0.8,0,2e-3,0,0,0,0,0"},
                                     {"LCA23", 1, "0.8,0,0,7,0,0,0,0"},
                                     {"CP23, AP23", 1, "0.8,0,1e-3,0,0.5,0,1e-3,0"},
                                     {"LCCP23", 1, "0.8,0,1e-3,0,0,8,1e-3,0"},
                                     {"LCAP23", 1, "0.8,0,1e-3,0,0.5,0,0,7"},
                                     {"PVENT", 2, "0,1e5,2,0,0,0"},
                                     {"LCEFR", 2, "0,0,2,8,0,0"},
                                     {"LCIDM0", 2, "0,0,2,0,4,0"},
                                     {"MW", 3, "0,0,0,0.02,1,28.1,0.002,4e-6"},
                                     {"A", 3, "0,0,0,0.029,1,30,0.002,4e-6"},
                                     {"B", 3, "0,0,0,0.029,1,28.1,0.02,4e-6"},
                                     {"C", 3, "0,0,0,0.029,1,28.1,0.002,4e-5"},
                                     {"LCIDM", 5, "4,5,0,0.028,0,29,0,0"},
                                     {"LCIDM < 0", 5, "-3,5,0,0.028,0,29,0,0"},
                                     {"LCIDT", 5, "3,6,0,0.028,0,29,0,0"},
                                     {"LCIDT < 0", 5, "3,-5,0,0.028,0,29,0,0"},
                                     {"FMASS", 6, "0.2"}};
    check_changes("HYBRID", hybrid, 7, changes, (int)(sizeof changes / sizeof changes[0]));
    /* INITM: half helium at the start */
    static const char *const helium[2] = {"0,0,0,0.004,0.5,20.8,0,0", "0,0,0,0.029,0.5,28.1,0.002,4e-6"};
    const char *two[9] = {hybrid[0], hybrid[1], "0,0,3,0,0,0", hybrid[3], "0", hybrid[5], "0", "0,0,0,0.004,0,20.8,0,0",
                          "0"};
    double first = result_of("HYBRID", two, 9, NULL, 0);
    Change initial[2] = {{"INITM", 3, helium[1]}, {"INITM", 7, helium[0]}};
    box_differs("INITM", first, result_of("HYBRID", two, 9, initial, 2));
}

/* A user's function as a vent's area does as the constant, also behind the splines that the inflow asks for. */
static void hybrid_functions(void **state)
{
    (void)state;
    static const char *const inflows[2] = {"3,5,0,0.028,0,29,0,0", "-3,-5,0,0.028,0,29,0,0"};
    for (int i = 0; i < 2; i++) {
        const Change constant[] = {{"", 5, inflows[i]}},
                     function[] = {{"", 5, inflows[i]}, {"", 1, "0.8,0,0,12,0,0,0,0"}};
        double expected = result_of("HYBRID", hybrid, 7, constant, 1);
        verify_close("LCA23 by a function", result_of("HYBRID", hybrid, 7, function, 2), expected, 1e-12);
    }
}

/* ATMOSD is the ambient density of SPSF, and is compared with what the gas is. */
static void hybrid_density(void **state)
{
    (void)state;
    VerifyRun run;
    box_run(&run,
            "*AIRBAG_HYBRID\n1,1,0,1,1,0,0,0.5\n300,1e5,3.5,8.314,1,0\n0,0,0,0,0,0,0,0\n0,0,1,0,0,0\n"
            "0,0,0,0.029,1,28.1,0.002,4e-6\n0\n",
            0.001, 0, 0, &(VerifyOptions){.every = 1});
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "ATMOSD is 3.5"));
    assert_true(run.model.airbags[0].gas.ambient_density == 3.5);
    verify_close("density by ATMOSP and ATMOST", run.state.gas[0].density, 1e5 * 0.029 / (8.314 * 300), 1e-12);
    verify_free(&run);
}

/* B4 (a) through the deck: LCIDM for each gas, and LCIDM0 with molar fractions, whose INITM is molar too. */
static void tank(void **state)
{
    (void)state;
    static const double table[][4] = {{0.01, 0.0417499709, 447.863614, 185691.36},
                                      {0.03, 0.0577499709, 621.142203, 347570.048},
                                      {0.05, 0.0737499709, 716.617531, 504868.59}};
    static const char *const decks[2] = {
        "*AIRBAG_HYBRID\n1,1\n296.15,101325,1.1919,8.314462618\n0\n0,0,4\n0,0,0,0.028964,1,28.11,0.001967,4.802e-"
        "06\n0\n"
        "3,6,0,0.0280134,0,28.9,-0.001571,8.081e-06\n0\n4,6,0,0.0440095,0,22.26,0.05981,-3.501e-05\n0\n"
        "5,6,0,0.039948,0,20.786\n0\n"
        "*DEFINE_CURVE\n3\n0,0.48\n1,0.48\n*DEFINE_CURVE\n4\n0,0.2\n1,0.2\n*DEFINE_CURVE\n5\n0,0.12\n1,0.12\n"
        "*DEFINE_CURVE\n6\n0,800\n1,800\n",
        "*AIRBAG_HYBRID\n1,1\n296.15,101325,1.1919,8.314462618\n0\n0,0,4,0,7\n0,0,0,0.028964,1,28.11,0.001967,4.802e-"
        "06\n0\n"
        "3,6,0,0.0280134,0,28.9,-0.001571,8.081e-06\n0\n4,6,0,0.0440095,0,22.26,0.05981,-3.501e-05\n0\n"
        "5,6,0,0.039948,0,20.786\n0\n"
        "*DEFINE_CURVE\n3\n0,21.41832\n1,21.41832\n*DEFINE_CURVE\n4\n0,5.680592\n1,5.680592\n"
        "*DEFINE_CURVE\n5\n0,3.754881\n1,3.754881\n*DEFINE_CURVE\n6\n0,800\n1,800\n*DEFINE_CURVE\n7\n0,0.8\n1,0.8\n"};
    for (int k = 0; k < 2; k++) {
        VerifyRun run;
        Scene scene = {0};
        verify_begin_box(&scene, (const double[3]){0.283168, 0.1, 1}, 1, 7, 0.05);
        scene_print(&scene.deck, "%s", decks[k]);
        scene_write_output(&scene.deck, 0, 0.005, 0);
        scene_end(&scene.deck, &scene.mesh);
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
        for (size_t i = 0; i < 3; i++) {
            verify_close("B4 m [kg]", verify_at(&run, table[i][0], offsetof(VerifySample, mass)), table[i][1], 1e-8);
            verify_close("B4 T [K]", verify_at(&run, table[i][0], offsetof(VerifySample, temperature)), table[i][2],
                         1e-7);
            verify_close("B4 p [Pa]", verify_at(&run, table[i][0], offsetof(VerifySample, pressure)), table[i][3],
                         1e-7);
        }
        verify_free(&run);
    }
}

static const char *const chemkin[5] = {"3,5,2,2,300,1e5,8.314", "0", "0.8,1e-3", "N2,0.028,0,1,0", "O2,0.032,0,0.5,1"};

static void chemkin_fields(void **state)
{
    (void)state;
    static const Change changes[] = {{"LCIDM", 0, "4,5,2,2,300,1e5,8.314"},
                                     {"LCIDM < 0", 0, "-3,5,2,2,300,1e5,8.314"},
                                     {"LCIDT", 0, "3,6,2,2,300,1e5,8.314"},
                                     {"LCIDT < 0", 0, "3,-5,2,2,300,1e5,8.314"},
                                     {"ATMT", 0, "3,5,2,2,320,1e5,8.314"},
                                     {"ATMP", 0, "3,5,2,2,300,1.1e5,8.314"},
                                     {"RG", 0, "3,5,2,2,300,1e5,8"},
                                     {"HCONV", 1, "500"},
                                     {"HCONV < 0", 1, "-11"},
                                     {"C23", 2, "0.4,1e-3"},
                                     {"A23", 2, "0.8,2e-3"},
                                     {"CHNAME", 3, "CO2,0.028,0,1,0"},
                                     {"MW", 3, "N2,0.035,0,1,0"},
                                     {"LCIDN", 3, "N2,0.004,10,1,0"},
                                     {"FMOLE", 4, "O2,0.032,0,9,1"},
                                     {"FMOLET", 3, "N2,0.028,0,1,3"}};
    check_changes("HYBRID_CHEMKIN", chemkin, 5, changes, (int)(sizeof changes / sizeof changes[0]));
}

/* DATA 3 and 1: the same gas in the three forms, and each coefficient acts. */
static void chemkin_data(void **state)
{
    (void)state;
    static const char *const poly[5] = {"3,5,1,3,300,1e5,8.314", "0", "0.8,1e-3", "N2,0.028,0,1,1",
                                        "28,0.01,1e-6,1e-9,1e-12"};
    static const Change terms[] = {{"A", 4, "30,0.01,1e-6,1e-9,1e-12"},
                                   {"B", 4, "28,0.02,1e-6,1e-9,1e-12"},
                                   {"C", 4, "28,0.01,2e-5,1e-9,1e-12"},
                                   {"D", 4, "28,0.01,1e-6,2e-8,1e-12"},
                                   {"E", 4, "28,0.01,1e-6,1e-9,2e-11"}};
    check_changes("HYBRID_CHEMKIN", poly, 5, terms, 5);
    static const char *const nist[7] = {"3,5,1,1,300,1e5,8.314",
                                        "0",
                                        "0.8,1e-3",
                                        "N2,0.028,0,1,1",
                                        "200,500,2000",
                                        "28.98641,1.853978e-3,-9.647459e-6,16.63537e-9,117",
                                        "19.50583,19.88705e-3,-8.598535e-6,1.369784e-9,527601"};
    static const Change nist_terms[] = {{"TLOW", 4, "450,500,2000"},
                                        {"TMID", 4, "200,900,2000"},
                                        {"THIGH", 4, "200,500,510"},
                                        {"ALOW", 5, "32,1.853978e-3,-9.647459e-6,16.63537e-9,117"},
                                        {"BLOW", 5, "28.98641,8e-3,-9.647459e-6,16.63537e-9,117"},
                                        {"CLOW", 5, "28.98641,1.853978e-3,-2e-5,16.63537e-9,117"},
                                        {"DLOW", 5, "28.98641,1.853978e-3,-9.647459e-6,9e-8,117"},
                                        {"ELOW", 5, "28.98641,1.853978e-3,-9.647459e-6,16.63537e-9,1e5"},
                                        {"AHIGH", 6, "23,19.88705e-3,-8.598535e-6,1.369784e-9,527601"},
                                        {"BHIGH", 6, "19.50583,24e-3,-8.598535e-6,1.369784e-9,527601"},
                                        {"CHIGH", 6, "19.50583,19.88705e-3,-3e-6,1.369784e-9,527601"},
                                        {"DHIGH", 6, "19.50583,19.88705e-3,-8.598535e-6,9e-9,527601"},
                                        {"EHIGH", 6, "19.50583,19.88705e-3,-8.598535e-6,1.369784e-9,2e6"}};
    check_changes("HYBRID_CHEMKIN", nist, 7, nist_terms, 13);
    /* as the web book has it: for T/1000 */
    static const Change book[2] = {{"", 5, "28.98641,1.853978,-9.647459,16.63537,0.000117"},
                                   {"", 6, "19.50583,19.88705,-8.598535,1.369784,0.527601"}};
    double here = result_of("HYBRID_CHEMKIN", nist, 7, NULL, 0), there = result_of("HYBRID_CHEMKIN", nist, 7, book, 2);
    verify_close("NIST by T/1000", there, here, 1e-9);
    static const Change table[1] = {{"", 0, "3,5,1,2,300,1e5,8.314"}};
    verify_close("NIST and NASA", result_of("HYBRID_CHEMKIN", nist, 4, table, 1), here, 2e-3);
}

/* What is wrong is named. */
static void refusals(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"*AIRBAG_HYBRID\n1,1\n300,1e5,1.2,8.3\n0\n0,0,18\n", "NGAS is 18"},
        {"*AIRBAG_HYBRID\n1,1\n300,1e5,1.2,0\n0\n0,0,1\n0,0,0,0.029,1,28\n0\n", "gas constant must be positive"},
        {"*AIRBAG_HYBRID\n1,1\n300,1e5,1.2,8.3\n0\n0,0,1\n0,0,0,0.029,0,28\n0\n", "initial fractions are 0"},
        {"*AIRBAG_HYBRID\n1,1\n300,1e5,1.2,8.3\n0\n0,0,1\n0,0,0,0.029,1,8\n0\n", "above GC"},
        {"*AIRBAG_HYBRID\n1,1\n300,1e5,1.2,8.3\n0\n0,0,1\n1,0,0,0.029,1,28\n0\n", "LCIDT must be"},
        {"*AIRBAG_HYBRID_CHEMKIN\n1,1\n0,0,1,4,300,1e5,8.3\n0\n0\nN2,0.028,0,1,1\n", "DATA is 4"},
        {"*AIRBAG_HYBRID_CHEMKIN\n1,1\n0,0,1,2,300,1e5,8.3\n0\n0\nXE,0.028,0,1,1\n", "CHNAME XE"},
        {"*AIRBAG_HYBRID_CHEMKIN\n1,1\n0,0,1,2,300,1e5,8.3\n0\n0\nN2,0,0,1,1\n", "MW must"},
        {"*AIRBAG_HYBRID_CHEMKIN\n1,1\n0,0,1,2,300,1e5,8.3\n0\n1,-2\nN2,0.028,0,1,1\n", "A23 is -2"}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        Scene scene = {0};
        verify_begin_box(&scene, (const double[3]){1, 1, 1}, 1, 7, 0.01);
        scene_print(&scene.deck, "%s", wrong[i][0]);
        scene_end(&scene.deck, &scene.mesh);
        VerifyRun run;
        int status = verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
        if (!status || !verify_message(&run.diagnostics, SEVERITY_ERROR, wrong[i][1]))
            print_message("not refused: %s\n", wrong[i][1]);
        assert_int_equal(status, -1);
        assert_true(verify_message(&run.diagnostics, SEVERITY_ERROR, wrong[i][1]));
        verify_free(&run);
        scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(hybrid_fields),  cmocka_unit_test(hybrid_functions),
                                       cmocka_unit_test(hybrid_density), cmocka_unit_test(tank),
                                       cmocka_unit_test(chemkin_fields), cmocka_unit_test(chemkin_data),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests_name("mixtures", tests, NULL, NULL);
}

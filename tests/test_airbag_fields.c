/* Every field of card 1 of all models, and of the cards of *AIRBAG_SIMPLE_AIRBAG_MODEL, *AIRBAG_WANG_NEFSKE and its
 * jets, from the deck: a field that is changed changes the result. The values are judged in test_gas_cards.c and
 * others. */
#include "tests/airbag_box.h"
#include "tests/jet_case.h"

#include <stdio.h>

#define CURVES                                                                                                         \
    "*DEFINE_CURVE\n3\n0,0\n0.01,1\n0.05,0.5\n*DEFINE_CURVE\n4\n0,0.5\n0.05,0.2\n*DEFINE_CURVE\n5\n0,500\n0.05,900\n"  \
    "*DEFINE_CURVE\n6\n1e5,0.4\n2e5,0.9\n*DEFINE_CURVE\n7\n1e5,1e-3\n2e5,3e-3\n*DEFINE_CURVE\n8\n0,0.2\n0.05,0.9\n"    \
    "*DEFINE_CURVE\n10\n0.5,0.9\n1,0.3\n*DEFINE_CURVE\n11\n0,0\n1e5,5\n*DEFINE_CURVE\n12\n0,5000\n1,5000\n"            \
    "*DEFINE_CURVE\n13\n0,0\n0.05,9e5\n*DEFINE_CURVE\n14\n0,300\n0.05,2000\n"

/* A deck's cards with one of them in another form; field "base" begins a new one. */
typedef struct Change {
    const char *field;
    int card;
    const char *text;
} Change;

static double result_of(const char *keyword, const char *const *base, int count, const Change *change)
{
    char text[3000];
    int used = snprintf(text, sizeof text, "*AIRBAG_%s\n", keyword);
    for (int i = 0; i < count; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s\n",
                         change && change->card == i ? change->text : base[i]);
    snprintf(text + used, sizeof text - (size_t)used, CURVES);
    return box_signature(text, 0.05, -0.2);
}

static void check_changes(const char *keyword, const char *const *base, int count, const Change *changes, int changed)
{
    double first = result_of(keyword, base, count, NULL);
    for (int i = 0; i < changed; i++)
        box_differs(changes[i].field, first, result_of(keyword, base, count, &changes[i]));
}
#define CHECK(keyword, base, changes)                                                                                  \
    check_changes(keyword, base, (int)(sizeof base / sizeof *base), changes, (int)(sizeof changes / sizeof *changes))

static void simple_fields(void **state)
{
    (void)state;
    static const char *const constant[] = {"1,1", "718,1005,400,3,0.7,1e-3,1e5,1.16", "0"};
    static const Change changes[] = {{"CV", 1, "700,1005,400,3,0.7,1e-3,1e5,1.16"},
                                     {"CP", 1, "718,1100,400,3,0.7,1e-3,1e5,1.16"},
                                     {"T", 1, "718,1005,500,3,0.7,1e-3,1e5,1.16"},
                                     {"LCID", 1, "718,1005,400,4,0.7,1e-3,1e5,1.16"},
                                     {"MU", 1, "718,1005,400,3,0.5,1e-3,1e5,1.16"},
                                     {"MU < 0", 1, "718,1005,400,3,-6,1e-3,1e5,1.16"},
                                     {"AREA", 1, "718,1005,400,3,0.7,2e-3,1e5,1.16"},
                                     {"AREA < 0", 1, "718,1005,400,3,0.7,-7,1e5,1.16"},
                                     {"PE", 1, "718,1005,400,3,0.7,1e-3,1.1e5,1.16"},
                                     {"RO", 1, "718,1005,400,3,0.7,1e-3,1e5,1.3"},
                                     {"LOU", 2, "11"}};
    CHECK("SIMPLE_AIRBAG_MODEL", constant, changes);
    static const char *const varying[] = {"1,1", "0,0,400,3,0.7,1e-3,1e5,1.16", "0,0,28,0.002,0.029,8.314"};
    static const Change coefficients[] = {
        {"LOU", 2, "11,0,28,0.002,0.029,8.314"}, {"T_EXT", 2, "0,350,28,0.002,0.029,8.314"},
        {"A", 2, "0,0,30,0.002,0.029,8.314"},    {"B", 2, "0,0,28,0.02,0.029,8.314"},
        {"MW", 2, "0,0,28,0.002,0.02,8.314"},    {"GASC", 2, "0,0,28,0.002,0.029,8"}};
    CHECK("SIMPLE_AIRBAG_MODEL", varying, coefficients);
}

static void wang_nefske_fields(void **state)
{
    (void)state;
    static const char *const constant[] = {"1,1", "718,1005,400,0,3,0,0,300", "0.7,0,1e-3,0,0.5,0,1e-3,0",
                                           "1e5,1.16,1,0,1e4,0,0,0", "0"};
    static const Change changes[] = {
        {"CV", 1, "700,1005,400,0,3,0,0,300"},         {"CP", 1, "718,1100,400,0,3,0,0,300"},
        {"T", 1, "718,1005,500,0,3,0,0,300"},          {"LCT", 1, "718,1005,400,5,3,0,0,300"},
        {"LCMT", 1, "718,1005,400,0,4,0,0,300"},       {"TVOL", 1, "718,1005,400,0,13,0.02,0,300"},
        {"LCDT", 1, "718,1005,400,0,3,0,12,300"},      {"IABT", 1, "718,1005,400,0,3,0,0,350"},
        {"C23", 2, "0.5,0,1e-3,0,0.5,0,1e-3,0"},       {"LCC23", 2, "0,8,1e-3,0,0.5,0,1e-3,0"},
        {"LCC23 < 0", 2, "0,-10,1e-3,0,0.5,0,1e-3,0"}, {"A23", 2, "0.7,0,2e-3,0,0.5,0,1e-3,0"},
        {"LCA23", 2, "0.7,0,0,7,0.5,0,1e-3,0"},        {"CP23", 2, "0.7,0,1e-3,0,0.9,0,1e-3,0"},
        {"LCCP23", 2, "0.7,0,1e-3,0,0,8,1e-3,0"},      {"AP23", 2, "0.7,0,1e-3,0,0.5,0,2e-3,0"},
        {"LCAP23", 2, "0.7,0,1e-3,0,0.5,0,0,7"},       {"PE", 3, "1.1e5,1.16,1,0,1e4,0,0,0"},
        {"GC", 3, "1e5,1.16,4,0,1e4,0,0,0"},           {"LCEFR", 3, "1e5,1.16,1,11,1e4,0,0,0"},
        {"POVER", 3, "1e5,1.16,1,0,3e4,0,0,0"},        {"PPOP", 3, "1e5,1.16,1,0,1e4,3e4,0,0"},
        {"OPT", 3, "1e5,1.16,1,0,1e4,0,1,0"}};
    CHECK("WANG_NEFSKE", constant, changes);
    static const char *const density[] = {"1,1", "718,1005,400,0,3,0,0,0", "0.7,0,1e-3", "1e5,1.16,1", "0"};
    static const Change ro[] = {{"RO", 3, "1e5,1.3,1"}};
    CHECK("WANG_NEFSKE", density, ro);
    static const char *const varying[] = {"1,1", "0,0,400,0,3,0,0,300",         "0.7,0,1e-3", "1e5,1.16,1",
                                          "0",   "300,28,0.002,0.029,8.314,500"};
    static const Change card7[] = {
        {"TEXT", 5, "500,28,0.002,0.029,8.314,500"},     {"A", 5, "300,30,0.002,0.029,8.314,500"},
        {"B", 5, "300,28,0.02,0.029,8.314,500"},         {"MW", 5, "300,28,0.002,0.02,8.314,500"},
        {"GASC", 5, "300,28,0.002,0.029,8,500"},         {"HCONV", 5, "300,28,0.002,0.029,8.314,1000"},
        {"HCONV < 0", 5, "300,28,0.002,0.029,8.314,-14"}};
    CHECK("WANG_NEFSKE", varying, card7);
}

/* HYBRID's own OPT: the walls leak. */
static void hybrid_option(void **state)
{
    (void)state;
#define HYBRID(opt)                                                                                                    \
    "*AIRBAG_HYBRID\n1,1\n300,1e5,1.16,8.314,1\n0,0,0,0,0.5,0,1e-3\n" opt ",0,2,0,0,0\n0,0,0,0.029,1,28.1,0.002\n0\n"  \
    "3,5,0,0.028,0,29\n0\n*MAT_ADD_AIRBAG_POROSITY_LEAKAGE\n3,0.002,1\n" CURVES
    double none = box_signature(HYBRID("0"), 0.05, -0.2),
           law[3] = {box_signature(HYBRID("1"), 0.05, -0.2), box_signature(HYBRID("3"), 0.05, -0.2),
                     box_signature(HYBRID("7"), 0.05, -0.2)};
    for (int i = 0; i < 3; i++) box_differs("OPT", none, law[i]);
    box_differs("OPT 1 and 3", law[0], law[1]);
    box_differs("OPT 3 and 7", law[1], law[2]);
}

typedef struct ModelCase {
    const char *name, *cards;
} ModelCase;

static const ModelCase models[] = {
    {"SIMPLE_PRESSURE_VOLUME", "5e4,2\n"},
    {"SIMPLE_AIRBAG_MODEL", "718,1005,400,3,0.7,1e-3,1e5,1.16\n0\n"},
    {"ADIABATIC_GAS_MODEL", "1,0,1.4,2e4,1e5,1.2\n"},
    {"WANG_NEFSKE", "718,1005,400,0,3,0,0,300\n0.7,0,1e-3\n1e5,1.16,1\n0\n"},
    {"LOAD_CURVE", "0,0,1.2,1e5,2e4,300,0\n"},
    {"LINEAR_FLUID", "2e6,1000,4\n"},
    {"HYBRID", "300,1e5,1.16,8.314,1\n0\n0,0,1\n3,5,0,0.029,1,28.1\n0\n"},
    {"HYBRID_CHEMKIN", "3,5,1,2,300,1e5,8.314\n0\n0.8,1e-3\nN2,0.028,0,1,1\n"},
    {"FLUID_AND_GAS", "0.4,0,0.4,2e4,0,1000\n-3,3,0,0,1.4,2e9\n"},
};

static double core_result(const ModelCase *model, const char *card1)
{
    char text[2500];
    snprintf(text, sizeof text, "*AIRBAG_%s\n%s\n%s" CURVES, model->name, card1, model->cards);
    return box_signature(text, 0.05, -0.2);
}

/* Card 1 and the ID card of all nine models. */
static void core_fields(void **state)
{
    (void)state;
    /* the box by its segments; and its parts but the lid, which leaves a hole that is capped */
    static const char *const by_segments = "*SET_SEGMENT\n1\n1,4,3,2\n5,6,7,8\n1,2,6,5\n2,3,7,6\n3,4,8,7\n4,1,5,8\n";
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        double base = core_result(&models[i], "1,1");
        print_message("    %s\n", models[i].name);
        double less = core_result(&models[i], "1,1,0,1,1,0.01");
        box_differs("PSCA", base, core_result(&models[i], "1,1,0,1,1.5"));
        box_differs("VINI", base, less);
        box_differs("VSCA", less, core_result(&models[i], "1,1,0,1.5,1,0.01")); /* relative volumes see it with VINI */
        char text[2500];
        snprintf(text, sizeof text, "*AIRBAG_%s_ID\n%d,my bag\n9,1\n%s*SET_PART_LIST\n9\n1,3\n" CURVES, models[i].name,
                 70 + (int)i, models[i].cards);
        VerifyRun run;
        box_run(&run, text, 0.05, -0.2, 0, &(VerifyOptions){.every = 1, .stop = 1});
        assert_int_equal(run.model.airbags[0].id, 70 + (int)i);
        assert_string_equal(run.model.airbags[0].heading, "my bag");
        assert_int_equal(run.model.airbags[0].part_count, 2); /* SID */
        verify_free(&run);
        if (i != 0) continue;
        snprintf(text, sizeof text, "*AIRBAG_%s\n1,0\n%s%s" CURVES, models[i].name, models[i].cards, by_segments);
        verify_close("SIDTYP = 0", box_signature(text, 0.05, -0.2), base, 1e-12);
    }
}

/* A box of null shells without pressure, its corners at speeds of their own. */
static void run_free_box(VerifyRun *run, const char *bag, const char *velocities, double end)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    deck->exact = true;
    scene_add_box(&scene.mesh, 1, 1, 1, 0.2, 0.3, 1);
    scene_begin(deck, "box", end, 0);
    scene_write_part(deck, 1, 1, 1, "box");
    scene_write_section(deck, 1, 9, 1e-3);
    scene_write_null(deck, 1, 1000);
    scene_write_part_set(deck, 1, 1, (const int[]){1});
    scene_print(deck, "%s%s", bag, velocities);
    scene_end(deck, &scene.mesh);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1, .node = 4, .energy_limit = 1e30});
}

/* MWD: velocities about the mean of the bag's mass decay as exp(-D t), the mean stays. */
static void mass_weighted_damping(void **state)
{
    (void)state;
    VerifyRun run;
    run_free_box(&run, "*AIRBAG_SIMPLE_PRESSURE_VOLUME\n1,1,0,1,1,0,50\n0,1\n",
                 "*INITIAL_VELOCITY_NODE\n5,3.,1.,2.\n1,0.,0.,-1.\n", 0.02);
    double mass = 0, mean[3] = {0};
    for (int n = 0; n < 8; n++) {
        mass += run.model.mass[n];
        for (int k = 0; k < 3; k++) mean[k] += run.model.mass[n] * run.state.v[3 * n + k];
    }
    const VerifySample *first = &run.samples[0], *last = &run.samples[run.count - 1];
    for (int k = 0; k < 3; k++) {
        double start = k == 2 ? (2. - 1.) / 8 : first->v[k] / 8; /* all corners weigh the same */
        verify_close("the mean stays", mean[k] / mass, start, 1e-9);
        verify_close("decay about the mean", last->v[k] - start, (first->v[k] - start) * exp(-50 * last->time), 1e-4);
    }
    verify_free(&run);
}

/* SPSF: a corner with the area vector s feels -gamma rho (s.v)^2 s/s.s. */
static void stagnation_pressure(void **state)
{
    (void)state;
    VerifyRun run;
    run_free_box(&run, "*AIRBAG_SIMPLE_AIRBAG_MODEL\n1,1,0,1,1,0,0,0.6\n718,1005,400,31,0,0,1e-9,1.2\n0\n",
                 "*DEFINE_CURVE\n31\n0,0\n1,0\n*INITIAL_VELOCITY\n0\n0,0,5.\n", 1e-3);
    const double s[3] = {-0.3 * 1 / 4, -0.2 * 1 / 4, 0.2 * 0.3 / 4}, v = 5; /* corner (0, 0, 1) */
    double square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2], push = 0.6 * 1.2 * s[2] * v * fabs(s[2] * v) / square;
    double mass = run.model.mass[0];
    for (int k = 0; k < 3; k++) verify_close("acceleration", run.samples[0].a[k], -push * s[k] / mass, 1e-6);
    verify_free(&run);
}

#define JET_CURVES                                                                                                     \
    "*DEFINE_CURVE\n8\n0,0.4\n1,0.4\n*DEFINE_CURVE\n9\n0,0.5\n1,0.5\n*DEFINE_CURVE\n5\n0,1\n60,0.5\n90,0\n"            \
    "*DEFINE_CURVE\n6\n0,0.2\n60,1\n*SET_PART_LIST\n7\n3\n*NODE\n90001,0.18,0.18,0.05\n90002,0.18,0.18,1.\n"           \
    "90003,0.28,0.18,0.05\n"
#define CONE "0.18,0.18,0.05,0.18,0.18,1.,0.2,1.\n"
#define MULTIPLE "0.18,0.18,0.05,0.18,0.18,1.,5,1.\n"
#define FOCUS "0,0,0,0,0,0,0,0\n"

static double jet_force(const char *option, const char *cards)
{
    VerifyRun run;
    double force[3];
    run_duct(&run, force, option, cards, JET_CURVES, 24);
    verify_free(&run);
    return force[2];
}

static void jet_fields(void **state)
{
    (void)state;
    static const char *const changes[][3] = {
        {"XJFP", "0.05,0.18,0.05,0.18,0.18,1.,%s,1.\n" FOCUS, ""},
        {"YJFP", "0.18,0.05,0.05,0.18,0.18,1.,%s,1.\n" FOCUS, ""},
        {"ZJFP", "0.18,0.18,0.15,0.18,0.18,1.,%s,1.\n" FOCUS, ""},
        {"XJVH", "0.18,0.18,0.05,0.58,0.18,1.,%s,1.\n" FOCUS, ""},
        {"YJVH", "0.18,0.18,0.05,0.18,0.78,1.,%s,1.\n" FOCUS, ""},
        {"ZJVH", "0.18,0.18,0.05,0.18,0.18,-1.,%s,1.\n" FOCUS, ""},
        {"BETA", "0.18,0.18,0.05,0.18,0.18,1.,%s,0.5\n" FOCUS, ""},
        {"BETA < 0", "0.18,0.18,0.05,0.18,0.18,1.,%s,-9\n" FOCUS, ""},
        {"XSJFP", "0.18,0.18,0.05,0.18,0.18,1.,%s,1.\n0.28,0.18,0.05,0,0,0,0,0\n", ""},
        {"YSJFP", "0.18,0.18,0.05,0.18,0.18,1.,%s,1.\n0.18,0.28,0.05,0,0,0,0,0\n", ""},
        {"PSID", "0.18,0.18,0.05,0.18,0.18,1.,%s,1.\n0,0,0,7,0,0,0,0\n", ""},
        {"NODE3", "0.18,0.18,0.05,0.18,0.18,1.,%s,1.\n0,0,0,0,0,90001,90002,90003\n", ""},
        {"CA", "0.18,0.18,0.05,0.18,0.18,1.,0.5,1.\n" FOCUS, "_JETTING"},
        {"CA < 0", "0.18,0.18,0.05,0.18,0.18,1.,-8,1.\n" FOCUS, "_JETTING"},
        {"LCJRV", "0.18,0.18,0.05,0.18,0.18,1.,6,1.\n" FOCUS, "_MULTIPLE_JETTING"},
        {"ANGLE", "0.18,0.18,0.05,0.18,0.18,1.,5,1.\n0,0,0,0,30.,0,0,0\n", "_MULTIPLE_JETTING"},
    };
    static const char *const options[2] = {"_JETTING", "_MULTIPLE_JETTING"}, *const shapes[2] = {"0.2", "5"};
    for (int k = 0; k < 2; k++) {
        double base = jet_force(options[k], k ? MULTIPLE FOCUS : CONE FOCUS);
        assert_true(base > 1e-3);
        for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
            char cards[300];
            if (changes[i][2][0] && strcmp(changes[i][2], options[k])) continue;
            int used = 0; /* the cards with the shape of this option */
            for (const char *c = changes[i][1]; *c; c++) {
                if (c[0] == '%') {
                    used += snprintf(cards + used, sizeof cards - (size_t)used, "%s", shapes[k]);
                    c++;
                } else {
                    cards[used++] = *c;
                }
            }
            cards[used] = '\0';
            double force = jet_force(options[k], cards);
            if (!(fabs(force - base) > 1e-3 * base)) print_message("%s: %g, %g\n", changes[i][0], base, force);
            assert_true(fabs(force - base) > 1e-3 * base);
        }
        char nodes[200];
        snprintf(nodes, sizeof nodes, "9.,9.,9.,9.,9.,9.,%s,1.\n0,0,0,0,0,90001,90002,0\n", shapes[k]);
        verify_close("NODE1, NODE2", jet_force(options[k], nodes), base, 1e-12);
        char option[40];
        snprintf(option, sizeof option, "%s_CM", options[k]);
        box_differs("CM", base, jet_force(option, k ? MULTIPLE FOCUS "0\n" : CONE FOCUS "0\n"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_fields), cmocka_unit_test(wang_nefske_fields),    cmocka_unit_test(hybrid_option),
        cmocka_unit_test(core_fields),   cmocka_unit_test(mass_weighted_damping), cmocka_unit_test(stagnation_pressure),
        cmocka_unit_test(jet_fields),
    };
    return cmocka_run_group_tests_name("airbag fields", tests, NULL, NULL);
}

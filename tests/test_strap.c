/* Straps: *ELEMENT_SEATBELT with *MAT_SEATBELT: force by the curve, slack, mass, energy, the stable step, bad cards. */
#include "tests/wall_case.h"

#include <string.h>

#include "elements/link.h"

static const double points[4][2] = {{0, 0}, {0.05, 10}, {0.1, 40}, {0.3, 200}};

static double force_at(double e)
{
    int i = 1;
    if (e <= 0) return 0;
    while (i < 3 && e > points[i][0]) i++;
    return points[i - 1][1] +
           (points[i][1] - points[i - 1][1]) * (e - points[i - 1][0]) / (points[i][0] - points[i - 1][0]);
}

static double area_at(double e)
{
    double sum = 0;
    enum { MANY = 100000 };
    for (int i = 0; i < MANY; i++) sum += force_at(e * (i + 0.5) / MANY) * e / MANY;
    return sum;
}

/* A strap of length 1 and some slack from node 1, held, to node 2, which is pulled along x by 0.25 in 0.2 s. */
static void pull(VerifyRun *run, double slack)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    wall_begin(&scene, 0.3);
    scene_write_part(deck, 5, 5, 5, "straps");
    scene_print(deck, "*CONTROL_TIMESTEP\n0,.9,0,0,0,12\n*SECTION_SEATBELT\n5,1e-5\n*MAT_SEATBELT\n5,.1,9\n");
    scene_write_curve(deck, 9, 4, &points[0][0]);
    wall_add_square(&scene, 0, 0, 0);
    scene_print(deck, "*ELEMENT_SEATBELT\n1,5,1,2,0,%g\n*BOUNDARY_SPC_NODE\n1,0,1,1,1\n", slack);
    enum { MOTION = 101 };
    double motion[2 * MOTION];
    for (int i = 0; i < MOTION; i++) { /* smoothly, or the energies of a jump of speed show */
        double share = (double)i / (MOTION - 1);
        motion[2 * i] = 0.2 * share;
        motion[2 * i + 1] = 0.25 * share * share * (3 - 2 * share);
    }
    scene_write_curve(deck, 11, MOTION, motion);
    scene_write_curve(deck, 12, 2, (const double[]){0, 2e-4, 1, 2e-4});
    scene_write_motion(deck, 2, 1, 2, 11, 1);
    scene_end(deck, &scene.mesh);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1, .node = 1});
}

static void strap_follows_its_curve(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        double slack = 0.1 * i;
        VerifyRun run;
        pull(&run, slack);
        const Link *link = &run.model.links[0];
        double length = 1 + slack, strain = 1.25 / length - 1, energy;
        verify_close("length without force", link->length, length, 1e-14);
        verify_close("force", link_tension(link, 1.25, 0, &energy), force_at(strain), 1e-12);
        verify_close("energy", energy, length * area_at(strain), 1e-6);
        verify_close("internal energy of the run", run.samples[run.count - 1].internal, energy, 1e-12);
        verify_close("force on the node", -run.samples[run.count - 1].f[0], force_at(strain), 1e-10);
        verify_near("slack", link_tension(link, length - 1e-9, 0, &energy), 0, 0);
        verify_close("mass", run.model.parts[1].mass + run.model.parts[0].mass, run.model.parts[0].mass + 0.1 * length,
                     1e-12);
        for (double l = 1; l < 1.4; l += 0.013) { /* force is the energy's slope; the step knows the steepest */
            double up, down;
            link_tension(link, l + 1e-6, 0, &up);
            link_tension(link, l - 1e-6, 0, &down);
            verify_near("slope of the energy", (up - down) / 2e-6, link_tension(link, l, 0, &energy), 1e-3);
            assert_true(link_slope(link, l) <= link->stiffness * (1 + 1e-9));
        }
        verify_balance(&run, 2e-3);
        verify_free(&run);
    }
}

/* ---- the way back ---- */

enum { SWAYS = 4 };
static const double sway[SWAYS + 1] = {0, 0.2, 0.11, 0.27, 0.05}; /* strains at 0, 0.1, 0.2, ... */

/* The strap's force after the peak strain: the curve of unloading, shifted so that it begins there. */
static double back_at(double e, double peak)
{
    const double slope = 2000, shift = peak - force_at(peak) / slope;
    return fmax(0, slope * (e - shift));
}

/* A strap of length 1 that is pulled to and fro; its largest strain so far is peak. */
static void sway_strap(VerifyRun *run, const char *unload)
{
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    wall_begin(&scene, 0.5);
    scene_write_part(deck, 5, 5, 5, "straps");
    scene_print(deck, "*CONTROL_TIMESTEP\n0,.9,0,0,0,12\n*SECTION_SEATBELT\n5\n*MAT_SEATBELT\n5,.1,9,%s\n", unload);
    scene_write_curve(deck, 9, 4, &points[0][0]);
    scene_write_curve(deck, 10, 2, (const double[]){0, 0, 0.1, 200});
    wall_add_square(&scene, 0, 0, 0);
    scene_print(deck, "*ELEMENT_SEATBELT\n1,5,1,2\n*BOUNDARY_SPC_NODE\n1,0,1,1,1\n");
    enum { EACH = 50, MOTION = SWAYS * EACH + 1 };
    double motion[2 * MOTION];
    for (int i = 0; i < MOTION; i++) {
        int leg = i == MOTION - 1 ? SWAYS - 1 : i / EACH;
        double share = (double)(i - leg * EACH) / EACH;
        motion[2 * i] = 0.1 * i / EACH;
        motion[2 * i + 1] = sway[leg] + (sway[leg + 1] - sway[leg]) * share * share * (3 - 2 * share);
    }
    scene_write_curve(deck, 11, MOTION, motion);
    scene_write_curve(deck, 12, 2, (const double[]){0, 2e-4, 1, 2e-4});
    scene_write_motion(deck, 2, 1, 2, 11, 1);
    scene_end(deck, &scene.mesh);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1, .node = 1});
}

static void strap_comes_back_along_its_curve(void **state)
{
    (void)state;
    VerifyRun run;
    sway_strap(&run, "10");
    double worst = 0, peak = 0, lost = 0;
    for (size_t i = 0; i < run.count; i++) {
        const VerifySample *s = &run.samples[i];
        double strain = s->x[0] - 1;
        peak = fmax(peak, strain);
        double force = strain < peak && peak > 0.05 ? back_at(strain, peak) : force_at(strain);
        worst = fmax(worst, fabs(force + s->f[0]));
        lost = force_at(peak) * force_at(peak) / (2 * 2000); /* what the last way back has given */
    }
    const VerifySample *last = &run.samples[run.count - 1];
    verify_near("force", worst, 0, 1e-6);
    verify_close("energy kept by the cloth", last->internal, area_at(0.27) - lost, 1e-4);
    verify_balance(&run, 2e-3);
    verify_free(&run);
    sway_strap(&run, "9"); /* the same curve back: elastic */
    verify_near("elastic", run.samples[run.count - 1].internal, area_at(0.05), 1e-4);
    verify_free(&run);
}

static void expect_error(const char *cards, const char *text)
{
    Scene scene = {0};
    wall_begin(&scene, 0.1);
    scene_write_part(&scene.deck, 5, 5, 5, "straps");
    wall_add_square(&scene, 0, 0, 0);
    scene_print(&scene.deck,
                "%s*DEFINE_CURVE\n9\n0.,0.\n.1,10.\n*DEFINE_CURVE\n6\n0.,0.\n.05,10.\n.1,10.1\n*DEFINE_CURVE\n8\n0.,0."
                "\n.1,10.\n.2,5.\n",
                cards);
    scene_end(&scene.deck, &scene.mesh);
    VerifyRun run;
    verify_build(&run, scene.deck.text, scene.deck.length, &(VerifyOptions){0});
    scene_free(&scene);
    if (!verify_message(&run.diagnostics, SEVERITY_ERROR, text)) {
        diagnostics_print(&run.diagnostics, SEVERITY_WARNING, stderr);
        fail_msg("no error '%s'", text);
    }
    verify_free(&run);
}

static void bad_cards(void **state)
{
    (void)state;
    const char section[] = "*SECTION_SEATBELT\n5\n";
    char cards[400];
    const char *const cases[][2] = {
        {"*MAT_SEATBELT\n5,.1,7\n*ELEMENT_SEATBELT\n1,5,1,2\n", "LLCID = 7: the deck has no *DEFINE_CURVE"},
        {"*MAT_SEATBELT\n5,.1,8\n*ELEMENT_SEATBELT\n1,5,1,2\n", "LLCID = 8: the stress falls"},
        {"*MAT_SEATBELT\n5,.1,9,7\n*ELEMENT_SEATBELT\n1,5,1,2\n", "ULCID = 7: the deck has no *DEFINE_CURVE"},
        {"*MAT_SEATBELT\n5,.1,9,6\n*ELEMENT_SEATBELT\n1,5,1,2\n", "ULCID = 6: from the force at the strain 0.1 of"},
        {"*MAT_SEATBELT\n5,.1,9,0,0,0,0,1e9\n0\n*ELEMENT_SEATBELT\n1,5,1,2\n", "E (value 8) = 1e9"},
        {"*MAT_SEATBELT\n5,0.,9\n*ELEMENT_SEATBELT\n1,5,1,2\n", "MPUL = 0"},
        {"*MAT_SEATBELT\n5,.1,9\n*ELEMENT_SEATBELT\n1,5,1,2,0,-1.\n", "SLEN = -1"},
        {"*MAT_SEATBELT\n5,.1,9\n*ELEMENT_SEATBELT\n1,5,1,2,3\n", "SBRID"},
        /* in columns: SLEN 41 to 56, N3 57 to 64 */
        {"*MAT_SEATBELT\n5,.1,9\n*ELEMENT_SEATBELT\n       1       5       1       2       0             -1.\n",
         "SLEN = -1"},
        {"*MAT_SEATBELT\n5,.1,9\n*ELEMENT_SEATBELT\n       1       5       1       2       0              0.       3\n",
         "N3 (columns 57-64) = 3"},
        {"*MAT_SEATBELT\n5,.1,9\n*ELEMENT_SEATBELT_SLIPRING\n1,1,2,.1,3\n",
         "is not read by billow 0.1.0: straps do not slide"},
        {"*MAT_SEATBELT\n5,.1,9\n*ELEMENT_DISCRETE\n1,5,1,2\n", "straps have *MAT_SEATBELT"},
        {"*MAT_SPRING_ELASTIC\n5,10.\n*ELEMENT_SEATBELT\n1,5,1,2\n", "straps have *MAT_SEATBELT"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(cards, sizeof cards, "%s%s", section, cases[i][0]);
        expect_error(cards, cases[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(strap_follows_its_curve),
                                       cmocka_unit_test(strap_comes_back_along_its_curve), cmocka_unit_test(bad_cards)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

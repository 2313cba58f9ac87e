/* Membranes with stress fields in their plane, against closed forms: spinning ring and disc (A5), bending of a
 * pretensioned strip and torsion of an annulus with tension field (A6) of the reference collection. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "solver/elementary.h"

#define PI 3.14159265358979323846

static void write_body(Scene *scene, const char *title, double end, const SceneFabric *fabric, double thickness)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, title, end, 0.9);
    scene_write_part(deck, 1, 1, 1, "membrane");
    scene_write_section(deck, 1, 9, thickness);
    scene_write_fabric(deck, 1, fabric);
}

/* ---- spin ---------------------------------------------------------------------------------------------------- */

static double spin_momentum(const SceneMesh *mesh, const VerifyRun *run)
{
    double sum = 0;
    for (int i = 0; i < mesh->node_count; i++) {
        const double *x = run->x + 3 * i, *v = run->v + 3 * i;
        sum += run->model.mass[run->model.deck_node[i]] * (x[0] * v[1] - x[1] * v[0]);
    }
    return sum;
}

/* A body spun about z that comes to rest in its own frame by the fabric's DAMP. mesh is left to the caller. */
static void run_spin(Scene *scene, SceneMesh *mesh, int form, double omega, double end, VerifyRun *run)
{
    SceneFabric fabric = scene_isotropic(form, false, 800, 2e8, 0.3);
    fabric.damp = 0.3;
    write_body(scene, "spin", end, &fabric, 1e-3);
    scene_print(&scene->deck, "*INITIAL_VELOCITY_GENERATION\n");
    SCENE_CARD(&scene->deck, 1, 2, omega, 0, 0, 0, 0, 0);
    SCENE_CARD(&scene->deck, 0, 0, 0, 0, 0, 1, 0, 0);
    scene_end(&scene->deck, &scene->mesh);
    *mesh = scene->mesh;
    scene->mesh = (SceneMesh){0};
    double inertia = 0;
    verify_scene(run, scene, &(VerifyOptions){0});
    for (int i = 0; i < mesh->node_count; i++) {
        const double *x = mesh->x + 3 * i;
        inertia += run->model.mass[run->model.deck_node[i]] * (x[0] * x[0] + x[1] * x[1]);
    }
    verify_close("spin momentum kept", spin_momentum(mesh, run), omega * inertia, 1e-9);
}

/* The references are for small strains: 1/100 of the tabled stresses at 20 rad/s in place of 200. */
static void spinning_ring(void **state)
{
    (void)state;
    for (int form = 0; form <= 2; form += 2) {
        Scene scene = {0};
        SceneMesh mesh;
        VerifyRun run;
        scene_add_tube(&scene.mesh, 1, SCENE_QUADS, 1, 36, 0.3, 0.05);
        run_spin(&scene, &mesh, form, 20, 0.4, &run);
        double hoop = 0, across = 0;
        for (int e = 0; e < mesh.shell_count; e++) {
            ElementResult result = verify_element(&run, e);
            double principal[2];
            verify_principal(result.stress, principal);
            hoop += principal[0] / mesh.shell_count;
            across = fmax(across, fabs(principal[1]));
        }
        verify_close("A5 ring, hoop stress [Pa]", hoop, 2.88e6 / 100, 5e-3);
        verify_near("A5 ring, stress across over hoop", across / hoop, 0, 5e-3);
        verify_free(&run);
        scene_mesh_free(&mesh);
    }
}

static void spinning_disc(void **state)
{
    (void)state;
    for (int form = 0; form <= 2; form += 2) {
        Scene scene = {0};
        SceneMesh mesh;
        VerifyRun run;
        scene_add_disc(&scene.mesh, 1, SCENE_DIAGONAL, 14, 0.3);
        run_spin(&scene, &mesh, form, 20, 0.25, &run);
        double middle = 0, rim = 0, rim_count = 0;
        for (int e = 0; e < 6; e++) { /* the first ring of the mesh */
            ElementResult result = verify_element(&run, e);
            middle += (result.stress[0] + result.stress[1]) / 12;
        }
        for (int i = 0; i < mesh.node_count; i++) {
            if (hypot(mesh.x[3 * i], mesh.x[3 * i + 1]) < 0.3 * (1 - 1e-9)) continue;
            rim += hypot(run.x[3 * i], run.x[3 * i + 1]) - 0.3;
            rim_count += 1;
        }
        verify_close("A5 disc, stress in the middle [Pa]", middle, 1.188e6 / 100, 5e-3);
        verify_close("A5 disc, growth of the rim [m]", rim / rim_count, 0.000756 / 100, 5e-3);
        verify_free(&run);
        scene_mesh_free(&mesh);
    }
}

/* ---- Stein and Hedgepeth: bending of a pretensioned strip ------------------------------------------------------ */

typedef struct Strip {
    double height, length, thickness, e, strain, kbar; /* strain: of the pretension P / (E t h) */
} Strip;

static void make_strip(Scene *scene, const Strip *strip, ScenePattern pattern)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    const double h = strip->height, length = strip->length;
    scene_add_rectangle(mesh, 1, pattern, 10, 20, length, h);
    SceneFabric fabric = scene_isotropic(2, true, 1000, strip->e, 0);
    write_body(scene, "bending of a pretensioned strip", 0.03, &fabric, strip->thickness);
    scene_write_damping(deck, 0, 3000);
    scene_write_ramp(deck, 1, 3e-3, 1);
    scene_write_node_set(deck, 1, mesh, scene_select_all, NULL);
    scene_write_spc(deck, 1, false, false, true);
    scene_write_node_set(deck, 2, mesh, scene_select_plane, &(ScenePlane){0, 0, 1e-9});
    scene_write_spc(deck, 2, true, false, false);
    double curvature = 2 * strip->kbar * strip->strain / h, taut = strip->kbar > 1 ? h / sqrt(strip->kbar) : 0;
    double edge = strip->kbar > 1 ? curvature * taut : strip->strain + curvature * h / 2; /* strain at y = 0 */
    for (int i = 0; i < mesh->node_count; i++) {
        const double *x = mesh->x + 3 * i;
        if (x[0] < 1e-9 && fabs(x[1] - h / 2) < 1e-9) {
            scene_print(deck, "*SET_NODE_LIST\n%10d\n%10d\n", 3, i + 1);
            scene_write_spc(deck, 3, false, true, false);
        }
        if (x[0] > length - 1e-9) scene_write_motion(deck, i + 1, 1, 2, 1, length * (edge - curvature * x[1]));
    }
    scene_end(deck, mesh);
}

static void strip_bending(void **state)
{
    (void)state;
    const double table[4][2] = {{0.5, 0.1666667}, {2, 0.5285955}, {3, 0.6150998}, {5, 0.7018576}};
    const ScenePattern patterns[] = {SCENE_QUADS, SCENE_CROSS};
    for (int i = 0; i < 8; i++) {
        Strip strip = {1, 0.5, 1e-3, 2e8, 1e-4, table[i % 4][0]};
        Scene scene = {0};
        make_strip(&scene, &strip, patterns[i / 4]);
        SceneMesh mesh = scene.mesh;
        scene.mesh = (SceneMesh){0};
        VerifyRun run;
        verify_scene(&run, &scene, &(VerifyOptions){0});
        double tension = 0, moment = 0;
        for (int n = 0; n < mesh.node_count; n++) {
            if (mesh.x[3 * n] < strip.length - 1e-9) continue;
            tension -= run.f[3 * n];
            moment -= run.f[3 * n] * (0.5 * strip.height - mesh.x[3 * n + 1]);
        }
        print_message("  A6 strip, kbar %g, %s\n", strip.kbar, i < 4 ? "quads" : "triangles");
        verify_close("tension [N]", tension, strip.e * strip.thickness * strip.height * strip.strain, 1e-2);
        verify_close("2 M / (P h)", 2 * moment / (tension * strip.height), table[i % 4][1], 1e-2);
        verify_free(&run);
        scene_mesh_free(&mesh);
    }
}

/* ---- torsion of an annulus ------------------------------------------------------------------------------------- */

static void check_annulus(ScenePattern pattern, double nu, bool cut_off, double reference)
{
    const double inner = 0.1, outer = 0.25, angle = 0.1 * PI / 180, thickness = 3.5e-4, e = 2e8;
    Scene scene = {0};
    SceneText *deck = &scene.deck;
    SceneMesh *made = &scene.mesh;
    scene_add_ring(made, 1, pattern, 20, 144, inner, outer);
    SceneFabric fabric = scene_isotropic(2, cut_off, 800, e, nu);
    write_body(&scene, "torsion of an annulus", 0.01, &fabric, thickness);
    scene_write_damping(deck, 0, 8000);
    scene_write_ramp(deck, 1, 1e-3, 1);
    scene_write_node_set(deck, 1, made, scene_select_all, NULL);
    scene_write_spc(deck, 1, false, false, true);
    scene_write_node_set(deck, 2, made, scene_select_radius, &outer);
    scene_write_spc(deck, 2, true, true, true);
    double c = elementary_cos(angle), s = elementary_sin(angle);
    for (int i = 0; i < made->node_count; i++) {
        const double *x = made->x + 3 * i;
        if (!scene_select_radius(&inner, x)) continue;
        scene_write_motion(deck, i + 1, 1, 2, 1, (c - 1) * x[0] - s * x[1]);
        scene_write_motion(deck, i + 1, 2, 2, 1, s * x[0] + (c - 1) * x[1]);
    }
    scene_end(deck, made);
    SceneMesh mesh = scene.mesh;
    scene.mesh = (SceneMesh){0};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){0});
    double moment = 0;
    for (int i = 0; i < mesh.node_count; i++) {
        const double *x = run.x + 3 * i, *f = run.f + 3 * i;
        if (scene_select_radius(&inner, mesh.x + 3 * i)) moment -= x[0] * f[1] - x[1] * f[0];
    }
    verify_close("A6 annulus, M / (E t angle) [m2]", moment / (e * thickness * angle), reference, 1e-2);
    verify_free(&run);
    scene_mesh_free(&mesh);
}

static void annulus_torsion(void **state)
{
    (void)state;
    check_annulus(SCENE_QUADS, 0, true, 0.03051705);
    check_annulus(SCENE_CROSS, 0, true, 0.03051705);
    check_annulus(SCENE_QUADS, 0.3, true, 0.03053512);
    check_annulus(SCENE_QUADS, 0.3, false, 0.05753833);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(spinning_ring), cmocka_unit_test(spinning_disc),
                                       cmocka_unit_test(strip_bending), cmocka_unit_test(annulus_torsion)};
    return cmocka_run_group_tests_name("membrane fields", tests, NULL, NULL);
}

/* Same bits (D13): the state's hash over thread counts, kernel clones and the C library's choice of processor features.
 * Each variant runs in a process of its own, `test_determinism --hash THREADS`, which prints one hash per scene. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/contact_scene.h"

static bool select_rim(const void *radius, const double x[3])
{
    return scene_select_radius(radius, x);
}

/* Curves with unloading, reloading and liner. */
static void write_curves(SceneText *deck, int form)
{
    scene_print(deck, "*MAT_FABRIC\n1,800,3e8,2e8\n1e7,,,1,5e7,.3,.1,.1\n0,,,,,%d\n0\n0\n11,12,13,14,,15,.4\n", form);
    scene_write_curve(deck, 11, 4, (const double[]){0, 0, 0.02, 1e6, 0.06, 9e6, 0.2, 6e7});
    scene_write_curve(deck, 12, 3, (const double[]){-0.2, -3e6, 0, 0, 0.2, 4e7});
    scene_write_curve(deck, 13, 3, (const double[]){0, 0, 0.1, 2e5, 0.6, 4e6});
    scene_write_curve(deck, 14, 3, (const double[]){0, 0, 0.1, 4e6, 0.2, 6e7});
    scene_write_curve(deck, 15, 3, (const double[]){0, 0, 0.3, 3e5, 0.6, 4e6});
}

/* Two discs with gas, vent and damping; form and pattern vary. */
static void make_bag(Scene *scene, ScenePattern pattern, int form)
{
    const double radius = 0.35;
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_disc(&scene->mesh, 1, pattern, 9, radius);
    scene_sew_copy(&scene->mesh, 2, select_rim, &radius);
    scene_begin(deck, "bag", 0.004, 0.9);
    scene_write_part(deck, 1, 1, 1, "upper");
    scene_write_part(deck, 2, 1, 1, "lower");
    scene_write_section(deck, 1, 9, 3.5e-4);
    SceneFabric fabric = {.form = form,
                          .cse = true,
                          .density = 800,
                          .ea = 3e8,
                          .eb = 2e8,
                          .gab = 1e7,
                          .prba = 0.2,
                          .prab = 0.3,
                          .damp = 0.1,
                          .el = 5e7,
                          .prl = 0.3,
                          .lratio = 0.1};
    if (form == 14 || form == 24)
        write_curves(deck, form);
    else if (form == 77)
        scene_print(deck, "*MAT_OGDEN_RUBBER\n1,1000,.499\n6.3e6,1.2e4,-1e5\n1.3,5,-2\n");
    else if (form == 27)
        scene_print(deck, "*MAT_MOONEY-RIVLIN_RUBBER\n1,1000,.499,2e6,5e5\n");
    else
        scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 2, (const int[]){1, 2});
    scene_write_curve(deck, 1, 3, (const double[]){0, 0.5, 0.02, 1.5, 1, 1.5});
    scene_write_damping(deck, 0, 20);
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 500;
    air.vent_coefficient = 0.6;
    air.vent_area = 1e-3;
    scene_write_simple_airbag(deck, 1, &air);
    scene_end(deck, &scene->mesh);
}

static void make_triangles(Scene *scene)
{
    make_bag(scene, SCENE_DIAGONAL, 0);
}

static void make_green_triangles(Scene *scene)
{
    make_bag(scene, SCENE_DIAGONAL, 2);
}

static void make_quads(Scene *scene)
{
    make_bag(scene, SCENE_QUADS, 0);
}

static void make_green_quads(Scene *scene)
{
    make_bag(scene, SCENE_QUADS, 2);
}

static void make_curve_triangles(Scene *scene)
{
    make_bag(scene, SCENE_DIAGONAL, 24);
}

static void make_curve_quads(Scene *scene)
{
    make_bag(scene, SCENE_QUADS, 14);
}

static void make_ogden_triangles(Scene *scene)
{
    make_bag(scene, SCENE_DIAGONAL, 77);
}

static void make_mooney_quads(Scene *scene)
{
    make_bag(scene, SCENE_QUADS, 27);
}

/* The same of a fabric that tears. */
static void make_torn_bag(Scene *scene)
{
    scene_print(&scene->deck, "*MAT_ADD_EROSION\n1,0,0,-.02\n0,0,0,2e-4\n");
    make_bag(scene, SCENE_DIAGONAL, 0);
}

/* An elastic tube between a fixed and a falling rigid disc. */
static void make_bounce(Scene *scene)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    deck->exact = true;
    scene_add_disc(mesh, 1, SCENE_QUADS, 4, 0.2);
    int lid = mesh->node_count;
    scene_add_disc(mesh, 2, SCENE_QUADS, 4, 0.2);
    scene_transform(mesh, lid, (const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, (const double[3]){0, 0, 0.3});
    scene_add_tube(mesh, 3, SCENE_QUADS, 12, 16, 0.2, 0.3);
    scene_weld(mesh, 0, 1e-6);
    scene_begin(deck, "bounce", 0.01, 0.9);
    for (int part = 1; part <= 3; part++) scene_write_part(deck, part, 1, part, "part");
    scene_write_section(deck, 1, 9, 5e-4);
    scene_write_rigid(deck, 1, 7800, 7, 7);
    scene_write_rigid(deck, 2, 1e5, 0, 0);
    scene_write_elastic(deck, 3, 800, 2e8, 0.3);
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
    scene_write_curve(deck, 1, 2, (const double[]){0, 1, 1, 1});
    scene_write_gravity(deck, 1, 9.81);
    SceneGas air = scene_air(101325, 293.15);
    air.inflow_curve = 1;
    air.inflow_temperature = 300;
    scene_write_wang_nefske(deck, 1, &air);
    scene_print(deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(deck, 2, 0.5, 0, -4, 1, 2, 3);
    scene_end(deck, mesh);
}

/* A sheet thrown on a slope with friction and a sphere, beside a wall with mass; a rigid block hangs on it by cables.
 */
static void make_walls(Scene *scene)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    SceneFabric fabric = scene_isotropic(0, true, 800, 3e8, 0.3);
    deck->exact = true;
    scene_begin(deck, "walls", 0.02, 0.9);
    scene_write_part(deck, 1, 1, 1, "sheet");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part(deck, 2, 2, 2, "block");
    scene_write_rigid(deck, 2, 500, 0, 0);
    scene_write_part(deck, 3, 3, 3, "cables");
    scene_print(deck, "*SECTION_SOLID\n2\n*SECTION_BEAM\n3,6\n1e-6,,,1e-5,-.01\n*MAT_CABLE_DISCRETE_BEAM\n3,1e3,1e9\n"
                      "*INITIAL_VELOCITY\n0\n3,0,-20\n*RIGIDWALL_PLANAR\n0\n0,0,-.02,.3,0,.98,.3\n"
                      "*RIGIDWALL_PLANAR_MOVING\n0\n.8,0,0,-.2,0,.2,.2\n.02,1\n*RIGIDWALL_GEOMETRIC_SPHERE\n0\n"
                      ".3,.3,-.21,.3,.3,1\n.2\n");
    scene_add_rectangle(mesh, 1, SCENE_DIAGONAL, 24, 24, 0.6, 0.6);
    int corner[2] = {1, mesh->node_count}, block[8];
    for (int i = 0; i < 8; i++)
        block[i] = 1 + scene_add_node(mesh, 0.25 + 0.1 * (i % 4 == 1 || i % 4 == 2), 0.25 + 0.1 * (i % 4 >= 2),
                                      0.1 + 0.1 * (i >= 4));
    scene_print(deck, "*ELEMENT_SOLID\n1,2,%d,%d,%d,%d,%d,%d,%d,%d\n*ELEMENT_BEAM\n1,3,%d,%d\n2,3,%d,%d\n", block[0],
                block[1], block[2], block[3], block[4], block[5], block[6], block[7], corner[0], block[0], corner[1],
                block[2]);
    scene_end(deck, mesh);
}

static void make_drape(Scene *scene)
{
    scene_drape(scene, true);
}

static const struct DeterminismCase {
    const char *name;
    void (*make)(Scene *scene);
    bool one_point;
} cases[] = {{"triangles", make_triangles, false},
             {"triangles, Green", make_green_triangles, false},
             {"quads", make_quads, false},
             {"quads, Green", make_green_quads, false},
             {"one-point quads", make_quads, true},
             {"one-point quads, Green", make_green_quads, true},
             {"triangles, curves", make_curve_triangles, false},
             {"quads, curves", make_curve_quads, false},
             {"one-point quads, curves", make_curve_quads, true},
             {"triangles, Ogden", make_ogden_triangles, false},
             {"quads, Mooney-Rivlin", make_mooney_quads, false},
             {"rigid bodies", make_bounce, false},
             {"walls and cables", make_walls, false},
             {"contact", scene_crumple, false},
             {"contact entities", make_drape, false},
             {"torn bag", make_torn_bag, false},
             {"driver bag", NULL, false}};
enum { CASE_COUNT = sizeof cases / sizeof cases[0] };

static int print_hashes(int threads)
{
    for (int i = 0; i < CASE_COUNT; i++) {
        Scene scene = {0};
        VerifyRun run;
        if (cases[i].make)
            cases[i].make(&scene);
        else
            scene_driver_bag(&scene, 10);
        VerifyOptions options = {.threads = threads, .one_point = cases[i].one_point, .stop = 500, .energy_limit = 1e9};
        int status = scene_ok(&scene) ? verify_build(&run, scene.deck.text, scene.deck.length, &options) : -1;
        scene_free(&scene);
        if (status || verify_loop(&run)) return 1;
        printf("%016llx %ld %s\n", (unsigned long long)state_hash(&run.state), (long)run.cycles, cases[i].name);
        verify_free(&run);
    }
    return 0;
}

typedef struct Hashes {
    char text[CASE_COUNT][128];
} Hashes;

/* Runs this program once more with settings of the environment; false if the kernels are not for this processor. */
static bool run_variant(const char *environment, int threads, Hashes *hashes)
{
    char program[1024], command[2048];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    assert_true(length > 0);
    program[length] = 0;
    snprintf(command, sizeof command, "%s '%s' --hash %d", environment, program, threads);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    int count = 0;
    while (count < CASE_COUNT && fgets(hashes->text[count], sizeof hashes->text[count], pipe)) count++;
    int status = pclose(pipe);
    return status == 0 && count == CASE_COUNT;
}

static void compare_hashes(const char *name, const Hashes *hashes, const Hashes *expected)
{
    for (int i = 0; i < CASE_COUNT; i++)
        if (strcmp(hashes->text[i], expected->text[i]) != 0)
            fail_msg("%s: %sbut one thread gives %s", name, hashes->text[i], expected->text[i]);
    print_message("    %s: equal\n", name);
}

static void same_hash_for_any_thread_count(void **state)
{
    (void)state;
    Hashes one, other;
    assert_true(run_variant("", 1, &one));
    for (int i = 0; i < CASE_COUNT; i++) print_message("    %s", one.text[i]);
    for (int threads = 1; threads <= 4; threads++) {
        char name[32];
        snprintf(name, sizeof name, "%d threads", threads);
        assert_true(run_variant("", threads, &other));
        compare_hashes(name, &other, &one);
    }
}

static void same_hash_for_any_instruction_set(void **state)
{
    (void)state;
    Hashes one, other;
    const char *variants[] = {"BILLOW_KERNELS=v2", "BILLOW_KERNELS=v3", "BILLOW_KERNELS=v4",
                              "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA",
                              "BILLOW_KERNELS=v2 GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA"};
    assert_true(run_variant("", 1, &one));
    for (int i = 0; i < 5; i++) {
        bool ran = run_variant(variants[i], 2, &other);
        if (ran)
            compare_hashes(variants[i], &other, &one);
        else
            print_message("    %s: this processor cannot\n", variants[i]);
        assert_true(ran || i == 1 || i == 2); /* v2 and the tunables must run everywhere */
    }
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--hash") == 0) return print_hashes(atoi(argv[2]));
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_hash_for_any_thread_count),
                                       cmocka_unit_test(same_hash_for_any_instruction_set)};
    return cmocka_run_group_tests_name("determinism", tests, NULL, NULL);
}

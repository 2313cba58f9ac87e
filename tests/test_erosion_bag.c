/* Bags whose walls erode: the hole is a vent with VNTOPT 2 and 10, its cover keeps the volume closed, energy and mass
 * balance, restart. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "airbag/gas_vent.h"
#include "airbag/hole_cover.h"
#include "airbag/volume.h"
#include "io/checkpoint.h"
#include "solver/memory.h"

static const double radius = 0.3, torn_at = 0.015;

/* Parts of the sphere's shells about its poles. */
static bool near_top(const void *user, const double x[3])
{
    (void)user;
    return x[2] > 0.9 * radius;
}

static bool near_bottom(const void *user, const double x[3])
{
    (void)user;
    return x[2] < -0.93 * radius;
}

/* A sphere blown up by an inflator: part 2 about one pole erodes at torn_at, part 3 about the other does not; card4 and
 * vntopt of *AIRBAG_HYBRID. */
static void make_ball(Scene *scene, ScenePattern pattern, const char *card4, int vntopt, bool erodes)
{
    SceneText *deck = &scene->deck;
    SceneMesh *mesh = &scene->mesh;
    const SceneFabric fabric = scene_isotropic(2, false, 800, 3e8, 0.3);
    deck->exact = true;
    scene_add_sphere(mesh, 1, pattern, 8, radius);
    assert_true(scene_retag(mesh, 1, 2, near_top, NULL) > 4);
    assert_true(scene_retag(mesh, 1, 3, near_bottom, NULL) > 0);
    scene_begin(deck, "ball", 0.03, 0.1);
    for (int p = 1; p <= 3; p++) scene_write_part(deck, p, 1, p == 2 ? 2 : 1, "wall");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_fabric(deck, 2, &fabric);
    if (erodes) scene_print(deck, "*MAT_ADD_EROSION\n2\n0,0,0,0,0,0,0,%.17g\n", torn_at);
    scene_write_part_set(deck, 1, 3, (const int[]){1, 2, 3});
    scene_write_damping(deck, 0, 100);
    scene_write_curve(deck, 1, 4, (const double[]){0, 1, 0.01, 1, 0.011, 0, 1, 0});
    scene_write_curve(deck, 2, 2, (const double[]){0, 400, 1, 400});
    scene_write_curve(deck, 3, 4, (const double[]){0, 0, torn_at, 0, torn_at + 1e-9, 0.7, 1, 0.7});
    scene_print(deck, "*AIRBAG_HYBRID\n1,1\n300,1e5,0,8.314\n%s\n0,0,1,0,0,%d\n1,2,0,0.029,1,29\n0\n", card4, vntopt);
    scene_end(deck, mesh);
}

static void run_ball(VerifyRun *run, ScenePattern pattern, const char *card4, int vntopt, bool erodes)
{
    Scene scene = {0};
    make_ball(&scene, pattern, card4, vntopt, erodes);
    verify_scene(run, &scene, &(VerifyOptions){.every = 1});
}

static double eroded_area(const VerifyRun *run)
{
    double area = 0.0;
    for (int k = 0; k < run->model.bag_part_count; k++) area += run->state.part_eroded[k];
    return area;
}

static void a_hole_leaks_as_a_vent_of_its_area(void **state)
{
    (void)state;
    const ScenePattern patterns[] = {SCENE_DIAGONAL, SCENE_QUADS};
    for (int i = 0; i < 2; i++) {
        VerifyRun torn, vented, closed;
        char card[64];
        run_ball(&torn, patterns[i], ".7", 2, true);
        verify_near("outflow before", verify_at(&torn, 0.99 * torn_at, offsetof(VerifySample, mass_flow_out)), 0, 0);
        const double area = eroded_area(&torn), height = 0.1 * radius;
        verify_close("area of the hole", area, 2 * 3.14159 * radius * height, 0.15);
        /* the same hole, but the area and the moment by the card */
        snprintf(card, sizeof card, "0,3,%.17g", area);
        run_ball(&vented, patterns[i], card, 0, true);
        verify_close("mass that left", torn.state.gas[0].mass_out, vented.state.gas[0].mass_out, 1e-3);
        assert_true(verify_message(&vented.diagnostics, SEVERITY_WARNING, "nothing flows out of the holes"));
        assert_false(verify_message(&torn.diagnostics, SEVERITY_WARNING, "nothing flows out of the holes"));
        const GasState *gas = &torn.state.gas[0];
        verify_near("balance of mass", gas->mass + gas->mass_out - gas->mass_in, torn.samples[0].mass, 1e-12);
        verify_balance(&torn, 1e-4);
        /* a hole without a vent: nothing leaves, and the volume goes on without a jump */
        run_ball(&closed, patterns[i], ".7", 0, true);
        verify_near("without VNTOPT", closed.state.gas[0].mass_out, 0, 0);
        double jump = 0.0, usual = 0.0;
        for (size_t k = 1; k < closed.count; k++) {
            const double change = fabs(closed.samples[k].volume - closed.samples[k - 1].volume);
            if (fabs(closed.samples[k].time - torn_at) < 1e-4)
                jump = fmax(jump, change);
            else
                usual = fmax(usual, change);
        }
        /* the bulge of the patch, pi h^2 (r - h/3), is lost */
        const double bulge = 3.14159 * height * height * (radius - height / 3);
        verify_between("jump of the volume over the bulge", jump / bulge, 0.3, 1.3);
        verify_between("other changes over it", usual / bulge, 0, 0.3);
        verify_free(&torn);
        verify_free(&vented);
        verify_free(&closed);
    }
}

/* A23 < 0 with the options; shares of the parts in the flow. */
static void options_of_the_vent_area(void **state)
{
    (void)state;
    for (int vntopt = 0; vntopt <= 10; vntopt += vntopt == 2 ? 8 : 1) {
        VerifyRun run;
        run_ball(&run, SCENE_QUADS, ".02,0,-3", vntopt, true);
        const Airbag *bag = &run.model.airbags[0];
        const GasState *gas = &run.state.gas[0];
        double flow[8], weight[8], hole = 0, grown = 0, whole = 0;
        GasAreas areas = {run.state.part_area, run.state.part_blocked, run.state.part_eroded};
        gas_part_flows(&bag->gas, run.model.curves, &areas, gas, run.state.clock->time, bag->part_count, weight, flow);
        for (int k = 0; k < bag->part_count; k++) {
            const int id = run.model.parts[bag->part[k]].id;
            if (id == 2) hole = run.state.part_eroded[k];
            if (id != 3) continue;
            whole = run.state.part_area[k];
            grown = whole - bag->gas.holes[0].initial_area;
        }
        assert_true(gas->mass_flow_out_vent > 0.0 && grown > 0.0 && hole > 0.0);
        const double own = vntopt == 1 || vntopt == 10 ? grown : whole, others = vntopt >= 2 ? hole : 0.0;
        for (int k = 0; k < bag->part_count; k++) {
            const int id = run.model.parts[bag->part[k]].id;
            const double share = id == 3 ? own : id == 2 ? others : 0.0;
            verify_near("share of the part", flow[k] / gas->mass_flow_out_vent, share / (own + others), 1e-12);
        }
        verify_free(&run);
    }
    /* a vent that erodes stays one */
    VerifyRun torn, whole;
    run_ball(&torn, SCENE_QUADS, ".01,0,-2", 2, true);
    run_ball(&whole, SCENE_QUADS, ".01,0,-2", 2, false);
    verify_close("eroded vent", torn.state.gas[0].mass_out, whole.state.gas[0].mass_out, 0.01);
    verify_free(&torn);
    verify_free(&whole);
}

/* The cover is the fan of the rim: exact for one triangle, blind to nodes within the hole. */
static void covers_close_the_surface(void **state)
{
    (void)state;
    SceneMesh mesh = {0};
    HoleCover cover;
    const double origin[3] = {0.1, -0.05, 0.02};
    scene_add_sphere(&mesh, 1, SCENE_DIAGONAL, 8, 1);
    const int count = mesh.shell_count;
    int32_t *node = memory_alloc(4 * (size_t)count, sizeof *node);
    int64_t *element = memory_alloc((size_t)count, sizeof *element);
    unsigned char *lost = memory_alloc((size_t)count, 1);
    int *sign = memory_alloc((size_t)count, sizeof *sign);
    assert_true(node && element && lost && sign);
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 4; k++) node[4 * i + k] = mesh.shell[i][k];
        element[i] = i;
        sign[i] = 1;
    }
    assert_int_equal(hole_cover_create(&cover, count, node, element), 0);
    hole_cover_update(&cover, lost);
    verify_near("no hole", hole_cover_volume(&cover, mesh.x, origin), 0, 0);
    const double whole = volume_surface(count, node, sign, mesh.x, origin);
    lost[17] = 1;
    hole_cover_update(&cover, lost);
    verify_close("one triangle", hole_cover_volume(&cover, mesh.x, origin), volume_facet(node + 4 * 17, mesh.x, origin),
                 1e-12);
    /* two holes of many shells about the poles; the one at the top has nodes of its own */
    int32_t inner = -1;
    for (int i = 0; i < count; i++) {
        double top = 1, bottom = -1;
        for (int k = 0; k < 3; k++) {
            const double z = mesh.x[3 * mesh.shell[i][k] + 2];
            top = fmin(top, z);
            bottom = fmax(bottom, z);
            if (z > 0.999) inner = mesh.shell[i][k];
        }
        lost[i] = top > 0.8 || bottom < -0.9;
        sign[i] = !lost[i];
    }
    hole_cover_update(&cover, lost);
    assert_int_equal(cover.patch_count, 2);
    const double cut = volume_surface(count, node, sign, mesh.x, origin) + hole_cover_volume(&cover, mesh.x, origin);
    const double h1 = 0.2, h2 = 0.1, pi = 3.14159265358979;
    const double lost_volume = pi * (h1 * h1 * (1 - h1 / 3) + h2 * h2 * (1 - h2 / 3));
    verify_between("volume cut off over two caps of the sphere", (whole - cut) / lost_volume, 0.3, 1.0);
    if (inner >= 0) mesh.x[3 * inner] += 100; /* a scrap that flies away */
    verify_near("a scrap changes nothing",
                volume_surface(count, node, sign, mesh.x, origin) + hole_cover_volume(&cover, mesh.x, origin), cut,
                1e-12);
    /* and no origin matters: the surface is closed */
    verify_near("closed",
                volume_surface(count, node, sign, mesh.x, (const double[]){5, 6, 7}) +
                    hole_cover_volume(&cover, mesh.x, (const double[]){5, 6, 7}),
                cut, 1e-11);
    hole_cover_free(&cover);
    memory_free(node);
    memory_free(element);
    memory_free(lost);
    memory_free(sign);
    scene_mesh_free(&mesh);
}

/* Restarted after the hole has opened, on other threads: the covers are made anew from the state. */
static void a_restart_gives_the_same_bits(void **state)
{
    (void)state;
    static const char path[] = "test_erosion_bag.billow";
    VerifyRun straight, first, second, *parts[3] = {&first, &second, &straight};
    Scene scene = {0};
    for (int i = 0; i < 3; i++) {
        make_ball(&scene, SCENE_DIAGONAL, ".7", 2, true);
        const VerifyOptions options = {.threads = 1 + i, .stop_time = i == 0 ? 1.1 * torn_at : 0};
        assert_int_equal(verify_build(parts[i], scene.deck.text, scene.deck.length, &options), 0);
        scene_free(&scene);
        scene = (Scene){0};
        if (i == 1) assert_int_equal(checkpoint_read(path, &second.model, &second.state, &second.diagnostics), 0);
        assert_int_equal(verify_loop(parts[i]), 0);
        if (i == 0) assert_int_equal(checkpoint_write(path, &first.model, &first.state, &first.diagnostics), 0);
    }
    assert_true(*first.state.eroded_count > 0);
    verify_close("volume", second.state.gas[0].volume, straight.state.gas[0].volume, 0);
    assert_true(state_hash(&second.state) == state_hash(&straight.state));
    unlink(path);
    verify_free(&straight);
    verify_free(&first);
    verify_free(&second);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_close_the_surface),
        cmocka_unit_test(a_hole_leaks_as_a_vent_of_its_area),
        cmocka_unit_test(options_of_the_vent_area),
        cmocka_unit_test(a_restart_gives_the_same_bits),
    };
    return cmocka_run_group_tests_name("holes of bags", tests, NULL, NULL);
}

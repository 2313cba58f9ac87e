/* Tori, bodies of revolution, capsules and finite planes in motion: momentum, energy, bounce, what goes around a rim.
 */
#include <string.h>

#include "tests/entity_case.h"

/* A line of points as a *DEFINE_CURVE of general x-y data: z and radius in turn. */
static void write_outline(char *text, size_t size, int id, int count, const double *points)
{
    int length = snprintf(text, size, "*DEFINE_CURVE\n%d,0,1,1,0,0,1\n", id);
    for (int i = 0; i < count; i++)
        length += snprintf(text + length, size - (size_t)length, "%.17g,%.17g\n", points[2 * i], points[2 * i + 1]);
}

static const double drum[] = {-0.01, 0, -0.01, 0.03, 0.025, 0.03, 0.025, 0},
                    dish[] = {-0.02, 0, 0.03, 0.05, 0.031, 0.047, 0.02, 0}, /* hollow on top */
    tube[] = {-0.02, 0.02, 0.02, 0.02};

static void momentum_is_kept(void **state)
{
    (void)state;
    char text[1000];
    const double across[3] = {0, 1, 0}, up[3] = {0, 0, 1}; /* the third axis is x */
    SceneEntity torus = {.shape = 5, .g = {0, 0, 0, 0.02, 0.01}, .friction = 0.3},
                plane = {.shape = 10, .g = {0.04, 0.05}, .centre = {0, 0, 0.025}, .friction = 0.3, .order = 1},
                body = {.shape = 11, .g = {7}, .damping = 20, .order = 1};
    meet_patch(&torus, 1, "");
    memcpy(torus.a, across, sizeof torus.a);
    memcpy(torus.b, up, sizeof torus.b);
    torus.order = 2;
    meet_patch(&torus, 1, "");
    meet_patch(&plane, 1, "");
    write_outline(text, sizeof text, 7, 4, drum);
    meet_patch(&body, 1, text);
    write_outline(text, sizeof text, 7, 4, dish);
    meet_patch(&body, 1, text);
    write_outline(text, sizeof text, 7, 2, tube);
    SceneEntity capsule[3] = {{.shape = 11, .g = {7}}, {.shape = 2, .g = {-0.02, 0, 0, 0.02}}, {.shape = 2}};
    memcpy(capsule[0].a, across, sizeof across);
    memcpy(capsule[0].b, up, sizeof up);
    capsule[2].g[0] = 0.02;
    capsule[2].g[3] = 0.02;
    meet_patch(capsule, 3, text);
}

/* Where a small sheet strikes a surface of revolution, r and z, and the normal there. */
typedef struct Strike {
    double r, z, normal[2];
} Strike;

/* Small sheets all around fly against the surface of a fixed body and come back as fast: an elastic bounce. */
static void bounce_off(const char *name, const SceneEntity *entities, int count, const char *cards,
                       const Strike *strike, int strikes)
{
    enum { AROUND = 5 };
    const double side = 4e-4, apart = 2e-4, speed = 5;
    Scene scene = {0};
    begin(&scene, 3e-4, 7);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 1, 0.001);
    int first = scene.mesh.node_count;
    double normal[64][3];
    assert_true(strikes * AROUND <= 64);
    for (int i = 0; i < strikes * AROUND; i++) {
        const Strike *s = &strike[i / AROUND];
        double angle = 2 * M_PI * i / AROUND + 0.1, c = cos(angle), d = sin(angle), *n = normal[i];
        const double across[3] = {-d, c, 0}, shift[3] = {s->r * c, s->r * d, s->z};
        double place[3], other[3];
        n[0] = s->normal[0] * c;
        n[1] = s->normal[0] * d;
        n[2] = s->normal[1];
        vector3_cross(across, n, other);
        const double turn[9] = {across[0], other[0], n[0], across[1], other[1], n[1], across[2], other[2], n[2]};
        for (int k = 0; k < 3; k++) place[k] = shift[k] + apart * n[k];
        int sheet = scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 1, 1, side, side, -0.5 * side, -0.5 * side, 0);
        scene_transform(&scene.mesh, sheet, turn, place);
        scene_write_speed(&scene.deck, sheet, scene.mesh.node_count, -speed * n[0], -speed * n[1], -speed * n[2]);
    }
    end_with_entities(&scene, entities, count, 0, cards);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double worst = 0;
    for (int i = 0; i < strikes * AROUND; i++) {
        double v[3];
        for (int k = 0; k < 3; k++) v[k] = mean_speed(&run, first + 4 * i, first + 4 * i + 4, k) - speed * normal[i][k];
        worst = fmax(worst, vector3_norm(v));
    }
    verify_near(name, worst / speed, 0, 0.01);
    check_end(&run, 1e-4);
    verify_free(&run);
}

static void bounces(void **state)
{
    (void)state;
    char text[1000];
    const double half = sqrt(0.5);
    bounce_off("torus", &(SceneEntity){.shape = 5, .g = {0, 0, 0, 0.03, 0.01}}, 1, "",
               (const Strike[]){{0.04, 0, {1, 0}},
                                {0.02, 0, {-1, 0}},
                                {0.03, 0.01, {0, 1}},
                                {0.03 - 0.01 * half, -0.01 * half, {-half, -half}}},
               4);
    bounce_off("inside of a torus", &(SceneEntity){.shape = 5, .g = {0, 0, 0, 0.03, 0.01}, .inside = 1}, 1, "",
               (const Strike[]){{0.04, 0, {-1, 0}}, {0.02, 0, {1, 0}}, {0.03, 0.01, {0, -1}}}, 3);
    bounce_off("finite plane", &(SceneEntity){.shape = 10, .g = {0.04, 0.04}, .centre = {0, 0, 0.01}}, 1, "",
               (const Strike[]){{0.01, 0.01, {0, 1}}, {0.019, 0.01, {0, 1}}}, 2);
    write_outline(text, sizeof text, 7, 4, drum);
    bounce_off("finite cylinder", &(SceneEntity){.shape = 11, .g = {7}}, 1, text,
               (const Strike[]){{0.03, 0.02, {1, 0}}, {0.01, -0.01, {0, -1}}, {0.02, 0.025, {0, 1}}}, 3);
    write_outline(text, sizeof text, 7, 4, dish);
    bounce_off("dish", &(SceneEntity){.shape = 11, .g = {7}}, 1, text,
               (const Strike[]){{0.025, 0.005, {half, -half}},
                                {0.0235, 0.0255, {-0.011 / hypot(0.011, 0.047), 0.047 / hypot(0.011, 0.047)}}},
               2);
    write_outline(text, sizeof text, 7, 2, tube);
    bounce_off("inside of a tube", &(SceneEntity){.shape = 11, .g = {7}, .inside = 1}, 1, text,
               (const Strike[]){{0.02, 0, {-1, 0}}, {0.02, 0.015, {-1, 0}}}, 2);
    const SceneEntity capsule[3] = {
        {.shape = 11, .g = {7}}, {.shape = 2, .g = {0, 0, 0.02, 0.02}}, {.shape = 2, .g = {0, 0, -0.02, 0.02}}};
    bounce_off(
        "capsule", capsule, 3, text,
        (const Strike[]){{0.02, 0.01, {1, 0}}, {0.02 * half, 0.02 + 0.02 * half, {half, half}}, {0.02, 0.02, {1, 0}}},
        3);
}

/* Sheets that fly around the rim of an open surface, or start behind it, and then away from it keep their speed. */
static void around_the_rim(const SceneEntity *entity, const char *cards, const double place[3], const double speed[3])
{
    const double side = 0.004;
    Scene scene = {0};
    begin(&scene, 4e-3, 7);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 1, 0.001);
    int sheet = scene_add_sheet(&scene.mesh, FABRIC, SCENE_QUADS, 2, 2, side, side, place[0], place[1], place[2]);
    scene_write_speed(&scene.deck, sheet, scene.mesh.node_count, speed[0], speed[1], speed[2]);
    end_with_entities(&scene, entity, 1, 1, cards);
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1});
    double most = 0;
    for (int i = sheet; i < run.model.node_count; i++)
        for (int k = 0; k < 3; k++) most = fmax(most, fabs(run.v[3 * i + k] - speed[k]));
    verify_near("largest change of speed", most, 0, 1e-9);
    verify_free(&run);
}

static void rims(void **state)
{
    (void)state;
    char text[1000];
    const SceneEntity plane = {.shape = 10, .g = {0.04, 0.04}}, can = {.shape = 11, .g = {7}, .inside = 1};
    around_the_rim(&plane, "", (const double[]){0.021, 0, -0.001}, (const double[]){-8, 0, -3});  /* in under it */
    around_the_rim(&plane, "", (const double[]){-0.002, 0, -0.008}, (const double[]){0, 0, -5});  /* behind it */
    around_the_rim(&plane, "", (const double[]){-0.002, 0, -0.008}, (const double[]){0, 0.5, 5}); /* and through */
    around_the_rim(&plane, "", (const double[]){0.021, 0, 0.01}, (const double[]){1, 0, -8});     /* past it */
    write_outline(text, sizeof text, 7, 3, (const double[]){0, 0, 0, 0.02, 0.03, 0.02});
    around_the_rim(&can, text, (const double[]){-0.002, 0, 0.01}, (const double[]){0, 0, 12});  /* out of the can */
    around_the_rim(&can, text, (const double[]){0.03, 0, 0.035}, (const double[]){0.5, 0, -7}); /* down outside */
    around_the_rim(&can, text, (const double[]){0.021, 0, 0.035}, (const double[]){1, 0, -7});  /* close to it */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(momentum_is_kept), cmocka_unit_test(bounces),
                                       cmocka_unit_test(rims)};
    return cmocka_run_group_tests_name("bodies of contact entities", tests, NULL, NULL);
}

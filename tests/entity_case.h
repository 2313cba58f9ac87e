/* What tests of contact entities share: fabric and bodies, momentum, a patch that flies against a body. */
#ifndef BILLOW_TESTS_ENTITY_CASE_H
#define BILLOW_TESTS_ENTITY_CASE_H

#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "solver/vector3.h"
#include "tests/contact_scene.h"

static const double thickness = 3e-4, density = 800;

enum { FABRIC = 1, BODY, STRIKER };

static inline void begin(Scene *scene, double end, int body_fixed)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_begin(deck, "entity", end, 0.9);
    scene_write_part(deck, FABRIC, 1, 1, "fabric");
    scene_write_part(deck, BODY, 2, 2, "body");
    scene_write_part(deck, STRIKER, 2, 3, "striker");
    scene_write_section(deck, 1, 9, thickness);
    scene_write_section(deck, 2, 9, 1e-3);
    SceneFabric fabric = scene_isotropic(2, false, density, 2e8, 0.3);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_rigid(deck, 2, 2000, body_fixed, body_fixed);
    scene_write_rigid(deck, 3, 7800, 0, 0);
}

/* Momentum and its moment about the origin of everything, kept by central differences: x at t_n, v at n + 1/2. */
typedef struct Momentum {
    double linear[3], angular[3];
} Momentum;

static inline Momentum momentum_of(const Model *model, const State *state)
{
    Momentum p = {0};
    unsigned char *rigid = calloc((size_t)model->node_count, 1);
    assert_non_null(rigid);
    for (int b = 0; b < model->rigid_body_count; b++) {
        const RigidBody *body = &model->rigid_bodies[b];
        const RigidState *s = &state->rigid[b];
        double part[3];
        for (int k = 0; k < body->node_count; k++) rigid[body->node[k]] = 1;
        vector3_cross(s->output.x, s->v, part);
        for (int k = 0; k < 3; k++) {
            p.linear[k] += body->mass * s->v[k];
            p.angular[k] += body->mass * part[k] + s->momentum[k];
        }
    }
    for (int n = 0; n < model->node_count; n++) {
        const double *v = state->v + 3 * n;
        double part[3];
        vector3_cross(state->x + 3 * n, v, part);
        for (int k = 0; k < 3 && !rigid[n]; k++) {
            p.linear[k] += model->mass[n] * v[k];
            p.angular[k] += model->mass[n] * part[k];
        }
    }
    free(rigid);
    return p;
}

typedef struct Watch {
    Momentum start;
    double linear, angular; /* largest change of a component */
    bool begun;
} Watch;

static inline void watch(void *user, const Model *model, const State *state, const StepView *view)
{
    Watch *w = user;
    (void)view;
    Momentum now = momentum_of(model, state);
    if (!w->begun) w->start = now;
    for (int k = 0; k < 3; k++) {
        w->linear = fmax(w->linear, fabs(now.linear[k] - w->start.linear[k]));
        w->angular = fmax(w->angular, fabs(now.angular[k] - w->start.angular[k]));
    }
    w->begun = true;
}

static inline void check_end(const VerifyRun *run, double tolerance)
{
    const VerifySample *last = &run->samples[run->count - 1];
    print_message("    %ld cycles\n", (long)run->cycles);
    verify_near("energy balance at the end", (last->held - last->given) / run->energy, 0, tolerance);
}

/* Ends the deck with entities of the body that the fabric meets. thick: ITHK; cards: further text. */
static inline void end_with_entities(Scene *scene, const SceneEntity *entities, int count, int thick, const char *cards)
{
    for (int i = 0; i < count; i++) {
        SceneEntity entity = entities[i];
        entity.part = BODY;
        entity.set = FABRIC;
        entity.set_type = 1;
        entity.thick = thick;
        scene_write_entity(&scene->deck, &entity);
    }
    scene_print(&scene->deck, "%s", cards);
    scene_end(&scene->deck, &scene->mesh);
}

/* A patch of fabric flies against a free, spinning body with these shapes: nothing is lost, with friction and damping,
 * nor with points within the elements. cards: further text of the deck. */
static inline void meet_patch(const SceneEntity *entities, int count, const char *cards)
{
    Scene scene = {0};
    begin(&scene, 2e-3, 0);
    scene_add_sphere(&scene.mesh, BODY, SCENE_QUADS, 3, 0.02);
    int patch = scene_add_sheet(&scene.mesh, FABRIC, SCENE_DIAGONAL, 12, 12, 0.06, 0.06, -0.027, -0.032, 0.031);
    scene_print(&scene.deck, "*INITIAL_VELOCITY_RIGID_BODY\n");
    SCENE_CARD(&scene.deck, BODY, 0, 0, 0, 100, -200, 150);
    scene_write_speed(&scene.deck, patch, scene.mesh.node_count, 1, 0, -10);
    end_with_entities(&scene, entities, count, 1, cards);
    Watch w = {0};
    VerifyRun run;
    verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = watch, .user = &w});
    double scale = density * thickness * 0.06 * 0.06 * 10, reached = 0;
    for (int k = 0; k < 3; k++) reached = fmax(reached, fabs(run.state.rigid[0].v[k]) * run.model.rigid_bodies[0].mass);
    verify_between("momentum that the body got", reached / scale, 0.1, 2);
    verify_near("change of momentum", w.linear / scale, 0, 1e-10);
    verify_near("change of its moment", w.angular / (scale * 0.03), 0, 1e-10);
    check_end(&run, 5e-3);
    verify_free(&run);
}

#endif

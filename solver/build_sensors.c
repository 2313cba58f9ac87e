/* RBID of *AIRBAG: sensors with their rigid bodies, frames and user's function. */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/coordinates.h"
#include "solver/vector3.h"

/* Axes of two vectors on *MAT_RIGID: x along a, y in the plane of a and v. */
static int vector_axes(Builder *b, const MaterialDefinition *material, double axes[9])
{
    const RigidCard *card = &material->rigid;
    const double a[3] = {card->lco_or_a1, card->a2, card->a3}, v[3] = {card->v1, card->v2, card->v3};
    memcpy(axes, a, sizeof a);
    vector3_cross(a, v, axes + 6);
    if (vector3_normalize(axes) > 0 && vector3_normalize(axes + 6) > 0) {
        vector3_cross(axes + 6, axes, axes + 3);
        return 0;
    }
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, material->source, "*MAT_RIGID",
                    "A1 to A3 and V1 to V3 of material %d do not span a plane; a sensor needs axes", material->id);
    return -1;
}

/* LCO, or A1 to V3, or the principal axes. */
static int find_axes(Builder *b, const MaterialDefinition *material, const RigidBody *body, double axes[9])
{
    const RigidCard *card = &material->rigid;
    bool vectors = card->a2 != 0 || card->a3 != 0 || card->v1 != 0 || card->v2 != 0 || card->v3 != 0;
    if (vectors) return vector_axes(b, material, axes);
    if (card->lco_or_a1 == 0) {
        memcpy(axes, body->axes, sizeof body->axes);
        return 0;
    }
    CoordinateSystem system;
    if (coordinates_resolve_system(&b->index, (int)card->lco_or_a1, material->source, "*MAT_RIGID", &system,
                                   b->diagnostics))
        return -1;
    memcpy(axes, system.axes, sizeof system.axes);
    return 0;
}

/* The user's function, from the library named on the command line; loaded once. */
static int load_function(Builder *b, const AirbagDefinition *bag, Sensor *sensor)
{
    const char *name = b->options->sensor_library;
    char path[4096];
    if (!name) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, bag->card1, "*AIRBAG",
                        "RBID = %d calls a function of the user's: name its shared library on the command line with "
                        "--sensor-library FILE, or give RBID = %d and the levels of the built-in sensor",
                        bag->rbid, -bag->rbid);
        return -1;
    }
    /* without a slash the loader would search the system's folders */
    snprintf(path, sizeof path, "%s%s", strchr(name, '/') ? "" : "./", name);
    if (!b->model->sensor_library) b->model->sensor_library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void *symbol = b->model->sensor_library ? dlsym(b->model->sensor_library, BILLOW_SENSOR_FUNCTION) : NULL;
    if (!symbol) {
        const char *why = dlerror();
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "--sensor-library %s: %s; it must be a shared library with the function %s", name,
                        why ? why : "no reason given", BILLOW_SENSOR_FUNCTION);
        return -1;
    }
    memcpy(&sensor->function, &symbol, sizeof symbol);
    return 0;
}

static int find_body(Builder *b, const AirbagDefinition *bag, Sensor *sensor)
{
    int part = id_map_find(&b->index.parts, sensor->part_id);
    if (part < 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, bag->card1, "*AIRBAG", "RBID = %d: there is no part of this id",
                        bag->rbid);
        return -1;
    }
    sensor->rigid_body = b->model->parts[part].rigid_body;
    if (sensor->rigid_body == MOTION_DEFORMABLE) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, bag->card1, "*AIRBAG",
                        "RBID = %d: part %d is not rigid; a sensor sits on a part of *MAT_RIGID", bag->rbid,
                        sensor->part_id);
        return -1;
    }
    const MaterialDefinition *material = &b->definitions->materials.items[b->parts[part].material];
    if (sensor->rigid_body >= 0)
        return find_axes(b, material, &b->model->rigid_bodies[sensor->rigid_body], sensor->axes);
    sensor->rigid_body = -1;
    sensor->axes[0] = sensor->axes[4] = sensor->axes[8] = 1.0;
    if (!sensor->function)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, bag->card1, "*AIRBAG",
                        "RBID = %d: part %d never moves, so that its sensor never fires", bag->rbid, sensor->part_id);
    return 0;
}

static int build_sensor(Builder *b, const AirbagDefinition *bag, int airbag_id, Sensor *sensor)
{
    const SensorCards *cards = &bag->sensor;
    sensor->airbag_id = airbag_id;
    sensor->part_id = bag->rbid < 0 ? -bag->rbid : bag->rbid;
    memcpy(sensor->acceleration, cards->a, sizeof cards->a);
    memcpy(sensor->velocity, cards->dv, sizeof cards->dv);
    memcpy(sensor->displacement, cards->u, sizeof cards->u);
    sensor->duration = cards->tdur;
    sensor->constant_count = cards->n;
    memcpy(sensor->constant, cards->c, sizeof cards->c);
    if (bag->rbid > 0 && load_function(b, bag, sensor)) return -1;
    return find_body(b, bag, sensor);
}

int build_sensors(Builder *b)
{
    Model *m = b->model;
    int count = 0, status = 0;
    for (int i = 0; i < m->airbag_count; i++) count += b->definitions->airbags.items[i].rbid != 0;
    if (count == 0) return 0;
    m->sensors = builder_alloc(b, (size_t)count, sizeof *m->sensors);
    m->sensor_airbag = builder_alloc(b, (size_t)count, sizeof *m->sensor_airbag);
    if (!m->sensors || !m->sensor_airbag) return -1;
    for (int i = 0; i < m->airbag_count; i++) {
        const AirbagDefinition *bag = &b->definitions->airbags.items[i];
        if (bag->rbid == 0) continue;
        m->sensor_airbag[m->sensor_count] = i;
        if (build_sensor(b, bag, m->airbags[i].id, &m->sensors[m->sensor_count])) status = -1;
        m->sensor_count++;
    }
    return status;
}

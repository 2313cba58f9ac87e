/* A model of seven nodes and four shells made by hand, with states to write: no deck, no solver. For the result
 * writers. */
#ifndef BILLOW_SMALL_MODEL_H
#define BILLOW_SMALL_MODEL_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "solver/definitions.h"
#include "solver/model.h"
#include "solver/state.h"
#include "solver/step.h"

enum { SMALL_NODES = 7, SMALL_ELEMENTS = 4, SMALL_PARTS = 3 };

/* Part 10: fabric, a quad and a triangle. Part 20: a moving rigid triangle. Part 30: a fixed rigid triangle.
 * Airbag 7 has parts 10 and 20 on its surface. Nodes 101 .. 107 are stored in another order than the deck's. */
typedef struct SmallModel {
    Model model;
    State state;
    StepView view;
    int node_id[SMALL_NODES], deck_node[SMALL_NODES], element_id[SMALL_ELEMENTS], element_part[SMALL_ELEMENTS];
    int32_t element_node[4 * SMALL_ELEMENTS];
    int64_t element_slot[SMALL_ELEMENTS];
    double initial[3 * SMALL_NODES], mass[SMALL_NODES], element_mass[SMALL_ELEMENTS], thickness[SMALL_ELEMENTS];
    ElementGroup groups[SMALL_ELEMENTS];
    Part parts[SMALL_PARTS];
    Airbag airbag;
    int bag_parts[2], history_nodes[2];
    double part_area[2], part_blocked[2];
    RigidBody body;
    Clock clock;
    Energies energy;
    GasState gas;
    RigidState rigid;
    double part_energy[SMALL_PARTS], part_hourglass[SMALL_PARTS];
    double x[3 * SMALL_NODES], v[3 * SMALL_NODES], a[3 * SMALL_NODES], f[3 * SMALL_NODES];
    double part_kinetic[SMALL_PARTS], part_momentum[3 * SMALL_PARTS];
} SmallModel;

static inline void small_add_group(SmallModel *small, int element, ElementKind kind)
{
    ElementGroup *group = &small->groups[element];
    *group = (ElementGroup){.kind = kind,
                            .law = LAW_SURFACE,
                            .part = small->element_part[element],
                            .corner_count = kind == ELEMENT_TRIANGLE ? 3 : 4,
                            .point_count = 1,
                            .element_count = 1,
                            .block_count = 1,
                            .first_element = element * BILLOW_LANES,
                            .pressure_set = -1};
    small->element_slot[element] = (int64_t)element * BILLOW_LANES;
}

static inline void small_fill_mesh(SmallModel *small)
{
    static const double place[SMALL_NODES][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},  {0, 1, 0},
                                                 {2, 0, 0}, {2, 1, 0}, {3, 0.5, 0}};
    static const int corner[SMALL_ELEMENTS][4] = {{0, 1, 2, 3}, {1, 4, 2, 2}, {4, 5, 2, 2}, {4, 6, 5, 5}};
    static const int part[SMALL_ELEMENTS] = {0, 0, 1, 2};
    for (int i = 0; i < SMALL_NODES; i++) {
        int node = (3 * i + 2) % SMALL_NODES;
        small->deck_node[i] = node;
        small->node_id[node] = 101 + i;
        small->mass[node] = 1;
        memcpy(small->initial + 3 * node, place[i], sizeof place[i]);
    }
    for (int e = 0; e < SMALL_ELEMENTS; e++) {
        small->element_id[e] = 11 + e;
        small->element_part[e] = part[e];
        small->element_mass[e] = 2 + e;
        small->thickness[e] = 0.25;
        for (int c = 0; c < 4; c++) small->element_node[4 * e + c] = small->deck_node[corner[e][c]];
        small_add_group(small, e, e == 0 ? ELEMENT_QUAD_FULL : ELEMENT_TRIANGLE);
    }
}

static inline void small_fill_parts(SmallModel *small)
{
    small->parts[0] = (Part){.id = 10, .title = "panel", .material_kind = MATERIAL_FABRIC, .rigid_body = -1, .mass = 5};
    small->parts[1] = (Part){.id = 20, .title = "plate", .material_kind = MATERIAL_RIGID, .rigid_body = 0, .mass = 4};
    small->parts[2] = (Part){.id = 30, .title = "nozzle", .material_kind = MATERIAL_RIGID, .rigid_body = -1, .mass = 5};
    small->body = (RigidBody){.part_id = 20, .mass = 4, .centre = {1.5, 0.5, 0}, .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    small->bag_parts[1] = 1;
    small->airbag =
        (Airbag){.id = 7, .heading = "cushion", .part = small->bag_parts, .part_count = 2, .surface_parts = 2};
    small->history_nodes[0] = small->deck_node[1];
    small->history_nodes[1] = small->deck_node[6];
}

/* Everything but the state's values; the structure must stay where it is. */
static inline void small_create(SmallModel *small)
{
    memset(small, 0, sizeof *small);
    small_fill_mesh(small);
    small_fill_parts(small);
    small->model = (Model){.title = "small model",
                           .node_count = SMALL_NODES,
                           .moving_count = SMALL_NODES,
                           .node_id = small->node_id,
                           .deck_node = small->deck_node,
                           .initial = small->initial,
                           .mass = small->mass,
                           .element_count = SMALL_ELEMENTS,
                           .deformable_count = 2,
                           .element_id = small->element_id,
                           .element_part = small->element_part,
                           .element_node = small->element_node,
                           .element_slot = small->element_slot,
                           .element_thickness = small->thickness,
                           .element_mass = small->element_mass,
                           .group_count = SMALL_ELEMENTS,
                           .padded_count = SMALL_ELEMENTS * BILLOW_LANES,
                           .groups = small->groups,
                           .part_count = SMALL_PARTS,
                           .parts = small->parts,
                           .airbag_count = 1,
                           .airbags = &small->airbag,
                           .rigid_body_count = 1,
                           .rigid_bodies = &small->body,
                           .output = {.history_node = small->history_nodes, .history_count = 2}};
    small->state = (State){.clock = &small->clock,
                           .energy = &small->energy,
                           .x = small->x,
                           .v = small->v,
                           .gas = &small->gas,
                           .part_area = small->part_area,
                           .part_blocked = small->part_blocked,
                           .part_energy = small->part_energy,
                           .part_hourglass = small->part_hourglass,
                           .rigid = &small->rigid};
    small->view = (StepView){.x = small->x,
                             .v = small->v,
                             .a = small->a,
                             .f = small->f,
                             .part_kinetic = small->part_kinetic,
                             .part_momentum = small->part_momentum,
                             .element_step = 0.0625,
                             .critical_element = 1};
}

/* The state at a time: numbers without meaning that differ from one another and from time to time. */
static inline void small_set_time(SmallModel *small, double time)
{
    double *gas = &small->gas.volume;
    double *energy = &small->energy.kinetic;
    small->clock = (Clock){.time = time, .step = 0.01 + time / 3, .cycle = (int64_t)(100 * time)};
    for (int i = 0; i < 3 * SMALL_NODES; i++) {
        small->x[i] = small->initial[i] + time * (i + 1) / 7;
        small->v[i] = (i + 1) / 7.0;
        small->a[i] = -i / 3.0 - time;
    }
    for (size_t i = 0; i < sizeof small->gas / sizeof *gas; i++) gas[i] = 1 + (double)i / 3 + time;
    for (size_t i = 0; i < sizeof small->energy / sizeof *energy; i++) energy[i] = 2 + (double)i / 7 + time;
    for (int p = 0; p < SMALL_PARTS; p++) {
        small->part_energy[p] = p + 0.1 + time;
        small->part_hourglass[p] = p + 0.2;
        small->part_kinetic[p] = p + 0.3;
        for (int c = 0; c < 3; c++) small->part_momentum[3 * p + c] = p + c + 0.4;
    }
    for (int k = 0; k < 2; k++) {
        small->part_area[k] = 1.5 - k + time;
        small->part_blocked[k] = 0.25 * time;
    }
    /* State proper is a cycle ahead of what is to be written. */
    small->rigid = (RigidState){.x = {99, 99, 99},
                                .v = {99, 99, 99},
                                .a = {time, 2, 3},
                                .rotation = {1, 0, 0, 0},
                                .spin = {99, 99, 99},
                                .alpha = {0, 0, 2},
                                .output = {.x = {1.5 + time, 0.5, -time},
                                           .v = {0.25, 0.5, time},
                                           .rotation = {sqrt(0.5), 0, 0, sqrt(0.5)},
                                           .spin = {0, 0, 1}}};
}

#endif

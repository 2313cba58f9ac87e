/* The bound of the mesh's highest frequency: what an element's own is worth where its nodes share it with others. */
#include <math.h>

#include "elements/kernels.h"
#include "solver/builder.h"
#include "solver/memory.h"

enum { LANES = BILLOW_LANES };

/* A lane's constant after its points. */
static ptrdiff_t tail_place(const ElementGroup *group, int64_t place, int constant)
{
    return (place / LANES * group->geometry_size + group->point_count * GEOMETRY_POINT_SIZE + constant) * LANES +
           place % LANES;
}

/* The element's own squared frequency: the largest over its geometries. */
static double own_rate(const Builder *b, int number, int64_t place)
{
    double largest = 0.0;
    for (int which = 0; which < GEOMETRY_COUNT; which++) {
        const double *constants = b->constants[number * GEOMETRY_COUNT + which];
        if (constants) largest = fmax(largest, constants[tail_place(&b->model->groups[number], place, GEOMETRY_RATE)]);
    }
    return largest;
}

/* Node sums over the elements with stress: mass, and mass times squared frequency (eq. E20a), each (node count). */
static void sum_nodes(const Builder *b, double *mass, double *mass_rate)
{
    const Model *m = b->model;
    const int32_t *order = b->order;
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count) {
        if (m->groups[g].law == LAW_SURFACE) continue;
        for (int place = 0; place < m->groups[g].element_count; place++) {
            const ShellRecord *r = &b->records[order[place]];
            const double share = r->mass / r->corner_count, rate = own_rate(b, g, place);
            for (int a = 0; a < r->corner_count; a++) {
                mass[r->node[a]] += share;
                mass_rate[r->node[a]] += share * rate;
            }
        }
    }
}

/* Of one element: the largest mean over its nodes to its own squared frequency (eq. E20b). */
static double node_share(const ShellRecord *r, double own, const double *mass, const double *mass_rate)
{
    double largest = 0.0;
    for (int a = 0; a < r->corner_count; a++)
        if (mass[r->node[a]] > 0.0) largest = fmax(largest, mass_rate[r->node[a]] / mass[r->node[a]]);
    return own > 0.0 && largest > 0.0 ? largest / own : 1.0;
}

int build_node_shares(Builder *b)
{
    const Model *m = b->model;
    double *mass = memory_alloc((size_t)m->node_count, 2 * sizeof *mass), *mass_rate = mass + m->node_count;
    if (!mass) {
        diagnostics_add(b->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "no memory for the model");
        return -1;
    }
    for (int i = 0; i < 2 * m->node_count; i++) mass[i] = 0.0;
    sum_nodes(b, mass, mass_rate);
    const int32_t *order = b->order;
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count) {
        const ElementGroup *group = &m->groups[g];
        if (group->law == LAW_SURFACE) continue;
        for (int place = 0; place < group->element_count; place++) {
            const double share = node_share(&b->records[order[place]], own_rate(b, g, place), mass, mass_rate);
            for (int which = 0; which < GEOMETRY_COUNT; which++) {
                double *constants = b->constants[g * GEOMETRY_COUNT + which];
                if (!constants) continue;
                constants[tail_place(group, place, GEOMETRY_RATE)] *= share;
                constants[tail_place(group, place, GEOMETRY_STRESS_RATE)] *= share;
            }
        }
    }
    memory_free(mass);
    return 0;
}

/* The bound of the mesh's highest frequency: what an element's own is worth where its nodes share it with others. */
#include <math.h>

#include "elements/kernels.h"
#include "solver/memory.h"
#include "solver/node_rates.h"

enum { LANES = BILLOW_LANES };

/* A lane's constant after its points. */
static ptrdiff_t tail_place(const ElementGroup *group, int64_t place, int constant)
{
    return (place / LANES * group->geometry_size + group->point_count * GEOMETRY_POINT_SIZE + constant) * LANES +
           place % LANES;
}

double node_rates_own(const Builder *b, int number, int64_t place)
{
    double largest = 0.0;
    for (int which = 0; which < GEOMETRY_COUNT; which++) {
        const double *constants = b->constants[number * GEOMETRY_COUNT + which];
        if (constants) largest = fmax(largest, constants[tail_place(&b->model->groups[number], place, GEOMETRY_RATE)]);
    }
    return largest;
}

double node_rates_sum(const Builder *b, const unsigned char *implicit, NodeRates *rates)
{
    const Model *m = b->model;
    const int32_t *order = b->order;
    double largest = 0.0;
    for (int i = 0; i < m->node_count; i++) rates->mass[i] = rates->mass_rate[i] = 0.0;
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count) {
        if (m->groups[g].law == LAW_SURFACE) continue;
        for (int place = 0; place < m->groups[g].element_count; place++) {
            const ShellRecord *r = &b->records[order[place]];
            const bool left_out = implicit && implicit[order[place]];
            const double share = r->mass / r->corner_count, rate = left_out ? 0.0 : node_rates_own(b, g, place);
            for (int a = 0; a < r->corner_count; a++) {
                rates->mass[r->node[a]] += share;
                rates->mass_rate[r->node[a]] += share * rate;
            }
        }
    }
    for (int i = 0; i < m->node_count; i++)
        if (rates->mass[i] > 0.0) largest = fmax(largest, rates->mass_rate[i] / rates->mass[i]);
    return largest;
}

void node_rates_scale(Builder *b, int number, int64_t place, double share)
{
    const ElementGroup *group = &b->model->groups[number];
    for (int which = 0; which < GEOMETRY_COUNT; which++) {
        double *constants = b->constants[number * GEOMETRY_COUNT + which];
        if (!constants) continue;
        constants[tail_place(group, place, GEOMETRY_RATE)] *= share;
        constants[tail_place(group, place, GEOMETRY_STRESS_RATE)] *= share;
    }
}

/* Of one element: the largest mean over its nodes to its own squared frequency (eq. E20b). */
static double node_share(const ShellRecord *r, double own, const NodeRates *rates)
{
    double largest = 0.0;
    for (int a = 0; a < r->corner_count; a++)
        if (rates->mass[r->node[a]] > 0.0)
            largest = fmax(largest, rates->mass_rate[r->node[a]] / rates->mass[r->node[a]]);
    return own > 0.0 && largest > 0.0 ? largest / own : 1.0;
}

void build_node_shares(Builder *b, NodeRates *rates)
{
    const Model *m = b->model;
    node_rates_sum(b, b->implicit, rates);
    const int32_t *order = b->order;
    for (int g = 0; g < m->group_count; order += m->groups[g++].element_count) {
        if (m->groups[g].law == LAW_SURFACE) continue;
        for (int place = 0; place < m->groups[g].element_count; place++)
            if (!b->implicit || !b->implicit[order[place]])
                node_rates_scale(b, g, place,
                                 node_share(&b->records[order[place]], node_rates_own(b, g, place), rates));
    }
}

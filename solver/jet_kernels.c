/* The loops over the rows of corner sums that a jet pushes, for one instruction set (docs/theory.md, J12). Compiled
 * once per set, with BILLOW_JET_TABLE naming its table. A row is two vectors of four doubles: force and area vector. */
#include "elements/pack.h"
#include "solver/workspace.h"

/* Three components and one that is carried along: 0 in rows, the next node's in velocities. */
typedef double Vector __attribute__((vector_size(32), may_alias));
typedef double LooseVector __attribute__((vector_size(32), aligned(8), may_alias));

ALWAYS_INLINE double sum_of(Vector v)
{
    return v[0] + v[1] + v[2];
}

ALWAYS_INLINE Vector velocity_of(const JetRows *rows, int i)
{
    return *(const LooseVector *)(rows->v + 3 * (ptrdiff_t)rows->node[i]);
}

/* Pressures times the area vectors onto the rows, their power, and the force of the jet alone. */
static void push(const JetRows *rows, JetSums *sums)
{
    const JetWeight *weight = rows->weight;
    Vector force = {0}, power = {0}, *row = (Vector *)(void *)rows->row;
    for (int i = 0; i < rows->count; i++) {
        if (weight[i].shape == 0.0 && weight[i].hidden == 0.0) continue;
        Vector area = row[2 * i + 1], jet = (rows->strength * weight[i].shape) * area,
               all = jet + (rows->knock * weight[i].hidden) * area;
        row[2 * i] += all;
        force += jet;
        power += all * velocity_of(rows, i);
    }
    for (int k = 0; k < 3; k++) sums->force[k] = force[k];
    sums->before = sum_of(power);
}

/* Power of the same forces on other velocities: the area vectors are still in the rows. */
static double count(const JetRows *rows)
{
    const JetWeight *weight = rows->weight;
    Vector power = {0};
    const Vector *row = (const Vector *)(const void *)rows->row;
    for (int i = 0; i < rows->count; i++) {
        if (weight[i].shape == 0.0 && weight[i].hidden == 0.0) continue;
        double pressure = rows->strength * weight[i].shape + rows->knock * weight[i].hidden;
        power += pressure * row[2 * i + 1] * velocity_of(rows, i);
    }
    return sum_of(power);
}

const JetKernels BILLOW_JET_TABLE = {push, count};

/* Dampers in the step. Equations (K9) to (K11) of docs/theory.md. */
#include "solver/step_dampers.h"

#include <math.h>

#include "solver/vector3.h"

static const double REST[3] = {0.0, 0.0, 0.0};

/* Velocity of an end; what never moves, as the ground, has none. */
static const double *end_velocity(const Model *m, const Damper *damper, int end, const double *v)
{
    const int32_t node = damper->node[end];
    return node < 0 || node >= m->moving_count ? REST : v + 3 * (ptrdiff_t)node;
}

/* The pull, and the unit vector from the first end to the second; where they are at one place, along their motion. */
static double find_tension(const Model *m, const Damper *damper, const double *x, const double *v, double line[3])
{
    const double *far = damper->node[1] < 0 ? damper->ground : x + 3 * (ptrdiff_t)damper->node[1];
    double apart[3];
    vector3_subtract(far, x + 3 * (ptrdiff_t)damper->node[0], line);
    vector3_subtract(end_velocity(m, damper, 1, v), end_velocity(m, damper, 0, v), apart);
    if (!(vector3_normalize(line) > 0.0)) {
        for (int k = 0; k < 3; k++) line[k] = apart[k];
        vector3_normalize(line);
    }
    return damper_tension(damper, vector3_dot(line, apart));
}

void dampers_act(const Model *m, const double *x, const double *v, double *f)
{
    for (int i = 0; i < m->damper_count; i++) {
        const Damper *damper = &m->dampers[i];
        double line[3], tension = find_tension(m, damper, x, v, line);
        for (int end = 0; end < 2; end++) {
            const int32_t node = damper->node[end];
            if (node < 0 || node >= m->moving_count) continue;
            for (int k = 0; k < 3; k++) f[3 * (ptrdiff_t)node + k] += (end == 0 ? tension : -tension) * line[k];
        }
    }
}

double dampers_work(const Model *m, const double *x, const double *v_before, const double *v, double dt_mean)
{
    double work = 0.0;
    for (int i = 0; i < m->damper_count; i++) {
        const Damper *damper = &m->dampers[i];
        double line[3], apart = 0.0, tension = find_tension(m, damper, x, v_before, line);
        const double *before[2], *after[2];
        for (int end = 0; end < 2; end++) {
            before[end] = end_velocity(m, damper, end, v_before);
            after[end] = end_velocity(m, damper, end, v);
        }
        for (int k = 0; k < 3; k++)
            apart += 0.5 * line[k] * ((before[1][k] + after[1][k]) - (before[0][k] + after[0][k]));
        work += tension * apart * dt_mean;
    }
    return work;
}

double dampers_rate(const Model *m, double rate)
{
    double largest = 0.0;
    for (int i = 0; i < m->damper_count; i++) {
        const double own = damper_rate(&m->dampers[i]);
        if (own > largest) largest = own;
    }
    const double omega = largest + sqrt(largest * largest + rate);
    return largest > 0.0 ? omega * omega : rate;
}

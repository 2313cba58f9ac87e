/* Seams: pairs of nodes that move as one until they tear. */
#include "solver/seam.h"

#include <math.h>

#include "solver/elementary.h"
#include "solver/step_seams.h"
#include "solver/vector3.h"

static double share_of(double force, double limit, double exponent)
{
    return limit > 0.0 && force > 0.0 ? elementary_pow(force / limit, exponent) : 0.0;
}

bool seam_tears(const Seam *seam, const double force[3], const double x[3], const double y[3])
{
    double axis[3], across[3];
    vector3_subtract(y, x, axis);
    const double size = vector3_norm(force);
    double pull = size, shear = 0.0;
    if (vector3_normalize(axis) > 0.0) {
        pull = vector3_dot(force, axis);
        for (int k = 0; k < 3; k++) across[k] = force[k] - pull * axis[k];
        shear = vector3_norm(across);
    } else if (!(seam->normal > 0.0)) {
        pull = 0.0;
        shear = size;
    }
    return share_of(pull, seam->normal, seam->normal_exponent) + share_of(shear, seam->shear, seam->shear_exponent) >=
           1.0;
}

void seams_act(const Model *model, State *state, double dt_mean)
{
    for (int i = 0; i < model->seam_count; i++) {
        const Seam *seam = &model->seams[i];
        if (state->seam_torn[i] >= 0.0) continue;
        const ptrdiff_t a = seam->node[0], b = seam->node[1];
        double *v = state->v + 3 * a, *w = state->v + 3 * b, common[3], force[3];
        const double share = model->mass[a] / (model->mass[a] + model->mass[b]);
        for (int k = 0; k < 3; k++) {
            common[k] = share * v[k] + (1.0 - share) * w[k];
            force[k] = dt_mean > 0.0 ? model->mass[a] * (common[k] - v[k]) / dt_mean : 0.0;
        }
        if (state->clock->time >= seam->end || seam_tears(seam, force, state->x + 3 * a, state->x + 3 * b)) {
            state->seam_torn[i] = state->clock->time;
            continue;
        }
        for (int k = 0; k < 3; k++) v[k] = w[k] = common[k];
    }
}

/* Forces and moments on rigid bodies. Equations (M24) and (M25) of docs/theory.md. */
#include "solver/rigid_loads.h"

#include <stddef.h>
#include <string.h>

#include "solver/vector3.h"

/* Direction of a load that follows the plane of three nodes (M8); a collapsed triangle has none. */
static void follow_plane(const RigidLoad *load, const double *x, double direction[3])
{
    double along[3], across[3];
    const double *corner = x + 3 * (size_t)load->m[0];
    vector3_subtract(x + 3 * (size_t)load->m[1], corner, along);
    vector3_subtract(x + 3 * (size_t)load->m[2], corner, across);
    vector3_cross(along, across, direction);
    vector3_normalize(direction);
}

void rigid_loads_at(const RigidLoad *loads, int count, int body, const Curve *curves, double time, const double *x,
                    RigidWrench *wrench)
{
    *wrench = (RigidWrench){0};
    for (int k = 0; k < count; k++) {
        const RigidLoad *load = &loads[k];
        double direction[3], *sum = load->moment ? wrench->moment : wrench->force;
        if (load->body != body) continue;
        memcpy(direction, load->direction, sizeof direction);
        if (load->follower) follow_plane(load, x, direction);
        double size = load->scale * curve_value(&curves[load->curve], time);
        for (int i = 0; i < 3; i++) sum[i] += size * direction[i];
    }
}

double rigid_loads_work(const RigidWrench *wrench, const double v_before[3], const double v_after[3],
                        const double spin_before[3], const double spin_after[3], double dt_mean)
{
    double power = 0.0;
    for (int i = 0; i < 3; i++)
        power += 0.5 *
                 (wrench->force[i] * (v_before[i] + v_after[i]) + wrench->moment[i] * (spin_before[i] + spin_after[i]));
    return power * dt_mean;
}

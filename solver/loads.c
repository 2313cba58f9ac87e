/* Point loads, pressure on segments, gravity and mass damping. Equations (M8) to (M11) of docs/theory.md. */
#include "solver/loads.h"

#include <stddef.h>

#include "solver/vector3.h"

static double factor_at(int curve, const Curve *curves, double time)
{
    return curve < 0 ? 1 : curve_value(&curves[curve], time);
}

void loads_body_at(const BodyClass *body_class, const Curve *curves, double time, double g[3], double damping[6])
{
    for (int i = 0; i < 3; i++) g[i] = 0;
    for (int i = 0; i < 6; i++) damping[i] = 0;
    for (int k = 0; k < body_class->gravity_count; k++) {
        g[body_class->gravity[k].axis] +=
            body_class->gravity[k].scale * factor_at(body_class->gravity[k].curve, curves, time);
    }
    for (int k = 0; k < body_class->damping_count; k++) {
        double rate = body_class->damping[k].scale * factor_at(body_class->damping[k].curve, curves, time);
        for (int i = 0; i < 6; i++) damping[i] += rate * body_class->damping[k].factor[i];
    }
}

void loads_class_at(const BodyClass *body_class, const Curve *curves, double time, double g[3], double damping[3])
{
    double all[6];
    loads_body_at(body_class, curves, time, g, all);
    for (int i = 0; i < 3; i++) damping[i] = all[i];
}

/* Force of one point load at time. */
static void point_force(const NodeLoad *load, const Curve *curves, double time, const double *x, double force[3])
{
    double size = load->scale * curve_value(&curves[load->curve], time);
    double direction[3] = {load->direction[0], load->direction[1], load->direction[2]};
    if (load->follower) {
        double along[3], across[3];
        const double *corner = x + 3 * (size_t)load->m[0];
        vector3_subtract(x + 3 * (size_t)load->m[1], corner, along);
        vector3_subtract(x + 3 * (size_t)load->m[2], corner, across);
        vector3_cross(along, across, direction);
        vector3_normalize(direction); /* a collapsed triangle has no normal: no force */
    }
    for (int i = 0; i < 3; i++) force[i] = size * direction[i];
}

void loads_apply_points(const Loads *loads, const Curve *curves, double time, const double *x, double *f)
{
    for (int k = 0; k < loads->node_load_count; k++) {
        double force[3];
        point_force(&loads->node_loads[k], curves, time, x, force);
        for (int i = 0; i < 3; i++) f[3 * (size_t)loads->node_loads[k].node + (size_t)i] += force[i];
    }
}

double loads_points_work(const Loads *loads, const Curve *curves, double time, const double *x, const double *v_before,
                         const double *v, double dt_mean)
{
    double work = 0;
    for (int k = 0; k < loads->node_load_count; k++) {
        double force[3];
        size_t n = 3 * (size_t)loads->node_loads[k].node;
        point_force(&loads->node_loads[k], curves, time, x, force);
        for (size_t i = 0; i < 3; i++) work += 0.5 * force[i] * (v_before[n + i] + v[n + i]) * dt_mean;
    }
    return work;
}

double loads_segment_pressure(const SegmentLoad *load, const Curve *curves, double time)
{
    if (time < load->arrival) return 0;
    return load->scale * curve_value(&curves[load->curve], time - load->arrival);
}

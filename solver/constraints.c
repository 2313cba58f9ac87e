/* Supports, prescribed motion and hanging nodes. Equations (M1) to (M7) of docs/theory.md. */
#include "solver/constraints.h"

#include <stddef.h>

#include "solver/rate_rows.h"
#include "solver/vector3.h"

void constraints_fold_forces(const Constraints *constraints, double *f)
{
    for (int h = constraints->hanging_count; h-- > 0;) {
        const HangingNode *hanging = &constraints->hanging[h];
        double *slave = f + 3 * (size_t)hanging->node;
        for (int end = 0; end < 2; end++) {
            double *master = f + 3 * (size_t)hanging->end[end];
            for (int i = 0; i < 3; i++) master[i] += 0.5 * slave[i];
        }
        slave[0] = slave[1] = slave[2] = 0;
    }
}

void constraints_fold_mass(const Constraints *constraints, double *mass)
{
    for (int h = constraints->hanging_count; h-- > 0;) {
        const HangingNode *hanging = &constraints->hanging[h];
        for (int end = 0; end < 2; end++) mass[hanging->end[end]] += 0.5 * mass[hanging->node];
        mass[hanging->node] = 0;
    }
}

void constraints_place_hanging(const Constraints *constraints, double *v)
{
    for (int h = 0; h < constraints->hanging_count; h++) {
        const HangingNode *hanging = &constraints->hanging[h];
        const double *a = v + 3 * (size_t)hanging->end[0], *b = v + 3 * (size_t)hanging->end[1];
        double *slave = v + 3 * (size_t)hanging->node;
        for (int i = 0; i < 3; i++) slave[i] = 0.5 * (a[i] + b[i]);
    }
}

bool constraints_motion_rate(const PrescribedMotion *motion, const Curve *curves, double time, double dt_mean,
                             double dt_next, double before, double path, double *rate)
{
    if (!(time >= motion->birth && time < motion->death)) return false;
    const Curve *curve = &curves[motion->curve];
    double from = time - motion->birth, to = from + dt_next;
    if (motion->vad == 0) { /* (M2): the mean of the curve over the step, so that positions are its exact integral */
        *rate = motion->scale * curve_integral(curve, from, to) / dt_next;
    } else if (motion->vad == 1) { /* (M3) */
        double dt_before = 2 * dt_mean - dt_next;
        *rate = before + motion->scale * curve_integral(curve, from - 0.5 * dt_before, from + 0.5 * dt_next);
    } else { /* (M4): displacement from the start; counted from the birth where that comes later, and for angles */
        double reached = path;
        if (motion->rotation || motion->birth > 0) reached = motion->scale * curve_value(curve, from);
        *rate = (motion->scale * curve_value(curve, to) - reached) / dt_next;
    }
    return true;
}

static void add_support(RateRows *rows, const Support *support)
{
    for (int i = 0; i < 3; i++) {
        if (support->fixed[i]) rate_rows_add(rows, support->axes + 3 * i, 0);
    }
}

static bool support_active(const Support *support, double time)
{
    return time >= support->birth && time < support->death;
}

/* What the node's active motions ask for; those that fix the other components come last. */
static void add_motions(RateRows *rows, const PrescribedMotion *motions, int count, const Curve *curves, double time,
                        double dt_mean, double dt_next, const double *x, const double *initial, const double *v_before)
{
    for (int m = 0; m < count; m++) {
        const PrescribedMotion *motion = &motions[m];
        size_t node = 3 * (size_t)motion->node;
        double moved[3], rate;
        vector3_subtract(x + node, initial + node, moved);
        if (constraints_motion_rate(motion, curves, time, dt_mean, dt_next,
                                    vector3_dot(motion->direction, v_before + node),
                                    vector3_dot(motion->direction, moved), &rate)) {
            rate_rows_add(rows, motion->direction, rate);
        }
    }
    for (int m = 0; m < count; m++) {
        const PrescribedMotion *motion = &motions[m];
        if (!motion->only_direction || !(time >= motion->birth && time < motion->death)) continue;
        RateRows line = {0};
        double across[9];
        rate_rows_add(&line, motion->direction, 0);
        rate_rows_complement(&line, across);
        for (int k = 0; k < 2; k++) rate_rows_add(rows, across + 3 * k, 0);
    }
}

void constraints_apply(const Constraints *constraints, const Curve *curves, double time, double dt_mean, double dt_next,
                       const double *x, const double *initial, const double *mass, const double *v_before, double *v,
                       double *work)
{
    int s = 0, m = 0;
    double done = 0;
    while (s < constraints->support_count || m < constraints->node_motion_count) {
        int32_t support_node = s < constraints->support_count ? constraints->supports[s].node : INT32_MAX;
        int32_t motion_node = m < constraints->node_motion_count ? constraints->motions[m].node : INT32_MAX;
        int32_t node = support_node < motion_node ? support_node : motion_node;
        size_t n = 3 * (size_t)node;
        RateRows rows = {0};
        int first_motion = m;
        while (m < constraints->node_motion_count && constraints->motions[m].node == node) m++;
        add_motions(&rows, constraints->motions + first_motion, m - first_motion, curves, time, dt_mean, dt_next, x,
                    initial, v_before);
        for (; s < constraints->support_count && constraints->supports[s].node == node; s++) {
            if (support_active(&constraints->supports[s], time)) add_support(&rows, &constraints->supports[s]);
        }
        double free_v[3] = {v[n], v[n + 1], v[n + 2]};
        rate_rows_apply(&rows, v + n);
        for (int i = 0; i < 3; i++) { /* (M5) */
            done += 0.5 * mass[node] * (v[n + (size_t)i] - free_v[i]) * (v_before[n + (size_t)i] + v[n + (size_t)i]);
        }
    }
    if (work) *work += done;
}

/* The first support of the node or of a later one. */
static int first_support(const Constraints *constraints, int32_t node)
{
    int low = 0, high = constraints->support_count;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (constraints->supports[middle].node < node)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static int first_motion(const Constraints *constraints, int32_t node)
{
    int low = 0, high = constraints->node_motion_count;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (constraints->motions[middle].node < node)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void constraints_held(const Constraints *constraints, int32_t node, double time, RateRows *rows)
{
    for (int m = first_motion(constraints, node); m < constraints->node_motion_count; m++) {
        const PrescribedMotion *motion = &constraints->motions[m];
        if (motion->node != node) break;
        if (!(time >= motion->birth && time < motion->death)) continue;
        rate_rows_add(rows, motion->direction, 0);
        if (!motion->only_direction) continue;
        static const double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        for (int k = 0; k < 3; k++) rate_rows_add(rows, axes + 3 * k, 0);
    }
    for (int s = first_support(constraints, node); s < constraints->support_count; s++) {
        if (constraints->supports[s].node != node) break;
        if (support_active(&constraints->supports[s], time)) add_support(rows, &constraints->supports[s]);
    }
}

void constraints_start(const Constraints *constraints, double *v)
{
    for (int s = 0; s < constraints->support_count;) {
        int32_t node = constraints->supports[s].node;
        RateRows rows = {0};
        for (; s < constraints->support_count && constraints->supports[s].node == node; s++) {
            if (support_active(&constraints->supports[s], 0)) add_support(&rows, &constraints->supports[s]);
        }
        rate_rows_apply(&rows, v + 3 * (size_t)node);
    }
    constraints_place_hanging(constraints, v);
}

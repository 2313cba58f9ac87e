/* The node pass: corner forces and pressures to accelerations, velocities, positions (docs/theory.md, Time integration). */
#include "solver/workspace.h"

enum { LANES = BILLOW_LANES };

/* Stress forces f and area vector s of one node: sums over its corners in element order. */
static inline void gather_node(const Workspace *w, int node, double f[3], double s[3])
{
    const Model *m = w->model;
    double fx = 0.0, fy = 0.0, fz = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
    for (int32_t k = m->corner_start[node]; k < m->corner_start[node + 1]; k++) {
        const double *c = w->corner + m->corner_list[k];
        fx += c[0 * LANES];
        fy += c[1 * LANES];
        fz += c[2 * LANES];
        sx += c[3 * LANES];
        sy += c[4 * LANES];
        sz += c[5 * LANES];
    }
    f[0] = fx;
    f[1] = fy;
    f[2] = fz;
    s[0] = sx;
    s[1] = sy;
    s[2] = sz;
}

/* Full-step values of a node for the writers: v_n = v_{n-1/2} + a dt_before / 2 (eq. T3). */
static inline void keep_view(Workspace *w, int node, const double *a, const double *v_full, const double *f)
{
    for (int k = 0; k < 3; k++) {
        w->acceleration[3 * node + k] = a[k];
        w->velocity[3 * node + k] = v_full[k];
        w->force[3 * node + k] = f[k];
    }
}

/* v_{n+1/2} = v_{n-1/2} + a dt_mean, x_{n+1} = x_n + v_{n+1/2} dt_next (eq. T1, T2). */
static void lean_chunk(Workspace *w, int first, int end, NodeSums *sums)
{
    const Model *m = w->model;
    const CyclePlan plan = w->plan;
    double *x = w->state->x, *v = w->state->v;
    NodeSums t = {0};
    double half_before = 0.5 * plan.dt_before, advance = plan.emit ? 0.0 : plan.dt_next;
    for (int node = first; node < end; node++) {
        double f[3], s[3], a[3], full[3], before = 0.0, after = 0.0, square = 0.0;
        gather_node(w, node, f, s);
        int set = m->node_pressure[node];
        double bag = set < 0 ? 0.0 : w->bag_pressure[set], load = set < 0 ? 0.0 : w->load_pressure[set];
        double pressure = bag + load, inverse = m->inverse_mass[node];
        double *vn = v + 3 * (ptrdiff_t)node, *xn = x + 3 * (ptrdiff_t)node;
        for (int k = 0; k < 3; k++) {
            f[k] += pressure * s[k];
            a[k] = f[k] * inverse;
            before += s[k] * vn[k];
            full[k] = vn[k] + half_before * a[k];
            vn[k] += a[k] * plan.dt_mean;
            after += s[k] * vn[k];
            xn[k] += advance * vn[k];
            square += full[k] * full[k];
        }
        t.kinetic += 0.5 * m->mass[node] * square;
        t.bag_before += bag * before;
        t.bag_after += bag * after;
        t.load_before += load * before;
        t.load_after += load * after;
        t.compliance += (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) * inverse;
        if (plan.emit) keep_view(w, node, a, full, f);
    }
    *sums = t;
}

/* The same with body acceleration and mass damping by node class, and stagnation pressure. Damping is taken at the mean
 * velocity: v+ (1 + D dt/2) = v- (1 - D dt/2) + D dt v_ref + a dt, stable for any D (eq. T4). */
static void general_chunk(Workspace *w, int first, int end, NodeSums *sums)
{
    const Model *m = w->model;
    const CyclePlan plan = w->plan;
    double *x = w->state->x, *v = w->state->v;
    NodeSums t = {0};
    double advance = plan.emit ? 0.0 : plan.dt_next;
    for (int node = first; node < end; node++) {
        double f[3], s[3], a[3], full[3], before = 0.0, after = 0.0, square = 0.0, through = 0.0;
        gather_node(w, node, f, s);
        int set = m->node_pressure[node], class = m->node_class ? m->node_class[node] : 0;
        double bag = set < 0 ? 0.0 : w->bag_pressure[set], load = set < 0 ? 0.0 : w->load_pressure[set];
        double inverse = m->inverse_mass[node], mass = m->mass[node];
        const double *gravity = w->class_gravity + 3 * class, *damping = w->class_damping + 3 * class,
                     *reference = w->class_velocity + 3 * class;
        double *vn = v + 3 * (ptrdiff_t)node, *xn = x + 3 * (ptrdiff_t)node;
        double area2 = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        double normal = s[0] * vn[0] + s[1] * vn[1] + s[2] * vn[2];
        double stagnation =
            set < 0 || area2 == 0.0 ? 0.0 : -w->stagnation[set] * normal * (normal < 0.0 ? -normal : normal) / area2;
        for (int k = 0; k < 3; k++) {
            double stress = f[k], old = vn[k], d = damping[k] * plan.dt_mean;
            f[k] = stress + (bag + load + stagnation) * s[k];
            double force = f[k] * inverse + gravity[k];
            vn[k] = (old * (1.0 - 0.5 * d) + d * reference[k] + force * plan.dt_mean) / (1.0 + 0.5 * d);
            double mean = 0.5 * (old + vn[k]);
            double drag = damping[k] * (mean - reference[k]);
            a[k] = force - drag;
            full[k] = old + 0.5 * plan.dt_before * a[k];
            before += s[k] * old;
            after += s[k] * vn[k];
            t.load_before += mass * gravity[k] * old;
            t.load_after += mass * gravity[k] * vn[k];
            t.damping += mass * drag * mean * plan.dt_mean;
            through += s[k] * mean;
            xn[k] += advance * vn[k];
            square += full[k] * full[k];
        }
        t.damping -= stagnation * through * plan.dt_mean;
        t.kinetic += 0.5 * mass * square;
        t.bag_before += bag * before;
        t.bag_after += bag * after;
        t.load_before += load * before;
        t.load_after += load * after;
        t.compliance += area2 * inverse;
        if (plan.emit) keep_view(w, node, a, full, f);
    }
    *sums = t;
}

void step_nodes(Workspace *w, int thread, int threads)
{
    int chunks = w->node_chunk_count;
    int first = (int)((int64_t)chunks * thread / threads), end = (int)((int64_t)chunks * (thread + 1) / threads);
    for (int c = first; c < end; c++) {
        int from = c * BILLOW_NODE_CHUNK, to = from + BILLOW_NODE_CHUNK;
        if (to > w->model->free_count) to = w->model->free_count;
        if (w->general)
            general_chunk(w, from, to, &w->node_sums[c]);
        else
            lean_chunk(w, from, to, &w->node_sums[c]);
    }
}

void step_advance_positions(Workspace *w, int thread, int threads)
{
    int64_t values = 3 * (int64_t)w->model->moving_count;
    int64_t first = values * thread / threads, end = values * (thread + 1) / threads;
    double dt = w->plan.dt_next, *x = w->state->x;
    const double *v = w->state->v;
    for (int64_t i = first; i < end; i++) x[i] += dt * v[i];
}

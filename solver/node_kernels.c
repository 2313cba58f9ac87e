/* The node loops for one instruction set: corner forces and pressures to accelerations, velocities, positions
 * (docs/theory.md, Time integration). Compiled once per set, with BILLOW_NODE_TABLE naming its table. */
#include <string.h>

#include "solver/workspace.h"

/* Three components and one that is carried along unused: its load may reach into the next node's values, so the arrays
 * end with room for it, and it never enters a sum. */
typedef double Vector __attribute__((vector_size(32)));
typedef double LooseVector __attribute__((vector_size(32), aligned(8), may_alias));

static inline Vector load3(const double *p)
{
    return *(const LooseVector *)p;
}

static inline void store3(double *p, Vector v)
{
    memcpy(p, &v, 3 * sizeof *p);
}

static inline double sum3(Vector v)
{
    return v[0] + v[1] + v[2];
}

/* Stress forces f and area vector s of one node: sums over its corners in element order. */
static inline void gather_node(const Workspace *w, int node, Vector *f, Vector *s)
{
    const Model *m = w->model;
    const double *corner = w->corner;
    const CornerPlace *end = m->corner_list + m->corner_start[node + 1];
    Vector force = {0}, area = {0};
    for (const CornerPlace *place = m->corner_list + m->corner_start[node]; place < end; place++) {
        force += load3(corner + place->force);
        area += load3(corner + place->share);
    }
    *f = force;
    *s = area;
}

/* Full-step values of a node for the writers: v_n = v_{n-1/2} + a dt_before / 2 (eq. T3). */
static inline void keep_view(Workspace *w, int node, Vector a, Vector v_full, Vector f)
{
    store3(w->acceleration + 3 * (ptrdiff_t)node, a);
    store3(w->velocity + 3 * (ptrdiff_t)node, v_full);
    store3(w->force + 3 * (ptrdiff_t)node, f);
}

/* v_{n+1/2} = v_{n-1/2} + a dt_mean, x_{n+1} = x_n + v_{n+1/2} dt_next (eq. T1, T2). */
static void lean_chunk(Workspace *w, int first, int end, NodeSums *sums)
{
    const Model *m = w->model;
    const CyclePlan plan = w->plan;
    double *x = w->state->x, *v = w->state->v;
    double half_before = 0.5 * plan.dt_before, advance = plan.emit ? 0.0 : plan.dt_next;
    Vector bag_before = {0}, bag_after = {0}, load_before = {0}, load_after = {0}, kinetic = {0}, steps = {0},
           compliance = {0};
    for (int node = first; node < end; node++) {
        Vector f, s;
        gather_node(w, node, &f, &s);
        int set = m->node_pressure[node];
        double bag = w->bag_pressure[set], load = w->load_pressure[set], inverse = m->inverse_mass[node];
        double *vn = v + 3 * (ptrdiff_t)node, *xn = x + 3 * (ptrdiff_t)node;
        Vector old = load3(vn);
        f += (bag + load) * s;
        Vector a = f * inverse, full = old + half_before * a, now = old + plan.dt_mean * a;
        store3(vn, now);
        store3(xn, load3(xn) + advance * now);
        Vector before = s * old, after = s * now;
        bag_before += bag * before;
        bag_after += bag * after;
        load_before += load * before;
        load_after += load * after;
        kinetic += (0.5 * m->mass[node]) * (full * full);
        steps += (0.5 * m->mass[node]) * (old * now);
        compliance += inverse * (s * s);
        if (plan.emit) keep_view(w, node, a, full, f);
    }
    *sums = (NodeSums){.kinetic = sum3(kinetic),
                       .kinetic_steps = sum3(steps),
                       .bag_before = sum3(bag_before),
                       .bag_after = sum3(bag_after),
                       .load_before = sum3(load_before),
                       .load_after = sum3(load_after),
                       .compliance = sum3(compliance)};
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
        Vector f, s;
        gather_node(w, node, &f, &s);
        int set = m->node_pressure[node], class = m->node_class ? m->node_class[node] : 0;
        double bag = w->bag_pressure[set], load = w->load_pressure[set];
        double inverse = m->inverse_mass[node], mass = m->mass[node];
        double *vn = v + 3 * (ptrdiff_t)node, *xn = x + 3 * (ptrdiff_t)node;
        Vector gravity = load3(w->class_gravity + 3 * class), damping = load3(w->class_damping + 3 * class),
               reference = load3(w->class_velocity + 3 * class), old = load3(vn);
        double area2 = sum3(s * s), normal = sum3(s * old);
        double stagnation =
            area2 == 0.0 ? 0.0 : -w->stagnation[set] * normal * (normal < 0.0 ? -normal : normal) / area2;
        f += (bag + load + stagnation) * s;
        Vector force = f * inverse + gravity, d = damping * plan.dt_mean;
        Vector now = (old * (1.0 - 0.5 * d) + d * reference + force * plan.dt_mean) / (1.0 + 0.5 * d);
        Vector mean = 0.5 * (old + now), drag = damping * (mean - reference), a = force - drag;
        Vector full = old + (0.5 * plan.dt_before) * a;
        store3(vn, now);
        store3(xn, load3(xn) + advance * now);
        t.bag_before += bag * normal;
        t.bag_after += bag * sum3(s * now);
        t.load_before += load * normal + mass * sum3(gravity * old);
        t.load_after += load * sum3(s * now) + mass * sum3(gravity * now);
        t.damping += (mass * sum3(drag * mean) - stagnation * sum3(s * mean)) * plan.dt_mean;
        t.kinetic += 0.5 * mass * sum3(full * full);
        t.kinetic_steps += 0.5 * mass * sum3(old * now);
        t.compliance += area2 * inverse;
        if (plan.emit) keep_view(w, node, a, full, f);
    }
    *sums = t;
}

const NodeKernels BILLOW_NODE_TABLE = {lean_chunk, general_chunk};

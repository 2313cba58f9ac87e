/* The node loops for one instruction set: corner forces and pressures to accelerations, velocities, positions
 * (docs/theory.md, Time integration). Compiled once per set, with BILLOW_NODE_TABLE naming its table.
 *
 * A chunk of nodes goes in two passes: the rows of corner sums of each node are added up, then all components x y z x y
 * z ... of the chunk are integrated in packs. Sums over nodes run over component j of the chunk into partial sum j mod
 * 8, so that every instruction set gives the same bits. */
#include <string.h>

#include "elements/pack.h"
#include "solver/workspace.h"

enum { COMPONENTS = 3 * BILLOW_NODE_CHUNK, SUM_WIDTH = 8, SUM_PACKS = SUM_WIDTH / PACK_WIDTH };

/* Three components and one that is carried along unused: its load may reach into the next node's values, so the arrays
 * end with room for it. */
typedef double Vector __attribute__((vector_size(32)));
typedef double LooseVector __attribute__((vector_size(32), aligned(8), may_alias));
typedef double LoosePack __attribute__((vector_size(8 * PACK_WIDTH), aligned(8), may_alias));

/* Partial sums over components; the members of NodeSums of the same name, without their factors. */
typedef struct ComponentSums {
    Pack before[SUM_PACKS], after[SUM_PACKS];           /* s.v- and s.v+ under one pressure */
    Pack bag_before[SUM_PACKS], bag_after[SUM_PACKS];   /* p s.v- and p s.v+ under several */
    Pack load_before[SUM_PACKS], load_after[SUM_PACKS]; /* loads and gravity likewise */
    Pack kinetic[SUM_PACKS], steps[SUM_PACKS], compliance[SUM_PACKS], damping[SUM_PACKS];
} ComponentSums;

/* One chunk between its passes: sums over corners, and per node what is not the same for the whole chunk. */
typedef struct NodeChunk {
    int first, count; /* nodes */
    double force[COMPONENTS + SUM_WIDTH], area[COMPONENTS + SUM_WIDTH];
    double bag[BILLOW_NODE_CHUNK + SUM_WIDTH], load[BILLOW_NODE_CHUNK + SUM_WIDTH]; /* pressures */
    double inverse[BILLOW_NODE_CHUNK + SUM_WIDTH], mass[BILLOW_NODE_CHUNK + SUM_WIDTH];
    double stagnation[BILLOW_NODE_CHUNK + SUM_WIDTH]; /* pressure against the motion */
    double gravity[COMPONENTS + SUM_WIDTH], damping[COMPONENTS + SUM_WIDTH], reference[COMPONENTS + SUM_WIDTH];
} NodeChunk;

/* Which terms a loop has: constants of each, so that it has no branch. */
enum {
    SEVERAL_PRESSURES = 1, /* nodes of the chunk are under different pressure sets */
    BODY_TERMS = 2,        /* gravity, mass damping, stagnation pressure, node by node */
    BODY_UNIFORM = 4,      /* gravity and mass damping, the same for all nodes of the chunk */
};

ALWAYS_INLINE double total(const Pack part[SUM_PACKS])
{
    double lane[SUM_WIDTH];
    for (int i = 0; i < SUM_WIDTH; i++) lane[i] = part[i / PACK_WIDTH][i % PACK_WIDTH];
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

/* Stress forces f and area vectors s: the rows of each node in the order of the segments. */
ALWAYS_INLINE void gather_rows(const Workspace *w, NodeChunk *chunk)
{
    const Model *m = w->model;
    const int32_t *row = m->node_row + m->node_row_start[chunk->first], *start = m->node_row_start + chunk->first;
    for (int i = 0; i < chunk->count; i++) {
        const int32_t *end = m->node_row + start[i + 1];
        Vector force = {0}, area = {0};
        for (; row < end; row++) {
            const Vector *sums = (const Vector *)(const void *)(w->rows + ROW_SIZE * (ptrdiff_t)*row);
            force += sums[0];
            area += sums[1];
        }
        *(LooseVector *)(chunk->force + 3 * i) = force;
        *(LooseVector *)(chunk->area + 3 * i) = area;
    }
}

/* The terms of each node that the packs need per component. Stagnation pressure -q |s.v| s.v / s.s is against v-. */
static void fill_terms(const Workspace *w, NodeChunk *chunk, int terms)
{
    const Model *m = w->model;
    for (int i = 0; i < chunk->count; i++) {
        int node = chunk->first + i, set = m->node_pressure[node];
        chunk->bag[i] = w->bag_pressure[set];
        chunk->load[i] = w->load_pressure[set];
        if (!(terms & BODY_TERMS)) continue;
        if (m->has_fluid && set < m->pressure_set_count)
            chunk->bag[i] += step_hydrostatic(w, set, w->state->x + 3 * (ptrdiff_t)node);
        int class = m->node_class ? m->node_class[node] : 0;
        const double *s = chunk->area + 3 * i, *v = w->state->v + 3 * (ptrdiff_t)node;
        double square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2], normal = s[0] * v[0] + s[1] * v[1] + s[2] * v[2];
        chunk->stagnation[i] =
            square == 0.0 ? 0.0 : -w->stagnation[set] * normal * (normal < 0.0 ? -normal : normal) / square;
        memcpy(chunk->gravity + 3 * i, w->class_gravity + 3 * class, 3 * sizeof(double));
        memcpy(chunk->damping + 3 * i, w->class_damping + 3 * class, 3 * sizeof(double));
        memcpy(chunk->reference + 3 * i, w->class_velocity + 3 * class, 3 * sizeof(double));
    }
    /* the empty lanes of the last pack: sums weight them with no mass and no area, and 0 x NaN is NaN */
    int left = (PACK_WIDTH - chunk->count % PACK_WIDTH) % PACK_WIDTH;
    double *per_node[] = {chunk->bag, chunk->load, chunk->stagnation};
    double *per_component[] = {chunk->gravity, chunk->damping, chunk->reference};
    for (int k = 0; k < 3; k++) {
        memset(per_node[k] + chunk->count, 0, (size_t)left * sizeof(double));
        memset(per_component[k] + 3 * chunk->count, 0, 3 * (size_t)left * sizeof(double));
    }
}

/* Values of PACK_WIDTH nodes to three packs of their components. */
ALWAYS_INLINE void spread(Pack value, Pack out[3])
{
#if BILLOW_KERNEL_LEVEL >= 4
    out[0] = __builtin_shufflevector(value, value, 0, 0, 0, 1, 1, 1, 2, 2);
    out[1] = __builtin_shufflevector(value, value, 2, 3, 3, 3, 4, 4, 4, 5);
    out[2] = __builtin_shufflevector(value, value, 5, 5, 6, 6, 6, 7, 7, 7);
#elif BILLOW_KERNEL_LEVEL == 3
    out[0] = __builtin_shufflevector(value, value, 0, 0, 0, 1);
    out[1] = __builtin_shufflevector(value, value, 1, 1, 2, 2);
    out[2] = __builtin_shufflevector(value, value, 2, 3, 3, 3);
#else
    out[0] = __builtin_shufflevector(value, value, 0, 0);
    out[1] = __builtin_shufflevector(value, value, 0, 1);
    out[2] = __builtin_shufflevector(value, value, 1, 1);
#endif
}

ALWAYS_INLINE Pack loose_load(const double *from)
{
    return *(const LoosePack *)from;
}

/* Where a pack of components is read and written: the State's arrays, or the tail's copies. */
typedef struct ComponentPlace {
    double *x, *v;
    double *acceleration, *full, *force; /* full-step view, NULL unless this cycle emits */
} ComponentPlace;

/* Full-step values for the writers: v_n = v_{n-1/2} + a dt_before / 2 (eq. T3). */
ALWAYS_INLINE void keep_view(const ComponentPlace *at, Pack a, Pack full, Pack f)
{
    *(LoosePack *)at->acceleration = a;
    *(LoosePack *)at->full = full;
    *(LoosePack *)at->force = f;
}

/* PACK_WIDTH components, the j-th of the chunk first: v_{n+1/2} = v_{n-1/2} + a dt_mean, x_{n+1} = x_n + v_{n+1/2}
 * dt_next (eq. T1, T2). bag, load, stagnation, inverse, mass: of the components' nodes. */
typedef struct NodeTerms {
    Pack bag[3], load[3], stagnation[3], inverse[3], mass[3];
    Pack gravity[3], damping[3], reference[3]; /* of a uniform chunk */
    bool damped;
} NodeTerms;

/* What a component gets beside stress and pressure. */
typedef struct BodyTerms {
    Pack gravity, damping, reference, stagnation;
} BodyTerms;

ALWAYS_INLINE BodyTerms body_terms(int terms, const NodeChunk *chunk, const NodeTerms *of, int third, int j)
{
    if (terms & BODY_UNIFORM) {
        BodyTerms uniform = {of->gravity[third], of->damping[third], of->reference[third], pack_of(0.0)};
        return uniform;
    }
    BodyTerms own = {loose_load(chunk->gravity + j), loose_load(chunk->damping + j), loose_load(chunk->reference + j),
                     of->stagnation[third]};
    return own;
}

ALWAYS_INLINE void integrate_pack(int terms, const CyclePlan *plan, const NodeChunk *chunk, const NodeTerms *of,
                                  int third, int j, const ComponentPlace *at, ComponentSums *sums)
{
    int lane = j / PACK_WIDTH % SUM_PACKS;
    Pack s = loose_load(chunk->area + j), old = loose_load(at->v), inverse = of->inverse[third], now, a;
    Pack bag = of->bag[third], load = of->load[third], f = loose_load(chunk->force + j) + (bag + load) * s;
    Pack mass = of->mass[third];
    if (terms & (BODY_TERMS | BODY_UNIFORM)) {
        const BodyTerms body = body_terms(terms, chunk, of, third, j);
        if (terms & BODY_TERMS) f += body.stagnation * s;
        Pack pushed = f * inverse + body.gravity;
        if (terms & BODY_TERMS || of->damped) {
            /* damping at the mean velocity: v+ (1 + D dt/2) = v- (1 - D dt/2) + D dt v_ref + a dt (eq. T4), stable for
             * any D */
            Pack d = body.damping * plan->dt_mean;
            now = (old * (1.0 - 0.5 * d) + d * body.reference + pushed * plan->dt_mean) / (1.0 + 0.5 * d);
            Pack mean = 0.5 * (old + now), drag = body.damping * (mean - body.reference);
            a = pushed - drag;
            sums->damping[lane] += mass * (drag * mean) - body.stagnation * (s * mean);
        } else {
            a = pushed;
            now = old + pushed * plan->dt_mean;
        }
        sums->load_before[lane] += mass * (body.gravity * old);
        sums->load_after[lane] += mass * (body.gravity * now);
    } else {
        a = f * inverse;
        now = old + plan->dt_mean * a;
    }
    Pack full = old + (0.5 * plan->dt_before) * a;
    *(LoosePack *)at->v = now;
    *(LoosePack *)at->x = loose_load(at->x) + plan->node_advance * now;
    if (terms & SEVERAL_PRESSURES) {
        sums->bag_before[lane] += bag * (s * old);
        sums->bag_after[lane] += bag * (s * now);
        sums->load_before[lane] += load * (s * old);
        sums->load_after[lane] += load * (s * now);
    } else {
        sums->before[lane] += s * old;
        sums->after[lane] += s * now;
    }
    sums->kinetic[lane] += mass * (full * full);
    sums->steps[lane] += mass * (old * now);
    sums->compliance[lane] += inverse * (s * s);
    if (at->acceleration) keep_view(at, a, full, f);
}

/* The terms of PACK_WIDTH nodes from the i-th of the chunk on. */
ALWAYS_INLINE void spread_terms(int terms, const NodeChunk *chunk, const double *inverse, const double *mass, int i,
                                NodeTerms *of)
{
    spread(loose_load(inverse), of->inverse);
    spread(loose_load(mass), of->mass);
    if (terms & BODY_TERMS) spread(loose_load(chunk->stagnation + i), of->stagnation);
    if (!(terms & SEVERAL_PRESSURES)) return;
    spread(loose_load(chunk->bag + i), of->bag);
    spread(loose_load(chunk->load + i), of->load);
}

ALWAYS_INLINE ComponentPlace find_place(Workspace *w, ptrdiff_t component)
{
    ComponentPlace at = {w->state->x + component, w->state->v + component, NULL, NULL, NULL};
    if (w->plan.emit) {
        at.acceleration = w->acceleration + component;
        at.full = w->velocity + component;
        at.force = w->force + component;
    }
    return at;
}

/* The last nodes of a chunk, fewer than a pack: on copies, whose empty lanes have neither mass nor area. */
ALWAYS_INLINE void integrate_tail(int terms, Workspace *w, NodeChunk *chunk, int i, NodeTerms *of, ComponentSums *sums)
{
    enum { TAIL = 3 * PACK_WIDTH };
    double copy[5][TAIL] = {{0}}, inverse[PACK_WIDTH] = {0}, mass[PACK_WIDTH] = {0};
    int left = chunk->count - i;
    size_t size = 3 * (size_t)left * sizeof(double);
    ComponentPlace home = find_place(w, 3 * ((ptrdiff_t)chunk->first + i));
    memcpy(copy[0], home.x, size);
    memcpy(copy[1], home.v, size);
    memcpy(inverse, w->model->inverse_mass + chunk->first + i, (size_t)left * sizeof(double));
    memcpy(mass, w->model->mass + chunk->first + i, (size_t)left * sizeof(double));
    size_t empty = (size_t)(3 * i + TAIL - 3 * chunk->count) * sizeof(double);
    memset(chunk->force + 3 * chunk->count, 0, empty);
    memset(chunk->area + 3 * chunk->count, 0, empty);
    spread_terms(terms, chunk, inverse, mass, i, of);
    for (int third = 0; third < 3; third++) {
        int at = third * PACK_WIDTH;
        ComponentPlace place = {copy[0] + at, copy[1] + at, NULL, NULL, NULL};
        if (home.acceleration) {
            place.acceleration = copy[2] + at;
            place.full = copy[3] + at;
            place.force = copy[4] + at;
        }
        integrate_pack(terms, &w->plan, chunk, of, third, 3 * i + at, &place, sums);
    }
    memcpy(home.x, copy[0], size);
    memcpy(home.v, copy[1], size);
    if (!home.acceleration) return;
    memcpy(home.acceleration, copy[2], size);
    memcpy(home.full, copy[3], size);
    memcpy(home.force, copy[4], size);
}

ALWAYS_INLINE void finish_sums(int terms, const Workspace *w, int set, const ComponentSums *sums, NodeSums *out)
{
    *out = (NodeSums){.kinetic = 0.5 * total(sums->kinetic),
                      .kinetic_steps = 0.5 * total(sums->steps),
                      .compliance = total(sums->compliance),
                      .damping = total(sums->damping) * w->plan.dt_mean,
                      .load_before = total(sums->load_before),
                      .load_after = total(sums->load_after)};
    double before = total(sums->before), after = total(sums->after);
    out->bag_before = terms & SEVERAL_PRESSURES ? total(sums->bag_before) : w->bag_pressure[set] * before;
    out->bag_after = terms & SEVERAL_PRESSURES ? total(sums->bag_after) : w->bag_pressure[set] * after;
    if (terms & SEVERAL_PRESSURES) return;
    out->load_before += w->load_pressure[set] * before;
    out->load_after += w->load_pressure[set] * after;
}

/* The class of a uniform chunk in the order of its components: x y z x y z ... */
static void fill_uniform(const Workspace *w, int first, NodeTerms *of)
{
    const Model *m = w->model;
    ptrdiff_t class = 3 * (ptrdiff_t)(m->node_class ? m->node_class[first] : 0);
    const double *damping = w->class_damping + class;
    for (int i = 0; i < 3 * PACK_WIDTH; i++) {
        int third = i / PACK_WIDTH, lane = i % PACK_WIDTH, k = i % 3;
        of->gravity[third][lane] = w->class_gravity[class + k];
        of->damping[third][lane] = damping[k];
        of->reference[third][lane] = w->class_velocity[class + k];
    }
    of->damped = damping[0] != 0.0 || damping[1] != 0.0 || damping[2] != 0.0;
}

ALWAYS_INLINE void advance_chunk(int terms, Workspace *w, int first, int end, NodeSums *out)
{
    NodeChunk chunk;
    NodeTerms of;
    ComponentSums sums = {0};
    const CyclePlan plan = w->plan;
    int set = w->model->node_pressure[first], i = 0;
    chunk.first = first;
    chunk.count = end - first;
    gather_rows(w, &chunk);
    if (terms & (SEVERAL_PRESSURES | BODY_TERMS)) fill_terms(w, &chunk, terms);
    if (terms & BODY_UNIFORM) fill_uniform(w, first, &of);
    for (int k = 0; k < 3; k++) {
        of.bag[k] = pack_of(w->bag_pressure[set]);
        of.load[k] = pack_of(w->load_pressure[set]);
    }
    for (; i + PACK_WIDTH <= chunk.count; i += PACK_WIDTH) {
        spread_terms(terms, &chunk, w->model->inverse_mass + first + i, w->model->mass + first + i, i, &of);
        ComponentPlace at = find_place(w, 3 * ((ptrdiff_t)first + i));
        for (int third = 0; third < 3; third++) {
            integrate_pack(terms, &plan, &chunk, &of, third, 3 * i + third * PACK_WIDTH, &at, &sums);
            at.x += PACK_WIDTH;
            at.v += PACK_WIDTH;
            if (!at.acceleration) continue;
            at.acceleration += PACK_WIDTH;
            at.full += PACK_WIDTH;
            at.force += PACK_WIDTH;
        }
    }
    if (i < chunk.count) integrate_tail(terms, w, &chunk, i, &of, &sums);
    finish_sums(terms, w, set, &sums, out);
}

static bool all_alike(const int32_t *value, int first, int end)
{
    int different = 0;
    for (int i = first; i < end; i++) different |= value[i] ^ value[first];
    return !different;
}

static void lean_chunk(Workspace *w, int first, int end, NodeSums *sums)
{
    if (all_alike(w->model->node_pressure, first, end))
        advance_chunk(0, w, first, end, sums);
    else
        advance_chunk(SEVERAL_PRESSURES, w, first, end, sums);
}

static void general_chunk(Workspace *w, int first, int end, NodeSums *sums)
{
    const Model *m = w->model;
    if (!m->has_fluid && w->stagnation[m->node_pressure[first]] == 0.0 && all_alike(m->node_pressure, first, end) &&
        (!m->node_class || all_alike(m->node_class, first, end)))
        advance_chunk(BODY_UNIFORM, w, first, end, sums);
    else
        advance_chunk(SEVERAL_PRESSURES | BODY_TERMS, w, first, end, sums);
}

const NodeKernels BILLOW_NODE_TABLE = {lean_chunk, general_chunk};

/* The phase before time 0, from the checks to the state that the run starts from. */
#define _POSIX_C_SOURCE 200809L
#include "solver/relax.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <time.h>

#include "solver/memory.h"
#include "solver/relax_assemble.h"
#include "solver/relax_dynamic.h"
#include "solver/relax_free.h"
#include "solver/relax_newton.h"
#include "solver/vector3.h"

enum { LIMIT = 500 }; /* factorisations */

static double wall_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void fail(Failure *failure, const char *advice, const char *format, ...) __attribute__((format(printf, 3, 4)));
static void fail(Failure *failure, const char *advice, const char *format, ...)
{
    va_list arguments;
    failure->failed = true;
    va_start(arguments, format);
    vsnprintf(failure->cause, sizeof failure->cause, format, arguments);
    va_end(arguments);
    snprintf(failure->advice, sizeof failure->advice, "%s", advice);
}

/* ---- checks ---- */

int relax_check(const Model *m, Diagnostics *diagnostics)
{
    const char *keyword = m->relax.source.line > 0 ? "*CONTROL_DYNAMIC_RELAXATION" : "--relax";
    int status = 0;
    for (int g = 0; g < m->group_count; g++) {
        const ElementGroup *group = &m->groups[g];
        const char *why = static_law_refusal(group->law, &group->material);
        if (group->has_reference &&
            (group->birth > 0.0 || group->rule.liner_waits || group->rule.restore != RESTORE_NEVER)) {
            diagnostics_add(
                diagnostics, SEVERITY_ERROR, m->relax.source, keyword,
                "part %d has a reference geometry that changes in the run (birth, LNRC or TSRFAC): there is no "
                "equilibrium before the run for it; let it act from the start, or take the phase out",
                m->parts[group->part].id);
            status = -1;
            continue;
        }
        if (!why || m->relax.kind != RELAX_STATIC) continue;
        diagnostics_add(diagnostics, SEVERITY_ERROR, m->relax.source, keyword, "part %d: %s; use IDRFLG = 1",
                        group->part >= 0 ? m->parts[group->part].id : 0, why);
        status = -1;
    }
    for (int i = 0; i < m->airbag_count; i++) {
        if (m->airbags[i].gas.kind != GAS_FLUID_AND_GAS) continue;
        diagnostics_add(diagnostics, SEVERITY_ERROR, m->airbags[i].source, "*AIRBAG_FLUID_AND_GAS",
                        "airbag %d: a pressure that changes with height has no equilibrium before the run yet; take "
                        "the phase out of the deck (--relax, *CONTROL_DYNAMIC_RELAXATION)",
                        m->airbags[i].id);
        status = -1;
    }
    if (m->rigid_body_count > 0)
        diagnostics_add(diagnostics, SEVERITY_NOTE, m->relax.source, keyword,
                        "rigid bodies are held where they are until the run begins");
    if (model_has_contact(m)) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, m->relax.source, keyword,
                        "contact takes no part in the equilibrium before the run, so surfaces could end within others: "
                        "take the phase or the *CONTACT keywords out of the deck");
        status = -1;
    }
    if (m->wall_count > 0)
        diagnostics_add(diagnostics, SEVERITY_NOTE, m->relax.source, keyword,
                        "rigid walls take no part in the equilibrium before the run; nodes must not end behind one");
    return status;
}

/* Nodes that came to lie behind a wall that acts at time 0. */
static int check_walls(const Model *m, const double *x, Failure *failure)
{
    for (int w = 0; w < m->wall_count; w++) {
        const RigidWall *wall = &m->walls[w];
        if (!(wall->birth <= 0.0 && wall->death > 0.0)) continue;
        for (int n = 0; n < m->moving_count; n++) {
            if (!wall->tracked[n]) continue;
            double before[3], now[3];
            vector3_subtract(m->initial + 3 * n, wall->origin, before);
            vector3_subtract(x + 3 * (ptrdiff_t)n, wall->origin, now);
            WallGap was = rigid_wall_gap(wall, before), is = rigid_wall_gap(wall, now);
            if (!(is.over && is.distance < -wall->tolerance && was.distance >= -wall->tolerance)) continue;
            fail(failure,
                 "walls take no part in the phase before the run: move the wall away, or let it act later (BIRTH)",
                 "at equilibrium node %d lies %g behind rigid wall %d", m->node_id[n], -is.distance, wall->id);
            return -1;
        }
    }
    return 0;
}

/* ---- the phase ---- */

/* Nodes that a displacement curve moves stand where it says. */
static void place_driven(const Model *m, double time, double *x)
{
    for (int i = 0; i < m->constraints.node_motion_count; i++) {
        const PrescribedMotion *motion = &m->constraints.motions[i];
        if (motion->vad != 2 || !(time >= motion->birth && time < motion->death)) continue;
        double move = motion->scale * curve_value(&m->curves[motion->curve], time - motion->birth);
        for (int k = 0; k < 3; k++) x[3 * (ptrdiff_t)motion->node + k] += move * motion->direction[k];
    }
}

/* The pressure that each bag's law starts with. */
static int bag_pressures(const Model *phase, double *pressure)
{
    State start;
    if (state_create(phase, &start)) return -1;
    for (int i = 0; i < phase->airbag_count; i++) pressure[i] = phase->airbags[i].idle ? 0.0 : start.gas[i].applied;
    state_free(&start);
    return 0;
}

static void set_pressures(RelaxSystem *s, const double *bag)
{
    const Model *m = s->model;
    for (int i = 0; i < m->airbag_count; i++) s->bag[i] = bag[i];
    for (int set = 0; set < m->pressure_set_count; set++) {
        const PressureSet *of = &m->pressure_sets[set];
        for (int k = 0; k < of->count; k++) {
            int source = of->source[k];
            double pressure =
                source < m->airbag_count
                    ? bag[source]
                    : loads_segment_pressure(&m->segment_loads[source - m->airbag_count], m->curves, s->time);
            s->pressure[set] += of->push[k] * pressure;
        }
    }
}

/* What to try where the laws store no energy, and where they do. */
static const char *advice_of_laws(const Model *m)
{
    bool elastic = false, fabric = false;
    for (int g = 0; g < m->group_count; g++) {
        if (static_law_is_symmetric(m->groups[g].law, &m->groups[g].material)) continue;
        elastic = elastic || m->groups[g].law == LAW_LOGARITHMIC;
        fabric = fabric || m->groups[g].law == LAW_BIOT;
    }
    return fabric
               ? "fabric of FORM 0 or 1 with CSE = 1 and PRBA > 0 has no stored energy, and where it crumples it may "
                 "have no exact equilibrium: use FORM 2, PRBA = 0, a liner (LRATIO) or dynamic relaxation (IDRFLG = "
                 "1); else look at loads and supports there"
           : elastic
               ? "*MAT_ELASTIC grows softer as it stretches: beyond its largest pressure a bag has no equilibrium; "
                 "lower the loads, or look at loads and supports there"
               : "look at loads and supports there";
}

static int not_converged(const RelaxSystem *s, const NewtonResult *result, const double *x, Failure *failure)
{
    const Model *m = s->model;
    const double *place = x + 3 * (ptrdiff_t)(result->worst < 0 ? 0 : result->worst);
    char where[120];
    snprintf(where, sizeof where, "node %d at (%g, %g, %g)", result->worst < 0 ? 0 : m->node_id[result->worst],
             place[0], place[1], place[2]);
    if (result->far)
        fail(failure,
             "hold the part of the model that nothing holds, or lower the loads: a bag beyond its largest "
             "pressure grows without end",
             "no static equilibrium: nodes move away without end, the largest force left over is at %s", where);
    else
        fail(failure, advice_of_laws(m),
             "no static equilibrium within %d factorisations: residual %.3g of the loads, worst at %s",
             result->factorisations, result->residual, where);
    return -1;
}

static int run_static(const Model *phase, const double *pressure, FILE *progress, double *x, RelaxReport *report,
                      Failure *failure)
{
    RelaxSystem system;
    const NewtonOptions options = {phase->relax.tolerance, LIMIT, progress};
    NewtonResult result = {0};
    int status = relax_system_create(phase, phase->relax.time, &system);
    if (status == 0) {
        set_pressures(&system, pressure);
        char free_nodes[200];
        if (relax_find_free(&system, x, free_nodes, sizeof free_nodes)) {
            fail(failure, "hold them (*BOUNDARY_SPC), give them fabric, or take the load away", "%s", free_nodes);
            relax_system_free(&system);
            return -1;
        }
        status = relax_newton(&system, &options, x, &result);
    }
    *report = (RelaxReport){.steps = result.steps,
                            .factorisations = result.factorisations,
                            .residual = result.residual,
                            .load = result.load};
    report->stopped = result.stopped;
    if (status > 0 && !result.stopped) not_converged(&system, &result, x, failure);
    if (status < 0)
        fail(failure, "use a smaller mesh or a machine with more memory", "no memory for the static equilibrium");
    relax_system_free(&system);
    return status ? -1 : 0;
}

/* Energies that the stress-work ledger starts from: those that the laws have stored at equilibrium. */
static int start_ledger(const Model *m, State *state, double *energy)
{
    double *stored = memory_alloc((size_t)m->group_count + 1, sizeof *stored);
    if (!stored) return -1;
    relax_stored_energy(m, state->x, stored);
    *energy = 0.0;
    for (int g = 0; g < m->group_count; g++) *energy += stored[g];
    state_start_energies(m, stored, state);
    memory_free(stored);
    return 0;
}

/* Positions from the phase's order of nodes to the run's. */
static int take_over(const Model *phase, const Model *model, const double *x, State *state, RelaxReport *report)
{
    double *own = memory_alloc(3 * (size_t)model->node_count + 1, sizeof *own);
    if (!own) return -1;
    for (int i = 0; i < model->node_count; i++)
        memcpy(own + 3 * (ptrdiff_t)model->deck_node[i], x + 3 * (ptrdiff_t)phase->deck_node[i], 3 * sizeof *own);
    int status = state_start_at(model, own, state);
    memory_free(own);
    return status ? -1 : start_ledger(model, state, &report->energy);
}

int relax_run(const Model *phase, const Model *model, int threads, FILE *progress, State *state, RelaxReport *report,
              Failure *failure)
{
    double start = wall_clock();
    *failure = (Failure){0};
    *report = (RelaxReport){0};
    size_t coordinates = 3 * (size_t)phase->node_count;
    double *x = memory_alloc(coordinates + 1, sizeof *x);
    double *pressure = memory_alloc((size_t)phase->airbag_count + 1, sizeof *pressure);
    int status = x && pressure ? bag_pressures(phase, pressure) : -1;
    if (status == 0) {
        memcpy(x, phase->initial, coordinates * sizeof *x);
        if (phase->relax.kind == RELAX_STATIC) place_driven(phase, phase->relax.time, x);
        status = phase->relax.kind == RELAX_STATIC
                     ? run_static(phase, pressure, progress, x, report, failure)
                     : relax_dynamic(phase, pressure, threads, progress, x, report, failure);
        if (status == 0) status = check_walls(phase, x, failure);
        if (status == 0) status = take_over(phase, model, x, state, report);
    }
    if (status && !failure->failed && !report->stopped)
        fail(failure, "use a smaller mesh or a machine with more memory", "no memory for the phase before the run");
    memory_free(x);
    memory_free(pressure);
    report->seconds = wall_clock() - start;
    return status ? -1 : 0;
}

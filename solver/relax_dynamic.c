/* Dynamic relaxation: the time loop on a copy of the model, with constant bag pressures and damping (docs/theory.md,
 * Static equilibrium). */
#include "solver/relax_dynamic.h"

#include <math.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/relax_system.h"
#include "solver/signals.h"

/* Runs that never settle end here unless DRTERM ends them. */
enum { MOST_CYCLES = 20000000 };

typedef struct Relaxation {
    Model model; /* the phase's, changed; arrays below replace the phase's */
    Airbag *airbags;
    Curve *curves;
    BodyClass *classes;
    RigidBody *bodies;
    int32_t *node_class;
    double *trial, *residual, *before; /* of the Rayleigh quotient; NULL unless it is wanted */
    RelaxSystem system;
    State state;
    StageTimes times;
    double largest, frequency;
    int threads;
} Relaxation;

static bool due_at_end(void *user, const Model *model, const State *state, bool last)
{
    (void)user;
    (void)model;
    (void)state;
    return last || signals_stop_requested();
}

static int emit_nothing(void *user, const Model *model, const State *state, const StepView *view, bool last)
{
    (void)user;
    (void)model;
    (void)state;
    (void)view;
    (void)last;
    return signals_stop_requested() ? 1 : 0;
}

/* Bags become reservoirs at the pressure that their law starts with; their gas does nothing else. */
static void hold_pressures(Relaxation *r, const Model *phase, const double *pressure)
{
    int first = phase->first_function + phase->function_count;
    first = first > phase->curve_count ? first : phase->curve_count;
    for (int i = 0; i < phase->airbag_count; i++) {
        Airbag *bag = &r->airbags[i];
        *bag = phase->airbags[i];
        gas_model_reset(&bag->gas);
        bag->gas.kind = GAS_LOAD_CURVE;
        bag->gas.load_curve.pressure_curve = first + i;
        bag->psca = 1.0;
        bag->mwd = bag->spsf = bag->ambient = 0.0;
        bag->pop_part = -1;
        bag->function_count = 0;
        static double zero[1]; /* one abscissa: the value holds everywhere */
        double *value = (double *)(void *)(r->curves + first + phase->airbag_count) + i;
        *value = pressure[i];
        r->curves[first + i] = (Curve){.count = 1, .x = zero, .y = value, .area = zero};
    }
    memcpy(r->curves, phase->curves, (size_t)first * sizeof *r->curves);
    for (int i = 0; i < phase->airbag_count; i++) r->model.airbags = r->airbags;
    r->model.curves = r->curves;
}

static void hold_bodies(Relaxation *r, const Model *phase)
{
    for (int i = 0; i < phase->rigid_body_count; i++) {
        RigidBody *body = &r->bodies[i];
        *body = phase->rigid_bodies[i];
        for (int k = 0; k < 3; k++) {
            body->fix_translation[k] = body->fix_rotation[k] = true;
            body->velocity[k] = body->spin[k] = 0.0;
        }
    }
    r->model.rigid_bodies = r->bodies;
}

/* Every class damps alike: velocities times DRFCTR each cycle (eq. Q16). */
static void set_damping(Relaxation *r, double rate)
{
    for (int c = 0; c < r->model.loads.class_count; c++) {
        BodyClass *class = &r->classes[c];
        class->airbag = -1;
        class->damping_count = 1;
        class->damping[0].curve = -1;
        class->damping[0].scale = rate;
        for (int k = 0; k < 6; k++) class->damping[0].factor[k] = 1.0;
    }
}

static int allocate(Relaxation *r, const Model *phase)
{
    int first = phase->first_function + phase->function_count;
    first = first > phase->curve_count ? first : phase->curve_count;
    size_t bags = (size_t)phase->airbag_count, nodes = (size_t)phase->node_count;
    r->airbags = memory_alloc(bags + 1, sizeof *r->airbags);
    r->curves = memory_alloc(((size_t)first + bags) * sizeof(Curve) + (bags + 1) * sizeof(double), 1);
    r->classes = memory_alloc((size_t)phase->loads.class_count + 1, sizeof *r->classes);
    r->bodies = memory_alloc((size_t)phase->rigid_body_count + 1, sizeof *r->bodies);
    r->node_class = memory_alloc(nodes + 1, sizeof *r->node_class);
    if (!r->airbags || !r->curves || !r->classes || !r->bodies || !r->node_class) return -1;
    if (!phase->relax.automatic) return 0;
    if (relax_system_create(phase, 0.0, &r->system)) return -1;
    r->trial = memory_alloc(3 * nodes + 1, sizeof(double));
    r->residual = memory_alloc((size_t)r->system.unknown_count + 1, sizeof(double));
    r->before = memory_alloc((size_t)r->system.unknown_count + 1, sizeof(double));
    return r->trial && r->residual && r->before ? 0 : -1;
}

static int prepare(Relaxation *r, const Model *phase, const double *pressure, const double *x)
{
    r->model = *phase;
    if (allocate(r, phase)) return -1;
    Model *m = &r->model;
    memcpy(r->classes, phase->loads.classes, (size_t)phase->loads.class_count * sizeof *r->classes);
    if (phase->node_class) memcpy(r->node_class, phase->node_class, (size_t)phase->node_count * sizeof *r->node_class);
    m->loads.classes = r->classes;
    m->node_class = r->node_class;
    hold_pressures(r, phase, pressure);
    hold_bodies(r, phase);
    m->jet_count = m->sensor_count = m->connection_count = m->wall_count = m->function_count = 0;
    m->has_moving_walls = m->has_fluid = false;
    m->velocity = NULL;
    m->output = (OutputPlan){0};
    m->energy_error_limit = INFINITY;
    m->step_scale = phase->relax.step_scale;
    m->end_time = phase->relax.time > 0.0 ? phase->relax.time : 1e20;
    set_damping(r, 0.0);
    if (state_create(m, &r->state)) return -1;
    return state_start_at(m, x, &r->state) ? -1 : 0;
}

static void release(Relaxation *r)
{
    state_free(&r->state);
    relax_system_free(&r->system);
    void *blocks[] = {r->airbags, r->curves, r->classes, r->bodies, r->node_class, r->trial, r->residual, r->before};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
}

static double kinetic_energy(const Relaxation *r)
{
    double sum = 0.0;
    for (int n = 0; n < r->model.node_count; n++) {
        const double *v = r->state.v + 3 * (ptrdiff_t)n;
        sum += 0.5 * r->model.mass[n] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sum;
}

/* Rayleigh's quotient of the present velocities: minus the work of the stress forces' change along them, over twice the
 * kinetic energy (eq. Q18). Pressure is left out: it only softens. */
static double moving_frequency(Relaxation *r, double kinetic)
{
    const State *state = &r->state;
    RelaxSystem *s = &r->system;
    double h = 1e-2 * state->clock->step, sum = 0.0, load;
    for (int side = 1; side >= -1; side -= 2) {
        for (int i = 0; i < 3 * r->model.node_count; i++) r->trial[i] = state->x[i] + side * h * state->v[i];
        relax_system_assemble(s, r->trial, false, side > 0 ? r->residual : r->before, &load);
    }
    for (int i = 0; i < s->unknown_count; i++) {
        const double *basis = s->nodes[s->unknown_node[i]].basis + 3 * (i - s->nodes[s->unknown_node[i]].first),
                     *v = state->v + 3 * (ptrdiff_t)s->unknown_node[i];
        sum += (r->before[i] - r->residual[i]) * (basis[0] * v[0] + basis[1] * v[1] + basis[2] * v[2]);
    }
    double square = kinetic > 0.0 ? sum / (4.0 * h * kinetic) : 0.0;
    return square > 0.0 ? sqrt(square) : 0.0;
}

/* Damping of the coming cycles [1/T]: DRFCTR, or critical at the frequency that moves. */
static double choose_damping(Relaxation *r, double kinetic)
{
    const RelaxControl *relax = &r->model.relax;
    double dt = r->state.clock->step_next > 0.0 ? r->state.clock->step_next : r->state.clock->step;
    double fixed = dt > 0.0 ? 2.0 * (1.0 - relax->factor) / (dt * (1.0 + relax->factor)) : 0.0;
    if (!relax->automatic || r->state.clock->cycle <= 1) return fixed;
    double now = moving_frequency(r, kinetic);
    if (!(now > 0.0)) return fixed;
    if (r->frequency <= 0.0 || fabs(now - r->frequency) > relax->automatic_tolerance * r->frequency) r->frequency = now;
    return 2.0 * r->frequency;
}

static void report_failure(const Relaxation *r, Failure *failure)
{
    failure->failed = true;
    snprintf(failure->cause, sizeof failure->cause,
             "dynamic relaxation has not settled after %lld cycles: kinetic energy %.3g of its largest, DRTOL = %g",
             (long long)r->state.clock->cycle, r->largest > 0.0 ? kinetic_energy(r) / r->largest : 0.0,
             r->model.relax.tolerance);
    snprintf(
        failure->advice, sizeof failure->advice,
        "raise DRTOL, lower DRFCTR (more damping), let it run longer (DRTERM), or solve the equilibrium (IDRFLG = 5)");
}

/* 0 settled or DRTERM reached, 1 stopped by the user, -1 failed. */
static int settle(Relaxation *r, FILE *progress, Failure *failure)
{
    const RunHooks hooks = {.due = due_at_end, .emit = emit_nothing};
    const RelaxControl *relax = &r->model.relax;
    const Clock *clock = r->state.clock;
    r->model.end_cycle = 1; /* a first cycle tells the step */
    for (;;) {
        if (solver_run(&r->model, &r->state, r->threads, &hooks, &r->times, failure)) return -1;
        if (signals_stop_requested()) return 1;
        double kinetic = kinetic_energy(r);
        if (progress && clock->cycle > 1)
            fprintf(progress, "%8lld cycles  kinetic energy %.3e of its largest\n", (long long)clock->cycle,
                    r->largest > 0.0 ? kinetic / r->largest : 1.0);
        if (clock->cycle > 1 && kinetic <= relax->tolerance * r->largest) return 0;
        if (clock->time >= r->model.end_time) return 0;
        if (clock->cycle >= MOST_CYCLES) {
            report_failure(r, failure);
            return -1;
        }
        if (clock->cycle > 1) r->largest = kinetic > r->largest ? kinetic : r->largest;
        set_damping(r, choose_damping(r, kinetic));
        r->model.end_cycle = (int)clock->cycle + relax->check_cycles;
    }
}

int relax_dynamic(const Model *phase, const double *pressure, int threads, FILE *progress, double *x,
                  RelaxReport *report, Failure *failure)
{
    Relaxation r = {.threads = threads};
    int status = prepare(&r, phase, pressure, x);
    if (status == 0) {
        status = settle(&r, progress, failure);
        memcpy(x, r.state.x, 3 * (size_t)phase->node_count * sizeof *x);
        report->cycles = (long)r.state.clock->cycle;
        report->stopped = status == 1;
        report->residual = r.largest > 0.0 ? kinetic_energy(&r) / r.largest : 0.0;
    }
    release(&r);
    return status;
}

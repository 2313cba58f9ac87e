/* Verification runs: deck text through reader, build and time loop, with recording. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "io/read.h"
#include "solver/memory.h"

int verify_build(VerifyRun *run, const char *text, size_t length, const VerifyOptions *options)
{
    *run = (VerifyRun){.options = *options};
    int read = deck_read_text("scene.k", text, length, &run->definitions, &run->diagnostics);
    BuildOptions build = {.one_point_quads = options->one_point,
                          .caps_push_rim = options->caps_push_rim,
                          .walls_block = options->walls_block,
                          .all_explicit = options->all_explicit,
                          .energy_error_limit = options->energy_limit};
    if (model_build(&run->definitions, &build, &run->model, &run->diagnostics) || read) return -1;
    size_t size = (size_t)run->model.node_count * 3 + 1;
    run->x = memory_alloc(size, sizeof *run->x);
    run->v = memory_alloc(size, sizeof *run->v);
    run->f = memory_alloc(size, sizeof *run->f);
    run->internal_x = memory_alloc(size, sizeof *run->internal_x);
    return run->x && run->v && run->f && run->internal_x && state_create(&run->model, &run->state) == 0 ? 0 : -1;
}

static bool must_stop(const VerifyRun *run, const Clock *clock)
{
    return (run->options.stop > 0 && clock->cycle >= run->options.stop) ||
           (run->options.stop_time > 0 && clock->time >= run->options.stop_time);
}

static bool cycle_due(void *user, const Model *model, const State *state, bool last)
{
    (void)model;
    const VerifyRun *run = user;
    int64_t cycle = state->clock->cycle;
    if (last || must_stop(run, state->clock)) return true;
    return run->options.every > 0 && cycle % run->options.every == 0;
}

static void record_sample(VerifyRun *run, const Model *model, const State *state, const StepView *view)
{
    if (memory_reserve((void **)&run->samples, &run->capacity, run->count + 1, sizeof *run->samples)) return;
    VerifySample *sample = &run->samples[run->count++];
    const Energies *energy = state->energy;
    *sample = (VerifySample){.time = state->clock->time,
                             .step = state->clock->step,
                             .element_step = view->element_step,
                             .kinetic = energy->kinetic,
                             .internal = energy->internal,
                             .external = energy->external_work,
                             .held = energy->kinetic + energy->internal + energy->hourglass + energy->damping +
                                     energy->contact,
                             .given = energy->initial + energy->external_work + energy->airbag_work};
    run->imbalance = fmax(run->imbalance, fabs(sample->held - sample->given));
    run->energy = energy->largest;
    if (run->options.airbag < model->airbag_count) {
        const GasState *gas = &state->gas[run->options.airbag];
        sample->volume = gas->volume;
        sample->pressure = gas->pressure;
        sample->temperature = gas->temperature;
        sample->mass = gas->mass;
        sample->area = gas->area;
        sample->mass_flow_out = gas->mass_flow_out;
        sample->applied = gas->applied;
    }
    size_t node = 3 * (size_t)model->deck_node[run->options.node];
    memcpy(sample->x, view->x + node, sizeof sample->x);
    memcpy(sample->v, view->v + node, sizeof sample->v);
    memcpy(sample->a, view->a + node, sizeof sample->a);
    memcpy(sample->f, view->f + node, sizeof sample->f);
}

static int emit_cycle(void *user, const Model *model, const State *state, const StepView *view, bool last)
{
    VerifyRun *run = user;
    bool stop = must_stop(run, state->clock);
    record_sample(run, model, state, view);
    run->cycles = state->clock->cycle;
    if (run->options.probe) run->options.probe(run->options.user, model, state, view);
    if (!last && !stop) return 0;
    memcpy(run->internal_x, view->x, 3 * (size_t)model->node_count * sizeof(double));
    for (int i = 0; i < model->node_count; i++) {
        size_t from = 3 * (size_t)model->deck_node[i], to = 3 * (size_t)i;
        memcpy(run->x + to, view->x + from, 3 * sizeof(double));
        memcpy(run->v + to, view->v + from, 3 * sizeof(double));
        memcpy(run->f + to, view->f + from, 3 * sizeof(double));
    }
    return stop;
}

static void completed_cycle(void *user, const Model *model, const State *state)
{
    (void)user;
    (void)model;
    (void)state;
}

int verify_loop(VerifyRun *run)
{
    RunHooks hooks = {run, cycle_due, emit_cycle, completed_cycle};
    int threads = run->options.threads > 0 ? run->options.threads : 1;
    int status = solver_run(&run->model, &run->state, threads, &hooks, &run->times, &run->failure);
    run->ran = status == 0;
    return status;
}

void verify_scene(VerifyRun *run, Scene *scene, const VerifyOptions *options)
{
    assert_true(scene_ok(scene));
    int status = verify_build(run, scene->deck.text, scene->deck.length, options);
    scene_free(scene);
    if (status) {
        diagnostics_print(&run->diagnostics, SEVERITY_WARNING, stderr);
        fail_msg("the deck was refused");
    }
    if (verify_loop(run)) fail_msg("the run failed: %s; %s", run->failure.cause, run->failure.advice);
}

void verify_scene_build(VerifyRun *run, Scene *scene, int errors)
{
    scene_end(&scene->deck, &scene->mesh);
    assert_true(scene_ok(scene));
    int status = verify_build(run, scene->deck.text, scene->deck.length, &(VerifyOptions){.every = 1});
    scene_free(scene);
    if (run->diagnostics.errors != errors) diagnostics_print(&run->diagnostics, SEVERITY_NOTE, stderr);
    assert_int_equal(run->diagnostics.errors, errors);
    assert_int_equal(status != 0, errors != 0);
}

void verify_free(VerifyRun *run)
{
    memory_free(run->x);
    memory_free(run->v);
    memory_free(run->f);
    memory_free(run->internal_x);
    memory_free(run->samples);
    state_free(&run->state);
    model_free(&run->model);
    definitions_free(&run->definitions);
    diagnostics_free(&run->diagnostics);
    *run = (VerifyRun){0};
}

static double channel(const VerifySample *sample, size_t offset)
{
    double value;
    memcpy(&value, (const char *)sample + offset, sizeof value);
    return value;
}

double verify_at(const VerifyRun *run, double time, size_t offset)
{
    size_t low = 0, high = run->count ? run->count - 1 : 0;
    if (run->count == 0) return NAN;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (run->samples[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    size_t first = low > 0 ? low - 1 : 0, points = run->count < 4 ? run->count : 4;
    if (first + points > run->count) first = run->count - points;
    double sum = 0;
    for (size_t i = first; i < first + points; i++) { /* Lagrange */
        double weight = 1;
        for (size_t j = first; j < first + points; j++)
            if (j != i) weight *= (time - run->samples[j].time) / (run->samples[i].time - run->samples[j].time);
        sum += weight * channel(&run->samples[i], offset);
    }
    return sum;
}

double verify_largest(const VerifyRun *run, double from, size_t offset)
{
    double value = -INFINITY;
    for (size_t i = 0; i < run->count; i++)
        if (run->samples[i].time >= from) value = fmax(value, channel(&run->samples[i], offset));
    return value;
}

double verify_smallest(const VerifyRun *run, double from, size_t offset)
{
    double value = INFINITY;
    for (size_t i = 0; i < run->count; i++)
        if (run->samples[i].time >= from) value = fmin(value, channel(&run->samples[i], offset));
    return value;
}

double verify_mean(const VerifyRun *run, double from, double to, size_t offset)
{
    double sum = 0, span = 0;
    for (size_t i = 1; i < run->count; i++) {
        const VerifySample *a = &run->samples[i - 1], *b = &run->samples[i];
        if (a->time < from || b->time > to) continue;
        sum += (b->time - a->time) * 0.5 * (channel(a, offset) + channel(b, offset));
        span += b->time - a->time;
    }
    return sum / span;
}

ElementResult verify_element(const VerifyRun *run, int element)
{
    ElementResult result;
    membrane_result(&run->model, &run->state, run->internal_x, element, &result);
    return result;
}

void verify_balance(const VerifyRun *run, double tolerance)
{
    verify_near("energy balance over the largest given", run->imbalance / run->energy, 0, tolerance);
}

void verify_principal(const double stress[6], double principal[2])
{
    const double *s = stress;
    double trace = s[0] + s[1] + s[2]; /* the invariants of a tensor with one vanishing principal value */
    double second = s[0] * s[1] + s[1] * s[2] + s[2] * s[0] - s[3] * s[3] - s[4] * s[4] - s[5] * s[5];
    double root = sqrt(fmax(0.25 * trace * trace - second, 0));
    principal[0] = 0.5 * trace + root;
    principal[1] = 0.5 * trace - root;
}

bool verify_message(const Diagnostics *diagnostics, Severity severity, const char *text)
{
    for (size_t i = 0; i < diagnostics->count; i++)
        if (diagnostics->messages[i].severity >= severity && strstr(diagnostics->messages[i].text, text)) return true;
    return false;
}

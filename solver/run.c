/* billow run: a whole run from the deck to the last line. */
#include "solver/run.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/checkpoint.h"
#include "io/folder.h"
#include "io/log.h"
#include "io/reference_file.h"
#include "io/results.h"
#include "io/summary.h"
#include "solver/accept.h"
#include "solver/recorder.h"
#include "solver/relax.h"
#include "solver/schedule.h"
#include "solver/signals.h"
#include "solver/step.h"

typedef struct Run {
    const Options *options;
    double start_wall;
    Accepted deck;
    char directory[PATH_MAX], checkpoint[PATH_MAX];
    bool append; /* a restart that goes on in the folder of the first run */
    int threads, processors;
    int64_t first_cycle;
    Log log;
    Results *results;
    Recorder recorder;
    StageTimes times;
    Failure failure;
} Run;

static void choose_threads(Run *run)
{
    run->processors = options_processors();
    run->threads = options_threads(run->options, getenv("OMP_NUM_THREADS"), run->processors);
    if (run->threads > run->processors)
        diagnostics_add(&run->deck.diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, NULL,
                        "%d threads on %d processor%s: the run will be slower than with -j %d", run->threads,
                        run->processors, run->processors == 1 ? "" : "s", run->processors);
}

/* Takes the state from the checkpoint and checks that something is left to run. */
static int restore_state(Run *run)
{
    const Model *model = &run->deck.model;
    State *state = &run->deck.state;
    if (checkpoint_read(run->options->restart, model, state, &run->deck.diagnostics)) return -1;
    run->first_cycle = state->clock->cycle;
    const bool late = state->clock->time >= model->end_time;
    if (late || (model->end_cycle > 0 && state->clock->cycle >= model->end_cycle)) {
        diagnostics_add(&run->deck.diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "%s has reached the %s already: %s", run->options->restart, late ? "end time" : "last cycle",
                        late ? "give a larger one with --end-time" : "raise ENDCYC of *CONTROL_TERMINATION");
        return -1;
    }
    /* -o names another folder than the checkpoint's: the results start anew there. */
    run->append = !run->options->directory || folder_contains(run->directory, run->options->restart);
    return 0;
}

static int prepare(Run *run)
{
    if (options_directory(run->options, run->directory, sizeof run->directory) ||
        snprintf(run->checkpoint, sizeof run->checkpoint, "%s/%s", run->directory, BILLOW_CHECKPOINT_NAME) >=
            (int)sizeof run->checkpoint) {
        diagnostics_add(&run->deck.diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "the name of the folder of results is too long: give a shorter one with -o");
        return -1;
    }
    choose_threads(run);
    if (accept_deck(run->options, &run->deck)) return -1;
    return run->options->restart ? restore_state(run) : 0;
}

/* Folder, log and results: from here on there is a place to write to. */
static int open_outputs(Run *run)
{
    Diagnostics *diagnostics = &run->deck.diagnostics;
    const Model *model = &run->deck.model;
    const double time = run->deck.state.clock->time;
    run->recorder.plan = model->output;
    schedule_fill_plan(&run->recorder.plan, model->end_time, diagnostics);
    signals_install();
    if (folder_claim(run->directory, run->append, diagnostics)) return -1;
    if (log_open(&run->log, run->directory, run->append, run->options->deck, diagnostics)) return -1;
    log_write_deck(&run->log, &run->deck.definitions, model, &run->deck.state, &run->recorder.plan, run->threads,
                   run->processors);
    const int unwritten = reference_file_write(run->directory, &run->deck.definitions, diagnostics);
    definitions_free(&run->deck.definitions);
    return unwritten ? -1 : results_open(run->directory, model, run->append, time, &run->results, diagnostics);
}

static void print_start(const Run *run)
{
    const Model *model = &run->deck.model;
    if (run->options->quiet) return;
    printf("billow %s: %s\n", BILLOW_VERSION, run->options->deck);
    if (model->title[0]) printf("%s\n", model->title);
    printf("%d nodes, %d elements (%d deformable), %d airbag%s; %d thread%s\n", model->node_count, model->element_count,
           model->deformable_count, model->airbag_count, model->airbag_count == 1 ? "" : "s", run->threads,
           run->threads == 1 ? "" : "s");
    if (run->options->restart)
        printf("restart from %s at cycle %lld, time %.9g\n", run->options->restart, (long long)run->first_cycle,
               run->deck.state.clock->time);
    fflush(stdout);
}

/* The phase before the run, if there is one: the state then starts from equilibrium. */
static void relax(Run *run)
{
    const Model *model = &run->deck.model, *phase = run->deck.phase.node_count > 0 ? &run->deck.phase : model;
    if (model->relax.kind == RELAX_NONE || run->options->restart) return;
    RelaxReport report;
    char seconds[32], text[200];
    FILE *progress = run->options->quiet ? NULL : stdout;
    if (progress) fprintf(progress, "static equilibrium before the run:\n");
    const int missing = relax_run(phase, model, run->threads, progress, &run->deck.state, &report, &run->failure);
    run->recorder.stopped_by_user = report.stopped;
    progress_format_seconds(report.seconds, seconds, sizeof seconds);
    if (model->relax.kind == RELAX_STATIC)
        snprintf(text, sizeof text,
                 "static equilibrium: %d steps, %d factorisations, residual %.3g of the loads, stored energy %.6g, %s",
                 report.steps, report.factorisations, report.residual, report.energy, seconds);
    else
        snprintf(text, sizeof text,
                 "dynamic relaxation: %ld cycles, kinetic energy %.3g of its largest, stored energy %.6g, %s",
                 report.cycles, report.residual, report.energy, seconds);
    if (report.stopped) snprintf(text, sizeof text, "stopped by a signal before equilibrium was found");
    if (!missing || report.stopped) log_write_event(&run->log, run->deck.state.clock, "%s", text);
    if (progress && (!missing || report.stopped)) fprintf(progress, "%s\n", text);
    fflush(stdout);
}

/* The time loop with its hooks, and the checkpoint at the end. */
static void run_loop(Run *run)
{
    const Model *model = &run->deck.model;
    State *state = &run->deck.state;
    Recorder *recorder = &run->recorder;
    recorder->state = state;
    recorder->last_time = state->clock->time;
    recorder->results = run->results;
    recorder->diagnostics = &run->deck.diagnostics;
    recorder->log = &run->log;
    recorder->checkpoint = run->checkpoint;
    recorder->switch_file = "d3kil";
    progress_start(&recorder->progress, stdout, isatty(STDOUT_FILENO) == 1, run->options->quiet, model, state->clock);
    const RunHooks hooks = recorder_hooks(recorder);
    const int failed = solver_run(model, state, run->threads, &hooks, &run->times, &run->failure);
    if (failed) run->failure.failed = true;
    progress_finish_line(&recorder->progress);
    if (!failed && !recorder->write_failed && recorder->checkpoint_cycle != state->clock->cycle)
        recorder_write_checkpoint(recorder, model, state);
}

static const char *status_of(const Run *run)
{
    if (run->failure.failed || run->deck.diagnostics.environment > 0) return "failed";
    return run->recorder.stopped_by_user ? "stopped_by_user" : "normal";
}

static Summary make_summary(const Run *run)
{
    const Model *model = &run->deck.model;
    const Clock *clock = run->deck.state.clock;
    const Energies *energy = run->deck.state.energy;
    const double loop = run->times.total - run->times.output;
    const int64_t cycles = clock->cycle - run->first_cycle;
    const double work = (double)cycles * model->deformable_count;
    return (Summary){.status = status_of(run),
                     .deck = run->options->deck,
                     .threads = run->threads,
                     .cycles = cycles,
                     .last_cycle = clock->cycle,
                     .elements = model->deformable_count,
                     .nodes = model->node_count,
                     .end_time = run->recorder.last_time,
                     .wall_seconds = progress_now() - run->start_wall,
                     .loop_seconds = loop,
                     .ns_per_element_cycle = work > 0.0 ? 1e9 * loop / work : 0.0,
                     .energy_ratio_min = energy->ratio_min,
                     .energy_ratio_max = energy->ratio_max,
                     .timing = run->times,
                     .memory_bytes = run->recorder.memory,
                     .warnings = run->deck.diagnostics.warnings,
                     .state_hash = state_hash(&run->deck.state),
                     .cause = run->failure.failed ? run->failure.cause : NULL,
                     .advice = run->failure.failed ? run->failure.advice : NULL};
}

static void print_end(const Run *run, const Summary *summary)
{
    char wall[32], loop[32];
    if (run->options->quiet) return;
    progress_format_seconds(summary->wall_seconds, wall, sizeof wall);
    progress_format_seconds(summary->loop_seconds, loop, sizeof loop);
    printf("%lld cycles to time %.9g in %s (loop %s, %.1f ns per element and cycle), energy ratio %.4f to %.4f\n",
           (long long)summary->cycles, summary->end_time, wall, loop, summary->ns_per_element_cycle,
           summary->energy_ratio_min, summary->energy_ratio_max);
    printf("results in %s: results.vtkhdf, histories (*.csv), summary.json, log.txt, %s\n", run->directory,
           BILLOW_CHECKPOINT_NAME);
}

/* Closes results, writes summary and log; messages of the run go to standard error. */
static void close_outputs(Run *run, size_t printed)
{
    Diagnostics *diagnostics = &run->deck.diagnostics;
    results_close(run->results);
    run->results = NULL;
    const Summary summary = make_summary(run);
    summary_write(run->directory, &summary, diagnostics);
    log_write_end(&run->log, &run->deck.state, &summary);
    print_end(run, &summary);
    fflush(stdout);
    for (size_t i = printed; i < diagnostics->count; i++)
        if (diagnostics->messages[i].severity >= SEVERITY_WARNING)
            diagnostics_print_message(diagnostics, &diagnostics->messages[i], stderr);
    if (run->failure.failed) fprintf(stderr, "error: %s\n%s\n", run->failure.cause, run->failure.advice);
}

static int exit_code_of(const Run *run)
{
    const int code = diagnostics_exit_code(&run->deck.diagnostics);
    return code == BILLOW_EXIT_NORMAL && run->failure.failed ? BILLOW_EXIT_FAILED : code;
}

int run_deck(const Options *options)
{
    Run run = {.options = options, .start_wall = progress_now()};
    const bool opened = prepare(&run) == 0 && open_outputs(&run) == 0;
    accept_print_problems(&run.deck.diagnostics, options->deck, stderr);
    if (opened) {
        const size_t printed = run.deck.diagnostics.count;
        print_start(&run);
        relax(&run);
        if (!run.failure.failed && !run.recorder.stopped_by_user) run_loop(&run);
        close_outputs(&run, printed);
    }
    const int code = exit_code_of(&run);
    log_close(&run.log, code == BILLOW_EXIT_NORMAL);
    results_close(run.results);
    accept_free(&run.deck);
    puts(code == BILLOW_EXIT_NORMAL ? BILLOW_NORMAL_TERMINATION : BILLOW_ERROR_TERMINATION);
    return code;
}

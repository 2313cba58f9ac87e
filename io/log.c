/* log.txt: what LS-DYNA puts into d3hsp and messag. */
#include "io/log.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "io/report.h"
#include "solver/memory.h"

enum { LISTED_STEPS = 100 };

/* How every log.txt of billow begins. */
static const char first_words[] = "billow ";

bool log_marks_folder(const char *directory)
{
    char path[PATH_MAX], start[sizeof first_words] = "";
    if (snprintf(path, sizeof path, "%s/%s", directory, BILLOW_LOG_NAME) >= (int)sizeof path) return false;
    FILE *file = fopen(path, "r");
    if (!file) return false;
    const size_t length = sizeof first_words - 1;
    const bool ours = fread(start, 1, length, file) == length && memcmp(start, first_words, length) == 0;
    fclose(file);
    return ours;
}

int log_open(Log *log, const char *directory, bool append, const char *deck, Diagnostics *diagnostics)
{
    char path[PATH_MAX];
    *log = (Log){.diagnostics = diagnostics};
    if (snprintf(path, sizeof path, "%s/%s", directory, BILLOW_LOG_NAME) < (int)sizeof path)
        log->file = fopen(path, append ? "a" : "w");
    else
        errno = ENAMETOOLONG;
    if (!log->file) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot write %s in %s: %s",
                        BILLOW_LOG_NAME, directory, strerror(errno));
        return -1;
    }
    char date[64] = "";
    const time_t now = time(NULL);
    struct tm local;
    if (localtime_r(&now, &local)) strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S", &local);
    fprintf(log->file, "%s%s, %s\n%s %s\n", first_words, BILLOW_VERSION, date, append ? "restart of" : "deck", deck);
    fflush(log->file);
    return 0;
}

void log_write_deck(Log *log, const Definitions *definitions, const Model *model, const State *state,
                    const OutputPlan *plan, int threads, int processors)
{
    FILE *file = log->file;
    if (!file) return;
    fprintf(file, "title: %s\nthreads %d of %d processors\n", model->title, threads, processors);
    if (state->clock->cycle > 0)
        fprintf(file, "goes on at cycle %lld, time %.9g\n", (long long)state->clock->cycle, state->clock->time);
    report_write_keywords(definitions, file);
    report_write_parts(model, file);
    report_write_reference(model, file);
    report_write_airbags(model, state, file);
    report_write_contacts(model, log->diagnostics, file);
    report_write_conditions(model, file);
    report_write_walls(model, file);
    report_write_plan(model, plan, file);
    report_write_steps(model, LISTED_STEPS, file);
    report_write_messages(log->diagnostics, file);
    log->messages = log->diagnostics->count;
    fputs("\nRun\n---\n", file);
    fflush(file);
}

void log_write_messages(Log *log)
{
    if (!log->file) return;
    for (; log->messages < log->diagnostics->count; log->messages++)
        diagnostics_print_message(log->diagnostics, &log->diagnostics->messages[log->messages], log->file);
    fflush(log->file);
}

void log_write_event(Log *log, const Clock *clock, const char *format, ...)
{
    if (!log->file) return;
    fprintf(log->file, "cycle %lld, time %.9g: ", (long long)clock->cycle, clock->time);
    va_list values;
    va_start(values, format);
    vfprintf(log->file, format, values);
    va_end(values);
    fputc('\n', log->file);
    fflush(log->file);
}

static void write_energies(FILE *file, const Energies *energy)
{
    fprintf(file, "\nEnergies at the end\n-------------------\n");
    fprintf(file, "  kinetic %.9g, internal %.9g, hourglass %.9g\n", energy->kinetic, energy->internal,
            energy->hourglass);
    fprintf(file, "  damping %.9g, contact %.9g\n", energy->damping, energy->contact);
    fprintf(file, "  external work %.9g, work of the airbags %.9g\n", energy->external_work, energy->airbag_work);
    fprintf(file, "  energy ratio %.9g, between %.9g and %.9g\n", energy->ratio, energy->ratio_min, energy->ratio_max);
}

static void write_timing(FILE *file, const Summary *summary)
{
    const StageTimes *times = &summary->timing;
    const struct {
        const char *name;
        double seconds;
    } rows[] = {
        {"elements", times->elements}, {"gas", times->gas},       {"contact", times->contact},
        {"search", times->search},     {"nodes", times->nodes},   {"special", times->special},
        {"waiting", times->waiting},   {"output", times->output},
    };
    fprintf(file, "\nTiming\n------\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        fprintf(file, "  %-12s %12.4f s %6.1f %%\n", rows[i].name, rows[i].seconds,
                times->total > 0.0 ? 100.0 * rows[i].seconds / times->total : 0.0);
    fprintf(file, "  %-12s %12.4f s\n  %-12s %12.4f s\n", "loop", summary->loop_seconds, "whole run",
            summary->wall_seconds);
    fprintf(file, "  %lld cycles on %d thread%s: %.2f ns per element and cycle\n", (long long)summary->cycles,
            summary->threads, summary->threads == 1 ? "" : "s", summary->ns_per_element_cycle);
}

static void write_memory(FILE *file, const Summary *summary)
{
    struct rusage usage = {0};
    getrusage(RUSAGE_SELF, &usage);
    fprintf(file, "\nMemory\n------\n  model, state and buffers %.1f MB", 1e-6 * (double)summary->memory_bytes);
    if (summary->elements > 0)
        fprintf(file, " (%.0f bytes per deformable element)", (double)summary->memory_bytes / summary->elements);
    fprintf(file, "; most ever held %.1f MB, by the whole process %.1f MB\n", 1e-6 * (double)memory_peak(),
            1024e-6 * (double)usage.ru_maxrss);
}

void log_write_end(Log *log, const State *state, const Summary *summary)
{
    FILE *file = log->file;
    if (!file) return;
    log_write_messages(log);
    fprintf(file, "\nOutcome: %s at cycle %lld, time %.9g\n", summary->status, (long long)summary->last_cycle,
            summary->end_time);
    if (summary->cause) fprintf(file, "  cause: %s\n", summary->cause);
    if (summary->advice) fprintf(file, "  advice: %s\n", summary->advice);
    write_energies(file, state->energy);
    write_timing(file, summary);
    write_memory(file, summary);
    fprintf(file, "\nstate hash %016llx\n", (unsigned long long)summary->state_hash);
}

void log_close(Log *log, bool normal)
{
    if (!log->file) return;
    log_write_messages(log);
    fputs(normal ? BILLOW_NORMAL_TERMINATION "\n" : BILLOW_ERROR_TERMINATION "\n", log->file);
    fclose(log->file);
    log->file = NULL;
}

/* The progress of a run on standard output: one rewritten line on a terminal, plain lines elsewhere. */
#include "solver/progress.h"

#include <math.h>
#include <time.h>

static const double terminal_interval = 0.2; /* seconds between two lines */
static const double plain_interval = 60.0;
static const double plain_share = 0.05; /* of the run between two plain lines */

double progress_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double progress_share(const Model *model, const Clock *clock)
{
    double share = model->end_time > 0.0 ? clock->time / model->end_time : 0.0;
    if (model->end_cycle > 0) share = fmax(share, (double)clock->cycle / model->end_cycle);
    return fmin(fmax(share, 0.0), 1.0);
}

void progress_start(Progress *progress, FILE *stream, bool terminal, bool quiet, const Model *model, const Clock *clock)
{
    *progress = (Progress){.stream = stream, .quiet = quiet, .terminal = terminal, .last_cycle = -1};
    progress->start_wall = progress->last_wall = progress_now();
    progress->start_share = progress_share(model, clock);
    progress->next_share = progress->start_share;
}

void progress_format_seconds(double seconds, char *text, size_t length)
{
    if (!(seconds >= 0.0) || seconds > 1e9) {
        snprintf(text, length, "-");
        return;
    }
    const long whole = lround(seconds);
    if (seconds < 59.95)
        snprintf(text, length, "%.1f s", seconds);
    else if (whole < 3600)
        snprintf(text, length, "%ld:%02ld", whole / 60, whole % 60);
    else
        snprintf(text, length, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

/* Wall time left, judged by the share done since the start. */
static double seconds_left(const Progress *progress, double share, double wall)
{
    const double done = share - progress->start_share;
    if (share >= 1.0) return 0.0;
    return done > 0.0 ? (wall - progress->start_wall) * (1.0 - share) / done : -1.0;
}

void progress_print(Progress *progress, const Model *model, const State *state, double wall)
{
    const Clock *clock = state->clock;
    const double share = progress_share(model, clock);
    char left[32];
    progress_format_seconds(seconds_left(progress, share, wall), left, sizeof left);
    if (!progress->heading_printed)
        fprintf(progress->stream, "%10s %14s %12s %13s %6s  %s\n", "cycle", "time", "dt", "energy ratio", "done",
                "time left");
    progress->heading_printed = true;
    fprintf(progress->stream, "%s%10lld %14.6g %12.4g %13.6f %5.1f%%  %-12s%s", progress->terminal ? "\r" : "",
            (long long)clock->cycle, clock->time, clock->step_next, state->energy->ratio, 100.0 * share, left,
            progress->terminal ? "" : "\n");
    progress->open_line = progress->terminal;
    fflush(progress->stream);
    progress->last_wall = wall;
    progress->last_cycle = clock->cycle;
    progress->next_share = (floor(share / plain_share + 1e-9) + 1.0) * plain_share;
}

void progress_update(Progress *progress, const Model *model, const State *state, double wall)
{
    if (progress->quiet) return;
    const double waited = wall - progress->last_wall;
    const bool due = progress->terminal
                         ? waited >= terminal_interval || !progress->heading_printed
                         : waited >= plain_interval || progress_share(model, state->clock) >= progress->next_share;
    if (due) progress_print(progress, model, state, wall);
}

void progress_finish(Progress *progress, const Model *model, const State *state)
{
    if (!progress->quiet && progress->last_cycle != state->clock->cycle)
        progress_print(progress, model, state, progress_now());
    progress_finish_line(progress);
}

void progress_finish_line(Progress *progress)
{
    if (progress->open_line) fputc('\n', progress->stream);
    progress->open_line = false;
}

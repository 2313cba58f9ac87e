/* History files: opening, headings, whole-block writing and cutting back for a restart. */
#include "io/history.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "solver/billow.h"
#include "solver/memory.h"

enum { LINE_LENGTH = 4096 }; /* longer than any row that is written here */

static void report_failure(History *history, HistoryFile *file, const char *action)
{
    int cause = errno;
    if (file->reported) return;
    file->reported = true;
    diagnostics_add(history->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                    "cannot %s %s: %s; the run's histories are incomplete, free space or choose another folder with -o",
                    action, file->path, cause ? strerror(cause) : "unknown reason");
}

static int make_path(HistoryFile *file, const char *dir, const char *name)
{
    size_t size = strlen(dir) + strlen(name) + 2;
    file->path = memory_alloc(size, 1);
    if (!file->path) return -1;
    snprintf(file->path, size, "%s/%s", dir, name);
    return 0;
}

int history_create(History *history, const HistoryFormat *format, const char *dir, Diagnostics *diagnostics)
{
    *history = (History){.format = format, .last_time = -INFINITY, .diagnostics = diagnostics};
    if (make_path(&history->csv, dir, format->csv_name) ||
        (format->ascii_name && make_path(&history->ascii, dir, format->ascii_name))) {
        diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "not enough memory for the history %s", format->csv_name);
        return -1;
    }
    return 0;
}

static int remove_file(History *history, HistoryFile *file)
{
    if (!file->path || remove(file->path) == 0 || errno == ENOENT) return 0;
    report_failure(history, file, "replace");
    return -1;
}

int history_remove(History *history)
{
    int status = remove_file(history, &history->csv);
    return remove_file(history, &history->ascii) ? -1 : status;
}

/* Reads one line into the buffer; false at the end of the file, at a line without its newline or a too long one. */
static bool read_line(FILE *stream, char *line)
{
    if (!fgets(line, LINE_LENGTH, stream)) return false;
    return strchr(line, '\n') != NULL;
}

/* Finds the end of the CSV rows up to the time. Returns the number of different times before it, or -1 if the heading
 * is not the one that this version writes. */
static long scan_rows(History *history, FILE *stream, double restart_time, off_t *end)
{
    char line[LINE_LENGTH];
    long times = 0;
    size_t heading = strlen(history->format->csv_header);
    *end = 0;
    if (!read_line(stream, line)) return 0;
    if (strncmp(line, history->format->csv_header, heading) != 0 || line[heading] != '\n') return -1;
    *end = ftello(stream);
    while (read_line(stream, line)) {
        char *after = NULL;
        double time = strtod(line, &after);
        if (*after != ',' || !(time <= restart_time)) break;
        if (time > history->last_time) times++;
        history->last_time = time;
        *end = ftello(stream);
    }
    return times;
}

/* Finds the end of the first count blocks of the ASCII file: the blank lines before block count + 1, or the end. */
static off_t scan_blocks(const History *history, FILE *stream, long count)
{
    char line[LINE_LENGTH];
    long blocks = 0;
    off_t end = 0;
    bool blank = false;
    size_t mark = strlen(history->format->ascii_mark);
    while (read_line(stream, line)) {
        if (end > 0 && strncmp(line, history->format->ascii_mark, mark) == 0 && ++blocks > count) return end;
        blank = line[0] == '\n';
        if (!blank) end = ftello(stream);
    }
    return end;
}

static int cut_file(History *history, HistoryFile *file, off_t end)
{
    if (end == 0 ? remove(file->path) == 0 || errno == ENOENT : truncate(file->path, end) == 0) {
        file->committed = end;
        return 0;
    }
    report_failure(history, file, "shorten");
    return -1;
}

int history_truncate(History *history, double restart_time)
{
    off_t end = 0;
    long times = 0;
    history->last_time = -INFINITY;
    FILE *stream = fopen(history->csv.path, "r");
    if (!stream && errno != ENOENT) {
        report_failure(history, &history->csv, "read");
        return -1;
    }
    if (stream) {
        times = scan_rows(history, stream, restart_time, &end);
        fclose(stream);
    }
    if (times < 0) {
        diagnostics_add(history->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "%s has other columns than this version of billow writes; restart into another folder with -o",
                        history->csv.path);
        return -1;
    }
    if (cut_file(history, &history->csv, end)) return -1;
    if (!history->ascii.path) return 0;
    end = 0;
    stream = times > 0 ? fopen(history->ascii.path, "r") : NULL;
    if (stream) {
        end = scan_blocks(history, stream, times);
        fclose(stream);
    }
    return cut_file(history, &history->ascii, end);
}

/* Opens the file behind its committed bytes. */
static int open_file(History *history, HistoryFile *file)
{
    if (!file->path) return 0;
    file->fresh = file->committed == 0;
    if (file->stream) return 0;
    file->stream = fopen(file->path, file->fresh ? "w" : "a");
    if (file->stream) return 0;
    report_failure(history, file, "write");
    return -1;
}

int history_begin(History *history, double time, const char *title)
{
    if (time <= history->last_time) return 0;
    if (open_file(history, &history->csv) || open_file(history, &history->ascii)) return -1;
    if (history->csv.fresh) fprintf(history->csv.stream, "%s\n", history->format->csv_header);
    if (history->ascii.path && history->ascii.fresh)
        fprintf(history->ascii.stream, " %-72.72s\n                         ls-dyna layout by billow %s\n", title,
                BILLOW_VERSION);
    return 1;
}

static int flush_file(HistoryFile *file)
{
    if (!file->stream) return 0;
    errno = 0;
    return fflush(file->stream) || ferror(file->stream) ? -1 : 0;
}

/* Drops what was written since the last commit. The file is closed first: stdio would write its buffer again. */
static void roll_back(HistoryFile *file)
{
    if (!file->path || !file->stream) return;
    fclose(file->stream);
    file->stream = NULL;
    if (truncate(file->path, file->committed)) file->reported = true; /* a device: nothing to cut back */
}

int history_commit(History *history, double time)
{
    HistoryFile *files[2] = {&history->csv, &history->ascii};
    for (int i = 0; i < 2; i++) {
        if (flush_file(files[i]) == 0) continue;
        report_failure(history, files[i], "write");
        roll_back(files[0]);
        roll_back(files[1]);
        return -1;
    }
    for (int i = 0; i < 2; i++)
        if (files[i]->path) files[i]->committed = ftello(files[i]->stream);
    history->last_time = time;
    return 0;
}

int history_flush(History *history)
{
    HistoryFile *files[2] = {&history->csv, &history->ascii};
    int status = 0;
    for (int i = 0; i < 2; i++) {
        if (flush_file(files[i]) == 0) continue;
        report_failure(history, files[i], "write");
        status = -1;
    }
    return status;
}

static int close_file(History *history, HistoryFile *file)
{
    int status = 0;
    errno = 0;
    if (file->stream && fclose(file->stream)) {
        report_failure(history, file, "write");
        status = -1;
    }
    memory_free(file->path);
    *file = (HistoryFile){0};
    return status;
}

int history_close(History *history)
{
    int status = close_file(history, &history->csv);
    return close_file(history, &history->ascii) ? -1 : status;
}

double history_clip(double value)
{
    if (!(fabs(value) >= 1e-99)) return isnan(value) ? value : 0;
    if (value > 9.9e99) return 9.9e99;
    return value < -9.9e99 ? -9.9e99 : value;
}

/* summary.json: the outcome of a run for scripts. */
#include "io/summary.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void write_text(FILE *file, const char *name, const char *text)
{
    fprintf(file, "  \"%s\": \"", name);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fprintf(file, "\\%c", *c);
        else if (*c < 0x20)
            fprintf(file, "\\u%04x", *c);
        else
            fputc(*c, file);
    }
    fputs("\",\n", file);
}

static void write_number(FILE *file, const char *indent, const char *name, double value, const char *tail)
{
    if (isfinite(value))
        fprintf(file, "%s\"%s\": %.17g%s", indent, name, value, tail);
    else
        fprintf(file, "%s\"%s\": null%s", indent, name, tail);
}

static void write_integer(FILE *file, const char *name, long long value)
{
    fprintf(file, "  \"%s\": %lld,\n", name, value);
}

static void write_timing(FILE *file, const StageTimes *times)
{
    const char *indent = "    ";
    fputs("  \"timing\": {\n", file);
    write_number(file, indent, "elements", times->elements, ",\n");
    write_number(file, indent, "gas", times->gas, ",\n");
    write_number(file, indent, "contact", times->contact, ",\n");
    write_number(file, indent, "search", times->search, ",\n");
    write_number(file, indent, "nodes", times->nodes, ",\n");
    write_number(file, indent, "special", times->special, ",\n");
    write_number(file, indent, "waiting", times->waiting, ",\n");
    write_number(file, indent, "output", times->output, ",\n");
    write_number(file, indent, "total", times->total, "\n");
    fputs("  },\n", file);
}

static void write_all(FILE *file, const Summary *summary)
{
    fputs("{\n", file);
    write_text(file, "status", summary->status);
    write_text(file, "deck", summary->deck);
    write_text(file, "version", BILLOW_VERSION);
    write_integer(file, "threads", summary->threads);
    write_integer(file, "cycles", (long long)summary->cycles);
    write_integer(file, "last_cycle", (long long)summary->last_cycle);
    write_integer(file, "elements", summary->elements);
    write_integer(file, "nodes", summary->nodes);
    write_number(file, "  ", "end_time", summary->end_time, ",\n");
    write_number(file, "  ", "wall_seconds", summary->wall_seconds, ",\n");
    write_number(file, "  ", "loop_seconds", summary->loop_seconds, ",\n");
    write_number(file, "  ", "ns_per_element_cycle", summary->ns_per_element_cycle, ",\n");
    write_number(file, "  ", "energy_ratio_min", summary->energy_ratio_min, ",\n");
    write_number(file, "  ", "energy_ratio_max", summary->energy_ratio_max, ",\n");
    write_timing(file, &summary->timing);
    write_integer(file, "memory_bytes", (long long)summary->memory_bytes);
    write_integer(file, "warnings", summary->warnings);
    if (summary->cause) write_text(file, "cause", summary->cause);
    if (summary->advice) write_text(file, "advice", summary->advice);
    fprintf(file, "  \"state_hash\": \"%016llx\"\n}\n", (unsigned long long)summary->state_hash);
}

int summary_write(const char *directory, const Summary *summary, Diagnostics *diagnostics)
{
    char path[PATH_MAX], temporary[PATH_MAX];
    FILE *file = NULL;
    int cause = ENAMETOOLONG;
    if (snprintf(path, sizeof path, "%s/%s", directory, BILLOW_SUMMARY_NAME) < (int)sizeof path &&
        snprintf(temporary, sizeof temporary, "%s/%s.new", directory, BILLOW_SUMMARY_NAME) < (int)sizeof temporary) {
        file = fopen(temporary, "w");
        cause = file ? 0 : errno;
    }
    if (file) {
        write_all(file, summary);
        if (ferror(file)) cause = EIO;
        if (fclose(file) || (cause == 0 && rename(temporary, path))) cause = errno;
        if (cause == 0) return 0;
        unlink(temporary);
    }
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "cannot write %s in %s: %s",
                    BILLOW_SUMMARY_NAME, directory, strerror(cause));
    return -1;
}

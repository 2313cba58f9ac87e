/* What the tests of the histories share: a fresh folder each, written with the small model. */
#ifndef BILLOW_RESULTS_CASE_H
#define BILLOW_RESULTS_CASE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

#include "io/results.h"
#include "tests/small_model.h"

static SmallModel small;
static char folder[64];
static Diagnostics diagnostics;

/* A fresh folder for each test. */
static inline int setup(void **unused)
{
    (void)unused;
    snprintf(folder, sizeof folder, "test_results.XXXXXX");
    if (!mkdtemp(folder)) return -1;
    small_create(&small);
    memset(&diagnostics, 0, sizeof diagnostics);
    return 0;
}

static const char *in_folder(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static inline int teardown(void **unused)
{
    (void)unused;
    DIR *dir = opendir(folder);
    for (struct dirent *entry = dir ? readdir(dir) : NULL; entry; entry = readdir(dir))
        if (entry->d_name[0] != '.') remove(in_folder(entry->d_name));
    if (dir) closedir(dir);
    diagnostics_free(&diagnostics);
    return rmdir(folder);
}

/* The whole file, to be freed; NULL if there is none. */
static inline char *read_whole(const char *name)
{
    FILE *file = fopen(in_folder(name), "rb");
    if (!file) return NULL;
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    size_t length = fread(text, 1, (1 << 20) - 1, file);
    assert_true(length < (1 << 20) - 1);
    fclose(file);
    return text;
}

static inline int write_histories(Results *results, double time)
{
    const Model *model = &small.model;
    small_set_time(&small, time);
    int status = results_write_glstat(results, model, &small.state, &small.view);
    status |= results_write_abstat(results, model, &small.state, &small.view);
    status |= results_write_nodout(results, model, &small.state, &small.view);
    status |= results_write_rbdout(results, model, &small.state, &small.view);
    status |= results_write_rcforc(results, model, &small.state, &small.view);
    status |= results_write_rwforc(results, model, &small.state, &small.view);
    return status | results_write_matsum(results, model, &small.state, &small.view);
}

static inline Results *open_results(bool append, double time)
{
    Results *results = NULL;
    assert_int_equal(results_open(folder, &small.model, append, time, &results, &diagnostics), 0);
    assert_non_null(results);
    return results;
}

static inline void write_run(bool append, double restart, const double *times, int count)
{
    Results *results = open_results(append, restart);
    for (int i = 0; i < count; i++) assert_int_equal(write_histories(results, times[i]), 0);
    assert_int_equal(results_flush(results), 0);
    assert_int_equal(results_close(results), 0);
    assert_int_equal(diagnostics.environment, 0);
}

#endif

/* gas_pass DECK: what area vectors, volume and area cost in the element pass, as "without with" in nanoseconds per
 * element on one thread; triangles only. The best of the repeats. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "benchmarks/area_pass.h"
#include "solver/memory.h"
#include "tests/verify.h"

enum { REPEATS = 400 };

static double wall_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static char *read_deck(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = size > 0 ? malloc((size_t)size) : NULL;
    *length = text ? fread(text, 1, (size_t)size, file) : 0;
    fclose(file);
    return text;
}

/* Nanoseconds per element of the best repeat; volume: of all groups. */
static double time_pass(const VerifyRun *run, ElementKernel *kernel, double *rows, double *volume)
{
    const Model *m = &run->model;
    double best = INFINITY;
    for (int i = 0; i < REPEATS; i++) {
        ChunkSums sums = {0};
        double start = wall_clock();
        for (int g = 0; g < m->group_count; g++) {
            KernelInput input = {.group = &m->groups[g],
                                 .end_block = m->groups[g].block_count,
                                 .x = run->state.x,
                                 .origin = m->origin,
                                 .rows = rows};
            kernel(&input, &sums);
        }
        best = fmin(best, wall_clock() - start);
        *volume = sums.volume;
    }
    return 1e9 * best / m->element_count;
}

int main(int argc, char **argv)
{
    VerifyRun run;
    size_t length = 0;
    char *text = argc == 2 ? read_deck(argv[1], &length) : NULL;
    if (!text || verify_build(&run, text, length, &(VerifyOptions){0})) {
        fputs("usage: gas_pass DECK, a bag of triangles\n", stderr);
        return 2;
    }
    int level = kernels_select(NULL)->level;
    const AreaPass *pass = level >= 4 ? &area_pass_v4 : level == 3 ? &area_pass_v3 : &area_pass_v2;
    double *rows = memory_alloc(ROW_SIZE * ((size_t)run.model.row_count + 1), sizeof *rows), plain, with, none, volume;
    if (!rows) return 3;
    plain = time_pass(&run, pass->plain, rows, &none);
    with = time_pass(&run, pass->with_gas, rows, &volume);
    printf("%.4f %.4f\n", plain, with);
    double expected = run.model.airbags[0].closure.volume;
    int status = fabs(volume - expected) <= 1e-9 * fabs(expected) ? 0 : 1;
    if (status) fprintf(stderr, "the volume is %.9g, but must be %.9g\n", volume, expected);
    memory_free(rows);
    verify_free(&run);
    free(text);
    return status;
}

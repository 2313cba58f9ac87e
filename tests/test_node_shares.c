/* The bound of a mesh's highest frequency by what its nodes share (eq. E20a, E20b), against the exact one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "elements/kernels.h"
#include "elements/lane.h"
#include "solver/element_steps.h"
#include "solver/memory.h"
#include "tests/verify.h"

/* A square sheet of FORM 2 whose elements get smaller towards a corner; nodes off their lines by wobble. */
static void build_sheet(VerifyRun *run, ScenePattern pattern, double grade, double wobble)
{
    Scene scene = {0};
    uint64_t seed = 5;
    scene.deck.exact = true;
    scene_add_rectangle(&scene.mesh, 1, pattern, 10, 10, 1, 1);
    for (int i = 0; i < scene.mesh.node_count; i++)
        for (int k = 0; k < 2; k++) {
            double *x = &scene.mesh.x[3 * i + k];
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            *x = pow(*x, grade) + wobble * *x * ((double)(seed >> 11) * 0x1p-53 - 0.5);
        }
    scene_begin(&scene.deck, "sheet", 1, 0.9);
    scene_write_part(&scene.deck, 1, 1, 1, "cloth");
    scene_write_section(&scene.deck, 1, 9, 3e-4);
    scene_print(&scene.deck, "*MAT_FABRIC\n1,800,3e8,2e8,,.2,.3\n2e7,,,0\n0,,,,,2\n");
    scene_end(&scene.deck, &scene.mesh);
    assert_int_equal(verify_build(run, scene.deck.text, scene.deck.length, &(VerifyOptions){0}), 0);
    scene_free(&scene);
}

/* Stress forces at x (3 per node), by the kernels. */
static void forces_at(const Model *m, const double *x, double *history, double *rows, double *force)
{
    const KernelTable *kernels = kernels_select(NULL);
    memset(rows, 0, ROW_SIZE * (size_t)m->row_count * sizeof *rows);
    for (int seg = 0; seg < m->segment_count; seg++)
        for (int c = m->segment_chunk[seg]; c < m->segment_chunk[seg + 1]; c++) {
            int g = 0;
            while (g + 1 < m->group_count && m->groups[g + 1].first_chunk <= c) g++;
            const ElementGroup *group = &m->groups[g];
            int first = (c - group->first_chunk) * BILLOW_CHUNK, end = first + BILLOW_CHUNK;
            KernelInput input = {.group = group,
                                 .first_block = first,
                                 .end_block = end < group->block_count ? end : group->block_count,
                                 .x = x,
                                 .origin = m->origin,
                                 .history = history,
                                 .rows = rows,
                                 .restart_ledger = true};
            ChunkSums sums = {0};
            kernels_for(kernels, group)(&input, &sums);
        }
    for (int n = 0; n < m->node_count; n++)
        for (int k = 0; k < 3; k++) {
            force[3 * n + k] = 0;
            for (int32_t r = m->node_row_start[n]; r < m->node_row_start[n + 1]; r++)
                force[3 * n + k] += rows[ROW_SIZE * (ptrdiff_t)m->node_row[r] + k];
        }
}

/* Largest eigenvalue of the mesh at rest, by the power method on differences of the forces. */
static double exact_rate(const Model *m, State *s)
{
    size_t n = 3 * (size_t)m->node_count;
    double *rows = memory_alloc(ROW_SIZE * (size_t)m->row_count, sizeof *rows), *u = memory_alloc(4 * n, sizeof *u),
           *x = u + n, *up = u + 2 * n, *down = u + 3 * n, rate = 0;
    for (size_t i = 0; i < n; i++) u[i] = i % 3 == 2 ? 0 : sin(12.9898 * (double)i) + 0.1;
    for (int pass = 0; pass < 3000; pass++) {
        double size = 0, dot = 0;
        for (size_t i = 0; i < n; i++) size += m->mass[i / 3] * u[i] * u[i];
        for (size_t i = 0; i < n; i++) u[i] /= sqrt(size);
        const double h = 1e-6 * sqrt(m->mass[0]);
        for (size_t i = 0; i < n; i++) x[i] = s->x[i] + h * u[i];
        forces_at(m, x, s->history, rows, up);
        for (size_t i = 0; i < n; i++) x[i] = s->x[i] - h * u[i];
        forces_at(m, x, s->history, rows, down);
        for (size_t i = 0; i < n; i++) {
            double k = (up[i] - down[i]) / (2 * h);
            dot += k * u[i];
            u[i] = k / m->mass[i / 3];
        }
        rate = fabs(dot);
    }
    memory_free(rows);
    memory_free(u);
    return rate;
}

static void shares_bound_the_mesh(void **state)
{
    (void)state;
    for (int pattern = SCENE_QUADS; pattern <= SCENE_DIAGONAL; pattern++)
        for (int graded = 0; graded < 3; graded++) {
            VerifyRun run;
            ElementStep smallest;
            build_sheet(&run, (ScenePattern)pattern, graded == 1 ? 1.6 : 1.0, graded == 2 ? 0.09 : 0);
            assert_int_equal(element_steps_smallest(&run.model, 1, &smallest), 1);
            double exact = 2 / sqrt(exact_rate(&run.model, &run.state)), mesh = element_steps_mesh(&run.model);
            print_message("    pattern %d, graded %d: step of the smallest element %.4g, by shares %.4g, exact %.4g\n",
                          pattern, graded, smallest.step, mesh, exact);
            assert_true(mesh <= exact * (1 + 1e-6));
            assert_true(mesh >= smallest.step * (1 - 1e-12));
            if (graded == 2) assert_true(mesh > 1.05 * smallest.step); /* the corner is the smallest element's alone */
            verify_free(&run);
        }
    assert_int_equal(memory_in_use(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_bound_the_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

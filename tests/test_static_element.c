/* The static equilibrium's laws and elements: tangents against differences, forces against the explicit kernels. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "elements/kernels.h"
#include "elements/static_element.h"
#include "solver/memory.h"
#include "tests/verify.h"

typedef struct LawCase {
    const char *name;
    LawKind kind;
    bool orthotropic, field, liner;
} LawCase;

static const LawCase laws[] = {
    {"Green", LAW_GREEN, true, false, false},
    {"Green, tension field", LAW_GREEN, true, true, false},
    {"Green, isotropic tension field", LAW_GREEN, false, true, false},
    {"Green, tension field and liner", LAW_GREEN, true, true, true},
    {"engineering", LAW_BIOT, true, false, false},
    {"engineering, no compression", LAW_BIOT, true, true, false},
    {"engineering, isotropic, no compression", LAW_BIOT, false, true, false},
    {"engineering, no compression, liner", LAW_BIOT, true, true, true},
    {"logarithmic", LAW_LOGARITHMIC, false, false, false},
};
enum { LAWS = sizeof laws / sizeof laws[0] };

static StaticLaw make_law(const LawCase *c)
{
    FabricLaw fabric = {.no_compression = c->field, .density = 800};
    PlaneModuli d = c->orthotropic ? law_orthotropic(3e8, 2e8, 0.2, 0.3, 2e7) : law_isotropic(2e8, 0.3);
    law_set(&fabric, d, law_isotropic(5e7, 0.3), 0.2, c->liner);
    return static_law_make(c->kind, &fabric);
}

/* Stretches and shears: taut, wrinkled, slack. */
static const double states[][3] = {{0.03, 0.02, 0.01},    {0.04, -0.03, 0.02},  {0.04, -0.002, 0.03},
                                   {-0.02, -0.03, 0.004}, {-0.06, 0.05, -0.03}, {0.3, -0.2, 0.1},
                                   {0.2, 0.15, -0.05},    {0.01, 0.01, 0.0}};
enum { STATES = sizeof states / sizeof states[0] };

static void law_tangents(void **state)
{
    (void)state;
    for (int l = 0; l < LAWS; l++) {
        StaticLaw law = make_law(&laws[l]);
        double worst = 0.0;
        for (int k = 0; k < STATES; k++) {
            const double *e = states[k], h = 1e-6;
            double c[3] = {1 + 2 * e[0], 1 + 2 * e[1], 2 * e[2]}, by_difference[3][3], scale = law.fabric.whole.d11;
            StaticPoint at, plus, minus;
            static_law_point(&law, c, true, &at);
            for (int j = 0; j < 3; j++) {
                double up[3] = {c[0], c[1], c[2]}, down[3] = {c[0], c[1], c[2]};
                up[j] += j < 2 ? 2 * h : h; /* of the strain 2 E12, C12 is one half of it twice */
                down[j] -= j < 2 ? 2 * h : h;
                static_law_point(&law, up, false, &plus);
                static_law_point(&law, down, false, &minus);
                for (int i = 0; i < 3; i++) by_difference[i][j] = (plus.stress[i] - minus.stress[i]) / (2 * h);
                if (law.kind == LAW_GREEN) /* the stress is the energy's gradient */
                    assert_true(fabs((plus.energy - minus.energy) / (2 * h) - at.stress[j]) < 1e-6 * scale * 0.1);
            }
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    double mean = 0.5 * (by_difference[i][j] + by_difference[j][i]);
                    worst = fmax(worst, fabs(at.tangent[i][j] - mean) / scale);
                }
        }
        print_message("  %-42s tangent off by %.1e\n", laws[l].name, worst);
        assert_true(worst < 2e-6);
    }
}

/* One group of eight elements with corners moved at random; the model's own build fills its constants. */
static void write_patch(Scene *scene, bool quads, const LawCase *law)
{
    SceneText *deck = &scene->deck;
    deck->exact = true;
    scene_add_rectangle(&scene->mesh, 1, quads ? SCENE_QUADS : SCENE_DIAGONAL, 4, 3, 0.4, 0.3);
    for (int i = 0; i < scene->mesh.node_count; i++) {
        double *x = scene->mesh.x + 3 * i;
        x[0] += 0.01 * sin(17.0 * i);
        x[1] += 0.01 * cos(23.0 * i);
        x[2] += 0.01 * sin(5.0 * i);
    }
    scene_begin(deck, "patch", 1e-3, 0.9);
    scene_write_part(deck, 1, 1, 1, "patch");
    scene_write_section(deck, 1, 9, 3e-4);
    SceneFabric fabric = {.form = law->kind == LAW_GREEN ? 2 : 0,
                          .cse = law->field,
                          .density = 800,
                          .ea = 3e8,
                          .eb = 2e8,
                          .gab = 2e7,
                          .prba = 0.2,
                          .prab = 0.3,
                          .el = law->liner ? 5e7 : 0,
                          .prl = 0.3,
                          .lratio = law->liner ? 0.2 : 0,
                          .elastic = law->kind == LAW_LOGARITHMIC};
    if (fabric.elastic)
        scene_write_elastic(deck, 1, 800, 2e8, 0.3);
    else
        scene_write_fabric(deck, 1, &fabric);
    scene_write_ramp(deck, 1, 0, 1);
    scene_write_pressure(deck, 1, &scene->mesh, 0, 1, 5000);
    scene_end(deck, &scene->mesh);
}

static void sum_kernel(const Model *m, State *s, double *rows)
{
    const KernelTable *kernels = kernels_select(NULL);
    for (int seg = 0; seg < m->segment_count; seg++)
        for (int c = m->segment_chunk[seg]; c < m->segment_chunk[seg + 1]; c++) {
            const ElementGroup *group = &m->groups[0];
            int first = (c - group->first_chunk) * BILLOW_CHUNK, end = first + BILLOW_CHUNK;
            KernelInput input = {.group = group,
                                 .first_block = first,
                                 .end_block = end < group->block_count ? end : group->block_count,
                                 .x = s->x,
                                 .origin = m->origin,
                                 .history = s->history,
                                 .rows = rows,
                                 .restart_ledger = true};
            ChunkSums sums = {0};
            kernels_for(kernels, group)(&input, &sums);
        }
}

static void check_element(const Model *m, const double *x, const double *rows, bool stiffness)
{
    const ElementGroup *group = &m->groups[0];
    StaticLaw law = static_law_make(group->law, &group->material);
    double *force = memory_alloc(6 * (size_t)m->node_count, sizeof *force), worst = 0, largest = 0, off = 0, stiff = 0;
    for (int e = 0; e < group->element_count; e++) {
        int block = e / BILLOW_LANES, lane = e % BILLOW_LANES;
        int32_t node[4];
        double corner[4][3];
        StaticElement element, plus, minus;
        for (int a = 0; a < group->corner_count; a++) {
            node[a] = group->node[(block * group->corner_count + a) * BILLOW_LANES + lane];
            memcpy(corner[a], x + 3 * node[a], sizeof corner[a]);
        }
        static_element(group, &law, block, lane, corner, m->origin, true, 5000, &element);
        for (int a = 0; a < group->corner_count; a++)
            for (int k = 0; k < 3; k++) {
                force[6 * node[a] + k] += element.force[a][k];
                force[6 * node[a] + 3 + k] += element.area[a][k];
            }
        int size = 3 * group->corner_count;
        double k[12][12];
        for (int j = 0; stiffness && j < size; j++) {
            double h = 1e-7, keep = corner[j / 3][j % 3];
            corner[j / 3][j % 3] = keep + h;
            static_element(group, &law, block, lane, corner, m->origin, false, 0, &plus);
            corner[j / 3][j % 3] = keep - h;
            static_element(group, &law, block, lane, corner, m->origin, false, 0, &minus);
            corner[j / 3][j % 3] = keep;
            for (int i = 0; i < size; i++) {
                int a = i / 3, c = i % 3;
                k[i][j] =
                    -((plus.force[a][c] - minus.force[a][c]) + 5000 * (plus.area[a][c] - minus.area[a][c])) / (2 * h);
            }
        }
        for (int i = 0; stiffness && i < size; i++)
            for (int j = 0; j < size; j++) {
                off = fmax(off, fabs(element.stiffness[i * STATIC_SIZE + j] - 0.5 * (k[i][j] + k[j][i])));
                stiff = fmax(stiff, fabs(k[i][j]));
            }
    }
    for (int n = 0; n < m->node_count; n++)
        for (int i = 0; i < 6; i++) {
            double sum = 0;
            for (int r = m->node_row_start[n]; r < m->node_row_start[n + 1]; r++)
                sum += rows[ROW_SIZE * (ptrdiff_t)m->node_row[r] + (i < 3 ? i : ROW_AREA + i - 3)];
            double of = i < 3 ? 1.0 : 1e4; /* areas on the scale of forces */
            worst = fmax(worst, of * fabs(force[6 * n + i] - sum));
            largest = fmax(largest, fabs(of * sum));
        }
    memory_free(force);
    print_message("    force off by %.1e of %.1e", worst, largest);
    assert_true(worst < 1e-12 * largest);
    if (stiffness) {
        print_message(", stiffness by %.1e of %.1e", off, stiff);
        assert_true(off < 2e-6 * stiff);
    }
    print_message("\n");
}

static void element_forces(void **state)
{
    (void)state;
    static const char *const kinds[] = {"triangles", "quads of 2 x 2 points", "quads of one point"};
    for (int l = 0; l < LAWS; l++)
        for (int kind = 0; kind < 3; kind++) {
            if (!laws[l].orthotropic && laws[l].kind != LAW_LOGARITHMIC) continue;
            Scene scene = {0};
            VerifyRun run;
            write_patch(&scene, kind > 0, &laws[l]);
            VerifyOptions options = {.one_point = kind == 2};
            assert_int_equal(verify_build(&run, scene.deck.text, scene.deck.length, &options), 0);
            print_message("  %s, %s\n", laws[l].name, kinds[kind]);
            double *rows = memory_alloc(ROW_SIZE * ((size_t)run.model.row_count + 1), sizeof *rows);
            for (int taut = 0; taut < 2; taut++) {
                for (int i = 0; i < run.model.node_count; i++)
                    for (int k = 0; k < 3; k++) {
                        const double *from = run.model.initial + 3 * i;
                        double wave = taut ? 0.0005 : 0.01;
                        run.state.x[3 * i + k] =
                            (taut ? 1.06 - 0.01 * k : 1.02 - 0.04 * k) * from[k] + wave * sin(7.0 * i + 3.0 * k);
                    }
                memset(rows, 0, ROW_SIZE * (size_t)run.model.row_count * sizeof *rows);
                sum_kernel(&run.model, &run.state, rows);
                /* of the in-plane hourglass energy the stiffness has the definite part only */
                check_element(&run.model, run.state.x, rows, taut && kind < 2);
            }
            memory_free(rows);
            verify_free(&run);
            scene_free(&scene);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(law_tangents), cmocka_unit_test(element_forces)};
    return cmocka_run_group_tests_name("static elements", tests, NULL, NULL);
}

/* Accounts of fabric without an energy of its own (eq. F7a, F7b), by the very kernels: random strain paths give back no
 * more than was put in, and all instruction sets agree. */
#include "solver/memory.h"
#include "tests/law_triangle.h"

static LawCase cases[LAW_CASES];

enum { ELEMENTS = 1000, BLOCKS = ELEMENTS / BILLOW_LANES, CORNERS = 4, LEGS = 5, STEPS = 120 };

typedef struct Sheet {
    ElementGroup group;
    int32_t *node;
    double *geometry, *x, *reference, *history, *account;
    Waypoint from[ELEMENTS], to[ELEMENTS];
} Sheet;

typedef struct PathExtremes {
    double least,
        largest; /* of an account over the largest it held, or a tenth of the mean of these; the largest of all */
    double off;  /* sum of the accounts less the work that the kernel reports, over the largest */
} PathExtremes;

/* Separate elements: triangles, or nearly square quads. */
static void make_sheet(const LawCase *l, ElementKind kind, Sheet *sheet)
{
    int corners = kind == ELEMENT_TRIANGLE ? 3 : 4, size = geometry_size(kind, l->kind);
    *sheet = (Sheet){
        .node = memory_alloc((size_t)ELEMENTS * CORNERS, sizeof(int32_t)),
        .geometry = memory_alloc((size_t)ELEMENTS * (size_t)size, sizeof(double)),
        .x = memory_alloc((size_t)ELEMENTS * CORNERS * 3 + 1, sizeof(double)), /* kernels read one value beyond */
        .reference = memory_alloc((size_t)ELEMENTS * CORNERS * 3, sizeof(double)),
        .history = memory_alloc((size_t)ELEMENTS * 32, sizeof(double)),
        .account = memory_alloc((size_t)ELEMENTS * ACCOUNT_SIZE, sizeof(double))};
    sheet->group = (ElementGroup){.kind = kind,
                                  .law = l->kind,
                                  .corner_count = corners,
                                  .point_count = kind == ELEMENT_QUAD_FULL ? 4 : 1,
                                  .element_count = ELEMENTS,
                                  .block_count = BLOCKS,
                                  .node = sheet->node,
                                  .row = sheet->node,
                                  .geometry = sheet->geometry,
                                  .geometry_size = size,
                                  .history_size = history_size(kind == ELEMENT_QUAD_FULL ? 4 : 1),
                                  .has_history = true,
                                  .material = l->law};
    sheet->group.material.free_fold = l->kind == LAW_BIOT && kind == ELEMENT_QUAD_FULL;
    for (int e = 0; e < ELEMENTS; e++) {
        double *x = sheet->reference + 3 * CORNERS * e, r[8];
        for (int i = 0; i < 8; i++) r[i] = random_between(-0.2, 0.2);
        const double square[12] = {r[0], r[1], 0, 1 + r[2], r[3], 0, 1 + r[4], 1 + r[5], 0, r[6], 1 + r[7], 0};
        memcpy(x, square, sizeof square);
        ElementInput input = {.kind = kind, .x = x, .thickness = 1e-3, .mass = 0.4, .law = &sheet->group.material};
        input.axis.angle = random_between(0, 6);
        double *lane = sheet->geometry + (ptrdiff_t)(e / BILLOW_LANES) * size * BILLOW_LANES + e % BILLOW_LANES;
        assert_int_equal(geometry_fill(&input, 1, lane), GEOMETRY_OK);
        for (int a = 0; a < corners; a++)
            sheet->node[(e / BILLOW_LANES * corners + a) * BILLOW_LANES + e % BILLOW_LANES] = CORNERS * e + a;
        sheet->from[e] = (Waypoint){0, 0, random_between(0, 6)};
    }
}

static void free_sheet(Sheet *sheet)
{
    void *all[] = {sheet->node, sheet->geometry, sheet->x, sheet->reference, sheet->history, sheet->account};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) memory_free(all[i]);
}

/* Elements at the share of their way. */
static void move_sheet(Sheet *sheet, double share)
{
    for (int e = 0; e < ELEMENTS; e++) {
        const Waypoint *from = &sheet->from[e], *to = &sheet->to[e];
        double l1 = exp(from->log1 + share * (to->log1 - from->log1)),
               l2 = exp(from->log2 + share * (to->log2 - from->log2)),
               angle = from->angle + share * (to->angle - from->angle), c = cos(angle), s = sin(angle);
        for (int a = 0; a < CORNERS; a++) {
            const double *x = sheet->reference + 3 * (CORNERS * e + a);
            double along = l1 * (c * x[0] + s * x[1]), across = l2 * (c * x[1] - s * x[0]);
            double *y = sheet->x + 3 * (CORNERS * e + a);
            y[0] = c * along - s * across;
            y[1] = 0.8 * (s * along + c * across);
            y[2] = 0.6 * (s * along + c * across);
        }
    }
}

static void follow(Sheet *sheet, const KernelTable *table, PathExtremes *all)
{
    static const double origin[3] = {0};
    static double highest[ELEMENTS], lowest[ELEMENTS];
    KernelInput input = {.group = &sheet->group,
                         .end_block = BLOCKS,
                         .x = sheet->x,
                         .origin = origin,
                         .history = sheet->history,
                         .account = sheet->account,
                         .open_account = true,
                         .restart_ledger = true};
    double work = 0, held = 0;
    *all = (PathExtremes){0};
    for (int e = 0; e < ELEMENTS; e++) highest[e] = lowest[e] = 0;
    for (int leg = 0; leg < LEGS; leg++) {
        for (int e = 0; e < ELEMENTS; e++)
            sheet->to[e] = leg == LEGS - 1 ? (Waypoint){0, 0, sheet->from[e].angle}
                                           : (Waypoint){random_between(-0.3, 0.35), random_between(-0.3, 0.35),
                                                        sheet->from[e].angle + random_between(-1, 1)};
        for (int i = leg == 0 ? 0 : 1; i <= STEPS; i++) {
            ChunkSums sums = {0};
            move_sheet(sheet, (double)i / STEPS);
            kernels_for(table, &sheet->group)(&input, &sums);
            input.open_account = input.restart_ledger = false;
            work += sums.energy;
            held = 0;
            for (int e = 0; e < ELEMENTS; e++) {
                double account = sheet->account[(ptrdiff_t)(e / BILLOW_LANES) * BILLOW_LANES * ACCOUNT_SIZE +
                                                ACCOUNT_HELD * BILLOW_LANES + e % BILLOW_LANES];
                assert_true(isfinite(account));
                held += account;
                highest[e] = fmax(highest[e], account);
                all->largest = fmax(all->largest, account);
                lowest[e] = fmin(lowest[e], account);
            }
        }
        memcpy(sheet->from, sheet->to, sizeof sheet->from);
    }
    double mean = 0;
    for (int e = 0; e < ELEMENTS; e++) mean += highest[e] / ELEMENTS;
    for (int e = 0; e < ELEMENTS; e++) all->least = fmin(all->least, lowest[e] / fmax(highest[e], 0.1 * mean));
    all->off = (held - work) / all->largest;
}

static const ElementKind kinds[] = {ELEMENT_TRIANGLE, ELEMENT_QUAD_FULL, ELEMENT_QUAD_ONE};

static void random_paths_give_back_what_they_got(void **unused)
{
    (void)unused;
    int seen = 0;
    for (int k = 0; k < LAW_CASES; k++)
        for (int i = 0; i < 3; i++) {
            const LawCase *l = &cases[k];
            if (!law_keeps_account(l->kind, &l->law)) continue;
            static Sheet sheet;
            PathExtremes all;
            random_state = 7;
            make_sheet(l, kinds[i], &sheet);
            follow(&sheet, kernels_select(NULL), &all);
            print_message("%-28s kind %d: least account %.3g of its largest; sum off by %.1e\n", l->name, kinds[i],
                          all.least, all.off);
            if (!(all.least > -0.01)) fail_msg("%s: an account falls to %g", l->name, all.least);
            if (!(fabs(all.off) < 1e-9)) fail_msg("%s: accounts miss the work by %g", l->name, all.off);
            free_sheet(&sheet);
            seen++;
        }
    assert_true(seen >= 9);
}

static void all_instruction_sets_agree(void **unused)
{
    (void)unused;
    static const char *const names[] = {"v2", "v3", "v4"};
    for (int i = 0; i < 3; i++) {
        static double first[ELEMENTS * ACCOUNT_SIZE];
        bool have = false;
        for (int n = 0; n < 3; n++) {
            const KernelTable *table = kernels_select(names[n]);
            if (!table) continue;
            static Sheet sheet;
            PathExtremes all;
            random_state = 7;
            make_sheet(&cases[1], kinds[i], &sheet);
            follow(&sheet, table, &all);
            if (!have) memcpy(first, sheet.account, sizeof first);
            assert_memory_equal(first, sheet.account, sizeof first);
            have = true;
            free_sheet(&sheet);
        }
        assert_true(have);
    }
    assert_int_equal(memory_in_use(), 0);
}

int main(void)
{
    law_cases_make(cases);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_paths_give_back_what_they_got),
        cmocka_unit_test(all_instruction_sets_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

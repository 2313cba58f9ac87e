/* Folding: lengths, order and distance of layers, kinds of folds, the file of folds, the deck that is written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact/mesh_crossing.h"
#include "examples/scene.h"
#include "fold/fold.h"
#include "io/read.h"
#include "solver/memory.h"
#include "tests/program.h"

static const double radius = 0.35, gap = 0.001;
static const Fold over_right = {FOLD_THIN, {0.14, 0}, {1, 0}, 1, 3.14159265358979312, 0, 1, {0, 1}};
static const Fold bellows_left = {FOLD_ZIG_ZAG, {-0.14, 0}, {-1, 0}, 1, 3.14159265358979312, 0.105, 2, {0, 2}};

/* Two discs of n rings, sewn at the rim. */
static void open_discs(FoldBag *bag, const FoldPlan *plan, int n)
{
    SceneMesh mesh = {0};
    scene_add_disc(&mesh, 1, SCENE_DIAGONAL, n, radius);
    scene_sew_copy(&mesh, 2, scene_select_radius, &radius);
    assert_false(mesh.failed);
    *bag = (FoldBag){.node_count = mesh.node_count, .facet_count = mesh.shell_count};
    bag->flat = memory_alloc((size_t)mesh.node_count, 3 * sizeof(double));
    bag->panel = memory_alloc((size_t)mesh.node_count, 1);
    bag->facet = memory_alloc((size_t)mesh.shell_count, 4 * sizeof(int32_t));
    bag->rigid = memory_alloc((size_t)mesh.shell_count, 1);
    assert_true(bag->flat && bag->panel && bag->facet && bag->rigid);
    memcpy(bag->flat, mesh.x, (size_t)mesh.node_count * 3 * sizeof(double));
    memcpy(bag->facet, mesh.shell, (size_t)mesh.shell_count * 4 * sizeof(int32_t));
    for (int f = 0; f < mesh.shell_count; f++)
        for (int c = 0; c < 4; c++) {
            const int node = mesh.shell[f][c];
            const double *x = mesh.x + 3 * (ptrdiff_t)node;
            const bool seam = scene_select_radius(&radius, x);
            bag->panel[node] = (signed char)(seam ? 0 : mesh.part[f] == 1 ? 1 : -1);
        }
    scene_mesh_free(&mesh);
    assert_int_equal(fold_bag_open(bag, plan), 0);
}

static void fold_discs(FoldBag *bag, int n, int count, const Fold *folds)
{
    const FoldPlan plan = {.gap = gap};
    char problem[FOLD_TEXT] = "";
    open_discs(bag, &plan, n);
    for (int i = 0; i < count; i++) {
        const int status = fold_make(bag, &plan, &folds[i], problem);
        if (status) print_error("%s\n", problem);
        assert_int_equal(status, 0);
    }
}

static void expect_isometry(const FoldBag *bag, double length, double area)
{
    FoldMeasure measure;
    fold_measure(bag, &measure);
    assert_true(measure.stretch < length);
    assert_true(measure.shrink < length);
    assert_true(fabs(measure.area / measure.flat_area - 1.0) < area);
    MeshCrossings crossings;
    assert_int_equal(mesh_find_crossings(bag->facet_count, bag->facet, bag->x, NULL, &crossings), 0);
    assert_int_equal(crossings.count, 0);
}

static void expect_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) print_error("%.17g instead of %.17g\n", value, expected);
    assert_true(fabs(value - expected) <= tolerance);
}

static int compare_heights(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

/* Heights at which the vertical line through (x, y) meets the folded bag, ascending; returns how many. */
static int find_layers(const FoldBag *bag, double x, double y, double height[64])
{
    int count = 0;
    for (int f = 0; f < bag->facet_count; f++) {
        const double *p[3];
        double weight[3], sum = 0.0;
        for (int c = 0; c < 3; c++) p[c] = bag->x + 3 * (ptrdiff_t)bag->facet[4 * (ptrdiff_t)f + c];
        for (int c = 0; c < 3; c++) {
            const double *a = p[(c + 1) % 3], *b = p[(c + 2) % 3];
            weight[c] = (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
            sum += weight[c];
        }
        if (weight[0] * sum < 0 || weight[1] * sum < 0 || weight[2] * sum < 0) continue;
        assert_true(count < 64);
        height[count++] = (weight[0] * p[0][2] + weight[1] * p[1][2] + weight[2] * p[2][2]) / sum;
    }
    qsort(height, (size_t)count, sizeof *height, compare_heights);
    return count;
}

static void a_thin_fold_keeps_lengths(void **state)
{
    (void)state;
    FoldBag bag;
    fold_discs(&bag, 20, 1, &over_right);
    expect_isometry(&bag, 0.015, 1e-4);
    /* what is far from the crease stays, and lies flat at half the gap */
    int far = 0;
    for (int n = 0; n < bag.node_count; n++) {
        const double *flat = bag.flat + 3 * (ptrdiff_t)n, *x = bag.x + 3 * (ptrdiff_t)n;
        if (flat[0] > 0.0) continue;
        far++;
        expect_near(x[0], flat[0], 1e-15);
        expect_near(x[1], flat[1], 1e-15);
        assert_true(fabs(x[2]) <= 0.5 * gap);
    }
    assert_true(far > 500);
    /* the tip of the right side, a seam node, at 0.14 - 0.21 less what the crease takes, a gap above the upper panel */
    double tip = 1.0, height = 0.0;
    for (int n = 0; n < bag.node_count; n++)
        if (bag.flat[3 * (ptrdiff_t)n] > radius - 1e-9)
            tip = bag.x[3 * (ptrdiff_t)n], height = bag.x[3 * (ptrdiff_t)n + 2];
    expect_near(tip, -0.07, 3 * gap);
    expect_near(height, 2 * gap, 1e-12);
    fold_bag_free(&bag);
}

static void eight_layers_lie_in_order(void **state)
{
    (void)state;
    FoldBag bag;
    const Fold folds[] = {over_right, bellows_left};
    fold_discs(&bag, 42, 2, folds);
    assert_true(bag.facet_count > 20000);
    expect_isometry(&bag, 0.02, 5e-4);
    double height[64];
    assert_int_equal(find_layers(&bag, -0.0503, 0.0031, height), 8);
    for (int i = 1; i < 8; i++) assert_true(height[i] - height[i - 1] > 0.3 * gap);
    /* where no seam is near: the panels of the middle and what lies on them, each a gap from the next */
    assert_int_equal(find_layers(&bag, 0.0503, 0.0031, height), 4);
    for (int i = 1; i < 4; i++) expect_near(height[i] - height[i - 1], gap, 0.01 * gap);
    fold_bag_free(&bag);
}

static void down_is_the_mirror_of_up(void **state)
{
    (void)state;
    FoldBag up, down;
    Fold fold = over_right;
    fold_discs(&up, 12, 1, &fold);
    fold.sense = -1;
    fold_discs(&down, 12, 1, &fold);
    /* the panels change places too */
    double most = 0.0, least = 0.0;
    for (int n = 0; n < up.node_count; n++) {
        most = fmax(most, up.x[3 * (ptrdiff_t)n + 2]);
        least = fmin(least, down.x[3 * (ptrdiff_t)n + 2]);
    }
    expect_near(most, -least, 1e-15);
    expect_isometry(&down, 0.02, 1e-4);
    fold_bag_free(&up);
    fold_bag_free(&down);
}

static void a_right_angle_stands_upright(void **state)
{
    (void)state;
    FoldBag bag;
    Fold fold = over_right;
    fold.angle = acos(0.0);
    fold_discs(&bag, 20, 1, &fold);
    expect_isometry(&bag, 0.015, 1e-4);
    double top = 0.0;
    for (int n = 0; n < bag.node_count; n++) {
        top = fmax(top, bag.x[3 * (ptrdiff_t)n + 2]);
        assert_true(bag.x[3 * (ptrdiff_t)n] < 0.14 + 2 * gap);
    }
    expect_near(top, 0.21, 2 * gap);
    const FoldPlan plan = {.gap = gap};
    char problem[FOLD_TEXT];
    assert_int_equal(fold_make(&bag, &plan, &bellows_left, problem), -1);
    assert_non_null(strstr(problem, "must be the last one"));
    fold_bag_free(&bag);
}

static void rolls_and_tucks_keep_lengths(void **state)
{
    (void)state;
    FoldBag bag;
    const Fold roll = {FOLD_ROLL, {0.3, 0}, {1, 0}, 1, acos(-1.0), 0, 2, {0, 1}};
    fold_discs(&bag, 30, 1, &roll);
    assert_int_equal(bag.crease_count, 2);
    expect_isometry(&bag, 0.05, 1e-3);
    fold_bag_free(&bag);

    const Fold tucks[] = {{FOLD_TUCK, {0.25, 0}, {1, 0}, 1, acos(-1.0), 0, 1, {0, 1}},
                          {FOLD_TUCK, {-0.25, 0}, {-1, 0}, 1, acos(-1.0), 0, 1, {0, 2}}};
    fold_discs(&bag, 30, 2, tucks);
    expect_isometry(&bag, 0.005, 2e-4);
    double height[64];
    assert_int_equal(find_layers(&bag, 0.2003, 0.0031, height), 4);
    fold_bag_free(&bag);
}

static void crossing_creases_do_not_tangle(void **state)
{
    (void)state;
    FoldBag bag;
    const Fold folds[] = {over_right,
                          {FOLD_THIN, {-0.14, 0}, {-1, 0}, 1, acos(-1.0), 0, 1, {0, 2}},
                          {FOLD_THIN, {0, 0.12}, {0, 1}, 1, acos(-1.0), 0, 1, {0, 3}}};
    fold_discs(&bag, 30, 3, folds);
    expect_isometry(&bag, 0.1, 2e-3);
    fold_bag_free(&bag);
}

static void impossible_folds_say_why(void **state)
{
    (void)state;
    const FoldPlan plan = {.gap = gap};
    char problem[FOLD_TEXT];
    FoldBag bag;
    Fold fold = over_right;
    open_discs(&bag, &plan, 10);
    fold.point[0] = 0.4;
    assert_int_equal(fold_make(&bag, &plan, &fold, problem), -1);
    assert_non_null(strstr(problem, "nothing lies on the side that moves"));
    fold.point[0] = -0.4;
    assert_int_equal(fold_make(&bag, &plan, &fold, problem), -1);
    assert_non_null(strstr(problem, "all of it lies on the side that moves"));
    bag.rigid[0] = 1;
    fold.point[0] = 0.01;
    assert_int_equal(fold_make(&bag, &plan, &fold, problem), -1);
    assert_non_null(strstr(problem, "would bend a rigid part"));
    fold_bag_free(&bag);
    fold_discs(&bag, 20, 1, &over_right);
    fold = (Fold){FOLD_TUCK, {-0.2, 0}, {-1, 0}, 1, acos(-1.0), 0, 1, {0, 2}};
    assert_int_equal(fold_make(&bag, &plan, &fold, problem), -1);
    assert_non_null(strstr(problem, "before every other fold"));
    fold_bag_free(&bag);
}

static int open_program(void **state)
{
    Program *program = malloc(sizeof *program);
    assert_non_null(program);
    program_open(program);
    Scene scene = {0};
    scene_driver_bag(&scene, 16);
    assert_true(scene_ok(&scene));
    program_write(program, "flat.k", scene.deck.text, scene.deck.length);
    scene_free(&scene);
    *state = program;
    return 0;
}

static int close_program(void **state)
{
    program_close(*state);
    free(*state);
    return 0;
}

static int run_folds(Program *program, const char *folds)
{
    program_write(program, "folds.txt", folds, strlen(folds));
    return program_run(program, "fold flat.k folds.txt");
}

static void the_deck_has_the_flat_bag_as_reference(void **state)
{
    Program *program = *state;
    assert_int_equal(run_folds(program, "# a comment\ngap 0.001\nupper 1\nlower 2 3\nthin 0.14 0 1 0 up # over\n"), 0);
    assert_non_null(strstr(program->out, "intersections 0"));
    char *text = calloc(1, 1 << 22);
    assert_non_null(text);
    assert_true(program_read(program, "flat.folded.k", text, 1 << 22));
    const char *reference = strstr(text, "*AIRBAG_REFERENCE_GEOMETRY\n");
    const char *nodes = strstr(text, "*NODE\n");
    assert_true(reference && nodes && strstr(text, "*END\n"));
    assert_null(strstr(nodes + 1, "*NODE\n"));
    assert_non_null(strstr(text, "*AIRBAG_WANG_NEFSKE"));
    Definitions flat = {0}, folded = {0};
    Diagnostics diagnostics = {0};
    char path[128];
    snprintf(path, sizeof path, "%s/flat.k", program->folder);
    deck_read(path, &flat, &diagnostics);
    snprintf(path, sizeof path, "%s/flat.folded.k", program->folder);
    deck_read(path, &folded, &diagnostics);
    assert_int_equal(flat.nodes.count, folded.nodes.count);
    assert_int_equal(flat.shells.count, folded.shells.count);
    int moved = 0;
    for (size_t i = 0; i < flat.nodes.count; i++) {
        assert_int_equal(flat.nodes.items[i].id, folded.nodes.items[i].id);
        moved += folded.nodes.items[i].x[2] > 1.4 * gap;
    }
    assert_true(moved > 300);
    int lines = 0;
    for (const char *c = reference; c < nodes; c++) lines += *c == '\n';
    assert_int_equal(lines - 1, flat.nodes.count);
    definitions_free(&flat);
    definitions_free(&folded);
    diagnostics_free(&diagnostics);
    free(text);
}

static void errors_come_with_file_and_line(void **state)
{
    Program *program = *state;
    assert_int_equal(run_folds(program, "gap -1\nupper 1\nlower 2 x\nfoo\nthin 0 0 1 0 sideways\nthin 0 0\n"
                                        "roll 0 0 0 0 up 2\nzig-zag 0 0 1 0 up 0.1 2.5\nthin 0 0 1 0 up 200\n"),
                     2);
    const char *expected[] = {"folds.txt:1: error: gap: the value is -1; it must be above 0",
                              "folds.txt:3: error: lower: the id of a part is 'x', which is not a number",
                              "folds.txt:4: error: unknown word 'foo'",
                              "folds.txt:5: error: thin: after DX DY comes up or down, not 'sideways'",
                              "folds.txt:6: error: 3 words; write: thin X Y DX DY up|down [ANGLE]",
                              "folds.txt:7: error: roll: the direction DX DY is zero",
                              "folds.txt:8: error: zig-zag: COUNT is 2.5; give a whole number",
                              "folds.txt:9: error: thin: ANGLE is 200"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        if (!strstr(program->err, expected[i])) print_error("missing: %s\nin: %s\n", expected[i], program->err);
        assert_non_null(strstr(program->err, expected[i]));
    }
    assert_int_equal(run_folds(program, "gap 0.001\nupper 1\nthin 0.14 0 1 0 up\n"), 2);
    assert_non_null(strstr(program->err, "'lower PART ...' is missing"));
    assert_int_equal(run_folds(program, "gap 0.001\nupper 1\nlower 2 3\ngap 0.002\nthin 0.14 0 1 0 up\n"), 2);
    assert_non_null(strstr(program->err, "folds.txt:4: error: gap is given a second time"));
    assert_int_equal(run_folds(program, "gap 0.001\nupper 1\nlower 2 9\nthin 0.14 0 1 0 up\n"), 2);
    assert_non_null(strstr(program->err, "lower: flat.k has no shells of part 9"));
    assert_int_equal(run_folds(program, "gap 0.001\nupper 1\nlower 2\nthin 0.14 0 1 0 up\n"), 2);
    assert_non_null(strstr(program->err, "a part that is neither upper nor lower"));
    assert_int_equal(run_folds(program, "gap 0.001\nupper 1\nlower 2 3\nthin 0.05 0 1 0 up\n"), 2);
    assert_non_null(strstr(program->err, "folds.txt:4: error: this fold cannot be made: the crease would bend"));
    assert_int_equal(run_folds(program, "gap 0.001\nlimit 0.001\nupper 1\nlower 2 3\nthin 0.14 0 1 0 up\n"), 2);
    assert_non_null(strstr(program->err, "more than the limit of 0.1 %"));
    assert_false(program_exists(program, "flat.folded.k"));
}

static void wrong_decks_are_refused(void **state)
{
    Program *program = *state;
    assert_int_equal(program_run(program, "fold flat.k"), 2);
    assert_int_equal(program_run(program, "fold flat.k folds.txt more"), 2);
    assert_int_equal(program_run(program, "fold flat.k none.txt"), 2);
    assert_int_equal(program_run(program, "fold --help"), 0);
    assert_non_null(strstr(program->out, "zig-zag"));
    const char folds[] = "gap 0.001\nupper 1\nlower 2\nthin 0.14 0 1 0 up\n";
    program_write(program, "folds.txt", folds, strlen(folds));
    assert_int_equal(program_run(program, "fold flat.k folds.txt -o flat.k"), 2);
    program_write_bag(program, "round.k", 4, NULL);
    const char ball[] = "gap 0.001\nupper 1\nlower 1\nthin 0.14 0 1 0 up\n";
    program_write(program, "ball.txt", ball, strlen(ball));
    assert_int_equal(program_run(program, "fold round.k ball.txt"), 2);
    assert_non_null(strstr(program->err, "is named as upper and as lower"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thin_fold_keeps_lengths),
        cmocka_unit_test(eight_layers_lie_in_order),
        cmocka_unit_test(down_is_the_mirror_of_up),
        cmocka_unit_test(a_right_angle_stands_upright),
        cmocka_unit_test(rolls_and_tucks_keep_lengths),
        cmocka_unit_test(crossing_creases_do_not_tangle),
        cmocka_unit_test(impossible_folds_say_why),
        cmocka_unit_test_setup_teardown(the_deck_has_the_flat_bag_as_reference, open_program, close_program),
        cmocka_unit_test_setup_teardown(errors_come_with_file_and_line, open_program, close_program),
        cmocka_unit_test_setup_teardown(wrong_decks_are_refused, open_program, close_program),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Checkpoints: "2N cycles" equals "N, restart, N" to the bit; wrong, damaged and missing files are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/checkpoint.h"
#include "io/read.h"
#include "solver/build.h"
#include "solver/memory.h"
#include "solver/step.h"
#include "tests/program.h"

static const char path[] = "test_checkpoint.billow";

/* A bag's model with its state at time 0. */
typedef struct Bag {
    Diagnostics diagnostics;
    Definitions definitions;
    Model model;
    State state;
} Bag;

static void make_bag(Bag *bag, int n, const BuildOptions *options)
{
    Scene scene = {0};
    memset(bag, 0, sizeof *bag);
    program_make_bag(&scene, n);
    assert_true(scene_ok(&scene));
    const int unread =
        deck_read_text("bag.k", scene.deck.text, scene.deck.length, &bag->definitions, &bag->diagnostics);
    const int unbuilt = model_build(&bag->definitions, options, &bag->model, &bag->diagnostics);
    if (unread || unbuilt) diagnostics_print(&bag->diagnostics, SEVERITY_WARNING, stderr);
    assert_int_equal(unread, 0);
    assert_int_equal(unbuilt, 0);
    assert_int_equal(state_create(&bag->model, &bag->state), 0);
    scene_free(&scene);
}

static void free_bag(Bag *bag)
{
    state_free(&bag->state);
    model_free(&bag->model);
    definitions_free(&bag->definitions);
    diagnostics_free(&bag->diagnostics);
}

static bool due_at(void *user, const Model *model, const State *state, bool last)
{
    (void)model;
    return last || state->clock->cycle + 1 >= *(const int *)user;
}

static int stop_at(void *user, const Model *model, const State *state, const StepView *view, bool last)
{
    (void)user, (void)model, (void)state, (void)view, (void)last;
    return 1;
}

static void completed(void *user, const Model *model, const State *state)
{
    (void)user, (void)model, (void)state;
}

/* Goes on until cycle cycles are done. */
static void run_until(Bag *bag, int cycles, int threads)
{
    const RunHooks hooks = {.user = &cycles, .due = due_at, .emit = stop_at, .completed = completed};
    StageTimes times;
    Failure failure = {0};
    if (solver_run(&bag->model, &bag->state, threads, &hooks, &times, &failure)) fail_msg("%s", failure.cause);
    assert_int_equal(bag->state.clock->cycle, cycles);
}

static void test_same_bits(void **state)
{
    (void)state;
    enum { HALF = 60 };
    const BuildOptions options = {0};
    Bag straight, first, second;
    make_bag(&straight, 8, &options);
    const uint64_t start = state_hash(&straight.state);
    run_until(&straight, 2 * HALF, 1);

    make_bag(&first, 8, &options);
    assert_true(state_hash(&first.state) == start);
    run_until(&first, HALF, 1);
    assert_int_equal(checkpoint_write(path, &first.model, &first.state, &first.diagnostics), 0);
    const uint64_t middle = state_hash(&first.state);
    assert_true(middle != start);

    make_bag(&second, 8, &options);
    assert_int_equal(checkpoint_read(path, &second.model, &second.state, &second.diagnostics), 0);
    assert_true(state_hash(&second.state) == middle);
    run_until(&second, 2 * HALF, 2);
    assert_true(state_hash(&second.state) == state_hash(&straight.state));
    assert_true(state_hash(&second.state) != middle);
    free_bag(&straight);
    free_bag(&first);
    free_bag(&second);
    unlink(path);
}

/* Reads path and expects one input error that contains word. */
static void expect_refused(Bag *bag, const char *word)
{
    const int before = bag->diagnostics.errors;
    assert_int_equal(checkpoint_read(path, &bag->model, &bag->state, &bag->diagnostics), -1);
    assert_int_equal(bag->diagnostics.errors, before + 1);
    const char *text = bag->diagnostics.messages[bag->diagnostics.count - 1].text;
    if (!strstr(text, word)) fail_msg("'%s' does not say '%s'", text, word);
    assert_non_null(strstr(text, path));
}

/* The file's bytes into memory of its own. */
static unsigned char *slurp(size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

static void spill(const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void test_damaged_files(void **state)
{
    (void)state;
    const BuildOptions options = {0};
    Bag bag;
    make_bag(&bag, 6, &options);
    assert_int_equal(checkpoint_write(path, &bag.model, &bag.state, &bag.diagnostics), 0);
    size_t size;
    unsigned char *bytes = slurp(&size);
    assert_true(size > bag.state.size);

    const size_t cuts[] = {0, 1, 8, 39, size - bag.state.size, size - 1};
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        spill(bytes, cuts[i]);
        expect_refused(&bag, i < 4 ? "not a checkpoint" : "damaged");
    }
    const struct {
        size_t place;
        const char *word;
    } flips[] = {{0, "not a checkpoint"}, {8, "another version"}, {16, "another deck"},  {24, "another deck"},
                 {32, "damaged"},         {40, "damaged"},        {size / 2, "damaged"}, {size - 1, "damaged"}};
    for (size_t i = 0; i < sizeof flips / sizeof *flips; i++) {
        bytes[flips[i].place] ^= 4;
        spill(bytes, size);
        expect_refused(&bag, flips[i].word);
        bytes[flips[i].place] ^= 4;
    }
    unsigned char *longer = malloc(size + 1);
    assert_non_null(longer);
    memcpy(longer, bytes, size);
    longer[size] = 0;
    spill(longer, size + 1);
    expect_refused(&bag, "damaged");
    free(longer);
    spill(bytes, size);
    assert_int_equal(checkpoint_read(path, &bag.model, &bag.state, &bag.diagnostics), 0);
    free(bytes);
    unlink(path);
    expect_refused(&bag, strerror(ENOENT));
    free_bag(&bag);
}

static void test_other_decks(void **state)
{
    (void)state;
    const BuildOptions options = {0}, longer = {.end_time = 1e3};
    Bag bag, finer, prolonged;
    make_bag(&bag, 6, &options);
    make_bag(&finer, 8, &options);
    make_bag(&prolonged, 6, &longer);
    assert_int_equal(checkpoint_write(path, &bag.model, &bag.state, &bag.diagnostics), 0);
    expect_refused(&finer, "another deck");
    /* A later end is no other deck; a moved node, a heavier node and another gas are. */
    assert_int_equal(checkpoint_read(path, &prolonged.model, &prolonged.state, &prolonged.diagnostics), 0);
    bag.model.initial[7] += 1e-12;
    expect_refused(&bag, "another deck");
    bag.model.initial[7] -= 1e-12;
    const double mass = bag.model.mass[3];
    bag.model.mass[3] *= 1.0 + 1e-15;
    assert_true(bag.model.mass[3] != mass);
    expect_refused(&bag, "another deck");
    bag.model.mass[3] = mass;
    bag.model.airbags[0].gas.cp *= 1.01;
    expect_refused(&bag, "another deck");
    free_bag(&bag);
    free_bag(&finer);
    free_bag(&prolonged);
    unlink(path);
}

static void test_no_place_to_write(void **state)
{
    (void)state;
    const BuildOptions options = {0};
    Bag bag;
    make_bag(&bag, 6, &options);
    assert_int_equal(checkpoint_write("no-such-folder/x", &bag.model, &bag.state, &bag.diagnostics), -1);
    assert_int_equal(diagnostics_exit_code(&bag.diagnostics), BILLOW_EXIT_ENVIRONMENT);
    free_bag(&bag);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_damaged_files),
        cmocka_unit_test(test_other_decks),
        cmocka_unit_test(test_no_place_to_write),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A run with contact that is interrupted has the same bits as one that is not, whatever is written in between. */
#include "tests/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/contact_scene.h"

/* The pieces after the first, each a new time loop from the state alone; the hash of the last state. */
static uint64_t finish_in_pieces(VerifyRun *run, int cycles, int pieces)
{
    for (int i = 2; i <= pieces; i++) {
        run->options.stop = cycles * i / pieces;
        if (verify_loop(run)) fail_msg("%s", run->failure.cause);
    }
    return state_hash(&run->state);
}

static uint64_t run_in_pieces(int pieces, int threads, int every)
{
    enum { CYCLES = 480 };
    Scene scene = {0};
    VerifyRun run;
    scene_crumple(&scene);
    VerifyOptions options = {.threads = threads, .stop = CYCLES / pieces, .every = every, .energy_limit = 1e9};
    verify_scene(&run, &scene, &options);
    uint64_t hash = finish_in_pieces(&run, CYCLES, pieces);
    print_message("    %d pieces, %d threads: %d pairs in contact, contact %.1f %% of the energy, %016llx\n", pieces,
                  threads, (int)run.state.contact_memories[0],
                  100 * run.state.energy->contact / run.state.energy->largest, (unsigned long long)hash);
    assert_true(run.state.contact_memories[0] > 50);
    verify_free(&run);
    return hash;
}

static void same_bits(void **state)
{
    (void)state;
    uint64_t whole = run_in_pieces(1, 1, 0);
    assert_true(run_in_pieces(1, 1, 7) == whole);
    assert_true(run_in_pieces(2, 2, 0) == whole);
    assert_true(run_in_pieces(12, 1, 0) == whole);
    assert_true(run_in_pieces(40, 3, 0) == whole);
}

static uint64_t drape_in_pieces(bool self, int pieces, int threads, int every)
{
    enum { CYCLES = 240 };
    Scene scene = {0};
    VerifyRun run;
    scene_drape(&scene, self);
    VerifyOptions options = {.threads = threads, .stop = CYCLES / pieces, .every = every, .energy_limit = 1e9};
    verify_scene(&run, &scene, &options);
    uint64_t hash = finish_in_pieces(&run, CYCLES, pieces);
    int held = 0;
    for (size_t p = 0; p < run.model.entity_probe_count; p++) held += run.state.entity_memory[p].side != 0;
    print_message("    entities, %d pieces, %d threads: %d probes in contact, contact %.1f %% of the energy, %016llx\n",
                  pieces, threads, held, 100 * run.state.energy->contact / run.state.energy->largest,
                  (unsigned long long)hash);
    assert_true(held > 20);
    verify_free(&run);
    return hash;
}

static void entities_too(void **state)
{
    (void)state;
    for (int self = 0; self < 2; self++) {
        uint64_t whole = drape_in_pieces(self, 1, 1, 0);
        assert_true(drape_in_pieces(self, 1, 1, 7) == whole);
        assert_true(drape_in_pieces(self, 2, 2, 0) == whole);
        assert_true(drape_in_pieces(self, 12, 1, 0) == whole);
        assert_true(drape_in_pieces(self, 40, 3, 0) == whole);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_bits), cmocka_unit_test(entities_too)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

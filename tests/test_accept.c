/* Reading and building without memory: whichever allocation fails, the deck is refused as short of memory, not more. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "solver/accept.h"
#include "solver/memory.h"
#include "tests/program.h"

static const char path[] = "test_accept.k";

static int write_deck(void **state)
{
    (void)state;
    Scene scene = {0};
    program_make_bag(&scene, 2);
    assert_true(scene_ok(&scene));
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(scene.deck.text, 1, scene.deck.length, file), scene.deck.length);
    fclose(file);
    scene_free(&scene);
    return 0;
}

static int remove_deck(void **state)
{
    (void)state;
    return unlink(path);
}

/* Accepts the deck while allocation number countdown fails; returns the exit code. Nothing may be left allocated. */
static int accept_short(long countdown)
{
    const Options options = {.command = COMMAND_RUN, .deck = path};
    const size_t held = memory_in_use();
    Accepted accepted = {0};
    memory_fail_after(countdown);
    const int failed = accept_deck(&options, &accepted);
    memory_fail_after(0);
    const int code = diagnostics_exit_code(&accepted.diagnostics);
    if ((failed != 0) != (code != BILLOW_EXIT_NORMAL)) fail_msg("allocation %ld: %d, exit %d", countdown, failed, code);
    accept_free(&accepted);
    if (memory_in_use() != held) fail_msg("allocation %ld: %zu bytes are left", countdown, memory_in_use() - held);
    return code;
}

static void test_every_allocation(void **state)
{
    (void)state;
    assert_int_equal(accept_short(0), BILLOW_EXIT_NORMAL);
    int refused = 0;
    /* The first hundreds one by one, then ever larger strides. */
    for (long k = 1; k < 100000000; k += k < 400 ? 1 : k / 50) {
        const int code = accept_short(k);
        if (code == BILLOW_EXIT_NORMAL && k > 400) break;
        /* A lost note is no reason to refuse a deck: those allocations may pass. */
        if (code != BILLOW_EXIT_NORMAL && code != BILLOW_EXIT_ENVIRONMENT) fail_msg("allocation %ld: exit %d", k, code);
        refused += code == BILLOW_EXIT_ENVIRONMENT;
    }
    assert_true(refused > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(test_every_allocation, write_deck, remove_deck)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

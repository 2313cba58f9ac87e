/* The folded bags of the tests to their end: shells that go through each other, volume and energy over time as CSV.
 *
 * usage: contact_crossings CELLS THREADS [resting]    resting: the one that is brought to rest */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "contact/mesh_crossing.h"
#include "tests/verify.h"

enum { EVERY = 100 }; /* cycles from row to row */

static void print_row(void *user, const Model *model, const State *state, const StepView *view)
{
    (void)user;
    (void)view;
    MeshCrossings found = {0};
    if (mesh_find_crossings(model->element_count, model->element_node, state->x, NULL, &found)) exit(3);
    printf("%.17g,%lld,%d,%.17g,%.17g,%.17g,%.17g\n", state->clock->time, (long long)state->clock->cycle, found.count,
           found.depth, state->energy->ratio_min, state->energy->ratio_max, state->gas->volume);
}

int main(int argc, char **argv)
{
    Scene scene = {0};
    VerifyRun run;
    bool resting = argc == 4 && strcmp(argv[3], "resting") == 0;
    if (argc != 3 && !resting) {
        fprintf(stderr, "usage: contact_crossings CELLS THREADS [resting]\n");
        return 2;
    }
    if (resting)
        scene_resting_bag(&scene, atoi(argv[1]), true);
    else
        scene_folded_bag(&scene, SCENE_DIAGONAL, atoi(argv[1]), 0);
    printf("time,cycle,crossings,depth,energy_ratio_min,energy_ratio_max,volume\n");
    verify_scene(&run, &scene, &(VerifyOptions){.every = EVERY, .threads = atoi(argv[2]), .probe = print_row});
    verify_free(&run);
    return 0;
}

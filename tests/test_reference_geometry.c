/* Reference geometry at work: shrunken and folded bags (D5), no initial tension, its return, liners that wait, births,
 * steps, and the same bits over threads and a restart. */
#include "tests/reference_bag.h"

enum { CELLS = 12 };

static void shrunken_bags_reach_the_reference_shape(void **state)
{
    (void)state;
    static Fold *const folds[] = {shrink_to_tenth, shrink_to_hundredth};
    static const double scale[] = {0.1, 0.01}, push[] = {300, 5e4};
    for (int form = 0; form <= 2; form += 2) {
        BagResult flat = run_bag(&(BagSetup){.form = form, .n = CELLS, .end = 0.3, .push = 300});
        for (int i = 0; i < 2; i++) {
            BagResult rdt = run_bag(&(BagSetup){form, CELLS, folds[i], "_RDT", 0, 0.3, push[i], 0});
            verify_close("volume with RDT", rdt.volume, flat.volume, 0.005);
            verify_close("height with RDT", rdt.height, flat.height, 0.005);
            assert_true(rdt.least_step >= 0.9 * flat.start_step);
            if (i == 1 && form == 0) continue; /* a hundred times the cycles: test_reference_hundredth.c */
            BagResult now = run_bag(&(BagSetup){form, CELLS, folds[i], "", 0, i == 0 ? 0.3 : 0.002, push[i], 0});
            verify_close("start step", now.start_step, scale[i] * flat.start_step, 1e-6);
            if (i > 0) continue;
            verify_close("volume", now.volume, flat.volume, 0.005);
            verify_close("height", now.height, flat.height, 0.005);
        }
    }
}

static void a_folded_bag_stores_the_same_energy(void **state)
{
    (void)state;
    BagResult flat = run_bag(&(BagSetup){.form = 2, .n = CELLS, .end = 0.6, .push = 300});
    BagResult folded = run_bag(&(BagSetup){2, CELLS, accordion, "_RDT", 0, 0.6, 300, 0});
    verify_close("volume", folded.volume, flat.volume, 0.001);
    verify_close("energy", folded.internal, flat.internal, 0.01);
}

static void shrink_to_half(double x[3])
{
    shrink(x, 0.5);
}

/* Before birth the mesh tells the step, with RDT or without; the mass is the mesh's, so that the bound by the reference
 * is the same as that by the mesh. */
static void births_change_the_rule_of_the_step(void **state)
{
    (void)state;
    const double birth = 0.012;
    Scene scenes[2];
    VerifyRun run[2];
    BagResult flat = run_bag(&(BagSetup){.form = 2, .n = CELLS, .end = 0.3, .push = 300});
    for (int i = 0; i < 2; i++) {
        scenes[i] = (Scene){0};
        make_bag(&scenes[i], &(BagSetup){2, CELLS, shrink_to_half, i ? "_RDT_BIRTH" : "_BIRTH", birth, 0.3, 300, 0});
        verify_scene(&run[i], &scenes[i], &(VerifyOptions){.every = 1});
    }
    double bound = run[0].samples[0].element_step, least = 1, before = 0, after = 1;
    verify_close("step of the mesh", bound, 0.5 * flat.start_step, 1e-6);
    for (size_t i = 0; i < run[0].count; i++) {
        const VerifySample *a = &run[0].samples[i];
        if (a->time <= birth && a->time > before) { /* the cycle that finds the birth still has the mesh's step */
            assert_true(a->element_step == run[1].samples[i].element_step);
            before = a->time;
        } else {
            after = fmin(after, a->element_step);
        }
    }
    for (size_t i = 0; i < run[1].count; i++) least = fmin(least, run[1].samples[i].element_step);
    print_message("    equal until %g, then without RDT %.4g of %.4g, with RDT never less than %.4g\n", before, after,
                  bound, least);
    assert_true(after < 0.6 * bound);
    assert_true(least >= 0.9 * bound);
    for (int i = 0; i < 2; i++) {
        verify_close("volume", run[i].samples[run[i].count - 1].volume, flat.volume, 0.005);
        verify_balance(&run[i], 0.02);
        verify_free(&run[i]);
    }
}

/* Kinetic energy that the balance of central differences keeps exactly (eq. L5), of every cycle. */
typedef struct StepEnergy {
    double kinetic[4000];
    int count;
} StepEnergy;

static void keep_step_energy(void *user, const Model *model, const State *state, const StepView *view)
{
    StepEnergy *energy = user;
    double before = state->clock->step, next = state->clock->step_next, share = before / (before + next), sum = 0;
    for (int i = 0; i < 3 * model->moving_count; i++) {
        double after = state->v[i], old = (view->v[i] - share * after) / (1 - share);
        sum += 0.5 * model->mass[i / 3] * old * after;
    }
    if (energy->count < 4000) energy->kinetic[energy->count++] = sum;
}

/* A birth under pressure: the fabric that was taut is slack at once. The energy that this takes away, and the work of
 * the stress that jumps, are booked so that the balance does not notice (eq. R10, R10a). */
static void a_birth_keeps_the_balance(void **state)
{
    (void)state;
    static StepEnergy kept;
    for (int form = 0; form <= 2; form += 2) {
        const double birth = 0.003;
        BagSetup setup = {form, CELLS, shrink_to_half, "_BIRTH_RDT", birth, 0.0035, 5e4, 1e-5};
        Scene scene = {0};
        VerifyRun run;
        kept.count = 0;
        make_bag(&scene, &setup);
        verify_scene(&run, &scene, &(VerifyOptions){.every = 1, .probe = keep_step_energy, .user = &kept});
        size_t at = 0;
        while (run.samples[at].time < birth) at++;
        double error[2];
        for (int i = 0; i < 2; i++) {
            const VerifySample *s = &run.samples[at - 3 + 6 * (size_t)i];
            error[i] = s->held - s->kinetic + kept.kinetic[at - 3 + 6 * (size_t)i] - s->given;
        }
        double taken = fabs(run.samples[at].external - run.samples[at - 1].external), size = run.samples[at].given;
        print_message("    form %d: the birth takes %g of %g; the balance is off by %g before, %g after\n", form, taken,
                      size, error[0], error[1]);
        assert_true(taken > 0.005 * size);
        assert_true(fabs(error[1] - error[0]) < 1e-5 * size);
        verify_free(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shrunken_bags_reach_the_reference_shape),
        cmocka_unit_test(births_change_the_rule_of_the_step),
        cmocka_unit_test(a_birth_keeps_the_balance),
        cmocka_unit_test(a_folded_bag_stores_the_same_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A bag shrunken to a hundredth, without RDT: the step begins at a hundredth of the reference's and grows with the bag,
 * which ends in the shape of the bag that was never shrunken (D5). A coarse mesh: it takes a quarter of a million
 * cycles. */
#include "tests/reference_bag.h"

static void a_hundredth_reaches_the_reference_shape(void **state)
{
    (void)state;
    enum { CELLS = 6 };
    for (int form = 0; form <= 2; form += 2) {
        BagResult flat = run_bag(&(BagSetup){.form = form, .n = CELLS, .end = 0.3, .push = 300});
        BagResult now = run_bag(&(BagSetup){form, CELLS, shrink_to_hundredth, "", 0, 0.3, 5e4, 0});
        BagResult rdt = run_bag(&(BagSetup){form, CELLS, shrink_to_hundredth, "_RDT", 0, 0.3, 5e4, 0});
        verify_close("start step", now.start_step, 0.01 * flat.start_step, 1e-6);
        verify_close("volume", now.volume, flat.volume, 0.005);
        verify_close("height", now.height, flat.height, 0.005);
        verify_close("volume with RDT", rdt.volume, flat.volume, 0.005);
        assert_true(rdt.least_step >= 0.9 * flat.start_step);
        verify_close("height with RDT", rdt.height, flat.height, 0.005);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_hundredth_reaches_the_reference_shape)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

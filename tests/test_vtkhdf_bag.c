/* results.vtkhdf of a real bag: what the elements give for a stretched cushion is what the file holds, cell by cell. */
#include "tests/vtkhdf_case.h"

#include "examples/scene.h"
#include "io/read.h"
#include "solver/build.h"

/* The cushion's model, built from its deck's text. */
typedef struct Bag {
    Definitions definitions;
    Model model;
    State state;
    double *x, *v; /* positions and velocities to write */
} Bag;

static void make_bag(Bag *bag)
{
    Scene scene = {0};
    const BuildOptions options = {0};
    memset(bag, 0, sizeof *bag);
    scene_cushion(&scene, 70);
    assert_true(scene_ok(&scene));
    assert_int_equal(deck_read_text("cushion.k", scene.deck.text, scene.deck.length, &bag->definitions, &diagnostics),
                     0);
    assert_int_equal(model_build(&bag->definitions, &options, &bag->model, &diagnostics), 0);
    assert_int_equal(state_create(&bag->model, &bag->state), 0);
    scene_free(&scene);
    size_t count = 3 * (size_t)bag->model.node_count;
    bag->x = calloc(count, sizeof *bag->x);
    bag->v = calloc(count, sizeof *bag->v);
    assert_true(bag->x && bag->v);
    /* Stretched unlike in every direction, and bulging: no two cells are alike. */
    for (size_t i = 0; i < count; i += 3) {
        const double *start = bag->state.x + i;
        bag->x[i] = 1.02 * start[0];
        bag->x[i + 1] = 1.05 * start[1] + 0.03 * start[0] * start[1];
        bag->x[i + 2] = start[2] + 0.2 * start[0] * start[0];
    }
}

static void free_bag(Bag *bag)
{
    free(bag->x);
    free(bag->v);
    state_free(&bag->state);
    model_free(&bag->model);
    definitions_free(&bag->definitions);
}

/* Points in deck order, and corners that are points of the same cells. */
static void check_mesh(hid_t file, const Bag *bag)
{
    static double points[VALUES], corners[VALUES];
    const Model *model = &bag->model;
    read_set(file, "VTKHDF/Points", (hsize_t)model->node_count, 3, points);
    read_set(file, "VTKHDF/Connectivity", 4 * (hsize_t)model->element_count, 1, corners);
    for (int i = 0; i < 3 * model->node_count; i++)
        assert_true(points[i] == bag->x[3 * model->deck_node[i / 3] + i % 3]);
    for (int i = 0; i < 4 * model->element_count; i++)
        assert_int_equal(model->deck_node[(int)corners[i]], model->element_node[i]);
}

static void test_cells_of_a_bag(void **unused)
{
    (void)unused;
    static double stress[VALUES], strain[VALUES], thickness[VALUES];
    Bag bag;
    Results *results = NULL;
    make_bag(&bag);
    assert_true(bag.model.element_count > 8192); /* more than the writer stages at once */
    const StepView view = {.x = bag.x, .v = bag.v};
    assert_int_equal(results_open(folder, &bag.model, false, 0, &results, &diagnostics), 0);
    assert_int_equal(results_write_state(results, &bag.model, &bag.state, &view), 0);
    assert_int_equal(results_close(results), 0);
    hid_t file = open_grid();
    const hsize_t cells = (hsize_t)bag.model.element_count;
    read_set(file, "VTKHDF/CellData/stress", cells, 6, stress);
    read_set(file, "VTKHDF/CellData/strain", cells, 6, strain);
    read_set(file, "VTKHDF/CellData/thickness", cells, 1, thickness);
    check_mesh(file, &bag);
    H5Fclose(file);
    double largest = 0;
    for (int e = 0; e < bag.model.element_count; e++) {
        ElementResult result;
        membrane_result(&bag.model, &bag.state, bag.x, e, &result);
        for (int c = 0; c < 6; c++) {
            assert_true(stress[6 * e + c] == (double)(float)result.stress[c]);
            assert_true(strain[6 * e + c] == (double)(float)result.strain[c]);
            largest = fmax(largest, fabs(stress[6 * e + c]));
        }
        assert_true(thickness[e] == (double)(float)result.thickness && thickness[e] > 0);
        assert_true(e == 0 || stress[6 * e] != stress[6 * e - 6]);
    }
    assert_true(largest > 0);
    free_bag(&bag);
}

int main(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(test_cells_of_a_bag, setup, teardown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The bag's surface of real decks, against the volumes and areas that LS-DYNA prints at the start. Skipped where the
 * shared folder is absent. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "tests/surface_meshes.h"

#ifndef BILLOW_SHARED_DIR
#define BILLOW_SHARED_DIR "../shared"
#endif

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

enum { MOST_NODES = 30000, MOST_SHELLS = 10000 };

/* Reads the fixed columns of *NODE and *ELEMENT_SHELL, no more: the shells of the given parts. NULL-ended part list. */
static bool load(const char *deck, const int *part, Mesh *mesh)
{
    char path[1000], line[200], keyword[80] = "";
    snprintf(path, sizeof path, "%s/decks/%s/deck.k", BILLOW_SHARED_DIR, deck);
    FILE *file = fopen(path, "r");
    if (!file) {
        printf("skipped: %s is not there\n", path);
        return false;
    }
    *mesh = mesh_create(MOST_NODES, MOST_SHELLS);
    int *index = calloc(MOST_NODES, sizeof *index);
    for (int i = 0; i < MOST_NODES; i++) index[i] = -1;
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '*') snprintf(keyword, sizeof keyword, "%.70s", line);
        if (line[0] == '*' || line[0] == '$') continue;
        if (strncmp(keyword, "*NODE", 5) == 0 && strlen(line) > 50) {
            double x[3];
            for (int k = 2; k >= 0; k--) {
                line[24 + 16 * k] = '\0';
                x[k] = strtod(line + 8 + 16 * k, NULL);
            }
            line[8] = '\0';
            int id = atoi(line);
            assert_in_range(id, 1, MOST_NODES - 1);
            index[id] = add_node(mesh, x[0], x[1], x[2]);
            mesh->node_id[index[id]] = id;
        } else if (strncmp(keyword, "*ELEMENT_SHELL", 14) == 0) {
            int v[6];
            for (int k = 5; k >= 0; k--) {
                line[8 * k + 8] = '\0';
                v[k] = atoi(line + 8 * k);
            }
            for (const int *p = part; *p; p++)
                if (v[1] == *p) mesh->facet_id[add_quad(mesh, v[2], v[3], v[4], v[5])] = v[0];
        }
    }
    fclose(file);
    for (int i = 0; i < 4 * mesh->facet_count; i++) mesh->facet[i] = (int32_t)index[mesh->facet[i]];
    free(index);
    return true;
}

/* Closes the bag and checks what holds for all decks. */
static void close_deck(Mesh *mesh)
{
    assert_int_equal(mesh_close(mesh), 0);
    diagnostics_print(&mesh->diagnostics, SEVERITY_NOTE, stdout);
    assert_int_equal(mesh->diagnostics.errors, 0);
    assert_int_equal(mesh->closure.components, 1);
    assert_int_equal(mesh->closure.inner, 0);
    assert_near(mesh_leak(mesh), 0.0, 1e-10 * mesh->closure.volume);
}

static void test_landing_pad_closed(void **state)
{
    (void)state;
    Mesh mesh;
    if (!load("landing-pad-closed", (const int[]){1, 2, 0}, &mesh)) skip();
    close_deck(&mesh);
    assert_int_equal(mesh.closure.holes, 1);
    assert_int_equal(mesh.closure.caps[0].count, 20);
    assert_int_equal(mesh.closure.free_edges, 20);
    assert_near(mesh.closure.caps[0].planarity, 0.0, 1e-6);
    assert_near(mesh.closure.caps[0].size, 80.0, 0.01);
    assert_near(mesh.closure.volume, 272698.0, 1e-4 * 272698.0);
    assert_near(mesh.closure.area, 560215.0, 1e-4 * 560215.0);
    assert_in_range(mesh.closure.turned, 1900, 2100);
    mesh_free(&mesh);
}

static void test_landing_pad_ring_wall(void **state)
{
    (void)state;
    Mesh mesh;
    if (!load("landing-pad-ring-wall", (const int[]){1, 2, 0}, &mesh)) skip();
    close_deck(&mesh);
    assert_int_equal(mesh.closure.holes, 2);
    for (int c = 0; c < 2; c++) assert_int_equal(mesh.closure.caps[c].count, 72);
    assert_near(mesh.closure.volume, 272690.0, 1e-4 * 272690.0); /* printed 2.7269E+05 */
    assert_near(mesh.closure.area, 424000.0, 5e-4 * 424000.0);   /* printed 4.240E+05 */
    mesh_free(&mesh);
}

static void test_landing_pad_wang_nefske(void **state)
{
    (void)state;
    Mesh mesh;
    if (!load("landing-pad-wang-nefske", (const int[]){1, 2, 6, 0}, &mesh)) skip();
    close_deck(&mesh);
    assert_int_equal(mesh.closure.seams, 80);
    assert_int_equal(mesh.closure.free_edges, 276);
    assert_int_equal(mesh.closure.holes, 2);
    assert_int_equal(mesh.closure.caps[0].count + mesh.closure.caps[1].count, 24 + 12);
    assert_near(mesh.closure.volume, 2726.9, 1e-4 * 2726.9); /* printed 2.7269E+03 */
    assert_near(mesh.closure.area, 5614.0, 2e-4 * 5614.0);   /* printed 5.614E+03 */
    mesh_free(&mesh);
}

static void test_classic_deploy(void **state)
{
    (void)state;
    Mesh mesh;
    if (!load("classic-deploy", (const int[]){3, 0}, &mesh)) skip();
    close_deck(&mesh);
    assert_int_equal(mesh.closure.turned, 2432);
    assert_int_equal(mesh.closure.free_edges, 0);
    assert_true(mesh.closure.volume > 0.0);
    mesh_free(&mesh);
}

/* All parts of a deck in one bag: shells of the ground beside the bag are no obstacle to an answer. */
static void test_whole_deck_gives_an_answer(void **state)
{
    (void)state;
    Mesh mesh;
    if (!load("landing-pad-wang-nefske", (const int[]){1, 2, 3, 6, 8, 9, 0}, &mesh)) skip();
    int result = mesh_close(&mesh);
    diagnostics_print(&mesh.diagnostics, SEVERITY_NOTE, stdout);
    assert_int_equal(result == 0, mesh.diagnostics.errors == 0);
    mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_landing_pad_closed),         cmocka_unit_test(test_landing_pad_ring_wall),
        cmocka_unit_test(test_landing_pad_wang_nefske),    cmocka_unit_test(test_classic_deploy),
        cmocka_unit_test(test_whole_deck_gives_an_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The bag's surface of real decks, against the volumes and areas that LS-DYNA prints at the start. Skipped where the
 * shared folder is absent. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "io/read.h"
#include "tests/surface_meshes.h"

#ifndef BILLOW_SHARED_DIR
#define BILLOW_SHARED_DIR "../shared"
#endif

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) fail_msg("%.17g is not %.17g within %g", value, expected, tolerance);
}

/* The deck's node at id; ids are looked up by bisection in the sorted places. */
typedef struct Place {
    int id, node;
} Place;

static int compare_places(const void *a, const void *b)
{
    int one = ((const Place *)a)->id, other = ((const Place *)b)->id;
    return (one > other) - (one < other);
}

/* Reads the deck and makes a mesh of the shells of the given parts, or of part set 1 if part is NULL. What else the
 * reader says of the deck is not this test's business. */
static bool load(const char *deck, const int *part, size_t parts, Mesh *mesh)
{
    char path[1000];
    snprintf(path, sizeof path, "%s/decks/%s/deck.k", BILLOW_SHARED_DIR, deck);
    FILE *file = fopen(path, "r");
    if (!file) {
        printf("skipped: %s is not there\n", path);
        return false;
    }
    fclose(file);
    Definitions d = {0};
    Diagnostics diagnostics = {0};
    deck_read(path, &d, &diagnostics);
    assert_true(d.nodes.count > 3000 && d.shells.count > 3000);
    *mesh = mesh_create((int)d.nodes.count, (int)d.shells.count);
    Place *place = calloc(d.nodes.count, sizeof *place);
    for (size_t i = 0; i < d.nodes.count; i++) {
        const NodeDefinition *node = &d.nodes.items[i];
        place[i] = (Place){node->id, add_node(mesh, node->x[0], node->x[1], node->x[2])};
        mesh->node_id[i] = node->id;
    }
    qsort(place, d.nodes.count, sizeof *place, compare_places);
    for (size_t i = 0; i < d.sets.count && !part; i++)
        if (d.sets.items[i].kind == SET_PART && d.sets.items[i].id == 1) {
            part = d.sets.items[i].members.items;
            parts = d.sets.items[i].members.count;
        }
    assert_non_null(part);
    for (size_t i = 0; i < d.shells.count; i++) {
        const ShellDefinition *shell = &d.shells.items[i];
        bool in_set = false;
        for (size_t p = 0; p < parts; p++) in_set = in_set || part[p] == shell->part;
        if (!in_set) continue;
        int node[4];
        for (int k = 0; k < 4; k++) {
            const Place wanted = {shell->node[k], 0};
            const Place *found = bsearch(&wanted, place, d.nodes.count, sizeof *place, compare_places);
            assert_non_null(found);
            node[k] = found->node;
        }
        mesh->facet_id[add_quad(mesh, node[0], node[1], node[2], node[3])] = shell->id;
    }
    free(place);
    definitions_free(&d);
    diagnostics_free(&diagnostics);
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
    if (!load("landing-pad-closed", NULL, 0, &mesh)) skip();
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
    if (!load("landing-pad-ring-wall", NULL, 0, &mesh)) skip();
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
    if (!load("landing-pad-wang-nefske", NULL, 0, &mesh)) skip();
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
    if (!load("classic-deploy", NULL, 0, &mesh)) skip();
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
    if (!load("landing-pad-wang-nefske", (const int[]){1, 2, 3, 6, 8, 9}, 6, &mesh)) skip();
    assert_int_equal(mesh_close(&mesh), 0);
    diagnostics_print(&mesh.diagnostics, SEVERITY_NOTE, stdout);
    assert_int_equal(mesh.closure.components, 1);
    assert_int_equal(mesh.closure.seams, 80);
    assert_int_equal(mesh.closure.inner, 2756 + 296); /* the ground and two discs, each flat and loose */
    assert_near(mesh_leak(&mesh), 0.0, 1e-10 * mesh.closure.volume);
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

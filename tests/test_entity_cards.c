/* *CONTACT_ENTITY cards: fields, everything that is wrong in one list, the report and gceout. */
#include "tests/keyword_case.h"

#include <math.h>

#include "tests/program.h"
#include "tests/verify.h"

static void test_cards(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*CONTACT_ENTITY\n"
                              "         7         2         5         0       2.0      20.0       0.3\n"
                              "      0.01       0.5         1         1         1         1\n"
                              "       1.0       2.0       3.0       1.0\n"
                              "       0.0       1.0\n"
                              "         1       0.1       0.2       0.3       0.4\n"
                              "         8         3         6         1                                       2\n"
                              "\n\n\n"
                              "         0       0.1       0.2       0.3       0.0       0.0       1.0       0.4\n");
    assert_int_equal(c.d.entities.count, 2);
    const EntityDefinition *e = c.d.entities.items;
    assert_true(e->pid == 7 && e->geotyp == 2 && e->ssid == 5 && e->sstyp == 0 && e->intord == 0 && e->inout == 1);
    assert_true(e->sf == 2 && e->df == 20 && e->cf == 0.3 && e->birth == 0.01 && e->death == 0.5 && e->ithk == 1);
    assert_true(e->centre[2] == 3 && e->a[0] == 1 && e->b[1] == 1 && e->g[2] == 0.3 && e->g[3] == 0.4);
    assert_true(e[1].sf == 1 && e[1].death == 1e20 && e[1].intord == 2 && e[1].a[0] == 1 && e[1].b[1] == 1);
    assert_int_equal(count_notes(&c, "GO"), 1);
    assert_int_equal(count_notes(&c, "SPR"), 1);
    close_case(&c);
}

#define ENTITY(one, five) "*CONTACT_ENTITY\n" one "\n\n0,0,0,1\n0,1\n" five "\n"

static void test_wrong_fields(void **state)
{
    (void)state;
    static const char k[] = "*CONTACT_ENTITY";
    assert_one_error(ENTITY("1,5,1", "0"), 2, k, "GEOTYP = 5 (torus)");
    assert_one_error(ENTITY("1,10,1", "0"), 2, k, "GEOTYP = 10 (finite plane)");
    assert_one_error(ENTITY("1,12,1", "0"), 2, k, "GEOTYP = 12 is no shape");
    assert_one_error(ENTITY("1,2,1,3", "0"), 2, k, "SSTYP = 3");
    assert_one_error(ENTITY("1,2,1,0,-1", "0"), 2, k, "SF = -1");
    assert_one_error(ENTITY("1,2,1,0,1,-3", "0"), 2, k, "DF = -3");
    assert_one_error(ENTITY("1,2,1,0,1,0,-1", "0"), 2, k, "CF = -1");
    assert_one_error(ENTITY("1,2,1,1,1,0,0,6", "0"), 2, k, "INTORD = 6");
    assert_one_error(ENTITY("1,2,1,0,1,0,0,2", "0"), 2, k, "INTORD = 2 needs segments");
    assert_one_error(ENTITY("1,2,1", "2"), 6, k, "INOUT = 2");
    assert_one_error(ENTITY("0,2,1", "0"), 2, k, "PID");
    assert_one_error(ENTITY("1,2,0", "0"), 2, k, "SSID");
    assert_one_error("*CONTACT_ENTITY\n1,2,1\n0,0,-4\n\n\n0,0,0,0,1\n", 3, k, "SO = -4");
}

static const char model_head[] = "*CONTROL_TERMINATION\n1e-3\n"
                                 "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
                                 "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,2,5,6,7,8\n"
                                 "*PART\nfabric\n1,1,1\n*PART\nbody\n2,1,2\n*PART\nempty\n3,1,1\n"
                                 "*SECTION_SHELL\n1,9\n0.01\n"
                                 "*MAT_ELASTIC\n1,800,1e6,0.3\n*MAT_RIGID\n2,800\n\n\n";

static int build(const char *cards, VerifyRun *run)
{
    char text[6000];
    snprintf(text, sizeof text, "%s%s*END\n", model_head, cards);
    return verify_build(run, text, strlen(text), &(VerifyOptions){0});
}

static void test_wrong_models(void **state)
{
    (void)state;
    static const char *const expected[] = {"PID = 9 is not a part",
                                           "part 1 is not rigid",
                                           "SSID = 44 is not a part",
                                           "no set 77",
                                           "SSID = 3 of type 1 holds no nodes",
                                           "make no local system",
                                           "the normal of the plane",
                                           "the radius of the sphere (G4)",
                                           "the axis of the cylinder",
                                           "the radius of the cylinder (G7)",
                                           "the half axes",
                                           "the order of the ellipsoid",
                                           "the mesh of the part is not closed"};
    VerifyRun run;
    assert_true(
        build(ENTITY("9,2,1,1", "0,0,0,0,1") ENTITY("1,2,1,1", "0,0,0,0,1") ENTITY("2,2,44,1", "0,0,0,0,1")
                  ENTITY("2,2,77,0", "0,0,0,0,1")
                      ENTITY("2,2,3,1", "0,0,0,0,1") "*CONTACT_ENTITY\n2,2,1,1\n\n0,0,0,1\n2,0,0\n0,0,0,0,1\n" ENTITY(
                          "2,1,1,1", "0") ENTITY("2,2,1,1", "0") ENTITY("2,3,1,1", "0,0,0,0,0,0,0,1")
                          ENTITY("2,3,1,1", "0,0,0,0,0,0,1") ENTITY("2,4,1,1", "0,0,0,0,1,1,-1")
                              ENTITY("2,4,1,1", "0,0,0,0,1,1,1,4") ENTITY("2,9,1,1", "0"),
              &run) != 0);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!verify_message(&run.diagnostics, SEVERITY_ERROR, expected[i])) fail_msg("no error: %s", expected[i]);
    assert_int_equal(run.diagnostics.errors, sizeof expected / sizeof *expected);
    verify_free(&run);
}

/* The local system, and who counts. */
static void test_model(void **state)
{
    (void)state;
    VerifyRun run;
    assert_int_equal(build("*CONTACT_ENTITY\n2,1,1,1,1,0,0,2\n0,0,0,0,1\n1,2,3,0,1\n-1\n0,1,2,3,0,2,0\n"
                           "2,2,2,1\n\n\n\n0,0,0,0,1\n",
                           &run),
                     0);
    const ContactEntity *e = run.model.entities;
    const double origin[3] = {-1, 3, 6}, normal[3] = {-1, 0, 0}; /* A = y, B = -x */
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(e->origin[k] - origin[k]) < 1e-14);
        assert_true(fabs(e->axes[6 + k] - normal[k]) < 1e-14);
    }
    assert_int_equal(e->node_count, 4);
    assert_int_equal(e->probe_count, 8); /* and 2 x 2 points of the one shell */
    assert_true(fabs(e->radius[0] - 0.005) < 1e-15 && e->radius[7] == e->radius[0]);
    assert_int_equal(e[1].probe_count, 0); /* its own body's nodes */
    assert_true(verify_message(&run.diagnostics, SEVERITY_WARNING, "entity 2 has no nodes to act on"));
    verify_free(&run);
}

/* What check says, and gceout of a run: a sheet that lies on a driven sphere's place pushes it. */
static void test_report_and_results(void **state)
{
    (void)state;
    static Program program;
    char text[6000];
    static char rows[1000000];
    int length = snprintf(text, sizeof text,
                          "%s*CONTACT_ENTITY\n2,2,1,1\n\n\n\n0,0.9,0.9,0.5,0.51\n*INITIAL_VELOCITY_NODE\n1,0,0,100\n2,"
                          "0,0,100\n3,0,0,100\n4,0,0,100\n"
                          "*DATABASE_GCEOUT\n1e-5\n*END\n",
                          model_head);
    program_open(&program);
    program_write(&program, "entity.k", text, (size_t)length);
    assert_int_equal(program_run(&program, "check entity.k"), BILLOW_EXIT_NORMAL);
    assert_non_null(strstr(program.out, "entity 1: sphere on rigid part 2, at (0.9, 0.9, 0.5), radius 0.51; 4 nodes"));
    assert_non_null(strstr(program.out, "none of them is within it"));
    assert_non_null(strstr(program.out, "gceout 1e-05"));
    assert_int_equal(program_run(&program, "run entity.k"), BILLOW_EXIT_NORMAL);
    assert_true(program_read(&program, "entity.results/gceout.csv", rows, sizeof rows));
    assert_int_equal(strncmp(rows, "time,entity,part,fx,fy,fz,mx,my,mz\n", 35), 0);
    double least = 0, time, f[6];
    int entity, part;
    for (char *line = strchr(rows, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
        assert_int_equal(sscanf(line + 1, "%lf,%d,%d,%lf,%lf,%lf,%lf,%lf,%lf", &time, &entity, &part, f, f + 1, f + 2,
                                f + 3, f + 4, f + 5),
                         9);
        assert_true(entity == 1 && part == 2);
        least = fmin(least, f[0]);
        /* it acts on the corner (1, 1) of the sheet, from the body's centre (0.5, 0.5, 1) */
        assert_true(fabs(f[0] - f[1]) <= 1e-9 * fabs(f[0]) && fabs(f[5]) <= 1e-9 * fabs(f[0]));
    }
    assert_true(least < 0);
    program_close(&program);
}

/* What check says of rigid parts: two cubes in each other, one with a corner pushed in, an open sheet. */
static void test_rigid_shapes(void **state)
{
    (void)state;
    static Program program;
    char text[6000];
    int length = snprintf(text, sizeof text,
                          "*CONTROL_TERMINATION\n1e-3\n*SECTION_SOLID\n1\n*SECTION_SHELL\n2,9\n.01\n"
                          "*MAT_RIGID\n1,800\n\n\n*PART\na\n1,1,1\n*PART\nb\n2,1,1\n"
                          "*PART\nc\n3,1,1\n*PART\nd\n4,2,1\n*NODE\n");
    for (int cube = 0; cube < 3; cube++)
        for (int i = 0; i < 8; i++) {
            double x = (i % 4 == 1 || i % 4 == 2) + 0.75 * cube + 5 * (cube == 2), y = i % 4 >= 2, z = i >= 4;
            if (cube == 2 && i == 6) x -= 0.5, y -= 0.5, z -= 0.5;
            length += snprintf(text + length, sizeof text - (size_t)length, "%d,%g,%g,%g\n", 8 * cube + i + 1, x, y, z);
        }
    length += snprintf(text + length, sizeof text - (size_t)length,
                       "25,20,0,0\n26,21,0,0\n27,21,1,0\n28,20,1,0\n*ELEMENT_SHELL\n9,4,25,26,27,28\n"
                       "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n2,2,9,10,11,12,13,14,15,16\n"
                       "3,3,17,18,19,20,21,22,23,24\n*END\n");
    program_open(&program);
    program_write(&program, "rigid.k", text, (size_t)length);
    assert_int_equal(program_run(&program, "check rigid.k"), BILLOW_EXIT_NORMAL);
    const char *expected[] = {"part 1: closed and convex", "part 2: closed and convex", "part 3: closed, not convex",
                              "part 4: not closed", "parts 1 and 2 lie in each other at the start, by up to 0.25 at"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!strstr(program.out, expected[i])) fail_msg("%s\nlacks: %s", program.out, expected[i]);
    program_close(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cards), cmocka_unit_test(test_wrong_fields),       cmocka_unit_test(test_wrong_models),
        cmocka_unit_test(test_model), cmocka_unit_test(test_report_and_results), cmocka_unit_test(test_rigid_shapes)};
    return cmocka_run_group_tests_name("cards of contact entities", tests, NULL, NULL);
}

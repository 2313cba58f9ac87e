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
    assert_one_error(ENTITY("1,6,1", "0"), 2, k, "GEOTYP = 6 (CAL3D or MADYMO plane)");
    assert_one_error(ENTITY("1,8,1", "0"), 2, k, "GEOTYP = 8 (VDA surface)");
    assert_one_error(ENTITY("1,12,1", "0"), 2, k, "GEOTYP = 12 is no shape");
    assert_one_error(ENTITY("1,-2,1", "0"), 2, k, "GEOTYP = -2 is no shape; use 1 (plane)");
    assert_one_error(ENTITY("1,11,1", "0"), 6, k, "G1 = 0: with GEOTYP = 11 name the *DEFINE_CURVE");
    assert_one_error(ENTITY("1,11,1", "0,-3"), 6, k, "G1 = -3: with GEOTYP = 11");
    assert_one_error(ENTITY("1,11,1", "0,2.5"), 6, k, "G1");
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

/* What a shape does not use is listed. */
static void test_notes(void **state)
{
    (void)state;
    KeywordCase c = read_fine(ENTITY("7,5,1", "0,0,0,0,2,1,8,9") ENTITY("7,9,1", "0,0.1") ENTITY("7,11,1", "0,4,0,-1")
                                  ENTITY("7,10,1", "0,2,3") ENTITY("7,1,1", "0,0,0,0,0,0,1,5"));
    assert_int_equal(c.d.entities.count, 5);
    assert_int_equal(count_notes(&c, "G6 = 8 is read but not used with GEOTYP = 5"), 1);
    assert_int_equal(count_notes(&c, "G7 = 9 is read but not used with GEOTYP = 5"), 1);
    assert_int_equal(count_notes(&c, "G1 = 0.1 is read but not used with GEOTYP = 9"), 1);
    assert_int_equal(count_notes(&c, "G3 = -1 is read but not used with GEOTYP = 11"), 1);
    assert_int_equal(count_notes(&c, "G7 = 5 is read but not used with GEOTYP = 1"), 1);
    assert_int_equal(count_notes(&c, "is read but not used with"), 5);
    close_case(&c);
}

/* General x-y data: kept for a profile, told of if nothing uses it, never twice. */
static void test_outlines(void **state)
{
    (void)state;
    static const char outline[] = "*DEFINE_CURVE\n4,0,1,1,0,0,1\n0,0\n0,1\n1,1\n1,0\n";
    char text[1000];
    KeywordCase c;
    snprintf(text, sizeof text, "%s" ENTITY("7,11,1", "0,4"), outline);
    c = read_fine(text);
    assert_true(c.d.outlines.count == 1 && c.d.outlines.items[0].x.count == 4 && c.d.curves.count == 0);
    close_case(&c);
    c = read_case(outline);
    assert_true(c.status == 0 && c.g.warnings == 1);
    assert_true(verify_message(&c.g, SEVERITY_WARNING, "curve 4 is general x-y data"));
    close_case(&c);
    snprintf(text, sizeof text, "%s%s", outline, "*DEFINE_CURVE\n4\n0,0\n1,1\n");
    assert_one_error(text, 2, "*DEFINE_CURVE", "curve 4 is defined a second time (also in line 8)");
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

static void check_messages(VerifyRun *run, const char *const *expected, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!verify_message(&run->diagnostics, SEVERITY_ERROR, expected[i])) fail_msg("no error: %s", expected[i]);
    assert_int_equal(run->diagnostics.errors, count);
    verify_free(run);
}

static void test_wrong_models(void **state)
{
    (void)state;
    static const char *const expected[] = {"PID = 9 is not a part",
                                           "part 1 is not rigid",
                                           "SSID = 44 is not a part",
                                           "no set 77",
                                           "SSID = 3 of type 1 holds no nodes",
                                           "A (AX, AY, AZ) = (1, 0, 0) and B (BX, BY, BZ) = (2, 0, 0) make no local",
                                           "the normal of the plane",
                                           "G4 = 0: the radius of the sphere must be positive",
                                           "the axis of the cylinder",
                                           "G7 = 0: the radius of the cylinder",
                                           "G6 = -1: half an axis",
                                           "G7 = 4, the order of the ellipsoid",
                                           "the mesh of part 2 is not closed"};
    VerifyRun run;
    assert_true(
        build(ENTITY("9,2,1,1", "0,0,0,0,1") ENTITY("1,2,1,1", "0,0,0,0,1") ENTITY("2,2,44,1", "0,0,0,0,1")
                  ENTITY("2,2,77,0", "0,0,0,0,1")
                      ENTITY("2,2,3,1", "0,0,0,0,1") "*CONTACT_ENTITY\n2,2,1,1\n\n0,0,0,1\n2,0,0\n0,0,0,0,1\n" ENTITY(
                          "2,1,1,1", "0") ENTITY("2,2,1,1", "0") ENTITY("2,3,1,1", "0,0,0,0,0,0,0,1")
                          ENTITY("2,3,1,1", "0,0,0,0,0,0,1") ENTITY("2,4,1,1", "0,0,0,0,1,1,-1")
                              ENTITY("2,4,1,1", "0,0,0,0,1,1,1,4") ENTITY("2,9,1,1", "0"),
              &run) != 0);
    check_messages(&run, expected, sizeof expected / sizeof *expected);
}

#define PROFILE_CURVE(id, points) "*DEFINE_CURVE\n" id ",0,1,1,0,0,1\n" points

static void test_wrong_sizes(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "G4 = 0: the radius of the torus",
        "G5 = -1: the radius of the tube",
        "G5 = 2, the radius of the tube, is larger than G4 = 1",
        "G1 = -2: the side of the finite plane along A",
        "G2 = 0: the side of the finite plane along B",
        "G1 = 33: there is no curve of this id",
        "G1 = 4: the profile, point 2 at z = 1 with r = -1, has a radius below 0",
        "G1 = 5: the profile, point 1 at z = 2 with r = 0, has less than two",
        "G1 = 6: the profile, point 2 at z = 1 with r = 0, has a point on the axis",
        "G1 = 7: the profile, point 2 at z = 1 with r = 2, crosses or touches itself",
        "has no inside; let it run along the third axis"};
    VerifyRun run;
    assert_true(
        build(ENTITY("2,5,1,1", "0,0,0,0,0,1") ENTITY("2,5,1,1", "0,0,0,0,1,-1") ENTITY("2,5,1,1", "0,0,0,0,1,2")
                  ENTITY("2,10,1,1", "0,-2,1") ENTITY("2,10,1,1", "0,1") ENTITY("2,11,1,1", "0,33")
                      ENTITY("2,11,1,1", "0,4") ENTITY("2,11,1,1", "0,5") ENTITY("2,11,1,1", "0,6")
                          ENTITY("2,11,1,1", "0,7") ENTITY("2,11,1,1", "0,8") PROFILE_CURVE("4", "0,1\n1,-1\n")
                              PROFILE_CURVE("5", "2,0\n") PROFILE_CURVE("6", "0,1\n1,0\n2,1\n")
                                  PROFILE_CURVE("7", "0,1\n1,2\n1,1\n0,2\n") PROFILE_CURVE("8", "1,0\n1,3\n"),
              &run) != 0);
    check_messages(&run, expected, sizeof expected / sizeof *expected);
    assert_true(build(ENTITY("2,5,1,1", "0,0,0,0,0,1"), &run) != 0); /* the card's line is in the message */
    assert_int_equal(run.diagnostics.messages[0].source.line, 38);
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

/* Where the shapes are, and what check says of them. */
static void test_shapes(void **state)
{
    (void)state;
    static Program program;
    char text[6000];
    static const char cards[] = "*CONTACT_ENTITY\n2,5,1,1\n\n1,2,3,0,1\n-1\n0,1,2,3,4,0.5\n"
                                "2,10,1,1\n\n0.5,0.5,0.25,0,1\n-1\n0,2,3\n"
                                "2,11,1,1\n\n0.5,0.5,0.25,1\n0,1\n0,9\n"
                                "*DEFINE_CURVE\n9,0,1,2\n0,0\n0.5,1\n1.5,1\n";
    int length = snprintf(text, sizeof text, "%s%s*END\n", model_head, cards);
    VerifyRun run;
    assert_int_equal(build(cards, &run), 0);
    const ContactEntity *e = run.model.entities;
    assert_true(e->shape == ENTITY_TORUS && fabs(e->origin[0] + 1) < 1e-14 && fabs(e->origin[1] - 3) < 1e-14 &&
                fabs(e->origin[2] - 6) < 1e-14 && e->size[0] == 4 && e->size[1] == 0.5 && !e->open);
    assert_true(e[1].open && e[1].origin[0] == 0.5 && e[1].size[0] == 1 && e[1].size[1] == 1.5);
    assert_true(e[2].open && e[2].profile.edge_count == 2 && e[2].profile.end[0] == 2 && e[2].profile.end[1] == 1.5);
    verify_free(&run);
    program_open(&program);
    program_write(&program, "shapes.k", text, (size_t)length);
    assert_int_equal(program_run(&program, "check shapes.k"), BILLOW_EXIT_NORMAL);
    const char *expected[] = {
        "entity 1: torus on rigid part 2, at (-1, 3, 6), radius 4 of a tube of radius 0.5; 4 nodes",
        "entity 2: finite plane on rigid part 2, at (0.5, 0.5, 0.25), 2 x 3, corners (2, -0.5, 0.25), (2, 1.5, 0.25), "
        "(-1, 1.5, 0.25), (-1, -0.5, 0.25); 4 nodes\n    at the start 4 of them are behind it; it holds only what "
        "comes "
        "through it later",
        "entity 3: body of revolution on rigid part 2, at (0.5, 0.5, 0.25), z from 0 to 1.5, radius up to 2, 2 edges, "
        "open "
        "at z = 1.5; 4 nodes\n    at the start none of them is within it"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!strstr(program.out, expected[i])) fail_msg("%s\nlacks: %s", program.out, expected[i]);
    program_close(&program);
}

/* Offsets and factors of an include: lengths are scaled, the profile's curve is found; it has its own units. */
static void test_include(void **state)
{
    (void)state;
    static Program program;
    char text[6000];
    static const char shapes[] = "*CONTACT_ENTITY\n2,5,1,1\n\n0.1,0.2,0.3,1\n0,1\n0,0.1,0,0,0.4,0.05\n"
                                 "2,10,1,1\n\n\n\n0,0.2,0.3\n2,11,1,1\n\n\n\n0,9\n"
                                 "*DEFINE_CURVE\n9\n0,1\n2,1\n";
    static const char wrong[] = "*CONTACT_ENTITY\n2,5,1,1\n\n\n\n0,0,0,0,1,2\n";
    int length =
        snprintf(text, sizeof text, "%s*INCLUDE_TRANSFORM\nshapes.k\n0,0,0,0,0,600\n\n1,1,10\n\n*END\n", model_head);
    program_open(&program);
    program_write(&program, "include.k", text, (size_t)length);
    program_write(&program, "shapes.k", shapes, sizeof shapes - 1);
    assert_int_equal(program_run(&program, "check include.k"), BILLOW_EXIT_NORMAL);
    const char *expected[] = {"torus on rigid part 2, at (2, 2, 3), radius 4 of a tube of radius 0.5",
                              "finite plane on rigid part 2, at (0, 0, 0), 2 x 3, corners",
                              "body of revolution on rigid part 2, at (0, 0, 0), z from 0 to 2, radius up to 1"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!strstr(program.out, expected[i])) fail_msg("%s\nlacks: %s", program.out, expected[i]);
    assert_true(strstr(program.out, "curve 609 is not converted") || strstr(program.err, "curve 609 is not converted"));
    program_write(&program, "wrong.k", text, (size_t)length - 5);
    program_write(&program, "shapes.k", wrong, sizeof wrong - 1);
    assert_int_equal(program_run(&program, "check wrong.k"), BILLOW_EXIT_INPUT);
    assert_non_null(
        strstr(program.err, "shapes.k:6: error: *CONTACT_ENTITY: G5 = 20, the radius of the tube, is larger"));
    program_close(&program);
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_cards),
                                       cmocka_unit_test(test_wrong_fields),
                                       cmocka_unit_test(test_notes),
                                       cmocka_unit_test(test_outlines),
                                       cmocka_unit_test(test_wrong_models),
                                       cmocka_unit_test(test_wrong_sizes),
                                       cmocka_unit_test(test_model),
                                       cmocka_unit_test(test_shapes),
                                       cmocka_unit_test(test_report_and_results),
                                       cmocka_unit_test(test_rigid_shapes),
                                       cmocka_unit_test(test_include)};
    return cmocka_run_group_tests_name("cards of contact entities", tests, NULL, NULL);
}

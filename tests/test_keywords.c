/* Readers of the model's keywords: nodes, elements, parts, sections, materials, sets, curves, coordinates. */
#include "tests/keyword_case.h"

static void test_nodes(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*KEYWORD\n"
                              "*TITLE\nA bag\n"
                              "*NODE\n"
                              "$ comment\n"
                              "       1             1.5            -2.0         3.0E+01       7       0\n"
                              "      42 1.000000000E+00-2.50000000E+01 3.000000000E-01\n"
                              "*NODE\n"
                              "7,1.,2.,3.,1\n"
                              "*END\n");
    assert_string_equal(c.d.title, "A bag");
    assert_int_equal(c.d.nodes.count, 3);
    const NodeDefinition *n = c.d.nodes.items;
    assert_int_equal(n[0].id, 1);
    assert_float_equal(n[0].x[1], -2.0, 0);
    assert_float_equal(n[0].x[2], 30.0, 0);
    assert_int_equal(n[0].tc, 7);
    assert_int_equal(n[0].source.line, 6);
    assert_int_equal(n[1].id, 42);
    assert_float_equal(n[1].x[1], -25.0, 0);
    assert_float_equal(n[1].x[2], 0.3, 0);
    assert_int_equal(n[2].id, 7);
    assert_int_equal(n[2].tc, 1);
    close_case(&c);
}

static void assert_shell(const ShellDefinition *s, int id, int a, int b, int c, int d)
{
    assert_int_equal(s->id, id);
    assert_int_equal(s->node[0], a);
    assert_int_equal(s->node[1], b);
    assert_int_equal(s->node[2], c);
    assert_int_equal(s->node[3], d);
}

static void test_shells(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*ELEMENT_SHELL\n"
                              "      11       3     101     102     103     104\n"
                              "      12       3     101     102     103     103\n"
                              "      13       3     101     102     103       0\n"
                              "      14       3     101     101     103     104\n"
                              "      15       3     101     102     102     104\n"
                              "      16       3     101     102     103     101\n"
                              "*ELEMENT_SHELL_THICKNESS_BETA\n"
                              "      17       3     101     101     103     104\n"
                              "             0.1             0.2             0.3             0.4            45.0\n"
                              "*ELEMENT_SHELL_THICKNESS\n"
                              "      18       3     101     102     103     104\n"
                              "             0.1             0.2             0.3             0.4\n"
                              "*ELEMENT_SHELL_MCID\n"
                              "      19       3     101     102     103     104\n"
                              "                                                                               9\n");
    const ShellDefinition *s = c.d.shells.items;
    assert_int_equal(c.d.shells.count, 9);
    assert_shell(&s[0], 11, 101, 102, 103, 104);
    assert_shell(&s[1], 12, 101, 102, 103, 103);
    assert_shell(&s[2], 13, 101, 102, 103, 103);
    assert_shell(&s[3], 14, 101, 103, 104, 104);
    assert_shell(&s[4], 15, 101, 102, 104, 104);
    assert_shell(&s[5], 16, 101, 102, 103, 103);
    assert_int_equal(s[0].part, 3);
    assert_false(s[0].has_beta);
    assert_shell(&s[6], 17, 101, 103, 104, 104);
    assert_true(s[6].has_beta);
    assert_float_equal(s[6].beta, 45.0, 0);
    assert_float_equal(s[6].thickness[0], 0.1, 0);
    assert_float_equal(s[6].thickness[1], 0.3, 0);
    assert_float_equal(s[6].thickness[3], 0.4, 0);
    assert_false(s[7].has_beta);
    assert_float_equal(s[7].thickness[3], 0.4, 0);
    assert_int_equal(s[8].mcid, 9);
    close_case(&c);
}

static void test_parts_and_sections(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*PART\n"
                              "Upper panel\n"
                              "         5         6         7         0         8\n"
                              "\n"
                              "         9         6         7\n"
                              "*SECTION_SHELL_TITLE\n"
                              "fabric\n"
                              "         6         9       1.0         3       0.0         0         1\n"
                              "      0.25                 0.5                          1E-3\n"
                              "      30.0      40.0      50.0\n"
                              "next\n"
                              "         7\n"
                              "       0.4\n"
                              "*HOURGLASS\n"
                              "         8         4      0.05\n"
                              "         9\n"
                              "*CONSTRAINED_ADAPTIVITY\n"
                              "        30        10        20\n");
    assert_int_equal(c.d.parts.count, 2);
    assert_string_equal(c.d.parts.items[0].title, "Upper panel");
    assert_int_equal(c.d.parts.items[0].id, 5);
    assert_int_equal(c.d.parts.items[0].section, 6);
    assert_int_equal(c.d.parts.items[0].material, 7);
    assert_int_equal(c.d.parts.items[0].hourglass, 8);
    assert_string_equal(c.d.parts.items[1].title, "");
    assert_int_equal(c.d.parts.items[1].id, 9);
    assert_int_equal(c.d.sections.count, 2);
    const SectionShellDefinition *s = c.d.sections.items;
    assert_int_equal(s[0].elform, 9);
    assert_int_equal(s[0].icomp, 1);
    assert_int_equal(s[0].beta_count, 3);
    assert_float_equal(s[0].beta[0], 30.0, 0);
    assert_float_equal(s[0].t[0], 0.25, 0);
    assert_float_equal(s[0].t[1], 0.25, 0);
    assert_float_equal(s[0].t[2], 0.5, 0);
    assert_float_equal(s[0].marea, 1e-3, 0);
    assert_int_equal(s[1].id, 7);
    assert_int_equal(s[1].elform, 2);
    assert_float_equal(s[1].t[3], 0.4, 0);
    assert_int_equal(count_notes(&c, "NIP (columns 31-40) = 3"), 1);
    assert_int_equal(c.d.hourglasses.count, 2);
    assert_float_equal(c.d.hourglasses.items[0].qm, 0.05, 0);
    assert_float_equal(c.d.hourglasses.items[1].qm, 0.1, 0);
    assert_int_equal(c.d.adaptivities.items[0].dnid, 30);
    assert_int_equal(c.d.adaptivities.items[0].nid1, 10);
    assert_int_equal(c.d.adaptivities.items[0].nid2, 20);
    close_case(&c);
}

static void test_fabric(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*MAT_FABRIC_TITLE\n"
                              "Nylon\n"
                              "         17.86000E-7       0.3       0.2                0.21      0.22\n"
                              "      0.04                           1.0      0.06      0.35       0.1       0.2\n"
                              "       2.0       0.0       0.0       0.0       0.0         1         0       0.0\n"
                              "                 0.0         0       1.0       2.0       3.0       0.0       0.0\n"
                              "       4.0       5.0       6.0                                    15.0         0\n"
                              "*MAT_034\n"
                              "         2    1.0E-4    2.0E+6\n"
                              "\n"
                              "                                                           2\n");
    assert_int_equal(c.d.materials.count, 2);
    const MaterialDefinition *m = &c.d.materials.items[0];
    const FabricCard *f = &m->fabric;
    assert_int_equal(m->kind, MATERIAL_FABRIC);
    assert_string_equal(m->title, "Nylon");
    assert_int_equal(m->id, 1);
    assert_float_equal(m->ro, 7.86e-7, 0);
    assert_float_equal(f->ea, 0.3, 0);
    assert_float_equal(f->eb, 0.2, 0);
    assert_float_equal(f->prba, 0.21, 0);
    assert_float_equal(f->prab, 0.22, 0);
    assert_float_equal(f->gab, 0.04, 0);
    assert_float_equal(f->cse, 1.0, 0);
    assert_float_equal(f->el, 0.06, 0);
    assert_float_equal(f->prl, 0.35, 0);
    assert_float_equal(f->lratio, 0.1, 0);
    assert_float_equal(f->damp, 0.2, 0);
    assert_float_equal(f->aopt, 2.0, 0);
    assert_int_equal(f->form, 1);
    assert_float_equal(f->a1, 1.0, 0);
    assert_float_equal(f->a3, 3.0, 0);
    assert_float_equal(f->v1, 4.0, 0);
    assert_float_equal(f->v3, 6.0, 0);
    assert_float_equal(f->beta, 15.0, 0);
    assert_int_equal(c.d.materials.items[1].fabric.form, 2);
    assert_float_equal(c.d.materials.items[1].fabric.ea, 2e6, 0);
    close_case(&c);
}

static void test_other_materials(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*MAT_ELASTIC\n"
                              "         1    1.2E-6       5.0       0.3\n"
                              "*MAT_009\n"
                              "         2    1.3E-6\n"
                              "*MAT_RIGID_TITLE\n"
                              "Nozzle\n"
                              "         37.80000E-6     200.0       0.3       0.0       0.0       0.0          \n"
                              "      -1.0         4    110111\n"
                              "       0.0\n"
                              "*MAT_020\n"
                              "         4    7.8E-6     200.0       0.3                                       0\n"
                              "       1.0         7         7\n");
    assert_int_equal(c.d.materials.count, 4);
    const MaterialDefinition *m = c.d.materials.items;
    assert_int_equal(m[0].kind, MATERIAL_ELASTIC);
    assert_float_equal(m[0].e, 5.0, 0);
    assert_float_equal(m[0].pr, 0.3, 0);
    assert_int_equal(m[1].kind, MATERIAL_NULL);
    assert_float_equal(m[1].ro, 1.3e-6, 0);
    assert_int_equal(m[2].kind, MATERIAL_RIGID);
    assert_string_equal(m[2].title, "Nozzle");
    assert_float_equal(m[2].ro, 7.8e-6, 0);
    assert_float_equal(m[2].rigid.cmo, -1.0, 0);
    assert_float_equal(m[2].rigid.con1, 4.0, 0);
    assert_float_equal(m[2].rigid.con2, 110111.0, 0);
    assert_float_equal(m[3].rigid.con2, 7.0, 0);
    assert_string_equal(m[3].rigid.alias, "");
    close_case(&c);
}

static void test_sets(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*SET_NODE_LIST_TITLE\n"
                              "rim\n"
                              "         1       0.0       0.0       0.0       0.0MECH\n"
                              "         1         2         3         4         5         6         7         8\n"
                              "         9         0         0\n"
                              "*SET_PART_LIST\n"
                              "         1                                        MECH\n"
                              "         3         4         0         0         0         0         0         0\n"
                              "*SET_NODE_LIST_GENERATE\n"
                              "         2\n"
                              "        10        20        30        40\n"
                              "*SET_SHELL_GENERATE_INCREMENT\n"
                              "         3\n"
                              "         1       101        10\n"
                              "*SET_NODE_COLUMN\n"
                              "         4\n"
                              "        71\n"
                              "        72\n"
                              "*SET_NODE_GENERAL\n"
                              "         5\n"
                              "part               1         2\n"
                              "DNODE             17\n"
                              "*SET_SEGMENT\n"
                              "         1       0.0       0.0       0.0       0.0MECH               0\n"
                              "        11        12        13        14       0.0\n"
                              "        21        22        23\n"
                              "*SET_SEGMENT_GENERAL_TITLE\n"
                              "named\n"
                              "         2\n"
                              "SET_SHELL          3\n");
    const SetDefinition *s = c.d.sets.items;
    assert_int_equal(c.d.sets.count, 8);
    assert_string_equal(s[0].title, "rim");
    assert_int_equal(s[0].kind, SET_NODE);
    assert_int_equal(s[0].members.count, 9);
    assert_int_equal(s[0].members.items[8], 9);
    assert_int_equal(s[1].kind, SET_PART);
    assert_int_equal(s[1].members.count, 2);
    assert_int_equal(s[2].clauses.count, 2);
    assert_string_equal(s[2].clauses.items[1].option, "RANGE");
    assert_float_equal(s[2].clauses.items[1].e[0], 30, 0);
    assert_float_equal(s[2].clauses.items[1].e[1], 40, 0);
    assert_float_equal(s[2].clauses.items[1].e[2], 1, 0);
    assert_int_equal(s[3].kind, SET_SHELL);
    assert_float_equal(s[3].clauses.items[0].e[2], 10, 0);
    assert_int_equal(s[4].members.items[1], 72);
    assert_string_equal(s[5].clauses.items[0].option, "PART");
    assert_float_equal(s[5].clauses.items[0].e[1], 2, 0);
    assert_string_equal(s[5].clauses.items[1].option, "DNODE");
    assert_int_equal(s[6].kind, SET_SEGMENT);
    assert_int_equal(s[6].segments.count, 2);
    assert_int_equal(s[6].segments.items[0].node[3], 14);
    assert_int_equal(s[6].segments.items[1].node[3], 23);
    assert_string_equal(s[7].title, "named");
    assert_string_equal(s[7].clauses.items[0].option, "SET_SHELL");
    close_case(&c);
}

static void test_curves(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*DEFINE_CURVE_TITLE\n"
                              "Mass flow\n"
                              "         1         0       2.0       0.0       0.5       0.0         0         0\n"
                              "                 0.0                 0.0\n"
                              "                30.0                0.01\n"
                              "                30.0                0.01\n"
                              "                40.0                 0.0\n"
                              "*DEFINE_CURVE\n"
                              "2\n"
                              "0.,1.\n");
    assert_int_equal(c.d.curves.count, 2);
    const CurveDefinition *curve = c.d.curves.items;
    assert_string_equal(curve[0].title, "Mass flow");
    assert_float_equal(curve[0].sfa, 2.0, 0);
    assert_float_equal(curve[0].sfo, 1.0, 0);
    assert_float_equal(curve[0].offa, 0.5, 0);
    assert_int_equal(curve[0].x.count, 3);
    assert_float_equal(curve[0].x.items[1], 30.0, 0);
    assert_float_equal(curve[0].y.items[1], 0.01, 0);
    assert_int_equal(curve[0].lines.items[2], 7);
    assert_float_equal(curve[1].y.items[0], 1.0, 0);
    close_case(&c);
}

static void test_coordinates(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*DEFINE_COORDINATE_NODES\n"
                              "         1        10        20        30         1         Y\n"
                              "         2        10        20        30\n"
                              "*DEFINE_COORDINATE_SYSTEM_TITLE\n"
                              "local\n"
                              "         3       1.0       2.0       3.0       4.0       5.0       6.0         1\n"
                              "       7.0       8.0       9.0\n"
                              "*DEFINE_COORDINATE_VECTOR\n"
                              "         4       1.0       0.0       0.0       0.0       1.0       0.0         0\n"
                              "*DEFINE_VECTOR\n"
                              "         5       1.0       2.0       3.0       4.0       5.0       6.0         4\n"
                              "*DEFINE_BOX\n"
                              "         6      -1.0       1.0      -2.0       2.0      -3.0       3.0\n");
    const CoordinateDefinition *s = c.d.coordinates.items;
    assert_int_equal(c.d.coordinates.count, 4);
    assert_int_equal(s[0].kind, COORDINATE_NODES);
    assert_int_equal(s[0].node[2], 30);
    assert_int_equal(s[0].flag, 1);
    assert_int_equal(s[0].dir, 'Y');
    assert_int_equal(s[1].dir, 'X');
    assert_int_equal(s[2].kind, COORDINATE_SYSTEM);
    assert_float_equal(s[2].origin[2], 3.0, 0);
    assert_float_equal(s[2].x_point[0], 4.0, 0);
    assert_float_equal(s[2].xy_point[2], 9.0, 0);
    assert_int_equal(s[2].cidl, 1);
    assert_int_equal(s[3].kind, COORDINATE_VECTOR);
    assert_float_equal(s[3].x_point[0], 1.0, 0);
    assert_float_equal(s[3].xy_point[1], 1.0, 0);
    assert_float_equal(c.d.vectors.items[0].tail[1], 2.0, 0);
    assert_float_equal(c.d.vectors.items[0].head[2], 6.0, 0);
    assert_int_equal(c.d.vectors.items[0].cid, 4);
    assert_float_equal(c.d.boxes.items[0].low[1], -2.0, 0);
    assert_float_equal(c.d.boxes.items[0].high[2], 3.0, 0);
    close_case(&c);
}

/* What stands in a local system or behind a sign follows an include's offsets; a turned include turns directions. */
static void test_transformed_include(void **state)
{
    (void)state;
    FILE *file = fopen("test_keywords_part.k", "w");
    assert_non_null(file);
    fputs("*NODE\n"
          "       1             1.0             0.0             0.0\n"
          "*MAT_FABRIC\n"
          "         1    1.0E-4    2.0E+6\n"
          "\n"
          "      -3.0\n"
          "                                     1.0       0.0       0.0\n"
          "*SET_NODE_GENERAL\n"
          "         1\n"
          "NODE               1\n"
          "*DEFINE_BOX\n"
          "         6      -1.0       1.0      -2.0       2.0      -3.0       3.0\n"
          "*DEFINE_CURVE\n"
          "         1\n"
          "                 0.0                 0.0\n",
          file);
    fclose(file);
    KeywordCase c = read_case("*DEFINE_TRANSFORMATION\n"
                              "         1\n"
                              "ROTATE           0.0       0.0       1.0       0.0       0.0       0.0      90.0\n"
                              "*INCLUDE_TRANSFORM\n"
                              "test_keywords_part.k\n"
                              "       100       200       300       400       500       600       700\n"
                              "       800\n"
                              "       1.0       1.0      10.0\n"
                              "         1\n");
    remove("test_keywords_part.k");
    assert_int_equal(c.d.nodes.items[0].id, 101);
    assert_float_equal(c.d.nodes.items[0].x[0], 0.0, 1e-12);
    assert_float_equal(c.d.nodes.items[0].x[1], 10.0, 1e-12);
    assert_int_equal(c.d.materials.items[0].id, 401);
    assert_float_equal(c.d.materials.items[0].fabric.aopt, -703.0, 0);
    assert_float_equal(c.d.materials.items[0].fabric.a1, 0.0, 1e-12);
    assert_float_equal(c.d.materials.items[0].fabric.a2, 1.0, 1e-12);
    assert_int_equal(c.d.sets.items[0].id, 501);
    assert_float_equal(c.d.sets.items[0].clauses.items[0].e[0], 101, 0);
    assert_int_equal(c.d.curves.items[0].id, 601);
    assert_int_equal(c.d.boxes.count, 0);
    assert_int_equal(c.g.errors, 1);   /* the turned box */
    assert_int_equal(c.g.warnings, 1); /* the curve in other units */
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes),
        cmocka_unit_test(test_shells),
        cmocka_unit_test(test_parts_and_sections),
        cmocka_unit_test(test_fabric),
        cmocka_unit_test(test_other_materials),
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_curves),
        cmocka_unit_test(test_coordinates),
        cmocka_unit_test(test_transformed_include),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Readers of what acts on the model: control, output, supports, motions, velocities, loads, damping, airbags. */
#include "tests/keyword_case.h"

static void test_control(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*CONTROL_TERMINATION\n"
                              "      40.0       123      0.01       0.01.000000E8         0\n"
                              "*CONTROL_TIMESTEP\n"
                              "1.00000E-7       0.0         0       0.0   -1.0E-6         9         0         0\n"
                              "       0.0         0         0\n"
                              "*CONTROL_HOURGLASS\n"
                              "         4\n"
                              "*CONTROL_ENERGY\n"
                              "         2         2         1         1\n"
                              "*CONTROL_ACCURACY\n"
                              "         1         4\n"
                              "*CONTROL_BULK_VISCOSITY\n"
                              "       1.5      0.06        -2\n"
                              "*CONTROL_SHELL\n"
                              "      20.0         0        -1         1         2         2         1         0\n"
                              "       1.0         0         0         1\n"
                              "*CONTROL_OUTPUT\n"
                              "         1\n"
                              "*CONTROL_CONTACT\n"
                              "       0.0       1.0\n"
                              "*CONTROL_DYNAMIC_RELAXATION\n"
                              "       250     0.001     0.995                           0      0.04         0\n"
                              "*CONTROL_MPP_DECOMPOSITION_METHOD\n"
                              "RCB\n");
    const ControlDefinitions *k = &c.d.control;
    assert_true(k->termination.given);
    assert_float_equal(k->termination.endtim, 40.0, 0);
    assert_int_equal(k->termination.endcyc, 123);
    assert_float_equal(k->termination.dtmin, 0.01, 0);
    assert_float_equal(k->timestep.dtinit, 1e-7, 0);
    assert_float_equal(k->timestep.tssfac, 0.9, 0);
    assert_float_equal(k->timestep.dt2ms, -1e-6, 0);
    assert_int_equal(k->timestep.lctm, 9);
    assert_int_equal(k->hourglass.ihq, 4);
    assert_float_equal(k->hourglass.qh, 0.1, 0);
    assert_int_equal(k->energy.hgen, 2);
    assert_int_equal(k->energy.irgen, 2);
    assert_int_equal(k->accuracy.inn, 4);
    assert_int_equal(k->bulk_viscosity.type, -2);
    assert_int_equal(k->shell.istupd, 1);
    assert_int_equal(count_notes(&c, "is not used"), 1);
    assert_int_equal(count_notes(&c, "ISTUPD"), 1);
    close_case(&c);
}

static void test_database(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*CONTROL_TERMINATION\n"
                              "      40.0\n"
                              "*DATABASE_ABSTAT\n"
                              "2.00000E-4         1         0         1\n"
                              "*DATABASE_BINARY_D3PLOT\n"
                              "       0.7         0         0        80\n"
                              "*DATABASE_BINARY_D3DUMP\n"
                              "    5000.0\n"
                              "*DATABASE_EXTENT_BINARY\n"
                              "         0         0         3         1\n"
                              "*DATABASE_ELOUT\n"
                              "       0.1\n"
                              "*DATABASE_HISTORY_NODE\n"
                              "        11        12         0        14\n"
                              "*DATABASE_HISTORY_NODE_SET\n"
                              "         7\n"
                              "*DATABASE_HISTORY_NODE_ID\n"
                              "        21top of the bag\n"
                              "        22\n");
    assert_int_equal(c.d.databases.count, 3);
    assert_string_equal(c.d.databases.items[0].name, "ABSTAT");
    assert_float_equal(c.d.databases.items[0].dt, 2e-4, 0);
    assert_string_equal(c.d.databases.items[1].name, "BINARY_D3PLOT");
    assert_float_equal(c.d.databases.items[1].dt, 0.5, 0);
    assert_int_equal(c.d.databases.items[1].npltc, 80);
    assert_string_equal(c.d.databases.items[2].name, "BINARY_D3DUMP");
    assert_float_equal(c.d.databases.items[2].dt, 5000.0, 0);
    assert_int_equal(c.d.histories.count, 6);
    assert_int_equal(c.d.histories.items[2].id, 14);
    assert_true(c.d.histories.items[3].is_set);
    assert_int_equal(c.d.histories.items[3].id, 7);
    assert_int_equal(c.d.histories.items[5].id, 22);
    assert_int_equal(count_notes(&c, "billow does not write this result"), 1);
    close_case(&c);
}

static void test_boundary(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*BOUNDARY_SPC_NODE\n"
                              "        11         2         1         0         1         1         1         1\n"
                              "*BOUNDARY_SPC_SET_BIRTH_DEATH_ID\n"
                              "         5rim\n"
                              "        12         0         0         1         0\n"
                              "       1.0       2.0\n"
                              "         6\n"
                              "        13         0         1\n"
                              "\n"
                              "*BOUNDARY_PRESCRIBED_MOTION_SET_ID\n"
                              "         8pull\n"
                              "        14         4         2         3       0.0         9       0.0       0.5\n"
                              "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n"
                              "         2         3         0         1      -2.0\n"
                              "*BOUNDARY_PRESCRIBED_MOTION_NODE\n"
                              "        21         1         1         1\n"
                              "        22         2         1         1\n");
    const SpcDefinition *s = c.d.spcs.items;
    assert_int_equal(c.d.spcs.count, 3);
    assert_false(s[0].is_set);
    assert_int_equal(s[0].id, 11);
    assert_int_equal(s[0].cid, 2);
    assert_int_equal(s[0].dof[0], 1);
    assert_int_equal(s[0].dof[1], 0);
    assert_int_equal(s[0].dof[2], 1);
    assert_int_equal(s[0].dof[5], 1);
    assert_float_equal(s[0].death, 1e20, 0);
    assert_true(s[1].is_set);
    assert_int_equal(s[1].id, 12);
    assert_int_equal(s[1].dof[1], 1);
    assert_float_equal(s[1].birth, 1.0, 0);
    assert_float_equal(s[1].death, 2.0, 0);
    assert_int_equal(s[2].id, 13);
    assert_float_equal(s[2].death, 1e20, 0);
    const PrescribedMotionDefinition *m = c.d.motions.items;
    assert_int_equal(c.d.motions.count, 4);
    assert_int_equal(m[0].kind, MOTION_SET);
    assert_int_equal(m[0].id, 14);
    assert_int_equal(m[0].dof, 4);
    assert_int_equal(m[0].vad, 2);
    assert_int_equal(m[0].lcid, 3);
    assert_float_equal(m[0].sf, 1.0, 0);
    assert_int_equal(m[0].vid, 9);
    assert_float_equal(m[0].death, 1e28, 0);
    assert_float_equal(m[0].birth, 0.5, 0);
    assert_int_equal(m[1].kind, MOTION_RIGID);
    assert_float_equal(m[1].sf, -2.0, 0);
    assert_int_equal(m[3].kind, MOTION_NODE);
    assert_int_equal(m[3].id, 22);
    close_case(&c);
}

static void test_initial(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*INITIAL_VELOCITY\n"
                              "         1         2         3         0         4\n"
                              "       1.0       2.0       3.0\n"
                              "       4.0       5.0       6.0\n"
                              "*INITIAL_VELOCITY_NODE\n"
                              "        11       1.0       2.0       3.0       0.0       0.0       0.0         5\n"
                              "*INITIAL_VELOCITY_GENERATION\n"
                              "         2         2      10.0       1.0       2.0       3.0         0         6\n"
                              "       7.0       8.0       9.0       0.0       0.0       1.0\n"
                              "*INITIAL_VELOCITY_RIGID_BODY\n"
                              "         3       1.0       2.0       3.0       4.0       5.0       6.0\n");
    const InitialVelocityDefinition *v = c.d.velocities.items;
    assert_int_equal(c.d.velocities.count, 4);
    assert_int_equal(v[0].kind, VELOCITY_ALL);
    assert_int_equal(v[0].id, 1);
    assert_int_equal(v[0].nsidex, 2);
    assert_int_equal(v[0].boxid, 3);
    assert_int_equal(v[0].icid, 4);
    assert_float_equal(v[0].v[2], 3.0, 0);
    assert_float_equal(v[0].vx_exempt[1], 5.0, 0);
    assert_int_equal(v[1].kind, VELOCITY_NODE);
    assert_int_equal(v[1].icid, 5);
    assert_int_equal(v[2].kind, VELOCITY_GENERATION);
    assert_int_equal(v[2].styp, 2);
    assert_float_equal(v[2].omega, 10.0, 0);
    assert_float_equal(v[2].v[0], 1.0, 0);
    assert_float_equal(v[2].centre[1], 8.0, 0);
    assert_float_equal(v[2].axis[2], 1.0, 0);
    assert_int_equal(v[3].kind, VELOCITY_RIGID_BODY);
    assert_float_equal(v[3].w[2], 6.0, 0);
    close_case(&c);
}

static void test_loads(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*LOAD_NODE_POINT\n"
                              "        11         3         1      -2.0\n"
                              "*LOAD_NODE_SET\n"
                              "        12         4         1       0.0         0         5         6         7\n"
                              "*LOAD_SEGMENT\n"
                              "         2       0.0       0.5         1         2         3         0\n"
                              "*LOAD_SEGMENT_SET_ID\n"
                              "         9inner\n"
                              "        13         2       3.0       0.1\n"
                              "*LOAD_BODY_Z\n"
                              "         4      9.81\n"
                              "*LOAD_GRAVITY_PART\n"
                              "         1         3         0      9.81\n"
                              "*LOAD_GRAVITY_PART_SET\n"
                              "         2         1         4      1.62\n"
                              "*DAMPING_GLOBAL\n"
                              "         0       5.0       1.0\n"
                              "*DAMPING_GLOBAL\n"
                              "         6       5.0\n"
                              "*DAMPING_PART_MASS\n"
                              "         1         6       0.0         1\n"
                              "       1.0       0.5       0.0\n"
                              "         2         6       0.1\n");
    assert_int_equal(c.d.node_loads.count, 2);
    assert_float_equal(c.d.node_loads.items[0].sf, -2.0, 0);
    assert_int_equal(c.d.node_loads.items[0].dof, 3);
    assert_true(c.d.node_loads.items[1].is_set);
    assert_int_equal(c.d.node_loads.items[1].m3, 7);
    const SegmentLoadDefinition *s = c.d.segment_loads.items;
    assert_int_equal(c.d.segment_loads.count, 2);
    assert_int_equal(s[0].lcid, 2);
    assert_float_equal(s[0].sf, 1.0, 0);
    assert_float_equal(s[0].at, 0.5, 0);
    assert_int_equal(s[0].node[3], 3);
    assert_true(s[1].is_set);
    assert_int_equal(s[1].id, 13);
    assert_float_equal(s[1].sf, 3.0, 0);
    assert_int_equal(c.d.body_loads.items[0].axis, 2);
    assert_float_equal(c.d.body_loads.items[0].sf, 9.81, 0);
    assert_false(c.d.gravity_parts.items[0].is_set);
    assert_float_equal(c.d.gravity_parts.items[0].accel, 9.81, 0);
    assert_int_equal(c.d.gravity_parts.items[1].lc, 4);
    assert_int_equal(c.d.gravity_parts.items[1].dof, 1);
    const DampingDefinition *d = c.d.dampings.items;
    assert_int_equal(c.d.dampings.count, 4);
    assert_float_equal(d[0].sf, 5.0, 0);
    assert_float_equal(d[0].st[0], 1.0, 0);
    assert_float_equal(d[1].sf, 1.0, 0);
    assert_float_equal(d[2].st[1], 0.5, 0);
    assert_float_equal(d[2].sf, 1.0, 0);
    assert_int_equal(d[3].id, 2);
    assert_float_equal(d[3].sf, 0.1, 0);
    close_case(&c);
}

static void test_simple_airbag(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*AIRBAG_SIMPLE_AIRBAG_MODEL_ID\n"
                              "         7driver\n"
                              "         1         1         0       0.0       0.0       0.5       0.1       0.2\n"
                              "    1736.0    2430.0    1200.0         1       0.7       0.0      14.73.82100E-6\n"
                              "        12\n"
                              "*AIRBAG_SIMPLE_AIRBAG_MODEL\n"
                              "         2         0         0       2.0       3.0\n"
                              "       0.0       0.0     800.0         1     -11.0     -12.01.01300E-41.22500E-9\n"
                              "         0     293.0      27.0     0.002     0.028     8.314\n"
                              "*AIRBAG_SIMPLE_AIRBAG_MODEL\n"
                              "         3         1\n"
                              "   196.168     274.6     800.0         1       0.7       0.01.01300E-41.22500E-9\n");
    const AirbagDefinition *b = c.d.airbags.items;
    assert_int_equal(c.d.airbags.count, 3);
    assert_int_equal(b[0].id, 7);
    assert_string_equal(b[0].heading, "driver");
    assert_float_equal(b[0].vsca, 1.0, 0);
    assert_float_equal(b[0].psca, 1.0, 0);
    assert_float_equal(b[0].vini, 0.5, 0);
    assert_float_equal(b[0].mwd, 0.1, 0);
    assert_float_equal(b[0].spsf, 0.2, 0);
    assert_float_equal(b[0].cv, 1736.0, 0);
    assert_float_equal(b[0].pe, 14.7, 0);
    assert_float_equal(b[0].ro, 3.821e-6, 0);
    assert_int_equal(b[0].lou, 12);
    assert_int_equal(b[1].id, 0);
    assert_int_equal(b[1].sidtyp, 0);
    assert_float_equal(b[1].psca, 3.0, 0);
    assert_float_equal(b[1].mu, -11.0, 0);
    assert_float_equal(b[1].area, -12.0, 0);
    assert_float_equal(b[1].text, 293.0, 0);
    assert_float_equal(b[1].a, 27.0, 0);
    assert_float_equal(b[1].b, 0.002, 0);
    assert_float_equal(b[1].mw, 0.028, 0);
    assert_float_equal(b[1].gasc, 8.314, 0);
    assert_int_equal(b[2].lou, 0);
    assert_int_equal(b[2].card3.line, 12);
    close_case(&c);
}

static void test_wang_nefske(void **state)
{
    (void)state;
    KeywordCase c = read_fine("*AIRBAG_WANG_NEFSKE_ID\n"
                              "         1\n"
                              "         1         1         0       1.0       1.0       0.0       0.0       0.0\n"
                              "       0.0       0.0    3600.0         2         1       0.5         3     260.0\n"
                              "       0.7        -4       0.1         5       0.2         6    1500.0         7\n"
                              "3.0000E-103.9000E-15       1.0         8       0.3       0.4       0.0         0\n"
                              "\n"
                              "     293.0      27.0     0.002     0.028     8.314     -15.0\n"
                              "*AIRBAG_WANG_NEFSKE\n"
                              "         1         1\n"
                              "     896.0    1204.0    3600.0         0         1\n"
                              "\n"
                              "     0.1E0    1.2E-9       1.0\n");
    const AirbagDefinition *b = c.d.airbags.items;
    assert_int_equal(c.d.airbags.count, 2);
    assert_int_equal(b->model, AIRBAG_WANG_NEFSKE);
    assert_float_equal(b->t, 3600.0, 0);
    assert_int_equal(b->lct, 2);
    assert_int_equal(b->lcmt, 1);
    assert_float_equal(b->tvol, 0.5, 0);
    assert_int_equal(b->lcdt, 3);
    assert_float_equal(b->iabt, 260.0, 0);
    assert_float_equal(b->c23, 0.7, 0);
    assert_int_equal(b->lcc23, -4);
    assert_float_equal(b->a23, 0.1, 0);
    assert_int_equal(b->lca23, 5);
    assert_float_equal(b->cp23, 0.2, 0);
    assert_int_equal(b->lccp23, 6);
    assert_float_equal(b->ap23, 1500.0, 0);
    assert_int_equal(b->lcap23, 7);
    assert_float_equal(b->pe, 3e-10, 0);
    assert_float_equal(b->ro, 3.9e-15, 0);
    assert_float_equal(b->gc, 1.0, 0);
    assert_int_equal(b->lcefr, 8);
    assert_float_equal(b->pover, 0.3, 0);
    assert_float_equal(b->ppop, 0.4, 0);
    assert_float_equal(b->text, 293.0, 0);
    assert_float_equal(b->gasc, 8.314, 0);
    assert_float_equal(b->hconv, -15.0, 0);
    assert_int_equal(b->card7.line, 8);
    assert_float_equal(b[1].ro, 1.2e-9, 0);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_control),     cmocka_unit_test(test_database), cmocka_unit_test(test_boundary),
        cmocka_unit_test(test_initial),     cmocka_unit_test(test_loads),    cmocka_unit_test(test_simple_airbag),
        cmocka_unit_test(test_wang_nefske),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

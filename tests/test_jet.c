/* The shape of a jet's pressure: case B15 of the reference collection, conservation of momentum and of mass, wedge,
 * several jets by a curve, curves of CA and BETA. */
#include "airbag/jet.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "tests/verify.h"

static const double PI = 3.14159265358979323846;

static Jet cone(double angle, bool same_momentum)
{
    return (Jet){.angle = angle,
                 .angle_curve = -1,
                 .efficiency = 1,
                 .efficiency_curve = -1,
                 .velocity_curve = -1,
                 .knock_curve = -1,
                 .cut_off = 180,
                 .same_momentum = same_momentum,
                 .head = {0, 0, 2}};
}

static GasJet nitrogen(double flow)
{
    double r = 8.314462618 / 0.0280134;
    return (GasJet){.mass_flow = flow, .speed = sqrt(1.4 * r * 700), .density = 1.2, .conversion = 1};
}

static double pressure_at(const Jet *jet, const Curve *curves, const JetFrame *frame, double px, double py, double pz)
{
    double origin[3], point[3] = {px, py, pz};
    jet_origin(frame, point, origin);
    return frame->strength * jet_shape(jet, curves, frame, point, origin, 0.0);
}

/* Integral over the plane z, rings about the axis up to a radius. */
static double force_inside(const Jet *jet, const JetFrame *frame, double z, double radius)
{
    double sum = 0;
    int rings = 4000;
    for (int i = 0; i < rings; i++) {
        double r = radius * (i + 0.5) / rings;
        sum += pressure_at(jet, NULL, frame, r, 0, z) * 2 * PI * r * radius / rings;
    }
    return sum;
}

static void constant_momentum(void **state)
{
    (void)state;
    Jet jet = cone(0.2, true);
    GasJet gas = nitrogen(1);
    verify_close("B15 v outlet [m/s]", gas.speed, 539.320861, 1e-9);
    JetFrame frame = jet_frame(&jet, NULL, NULL, &gas, 0);
    verify_close("B15 peak [Pa]", pressure_at(&jet, NULL, &frame, 0, 0, 0.3), 95372.8677, 1e-8);
    double share[][2] = {{0.015, 0.117503}, {0.03, 0.393469}, {0.06, 0.864665}, {0.09, 0.988891}};
    for (int i = 0; i < 4; i++)
        verify_close("B15 share", force_inside(&jet, &frame, 0.3, share[i][0]) / 539.320861, share[i][1], 2e-6);
    for (double z = 0.1; z < 1; z += 0.2)
        verify_close("force at any distance [N]", force_inside(&jet, &frame, z, z), 539.320861 * (1 - exp(-10)), 2e-6);
    assert_true(pressure_at(&jet, NULL, &frame, 0, 0, -0.3) == 0); /* nothing behind */
}

/* The standard jet keeps mass: the velocity sqrt(p/rho) integrates to the flow; its momentum falls with 1/z^2. */
static void constant_mass(void **state)
{
    (void)state;
    Jet jet = cone(0.2, false);
    GasJet gas = nitrogen(0.7);
    JetFrame frame = jet_frame(&jet, NULL, NULL, &gas, 0);
    double flow = 0, z = 0.3;
    int rings = 4000;
    for (int i = 0; i < rings; i++) {
        double r = 0.5 * (i + 0.5) / rings;
        flow += 1.2 * sqrt(pressure_at(&jet, NULL, &frame, r, 0, z) / 1.2) * 2 * PI * r * 0.5 / rings;
    }
    verify_close("mass flow [kg/s]", flow, 0.7 * (1 - exp(-5)), 1e-4); /* the rim beyond e^-5 is left out */
    double width = 0.2 * z;
    verify_close("force [N]", force_inside(&jet, &frame, z, 1), 0.7 * 0.7 / (2 * 1.2 * PI * width * width), 1e-4);
}

/* Between the foci the jet is a slot: for any distance the momentum is the flow's. */
static void wedge(void **state)
{
    (void)state;
    for (int cm = 0; cm < 2; cm++) {
        Jet jet = cone(0.2, cm);
        jet.wedge = true;
        memcpy(jet.second, (double[]){0.25, 0, 0.1}, sizeof jet.second); /* its part along the axis does not count */
        GasJet gas = nitrogen(1);
        JetFrame frame = jet_frame(&jet, NULL, NULL, &gas, 0);
        verify_near("distance", frame.distance, 0.25, 1e-15);
        double force = 0, flow = 0, step = 0.002, z = 0.3;
        for (double px = -0.3; px < 0.55; px += step)
            for (double py = -0.3; py < 0.3; py += step) {
                double p = pressure_at(&jet, NULL, &frame, px + 0.5 * step, py + 0.5 * step, z);
                force += p * step * step;
                flow += 1.2 * sqrt(p / 1.2) * step * step;
            }
        if (cm) verify_close("force of the wedge [N]", force, 539.320861, 1e-4);
        if (!cm) verify_close("flow of the wedge [kg/s]", flow, 1, 1e-2);
        double origin[3];
        jet_origin(&frame, (double[]){0.1, 0.05, 0.3}, origin);
        verify_near("the nearest point of the focal line", origin[0], 0.1, 1e-15);
        jet_origin(&frame, (double[]){0.4, 0.05, 0.3}, origin);
        verify_near("its end", origin[0], 0.25, 1e-15);
    }
}

/* LCJRV over the angle: momentum or mass over the whole sphere; the cut-off. */
static void multiple(void **state)
{
    (void)state;
    double points[2][4] = {{0, 30, 90, 120}, {0, 0.2, 1, 1}}, area[4];
    Curve curve = {.count = 4, .x = points[0], .y = points[1], .area = area};
    curve_fill_area(&curve);
    for (int k = 0; k < 4; k++) {
        bool cm = k % 2, slot = k / 2;
        Jet jet = cone(0, cm);
        jet.multiple = true;
        jet.velocity_curve = 0;
        jet.cut_off = 100;
        jet.wedge = slot;
        jet.second[0] = 0.4;
        jet_spread(&jet, &curve);
        GasJet gas = nitrogen(1);
        JetFrame frame = jet_frame(&jet, &curve, NULL, &gas, 0);
        double force = 0, flow = 0, radius = 0.3, step = PI / 20000;
        for (double angle = 0.5 * step; angle < PI; angle += step) { /* half spheres at the ends, a tube between */
            double sine = sin(angle), p = pressure_at(&jet, &curve, &frame, 0, radius * sine, radius * cos(angle));
            double patch = (2 * PI * radius * radius * sine + 2 * (slot ? 0.4 : 0) * radius) * step;
            force += p * patch;
            flow += 1.2 * sqrt(p / 1.2) * patch;
        }
        if (cm) verify_close("momentum over the sphere [N]", force, 539.320861, 1e-3);
        if (!cm) verify_close("flow over the sphere [kg/s]", flow, 1, 1e-3);
        assert_true(pressure_at(&jet, &curve, &frame, 0, sin(99 / 57.2958), cos(99 / 57.2958)) > 0);
        assert_true(pressure_at(&jet, &curve, &frame, 0, sin(101 / 57.2958), cos(101 / 57.2958)) == 0);
    }
}

static void curves_over_time(void **state)
{
    (void)state;
    double t[2] = {0, 1}, y[2][2] = {{0.1, 0.3}, {0.5, 1.5}}, area[2];
    Curve curves[2] = {{.count = 2, .x = t, .y = y[0], .area = area}, {.count = 2, .x = t, .y = y[1], .area = area}};
    Jet jet = cone(-1, true), fixed = cone(0.2, true);
    jet.angle_curve = 0;
    jet.efficiency_curve = jet.knock_curve = 1;
    GasJet gas = nitrogen(1);
    JetFrame frame = jet_frame(&jet, curves, NULL, &gas, 0.5), same = jet_frame(&fixed, curves, NULL, &gas, 0.5);
    verify_close("CA", pressure_at(&jet, curves, &frame, 0.02, 0, 0.3),
                 pressure_at(&fixed, curves, &same, 0.02, 0, 0.3), 1e-12);
    frame = jet_frame(&jet, curves, NULL, &gas, 0.0);
    verify_close("BETA", frame.strength, 0.5 * 539.320861, 1e-9);
    verify_close("KNKDN", frame.knock, 0.5, 1e-15);
    gas.mass_flow = 0;
    frame = jet_frame(&jet, curves, NULL, &gas, 0.0);
    assert_false(frame.active);
    assert_true(frame.knock == 1);
}

/* One facet never takes more than the whole jet, however near it is. */
static void near_the_focus(void **state)
{
    (void)state;
    Jet jet = cone(0.2, true);
    GasJet gas = nitrogen(1);
    JetFrame frame = jet_frame(&jet, NULL, NULL, &gas, 0);
    double area = 1e-4;
    for (double z = 1e-6; z < 1; z *= 3)
        assert_true(area * frame.strength * jet_shape(&jet, NULL, &frame, (double[]){0, 0, z}, frame.focus, area) <=
                    539.320861 * (1 + 1e-9));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_momentum), cmocka_unit_test(constant_mass),    cmocka_unit_test(wedge),
        cmocka_unit_test(multiple),          cmocka_unit_test(curves_over_time), cmocka_unit_test(near_the_focus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

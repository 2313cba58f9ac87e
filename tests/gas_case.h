/* What the tests of the gas share: air, a rigid box, curves on the stack, a reference integrator. */
#ifndef BILLOW_TESTS_GAS_CASE_H
#define BILLOW_TESTS_GAS_CASE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "airbag/gas.h"

#define CASE_R (8.314462618 / 0.028964) /* air of the references, gamma = 1.4 */

/* A gas with its curves, scales and state; zero-initialise through case_air. */
typedef struct GasCase {
    GasModel gas;
    Curve curves[4];
    double x[4][16], y[4][16], area[4][16];
    int curve_count;
    double vsca, psca, vini;
    double volume, surface; /* of the mesh at the start */
    GasState state;
    double time;
} GasCase;

static inline void assert_relative(double value, double expected, double tolerance)
{
    double error = fabs(value - expected) / fmax(fabs(expected), 1e-300);
    if (!(error <= tolerance)) print_message("%.17g, expected %.17g: off by %.3g\n", value, expected, error);
    assert_true(error <= tolerance);
}

/* Air at p and T in a volume, ambient pressure 101325 at 296.15 K. */
static inline void case_air(GasCase *c, double volume, double temperature, double pressure)
{
    memset(c, 0, sizeof *c);
    gas_model_reset(&c->gas);
    c->gas.kind = GAS_WANG_NEFSKE;
    c->gas.cv = 2.5 * CASE_R;
    c->gas.cp = 3.5 * CASE_R;
    c->gas.ambient_pressure = 101325.0;
    c->gas.ambient_density = 101325.0 / (CASE_R * 296.15);
    c->gas.initial_temperature = temperature;
    c->gas.overpressure = pressure - 101325.0;
    c->vsca = c->psca = 1.0;
    c->volume = volume;
    c->surface = 0.8;
}

/* Adds a curve of count points (x, y, x, y, ...) and returns its index. */
static inline int case_curve(GasCase *c, int count, const double *points)
{
    int i = c->curve_count++;
    for (int k = 0; k < count; k++) {
        c->x[i][k] = points[2 * k];
        c->y[i][k] = points[2 * k + 1];
    }
    c->curves[i] = (Curve){.id = i + 1, .count = count, .x = c->x[i], .y = c->y[i], .area = c->area[i]};
    curve_fill_area(&c->curves[i]);
    return i;
}

static inline void case_start(GasCase *c)
{
    const char *why = NULL;
    int status = gas_initialize(&c->gas, c->curves, c->vsca, c->psca, c->vini, c->volume, c->surface, &c->state, &why);
    if (status) print_message("%s\n", why);
    assert_int_equal(status, 0);
    c->time = 0.0;
}

/* One step to the mesh volume. */
static inline void case_step(GasCase *c, double dt, double volume)
{
    const char *why = NULL;
    GasStep step = {.time = c->time, .dt = dt, .volume = volume, .area = c->surface};
    int status = gas_advance(&c->gas, c->curves, c->vsca, c->psca, c->vini, &step, &c->state, &why);
    if (status) print_message("at %.6g: %s\n", c->time, why);
    assert_int_equal(status, 0);
    c->time += dt;
}

/* Equal steps of about dt at the volume of the start up to a time. */
static inline void case_run(GasCase *c, double end, double dt)
{
    double begin = c->time;
    int count = (int)fmax(ceil((end - begin) / dt - 1e-9), 1.0);
    for (int i = 0; i < count; i++) {
        double next = begin + (end - begin) * (i + 1) / count;
        case_step(c, next - c->time, c->volume);
        c->time = next;
    }
}

/* Steps as gas_time_scale proposes them; returns their number. */
static inline int case_run_scaled(GasCase *c, double end)
{
    int count = 0;
    while (c->time < end) {
        double dt = gas_time_scale(&c->gas, c->curves, &c->state, c->time);
        assert_true(dt > 0.0 && dt <= 1e20);
        double next = c->time + dt < end ? c->time + dt : end;
        assert_true(next > c->time);
        case_step(c, next - c->time, c->volume);
        c->time = next;
        count++;
        assert_true(count < 1000000);
    }
    return count;
}

/* The ledger closes: mass and energy are what was there, came and left. */
static inline void case_check_ledger(const GasCase *c, double tolerance)
{
    const GasState *s = &c->state;
    double mass = s->initial_mass + s->mass_in - s->mass_out;
    double mass_scale = s->initial_mass + s->mass_in;
    double energy = s->initial_energy + s->enthalpy_in - s->enthalpy_out - s->heat_out - s->work;
    double energy_scale = s->initial_energy + s->enthalpy_in + fabs(s->heat_out) + fabs(s->work);
    if (!(fabs(mass - s->mass) <= tolerance * mass_scale) || !(fabs(energy - s->energy) <= tolerance * energy_scale))
        print_message("ledger: mass off by %.3g, energy by %.3g\n", (mass - s->mass) / mass_scale,
                      (energy - s->energy) / energy_scale);
    assert_true(fabs(mass - s->mass) <= tolerance * mass_scale);
    assert_true(fabs(energy - s->energy) <= tolerance * energy_scale);
}

#endif
